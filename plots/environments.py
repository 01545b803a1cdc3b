"""Say in words what tells the environments of a summary apart."""
_FIELDS = ("host", "cpu", "compiler", "os_kernel", "git", "flags", "binding")


def names(summary):
    """Return {id: text}: the facts that differ between environments, else the id's first digits."""
    known = [row for row in summary["environments"] if isinstance(row.get("environment"), str)]
    differ = [field for field in _FIELDS if len({str(row.get(field)) for row in known}) > 1]
    texts = {}
    for row in known:
        words = [str(row.get(field)) for field in differ[:2] if len(str(row.get(field))) < 40]
        texts[row["environment"]] = ", ".join(words)
    for identity, text in list(texts.items()):
        if not text or list(texts.values()).count(text) > 1:
            texts[identity] = f"environment {identity[:8]}"
    return texts


def name(summary, identity):
    """Return the words for an environment, or for one that the summary does not list its id."""
    return names(summary).get(identity, f"environment {str(identity)[:8]}") if identity else None
