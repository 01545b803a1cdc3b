"""What an evaluation costs per pair, and what computing each pair once is worth, over pairs per particle."""
import itertools

import pandas as pd
from matplotlib.axes import Axes

from .. import words
from ..reports import Report
from . import style
from .marks import at, ends, intervals, log, reference, room, told
from .parts import Drawing
from .sheet import Panel

_LINES = {"scalar": (0, (5, 2)), "vector": "-"}


def _line(axes: Axes, line: pd.DataFrame, value: str, low: str, high: str, name: str, colour: str, look) -> tuple:
    x = line["pairs_per_particle"]
    drawn, = axes.plot(x, line[value], color=colour, linestyle=look, marker="o", label=name, zorder=3, **style.EDGE)
    told(drawn, "use", [f"{name}: {e.backend}, {e.pairs_per_particle:.0f} pairs a particle: "
                        f"{words.bounded(getattr(e, value), getattr(e, low), getattr(e, high))}"
                        for e in line.itertuples()])
    intervals(axes, x, line[value], line[low], line[high], colour)
    return x.iloc[-1], line[value].iloc[-1], name, colour


def _pairs_axis(axes: Axes, table: pd.DataFrame) -> None:
    ticks: list[float] = []
    for pairs in sorted(set(table["pairs_per_particle"].round())):
        ticks += [pairs] if not ticks or pairs > 1.15 * ticks[-1] else []
    log(axes, "x", table["pairs_per_particle"])
    at(axes.xaxis, ticks)
    axes.set_xlabel("interacting pairs per fluid particle")


def _panels(report: Report) -> list[Panel]:
    table = report.density
    panels = [Panel(f"{world}, {words.threads_words(threads)}", lambda axes, own=own: _cost(axes, own),
                    room(own.groupby(["units", "family"]).ngroups))
              for (_, world, threads), own in table.groupby(["problem", "world", "threads"], sort=False)]
    symmetric = table[table["fastest_symmetric"]]
    return panels + [Panel(f"symmetric against gather, {words.threads_words(threads)}",
                           lambda axes, own=own: _worth(axes, own), room(own.groupby(["units", "problem"]).ngroups + 1))
                     for threads, own in symmetric.groupby("threads")]


def _cost(axes: Axes, own: pd.DataFrame) -> None:
    labels = []
    for (units, family), line in own.groupby(["units", "family"], sort=False):
        colour = style.FAMILIES.get(family, style.FAMILIES["other"])[0]
        labels.append(_line(axes, line, "ns_per_pair", "ns_per_pair_low", "ns_per_pair_high",
                            f"{family}, {units}", colour, _LINES[units]))
    _pairs_axis(axes, own)
    log(axes, "y", own["ns_per_pair"])
    axes.set_ylabel("ns per pair")
    ends(axes, labels)


def _worth(axes: Axes, own: pd.DataFrame) -> None:
    labels, colours = [], dict(zip(own["problem"].unique(), itertools.cycle(style.SPARE)))
    for (problem, world, units), line in own.groupby(["problem", "world", "units"], sort=False):
        labels.append(_line(axes, line, "ratio", "low", "high", f"{world}, {units}", colours[problem], _LINES[units]))
    _pairs_axis(axes, own)
    reference(axes, y=1.0, label="equal")
    axes.set(ylabel="time of gather / symmetric",
             ylim=(min(0.9, 0.95 * own[["ratio", "low"]].min().min()), 1.08 * own[["ratio", "high"]].max().max()))
    ends(axes, labels)


DENSITY = Drawing(
    "density", "Pairs per particle",
    "Time of an evaluation per interacting pair against pairs per particle: a line per family of backends, each at its "
    "fastest; solid on vector units, dashed scalar. Then what computing each pair once is worth: the fastest gather "
    "over the fastest backend that computes it once, with 95\u00a0% intervals.",
    "density", _panels, each=False)
