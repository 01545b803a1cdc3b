"""What a figure is, and which part of a report it shows."""
import dataclasses
from typing import Callable, Iterator

import pandas as pd

from .. import words
from ..ladders import worlds
from ..reports import Report
from ..self_tests import self_tests
from .sheet import Panel


#: Places along x from which a line says more than a table.
LINE = 3


@dataclasses.dataclass(frozen=True)
class Drawing:
    """`panels` makes the panels of a report, or of one series of it if `each`; none if there is nothing to show."""
    name: str
    heading: str
    caption: str
    table: str  #: that of the report whose numbers it shows
    panels: Callable[[Report], list[Panel]]
    each: bool = True  #: drawn for every series by itself
    inline: bool = True  #: stands in the page as it is; otherwise the page draws the same itself


def working(report: Report) -> Report:
    """The report without the backends that test the harness, but for what it says of them."""
    tests = self_tests(report.results).index
    return dataclasses.replace(report, **{
        name: table[~table["backend"].isin(tests)] for name, table in report.tables.items() if name != "self_test"})


def of_series(report: Report) -> Iterator[tuple[str, Report]]:
    """The report of every series by itself with, if there are several, a few words for it."""
    names = worlds(report.results)
    for series, world in names.items():
        own = {name: t[t["series"] == series] for name, t in report.tables.items() if "series" in t}
        yield world if len(names) > 1 else "", dataclasses.replace(report, **own)


def usual(table: pd.DataFrame, time: str = "time_s", apart: tuple[str, ...] = ()) -> pd.DataFrame:
    """Of each backend in each series the granularity, block and instruction set that most lines have, of several such
    the fastest, alone; columns `apart` are kept apart."""
    keys = ["series", "backend", *apart]
    same = keys + [name for name in ("granularity", "block", "isa") if name not in apart]
    found = table.groupby(same)[time].agg(["size", "min"]).sort_values(["size", "min"], ascending=[False, True])
    best = found.reset_index()[same].drop_duplicates(keys)
    return table.reset_index(names="_").merge(best, on=same).set_index("_").sort_index()


def fastest(points: pd.DataFrame, time: str) -> Iterator[tuple[str, pd.DataFrame]]:
    """("1 thread", points) and, if there are more, those at most threads: the fastest of each backend, in order of
    time."""
    most = points["threads"] == points.groupby("backend")["threads"].transform("max")
    one = points["threads"] == 1
    at_most = "each at its most threads" if points.loc[most, "threads"].nunique() > 1 else (
        words.threads_words(points["threads"].max()))
    for title, some in (("1 thread", points[one]), (at_most, points[most])):
        if title == "1 thread" and one.any() or title != "1 thread":
            yield title, some.sort_values(time).drop_duplicates("backend")


def named(table: pd.DataFrame, threads: bool = True) -> list[str]:
    """Lines of a table in words: "tiles_omp avx512, M=6, 2 thr."; of points on different grids with these."""
    grids = table["grid"].nunique() > 1
    return [name + ("" if pd.isna(p.M) else f", M={p.M:.0f}") + (f", {p.threads} thr." if threads else "")
            for name, p in zip(words.names(table, grids), table.itertuples())]
