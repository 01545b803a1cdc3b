"""One self-contained page of one or several reports: warnings, answer, ladders, case by case, questions; and, folded,
ranks, figures, tables, facts and caveats."""
import base64
import hashlib
import pathlib
import re
import sys
from typing import Any, Iterable

import pandas as pd

from . import board, tables
from .facts import facts
from .figures import ALL, Look, Sheet, cases, draw_all, ladder, ranks
from .figures.style import FAMILIES
from .ladders import worlds
from .reports import Report
from .rows import ResultsError
from .summary import write_file

try:
    import jinja2
    from markupsafe import Markup
except ImportError as problem:
    raise ResultsError(f"the page needs jinja2 for {sys.executable}: {problem} (Debian: python3-jinja2)") from None

_HERE = pathlib.Path(__file__).parent / "html"
_BESIDE = Look(4.9, 1)  #: of figures that stand beside those of other machines


def write(reports: list[Report], folder: pathlib.Path) -> list[pathlib.Path]:
    """Writes report.html, and beside it a PNG of every figure of the first report, each whole or not at all; returns
    the paths of the PNGs. Several reports (of several machines) stand side by side in the page."""
    drawn = [draw_all(report, None if k else folder, _BESIDE if len(reports) > 1 else Look())
             for k, report in enumerate(reports)]
    write_file(folder / "report.html", text(reports, drawn, folder))
    return [folder / f"{sheet.name}.png" for sheet, _ in drawn[0]]


def text(reports: list[Report], drawn: list[list[tuple[Sheet, str]]], folder: pathlib.Path) -> str:
    """The HTML of the page. It loads nothing from anywhere; its links lead to files of the folder that exist."""
    script = (_HERE / "page.js").read_text()
    case, threads = board.start(reports[0])
    machines = list(map(_machine, reports))
    drawings, by_heading = dict(_figures(drawn)), _by_heading(map(_tables, reports))
    of_ranks = {"drawing": ranks.RANKS, "figure": drawings.pop(ranks.RANKS, []),
                "tables": by_heading.pop(ranks.RANKS.heading, [])}
    return filled(
        "page.html.j2", machines=machines, title=reports[0].title, case=case, threads=threads, families=FAMILIES,
        cases=list(dict.fromkeys(world for one in machines for world in one["worlds"])),
        counts=sorted({count for one in machines for _, count in one["ladders"]}),
        figures=list(drawings.items()), ranks=of_ranks, links=lambda *names: _links(folder, drawn[0], names),
        ladder=ladder.LADDER, heat=cases.CASES, tables=by_heading, facts=_by_heading(map(_facts, reports)),
        script=Markup(script),
        script_hash="sha256-" + base64.b64encode(hashlib.sha256(script.encode()).digest()).decode())


def filled(template: str, **values: Any) -> str:
    """A template of html/ with these values and the style of all pages."""
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(_HERE), autoescape=True, trim_blocks=True,
                                     lstrip_blocks=True, undefined=jinja2.StrictUndefined)
    return environment.get_template(template).render(style=Markup((_HERE / "page.css").read_text()), **values)


def _machine(report: Report) -> dict[str, Any]:
    return {"name": str(report.results.environments["host"].iloc[0]), "card": board.card(report),
            "warnings": board.warnings(report), "ladders": board.ladders(report), "by_case": board.by_case(report),
            "worlds": list(worlds(report.results)), "questions": report.questions, "caveats": report.caveats,
            "broken": report.strategies[["backend", "breaks_down"]].dropna().to_records(index=False),
            "details": report.answer.details if report.answer else "", "sources": report.results.sources}


def html_table(table: tables.Table) -> dict[str, Any]:
    frame = pd.DataFrame(table.rows, columns=table.header)
    with pd.option_context("display.max_colwidth", None):
        return {"caption": table.caption, "lines": len(frame), "html": Markup(frame.to_html(
            index=False, border=0, classes=f"left{table.left}"))}


def every_table(report: Report) -> list[tuple[str, tables.Table]]:
    """The tables that are not empty; with those of series, if there are several, the series in a few words."""
    names = worlds(report.results)
    found = [(names[series] if len(names) > 1 else "", table) for series in names.index
             for table in tables.series_tables(report, series)]
    return [(world, t) for world, t in found + [("", table) for table in tables.all_tables(report)] if t.rows]


_Headed = dict[str, list[tuple[str, Any]]]


def _tables(report: Report) -> _Headed:
    """(case, table) by heading: what stands first in the captions."""
    found: _Headed = {}
    for world, table in every_table(report):
        found.setdefault(re.split("[:;,]", table.caption)[0], []).append((world, html_table(table)))
    return found


def _facts(report: Report) -> _Headed:
    return {re.split("[:;]", table.caption)[0]: [("", html_table(table))] for table in facts(report) if table.rows}


def _by_heading(of_machines: Iterable[_Headed]) -> dict[str, list[list[tuple[str, Any]]]]:
    """A list per machine for every heading."""
    found = list(of_machines)
    headings = dict.fromkeys(heading for one in found for heading in one)
    return {heading: [one.get(heading, []) for one in found] for heading in headings}


def _figures(drawn: list[list[tuple[Sheet, str]]]) -> list[tuple[Any, list[list[tuple[str, Any]]]]]:
    """(drawing, (case, SVG) of every machine) of those that stand in the page as they are."""
    return [(drawing, columns) for drawing in ALL if drawing.inline
            and any(columns := [[(one.world, Markup(svg)) for one, svg in some if one.drawing is drawing]
                                for some in drawn])]


def _links(folder: pathlib.Path, drawn: list[tuple[Sheet, str]], names: tuple[Any, str]) -> list[tuple[str, str]]:
    """(path, word) of the CSV and PNGs behind a drawing, of one case if it is drawn case by case."""
    drawing, world = names
    paths = [f"csv/{drawing.table}.csv", *(f"{one.name}.png" for one, _ in drawn if one.drawing is drawing
                                           and one.world in ("", world))]
    return [(path, path.rsplit(".", 1)[1].upper()) for path in paths if (folder / path).exists()]
