"""Sort rows into panels and say in words what a panel shows."""
import environments
import usual

#: Fields that tell panels apart. Points hold all of them, tables the first three and maybe more.
FIELDS = ("case", "state", "dx", "n_fluid", "n_boundary", "H", "order", "dim", "precision",
          "interaction", "smoothing", "integrator", "dt", "grid", "study", "series")
_NO_BREAK = "\N{NO-BREAK SPACE}"
#: Always named in a title; the other fields only where they differ.
_USUAL_GRID = "hashed_grid"
_ALWAYS = ("case", "state", "dx", "N", "precision", "interaction")


class Panel:
    """Rows that belong into one panel, and the facts known about them (field -> set of values)."""

    def __init__(self, rows, facts):
        self.rows = rows
        self.facts = facts


def of_table(summary, table, keep=lambda row: True):
    """Group a table's rows by the FIELDS they hold; the other facts come from matching points."""
    points = [flat(summary, entry) for entry in summary["points"]]
    found = []
    keeps, copies = usual.is_usual(summary), self_test_copies(summary)
    rows = [row for row in summary[table] if keep(row) and keeps(row)
            and row.get("backend") not in copies]
    for key, rows in _group(rows, FIELDS):
        same = [point for point in points if all(value is None or point.get(field) == value
                                                 for field, value in zip(FIELDS, key))]
        found.append(Panel(rows, _facts(same or rows)))
    return found


def of_points(summary, keep=lambda entry: True, every=False, without=()):
    """Group the summary's points by everything but backend, M, threads and the fields `without`.

    Points of another isa or block than the usual one of their backend are left out, those of another granularity unless
    `every` is wanted.
    """
    keeps = usual.is_usual(summary, ("isa", "block") if every else usual.FIELDS)
    copies = self_test_copies(summary)
    entries = [{**entry, **flat(summary, entry)} for entry in summary["points"]
               if keep(entry) and keeps(entry["point"])
               and entry["point"]["backend"] not in copies]
    fields = [field for field in (*FIELDS, "environment") if field not in without]
    return [Panel(rows, {**_facts(rows), **{field: set() for field in without}})
            for _, rows in _group(entries, fields)]


def self_test_copies(summary):
    """Return the backends that are copies of others, made for the self-test; only its figure shows them."""
    return {row["backend"] for row in summary["self_test"] if row["backend"] != row["base_backend"]}


def flat(summary, entry):
    """Return the point of an entry together with its study, series and environment."""
    series, all_series = entry.get("series"), summary.get("series") or []
    known = isinstance(series, int) and 0 <= series < len(all_series)
    return {**entry["point"], "study": entry.get("study"), "series": series,
            "environment": environments.name(summary, all_series[series].get("environment"))
            if known else None}


def of_series(summary, table):
    """Group a table's rows by series alone, for tables that mix what else a backend was measured with."""
    keeps, copies = usual.is_usual(summary), self_test_copies(summary)
    rows = [row for row in summary[table] if keeps(row) and row["backend"] not in copies]
    points = [flat(summary, entry) for entry in summary["points"]]
    return [Panel(some, {**_facts([point for point in points if point["series"] == series] or some), "grid": set()})
            for series, some in split(rows, "series")]


def titles(panels):
    """Return (text common to all panels, [text of what differs, one per panel])."""
    worded = [_words(panel.facts) for panel in panels]
    if len({words["dx"] for words in worded}) == len({(words["dx"], words["H"]) for words in worded}):
        worded = [{**words, "H": ""} for words in worded]  # it follows dx
    common, own = [], [[] for _ in panels]
    for field in worded[0]:
        texts = [words[field] for words in worded]
        if len(set(texts)) > 1:
            for texts_of_panel, text in zip(own, texts):
                texts_of_panel.append(text)
        elif texts[0] and (field in _ALWAYS or " / " in texts[0] or field == "grid" and texts[0] != _USUAL_GRID):
            common.append(texts[0])
    return joined(*common), [joined(*texts) for texts in own]


def joined(*texts):
    """Join the texts that are not empty with commas."""
    return ", ".join(filter(None, texts))


def m_text(m):
    """Return "M=6", or an empty text for a grid that takes none."""
    return "" if m is None else f"M={m}"


def cells(row):
    """Return "M=6" of a point or row, or the name of a grid that takes no M."""
    return m_text(row["M"]) or row.get("grid") or "no M"


def split(rows, *fields):
    """Return [(value or values of the fields, rows)] sorted by these values."""
    groups = _group(rows, fields)
    return [(key[0] if len(fields) == 1 else key, members) for key, members in groups]


def _group(rows, fields):
    groups = {}
    for row in rows:
        groups.setdefault(tuple(row.get(field) for field in fields), []).append(row)
    seen = [list(dict.fromkeys(key[at] for key in groups)) for at in range(len(fields))]

    def rank(key):
        """Numbers by size, words in the order of the summary, null first."""
        return [(0, 0) if value is None else (1, seen[at].index(value)) if isinstance(value, str)
                else (2, value) for at, value in enumerate(key)]

    return [(key, groups[key]) for key in sorted(groups, key=rank)]


def _facts(rows):
    facts = {field: {row.get(field) for row in rows} - {None} for field in (*FIELDS, "environment")}
    facts["N"] = {(row["n_fluid"], row["n_boundary"]) for row in rows if "n_fluid" in row}
    return facts


def _words(facts):
    """Return {field: text} in the order of a title."""
    forms = {
        "case": str, "state": str, "dx": lambda v: _whole(f"dx = {v:g} m"), "N": _particles,
        "precision": str, "interaction": str, "dim": lambda v: f"{v}D",
        "H": lambda v: f"H = {v:g} m",
        "order": lambda v: f"order {v}", "smoothing": str, "integrator": str,
        "dt": lambda v: f"dt = {v:g} s",
        "grid": str, "study": lambda v: f"study {v}",
        "environment": str,
    }
    return {field: " / ".join(form(value) for value in sorted(facts[field]))
            for field, form in forms.items()}


def _particles(counts):
    fluid, boundary = (f"{count:,}".replace(",", " ") for count in counts)
    more = " " + _whole(f"+ {boundary} boundary") if counts[1] else ""
    return _whole(f"N = {fluid} fluid") + more


def _whole(text):
    """Keep the words of a text on one line."""
    return text.replace(" ", _NO_BREAK)
