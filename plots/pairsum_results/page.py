"""One self-contained page of one or several reports: the answer, questions, figures, tables, environments, caveats."""
import base64
import hashlib
import html
import pathlib
import re
import sys
from typing import Any

import pandas as pd

from . import tables
from .figures import ALL, Drawing, Look, draw, on_all_cores, parts, rendered
from .figures.style import BACKENDS, GRID, INK, MUTED, RULE
from .ladders import worlds
from .load import COMMON
from .reports import Report
from .rows import ResultsError
from .summary import write_file

try:
    import jinja2
    from markupsafe import Markup
except ImportError as problem:
    raise ResultsError(f"the page needs jinja2 for {sys.executable}: {problem} (Debian: python3-jinja2)") from None

_HERE = pathlib.Path(__file__).parent / "html"
#: Colours that change in the dark -> the page's CSS variable; all others stay.
_VARIABLES = {INK: "--ink", MUTED: "--muted", RULE: "--rule", GRID: "--grid", BACKENDS["naive"]: "--black"}


def write(reports: list[Report], path: pathlib.Path) -> None:
    """Writes the page, whole or not at all; several reports (of several machines) stand side by side."""
    write_file(path, text(reports))


def text(reports: list[Report]) -> str:
    """The HTML of the page. It loads nothing from anywhere."""
    script = (_HERE / "page.js").read_text()
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(_HERE), autoescape=True, trim_blocks=True,
                                     lstrip_blocks=True, undefined=jinja2.StrictUndefined)
    drawn = _figures(reports)
    filled = [_tables(report) for report in reports]
    headings = list(dict.fromkeys(heading for one in filled for heading in one))
    return environment.get_template("page.html.j2").render(
        machines=list(map(_machine, reports)), style=Markup((_HERE / "page.css").read_text()), script=Markup(script),
        script_hash="sha256-" + base64.b64encode(hashlib.sha256(script.encode()).digest()).decode(),
        sections=[("figures", "Figures", [f for f in drawn if not f["strategies"]], []),
                  ("strategies", "Strategies", [f for f in drawn if f["strategies"]],
                   [h for h in headings if h.startswith("Strategies")]),
                  ("tables", "Tables", [], [h for h in headings if not h.startswith("Strategies")])],
        tables={heading: [one.get(heading, []) for one in filled] for heading in headings},
        not_drawn=[f"{d.heading} (needs {d.needs})" for d in ALL if d.name not in [f["name"] for f in drawn]
                   and not d.strategies])


def _machine(report: Report) -> dict[str, Any]:
    results, first = report.results, report.results.environments.iloc[0]
    others = results.closed["others_share"].max()
    rounds = f"{len(results.closed)} finished rounds, {results.void_rounds} void" + (
        f"; other processes took up to {100 * others:.2g} % of the machine's CPU time." if pd.notna(others) else ".")
    facts = results.environments.drop(columns=["schema", "kind", "study", "utc", "file", "source", "build", "revision",
                                               "build_name"], errors="ignore")
    failed = results.failed[["case", "state", "dx", "backend", "M", "threads", "rows", "error"]]
    world = worlds(results).get(report.points["series"].get(report.answer.point)) if report.answer else None
    series = results.series[["study", *COMMON]].set_axis(worlds(results)).T
    return {"report": report, "world": world, "name": str(first["host"]), "cpu": first["cpu"], "rounds": rounds,
            "sources": results.sources, "series": _html(series, index=True),
            "environments": _html(facts.set_index("environment").applymap(_fact).T, index=True),
            "peaks": _html(results.peaks.drop(columns="build").applymap(_fact)) if len(results.peaks) else "",
            "failed": _html(failed) if len(failed) else "",
            "broken": report.strategies[["backend", "breaks_down"]].dropna().to_records(index=False)}


def _fact(value: Any) -> str:
    if isinstance(value, dict):
        return ", ".join(f"{name} {some}" for name, some in value.items())
    if isinstance(value, bool):
        return "yes" if value else "no"
    return "" if pd.isna(value) else f"{value:.5g}" if isinstance(value, float) else str(value)


def _html(frame: pd.DataFrame, index: bool = False, left: int = 99) -> Markup:
    with pd.option_context("display.max_colwidth", None):
        return Markup(frame.to_html(index=index, border=0, classes=f"left{left}", na_rep="",
                                    float_format="{:.6g}".format))


def every_table(report: Report) -> list[tuple[str, tables.Table]]:
    """The tables that are not empty; with those of series, if there are several, the series in a few words."""
    names = worlds(report.results)
    found = [(names[series] if len(names) > 1 else "", table) for series in names.index
             for table in tables.series_tables(report, series)]
    return [(world, t) for world, t in found + [("", table) for table in tables.all_tables(report)] if t.rows]


def _tables(report: Report) -> dict[str, list[dict[str, Any]]]:
    """Tables by heading: what stands first in their captions."""
    found: dict[str, list[dict[str, Any]]] = {}
    for world, table in every_table(report):
        content = _html(pd.DataFrame(table.rows, columns=table.header), left=table.left)
        found.setdefault(re.split("[:;,]", table.caption)[0], []).append(
            {"world": world, "caption": table.caption, "lines": len(table.rows), "html": content})
    return found


def _figures(reports: list[Report]) -> list[dict[str, Any]]:
    """The figures that can be drawn of some report: a column per report, in it a drawing for each world."""
    side_by_side = len(reports) > 1
    look = Look(4.9 if side_by_side else 5.2, 1 if side_by_side else 2, titled=False)
    shown = list(map(parts, reports))
    tasks = [(machine, drawing, world, part) for drawing in ALL for machine in range(len(reports))
             for world, part in shown[machine][drawing.each]]

    def drawn(task: tuple[int, Drawing, str, Report]) -> str | None:
        machine, drawing, world, part = task
        figure = draw(drawing, reports[machine], look, [("", part)])
        label = f"{drawing.heading}{f', {world}' if world else ''}. {drawing.caption}"
        return figure and _inline(figure, look, f"{machine} {drawing.name} {world}", label)

    found: dict[str, dict[str, Any]] = {}
    for (machine, drawing, world, _), svg in zip(tasks, on_all_cores(drawn, tasks)):
        if svg:
            figure = found.setdefault(drawing.name, {**vars(drawing), "columns": [{} for _ in reports]})
            figure["columns"][machine][world] = Markup(svg)
    return [found[drawing.name] for drawing in ALL if drawing.name in found]


def _inline(figure: Any, look: Look, salt: str, label: str) -> str:
    """The figure as SVG for HTML: text stays text, colours of text and rules follow the page; the label is for readers
    who cannot see it."""
    figure.patch.set_visible(False)
    for axes in figure.axes:
        axes.patch.set_visible(False)
    svg = rendered(figure, "svg", look, salt).decode()
    svg = re.sub(r"<metadata>.*?</metadata>|<!--.*?-->|<defs>\s*<style.*?</style>\s*</defs>", "", svg, flags=re.DOTALL)
    used = set(re.findall(r'(?:url\(|href=")#([^)"]+)', svg))
    svg = re.sub(r"<[^>]*>", lambda tag: _tag(tag[0], used), svg[svg.index("<svg"):])
    svg = re.sub(r">\s+<", "><", svg)
    width, height = figure.get_size_inches()
    return (f'<svg class="figure" role="img" aria-label="{html.escape(label)}" viewBox="0 0 {72 * width:.1f} '
            f'{72 * height:.1f}" style="--w:{96 * width:.0f}px">' + svg[svg.index(">") + 1:])


def _tag(tag: str, used: set[str]) -> str:
    """A tag without what nobody needs, in the colours of the page."""
    tag = re.sub(r' id="([^"]*)"', lambda name: name[0] if name[1] in used else "", tag).replace("xlink:href", "href")
    tag = re.sub(r"-?\d+\.\d{2,}", lambda number: f"{float(number[0]):.2f}".rstrip("0").rstrip("."), tag)
    tag = re.sub(r"font: ((?:bold )?)([\d.]+)px '[^']*'(?:, [^;\"]*)?",
                 lambda found: f"font-size:{found[2]}px" + (";font-weight:700" if found[1] else ""), tag)
    tag = re.sub(r"stroke-line(?:join|cap): [a-z]+;? ?", "", tag)
    for colour, variable in _VARIABLES.items():
        tag = re.sub(colour, f"var({variable})", tag, flags=re.IGNORECASE)
    return re.sub(r"\s+", " ", tag).replace("; ", ";").replace(": ", ":")
