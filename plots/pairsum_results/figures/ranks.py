"""The efficiency of ranks x threads over cores."""
import itertools

import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from .. import words
from ..reports import Report
from . import style
from .marks import at, ends, intervals, reference, room, told
from .parts import Drawing
from .sheet import Panel

_LOOKS = {"none": "-", "twice": (0, (5, 2)), "once": "-"}
_MARKERS = {"none": "s", "twice": "v", "once": "o"}
_VARIANT = ["grid", "isa", "block", "granularity", "M"]


def _panels(report: Report) -> list[Panel]:
    table = report.scaling
    table = table[table["efficiency"].notna()].astype({"efficiency": float})
    found = []
    for (kind, world, backend), own in table.groupby(["scaling", "world", "backend"], sort=False):
        own = _fastest(own)
        if (own["ranks"] > 1).any():
            lines = _lines(own)
            found.append(Panel(f"{kind} scaling of {backend}, {world}", lambda axes, lines=lines: _paint(axes, lines),
                               room(len(lines) + 1)))
    return found


def _fastest(own: pd.DataFrame) -> pd.DataFrame:
    """The lines of the cells, block and units that are fastest on the most cores."""
    most = own[own["ranks"] > 1].sort_values(["cores", "step_s"], ascending=[False, True]).head(1)
    return own.merge(most[_VARIANT], on=_VARIANT)


def _lines(own: pd.DataFrame) -> list[tuple[str, str, str, pd.DataFrame]]:
    """(name, cut, colour, points) of one rank, and of every number of threads a rank and cut. Each of these begins with
    one rank of as many threads."""
    alone = own[own["ranks"] == 1].sort_values("cores")
    lines = [("threads alone", "none", style.INK, alone)] if alone["cores"].nunique() > 1 else []
    colours = dict(zip(sorted(own.loc[own["ranks"] > 1, "threads"].unique()), itertools.cycle(
        ("#0072B2", "#E69F00", "#009E73", "#CC79A7", "#D55E00", "#56B4E9"))))
    for (threads, cut), some in own[own["ranks"] > 1].groupby(["threads", "cut"]):
        line = pd.concat([alone[alone["threads"] == threads], some.sort_values("cores")])
        lines.append((f"ranks of {words.threads_words(threads)}, {cut}", cut, colours[threads], line))
    return lines


def _paint(axes: Axes, lines: list[tuple[str, str, str, pd.DataFrame]]) -> None:
    labels = []
    for name, cut, colour, line in lines:
        drawn, = axes.plot(line["cores"], line["efficiency"], color=colour, linestyle=_LOOKS[cut], label=name, zorder=3,
                           marker=_MARKERS[cut], **style.EDGE)
        told(drawn, "use", [f"{name}, {e.ranks} x {e.threads} on {e.cores} core{'s' * (e.cores > 1)}: "
                            f"{words.bounded(e.efficiency, e.efficiency_low, e.efficiency_high)}"
                            for e in line.itertuples()])
        intervals(axes, line["cores"], line["efficiency"], line["efficiency_low"], line["efficiency_high"], colour)
        labels.append((line["cores"].iloc[-1], line["efficiency"].iloc[-1], name, colour))
    shown = pd.concat([line for *_, line in lines])
    cores = sorted(set(shown["cores"]))
    axes.set_xscale("log", base=2)
    axes.set_xlim(cores[0] / 1.15, cores[-1] * 1.15)
    at(axes.xaxis, [c for c in cores if len(cores) <= 8 or int(c) & (int(c) - 1) == 0] or cores)
    reference(axes, y=1.0, label="ideal")
    most = np.nanmax(shown[["efficiency", "efficiency_high"]].to_numpy(float))
    axes.set(xlabel="cores: ranks x threads", ylabel="efficiency of a step", ylim=(0, 1.08 * max(1, most)))
    ends(axes, labels)


RANKS = Drawing(
    "ranks", "Ranks",
    "Speedup of a step, from index to reduce, over 1 rank with 1 thread, per core; a line per number of threads a "
    "rank. Pairs across ranks are summed once (solid) or by both ranks (dashed). Weak scaling: as many particles on "
    "every rank.",
    "scaling", _panels, each=False)
