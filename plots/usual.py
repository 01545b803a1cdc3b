"""The granularity, isa and block that each backend was measured with as a rule; figures show points of these."""

#: A point that does not say one of them (of an earlier version) has the usual one.
FIELDS = ("granularity", "isa", "block")


def of_backends(summary, field):
    """Return {backend: its usual word}: that of the most points; of several such the one with the fastest point."""
    found = {}
    for entry in summary["points"]:
        point = entry["point"]
        if point.get(field) is not None:
            times = found.setdefault(point["backend"], {}).setdefault(point[field], [])
            times.append(entry["phases"].get("sum_s", {}).get("median") or float("inf"))
    return {backend: max(words, key=lambda word: (len(words[word]), -min(words[word])))
            for backend, words in found.items()}


def is_usual(summary, fields=FIELDS):
    """Return a test of a table's row or a point: has it the usual words of its backend?

    A row that does not say a field passes.
    """
    usual = {field: of_backends(summary, field) for field in fields}
    return lambda row: all(row.get(field) in (None, usual[field].get(row.get("backend"), row.get(field)))
                           for field in fields)


def text(summary):
    """Say the usual words of the backends that were measured with several, or nothing."""
    said = {}
    for field in FIELDS:
        several = {}
        for entry in summary["points"]:
            several.setdefault(entry["point"]["backend"], set()).add(entry["point"].get(field))
        for backend, word in of_backends(summary, field).items():
            if len(several[backend]) > 1:
                said.setdefault(backend, []).append(word)
    return ", ".join(" ".join([backend, *words]) for backend, words in said.items())
