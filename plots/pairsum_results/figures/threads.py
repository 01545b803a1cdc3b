"""What threads gain, and one algorithm over another."""
from typing import Callable, Iterable

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from .. import words
from ..reports import Report
from . import style
from .marks import at, dots, ends, intervals, name_rows, reference, room, threads_axis, told
from .parts import LINE, Drawing, named, usual
from .sheet import Panel, ratio_rows

_MACHINE = {"machine_flops_scaling": ("machine's flops", "-"),
            "machine_bandwidth_scaling": ("machine's bandwidth", ":")}
#: A grey line: its name, style, and y over x = threads.
_Grey = tuple[str, str, Iterable[float], Iterable[float]]


def _lines(table: pd.DataFrame, value: str, label: str, grey: Callable[[pd.DataFrame], list[_Grey]],
           axis: Callable[[Axes], None]) -> list[Panel]:
    """A panel for each "panel" of the table with a line for each "name" in it, grey lines for reference, and labels."""
    def paint(axes: Axes, own: pd.DataFrame) -> None:
        labels = []
        for name, line in own.groupby("name", sort=False):
            line, colour = line.sort_values("threads"), style.colour(line["backend"].iloc[0])
            drawn, = axes.plot(line["threads"], line[value], color=colour, linestyle=style.line(line["backend"].iloc[0]),
                               marker=style.marker(line["M"].iloc[0]), label=name, **style.EDGE)
            told(drawn, "use", [f"{name}, {words.threads_words(e.threads)}: {words.bounded(e.ratio, e.low, e.high)}"
                                for e in line.itertuples()])
            if value == "ratio":
                intervals(axes, line["threads"], line[value], line["low"], line["high"], colour)
            labels.append((line["threads"].iloc[-1], line[value].iloc[-1], name, colour))
        threads_axis(axes, table["threads"])
        axis(axes)
        for name, line, x, y in grey(own):
            axes.plot(x, y, color=style.RULE, linestyle=line, linewidth=1.6, zorder=1, label=name)
            labels.append((list(x)[-1], list(y)[-1], name, style.RULE))
        axes.set_ylabel(label)
        ends(axes, labels)

    return [Panel(title, lambda axes, own=own: paint(axes, own), room(own["name"].nunique() + 2))
            for title, own in table.groupby("panel", sort=False) if own["threads"].max() > 1]


def _panelled(table: pd.DataFrame) -> pd.DataFrame:
    """The table of backends measured beyond one thread with "panel", grid and M, and "name", what else tells lines
    apart."""
    table = table[table.groupby(["backend", "grid", "M"], dropna=False)["threads"].transform("max") > 1]
    grids = table["grid"].where(table["M"].isna() | (table["grid"].nunique() > 1), "")
    cells = table["M"].map(lambda m: "" if np.isnan(m) else f"M={m:.0f}")
    return table.assign(panel=(grids + " " + cells).str.strip(), name=words.names(table, False))


def _linear(table: pd.DataFrame, columns: list[str]) -> Callable[[Axes], None]:
    return lambda axes: axes.set_ylim(0, 1.1 * max(1, table[columns].max().max()))


def _speedup(report: Report) -> list[Panel]:
    table = usual(report.speedup)
    if not (table["threads"] > 1).any():
        return []
    if table["threads"].nunique() < LINE:
        return [_rows(table[table["threads"] > 1])]
    counts = sorted(set(table["threads"]))
    drawn = table[["ratio", "low", "high", *_MACHINE]]
    low, high = min(1, drawn.min().min()) / 1.15, 1.15 * max(counts[-1], drawn.max().max())

    def grey(own: pd.DataFrame) -> list[_Grey]:
        known = {look: own.groupby("threads")[column].first().dropna() for column, look in _MACHINE.items()}
        return [("ideal", "--", counts, counts), *((*look, y.index, y) for look, y in known.items() if len(y) > 1)]

    def axis(axes: Axes) -> None:
        axes.set_yscale("log", base=2)
        axes.set_ylim(low, high)
        at(axes.yaxis, [2.0**k for k in range(-6, 12) if low <= 2.0**k <= high])

    return _lines(_panelled(table), "ratio", "speedup over own 1 thread", grey, axis)


def _rows(table: pd.DataFrame) -> Panel:
    """Rows of dots on one number of threads, the best on top."""
    table, count = table.sort_values("ratio", ascending=False), table["threads"].max()
    grey = [("ideal", "--", 1.2, count), *((*look, 2, table[column].iloc[0]) for column, look in _MACHINE.items()
                                           if table[column].notna().any())]

    def paint(axes: Axes) -> None:
        dots(axes, name_rows(axes, named(table, False)), table, "speedup over own 1 thread")
        for name, line, width, value in grey:
            reference(axes, value, linestyle=line, linewidth=width, label=name)
        shown = [1, *table[["ratio", "low", "high"]].stack(), *(value for *_, value in grey)]
        edge = 0.04 * (max(shown) - min(shown))
        axes.set_xlim(min(shown) - edge, max(shown) + edge)
        axes.secondary_xaxis("top", functions=(lambda x: x / count, lambda x: x * count)).set_xlabel(
            "efficiency: speedup / threads")

    return Panel(words.threads_words(count), paint, len(table), [
        Line2D([], [], color=style.RULE, linestyle=line, linewidth=width, label=name) for name, line, width, _ in grey])


SPEEDUP = Drawing(
    "speedup", "Speedup",
    "Summation time with 1 thread over that with more threads, of the same backend, with 95\u00a0% intervals. Grey: "
    "ideal, and how the measured flops and memory bandwidth of the machine itself scale.",
    "speedup", _speedup)


def _algorithm_speedup(report: Report) -> list[Panel]:
    table = usual(report.algorithm_speedup, apart=("isa",))
    few = table[table["M"].isin([6, 7]) & table["base_M"].isin([6, 7]) | table["M"].isna()]
    table = few if table["M"].nunique() > 3 and len(few) else table  # the choice of M has the others
    other_m = table["M"].fillna(0) != table["base_M"].fillna(0)
    bases = table["base_backend"].where(~other_m, table["base_backend"] + [f", M={m:.0f}" for m in table["base_M"]])
    table = table.assign(name=named(table, False), base_name=bases, panel="base " + bases)
    if table["threads"].nunique() >= LINE:
        counts = sorted(set(table["threads"]))
        return _lines(table, "ratio", "time of the base / time",
                      lambda own: [("base", "--", counts, [1.0] * len(counts))], _linear(table, ["ratio", "high"]))

    return [ratio_rows(words.threads_words(count), own, own["name"] + " / " + own["base_name"],
                       own["ratio"].map("{:.2f}".format), own, "time of the base / time")
            for count, own in table.sort_values("ratio", ascending=False).groupby("threads")]


ALGORITHM_SPEEDUP = Drawing(
    "algorithm_speedup", "Algorithm speedup",
    "How many times as fast as its base (behind the stroke) a backend is, with the same runtime and threads, with "
    "95\u00a0% intervals; 1 is no gain.",
    "algorithm_speedup", _algorithm_speedup)
