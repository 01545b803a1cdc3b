"""Roofline: the flops per second of each point under the measured bandwidth and peak."""
import pandas as pd
from matplotlib.axes import Axes

from .. import words
from ..reports import Report
from . import style
from .marks import ends, log, room, told
from .parts import Drawing, named
from .sheet import Panel


def _panels(report: Report) -> list[Panel]:
    """1 thread and the most. Every point is a small marker, each backend at its best a large one with its name."""
    points = report.points.dropna(subset=["intensity", "achieved_flops_per_s"])
    points = points[points["threads"].isin([1, points["threads"].max()])].assign(
        gflops=lambda p: p["achieved_flops_per_s"] / 1e9, peak=lambda p: p["flops_per_s"] / 1e9,
        rate=lambda p: p["bandwidth_bytes_per_s"] / 1e9)
    x = pd.concat([points["intensity"], points["peak"] / points["rate"]]).dropna()
    y = pd.concat([points["gflops"], points["peak"]]).dropna()

    def paint(axes: Axes, own: pd.DataFrame) -> None:
        log(axes, "x", [x.min() / 1.6, x.max() * 1.8])
        log(axes, "y", [y.min() / 1.6, y.max() * 1.5])
        right, low = axes.get_xlim()[1], axes.get_ylim()[0]
        for peak, rate in own[["peak", "rate"]].dropna().drop_duplicates().itertuples(index=False):
            axes.plot([low / rate / 10, peak / rate, right], [low / 10, peak, peak], color=style.RULE, linewidth=2,
                      zorder=1, label="roof")
            axes.annotate(f"{peak:.3g} Gflop/s, {rate:.3g} GB/s", (right, peak), xytext=(-2, 4),
                          textcoords="offset points", ha="right", fontsize="small", color=style.MUTED)
        best = own.sort_values("sum_s").drop_duplicates("backend")
        for p in own.itertuples():
            large = p.Index in best.index
            drawn, = axes.plot(
                p.intensity, p.gflops, linestyle="", color=style.colour(p.backend), marker=style.marker(p.M),
                markersize=7 if large else 3.5, markeredgecolor=style.INK, markeredgewidth=0.6 if large else 0.3,
                zorder=4 if large else 3, label=p.backend)
            told(drawn, "use", [f"{p.backend}: {p.gflops:.3g} Gflop/s at {p.intensity:.3g} flops per byte"])
        axes.set(xlabel="flops per byte (model)", ylabel="Gflop/s")
        ends(axes, zip(best["intensity"], best["gflops"], named(best, False), map(style.colour, best["backend"])))

    return [Panel(words.threads_words(n), lambda axes, own=own: paint(axes, own), 1.3 * room(
        own["backend"].nunique())) for n, own in points.groupby("threads")]


ROOFLINE = Drawing(
    "roofline", "Roofline",
    "Achieved flops per second against flops per byte (a model of the work), on one thread and on the most. Grey: "
    "what the measured memory bandwidth and peak allow. Large markers: each backend at its best.",
    "points", _panels)
