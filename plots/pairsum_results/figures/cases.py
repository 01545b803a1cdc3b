"""Backends by cases: how far each is behind the fastest of every case."""
import textwrap

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection

from ..reports import Report
from . import style
from .marks import name_rows
from .parts import Drawing
from .sheet import Panel

#: Times over that of the fastest from which a cell is one shade paler.
STEPS = (1.05, 1.25, 1.6, 2.5, 5.0)
_STRONGEST = 0.55  # how far the fastest is from white


def grid(report: Report) -> pd.DataFrame:
    """Every backend (rows, those that are least behind on the whole first) in every series (columns) on its most
    threads: rows of `standings`, or null. Empty if there is one series alone."""
    table = report.standings
    table = table[table["threads"] == table.groupby("series")["threads"].transform("max")]
    if table["series"].nunique() < 2:
        return pd.DataFrame()
    behind = np.log(table.pivot(index="backend", columns="series", values="behind"))
    order = pd.DataFrame({"missing": behind.isna().sum(axis=1), "mean": behind.mean(axis=1)})
    order = order.sort_values(["missing", "mean"]).index
    return table.reset_index(names="line").pivot(index="backend", columns="series", values="line").loc[order]


def _panels(report: Report) -> list[Panel]:
    lines = grid(report)
    behind = report.standings["behind"].reindex(lines.stack()).set_axis(lines.stack().index) if len(lines) else None
    names = report.standings.drop_duplicates("series").set_index("series")["world"]

    def paint(axes: Axes) -> None:
        at, columns = dict(zip(lines.index, name_rows(axes, lines.index))), {s: k for k, s in enumerate(lines.columns)}
        spots = np.array([(columns[series], at[backend]) for backend, series in behind.index])
        corners = spots[:, None] + np.array([(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)])
        towards = [1 - _STRONGEST * (1 - shade(value) / len(STEPS)) for value in behind]
        axes.add_collection(PolyCollection(corners, edgecolor="white", linewidth=1.5,
                                           facecolor=[style.shade("#0072B2", one) for one in towards]))
        for (x, y), value in zip(spots, behind):
            axes.text(x, y, f"{value:.2f}", ha="center", va="center", fontsize="small")
        axes.set_xlim(-0.5, len(columns) - 0.5)
        axes.xaxis.tick_top()
        width = max(7, 48 // len(columns))
        axes.set_xticks(range(len(columns)),
                        [textwrap.fill(names[series].replace("_", " "), width) for series in columns])
        axes.tick_params(axis="x", length=0)
        axes.grid(False)

    return [Panel("", paint, 1.1 * len(lines))] if len(lines) else []


def shade(behind: float) -> int:
    """0 for the fastest and what is as good as that, one more for every step of STEPS behind it."""
    return int(np.searchsorted(STEPS, behind, side="right"))


CASES = Drawing(
    "cases", "Case by case",
    "Time of a step over that of the fastest backend of the same case, each at the most threads of the case: 1 is the "
    "fastest.",
    "standings", _panels, each=False, inline=False)
