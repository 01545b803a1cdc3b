"""What the report says of each summary, ready for the template."""
import importlib

import environments
import figures
import layout
import panels
import summary as summaries
import svg
import usual
import wording

_HIDDEN = ("schema", "kind", "study", "utc", "environment")


def content(data, markup):
    """Return the template's variables for checked summaries, one per machine; `markup` marks the SVG as safe."""
    machines = [_machine(summary) for summary in data]
    drawn, not_drawn = _figures(data, figures.FIGURES, "f")
    strategies = _figures(data, figures.STRATEGIES, "s")[0] if any(row["strategies"] for row in data) else []
    for figure in (*drawn, *strategies):
        for drawing in (some for column in figure["columns"] for some in column["drawings"]):
            drawing["svg"] = markup(drawing["svg"])
    return {"machines": machines, "figures": drawn, "not_drawn": not_drawn, "strategies": strategies}


def _machine(summary):
    first = summary["environments"][0] if summary["environments"] else {}
    names = environments.names(summary)
    several = len(summary["environments"]) > 1
    return {"title": summary["title"], "name": str(first.get("host") or "unknown machine"),
            "cpu": first.get("cpu"), "rounds": _rounds(summary.get("rounds")),
            "answer": _answer(summary["answer"]), "questions": summary["questions"],
            "usual": usual.text(summary), "caveats": summary["caveats"],
            "sources": summary.get("sources") or [],
            "environments": [{"name": names.get(row.get("environment"), "") if several else "",
                              "facts": _facts(row)} for row in summary["environments"]]}


def _rounds(rounds):
    if not isinstance(rounds, dict) or rounds.get("finished") is None:
        return ""
    text = f"{rounds['finished']} finished rounds, {rounds.get('void') or 0} void"
    if rounds.get("others_share") is not None:
        text += f"; other processes took up to {100 * rounds['others_share']:.2g} % of the machine's CPU time"
    return text + "."


def _answer(answer):
    if answer is None:
        return None
    return {"text": answer["text"], "time": wording.time(answer["time_s"]), "choice": _point(answer),
            "speedup": wording.number(answer["speedup"], 3), "interval": wording.confident(answer),
            "base": _point({key: answer.get(f"base_{key}") for key in ("backend", "grid", "M", "threads", "block")}),
            "base_time": wording.time(answer["base_time_s"]), "ties": list(map(_point, answer["ties"]))}


def _point(row):
    grain, block = row.get("granularity"), row.get("block")
    return panels.joined(row["backend"], panels.cells(row), wording.threads(row["threads"]),
                         block if block not in ("none", "auto") else None, grain if grain != "none" else None)


def _facts(row):
    """Return an environment's facts as (name, text); nested ones on one line."""
    facts = []
    for key, value in row.items():
        if key in _HIDDEN or value in (None, "", {}):
            continue
        if isinstance(value, dict):
            value = ", ".join(f"{name} {some}" for name, some in value.items())
        facts.append((key.replace("_", " "), {True: "yes", False: "no"}.get(value, value)
                      if isinstance(value, bool) else str(value)))
    return facts


def _figures(data, wanted, prefix):
    """Return the figures that can be drawn of some summary, and what is missing for the others."""
    drawn, not_drawn = [], []
    for at, (name, (heading, caption)) in enumerate(wanted.items()):
        columns = [_column(summary, name, f"{prefix}{at}-{number}-", f"{heading}%s. {caption}", len(data))
                   for number, summary in enumerate(data)]
        if any(column["drawings"] for column in columns):
            drawn.append({"name": name, "heading": heading, "caption": caption, "columns": columns})
        else:
            not_drawn.append(f"{heading} ({columns[0]['missing']})")
    return drawn, not_drawn


def _column(summary, name, prefix, label, machines):
    """`label` is for readers who cannot see it; %s in it stands for what tells a series apart."""
    module = importlib.import_module(name)
    parts = worlds(summary) if name in figures.SERIES else [("", summary)]
    drawings, missing = [], "no points"
    for number, (text, part) in enumerate(parts):
        try:
            figure = module.draw(layout.for_page(part, 2 if machines == 1 else 1))
        except summaries.NoData as problem:
            missing = str(problem)
            continue
        more = [part for part in text.split(", ") if part not in figure.subtitle]
        common, mark, rest = figure.subtitle.partition(";")
        drawings.append({"text": panels.joined(common, *more) + mark + rest,
                         "svg": svg.inline(figure, f"{prefix}{number}-", label.replace("%s", f", {text}" if text else "", 1))})
    return {"drawings": drawings, "missing": missing}


def worlds(summary):
    """Return [(what tells it apart, the summary of it alone)], one per series of points."""
    found = panels.of_points(summary, every=True, without=("grid",))
    _, texts = panels.titles(found) if found else ("", [])
    series = [next(iter(panel.facts["series"]), None) for panel in found]
    if None in series or len(set(series)) != len(series) or len(series) < 2:
        return [("", summary)]
    return [(text, {**summary, **{table: [row for row in summary[table] if row.get("series", one) == one]
                                  for table in ("points", "speedup", "algorithm_speedup", "m_comparison")}})
            for one, text in zip(series, texts)]
