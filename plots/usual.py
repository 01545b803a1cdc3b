"""The granularity that each backend was measured with as a rule; figures show points of it."""


def of_backends(summary):
    """Return {backend: its granularity}: the one it was measured with at the most points."""
    counts = {}
    for entry in summary["points"]:
        some = counts.setdefault(entry["point"]["backend"], {})
        word = entry["point"]["granularity"]
        some[word] = some.get(word, 0) + 1
    return {backend: max(some, key=some.get) for backend, some in counts.items()}


def is_usual(summary):
    """Return a test of a table's row or a point: is it of its backend's usual granularity?

    A row that does not say its granularity passes.
    """
    words = of_backends(summary)
    return lambda row: row.get("granularity") in (None, words.get(row["backend"], row.get("granularity")))


def text(summary):
    """Say the usual granularities, or nothing if no backend was measured with several."""
    several = {backend: set() for backend in of_backends(summary)}
    for entry in summary["points"]:
        several[entry["point"]["backend"]].add(entry["point"]["granularity"])
    words = {backend: word for backend, word in of_backends(summary).items() if len(several[backend]) > 1}
    return ", ".join(f"{backend} {word}" for backend, word in words.items())
