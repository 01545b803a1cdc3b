"""Where time goes, as stacked bars: the phases of a step, threads waiting at barriers."""
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from .. import words
from ..model import thread_times
from ..reports import Report
from . import style
from .marks import beside, boxes, few, name_rows
from .parts import Drawing, fastest, named, usual
from .sheet import Panel


def _phase_split(report: Report) -> list[Panel]:
    points = report.points.dropna(subset=["total_s"])
    columns = []
    for title, best in fastest(points, "total_s") if len(points) else []:
        pairs = points.set_index(["backend", "threads"]).index
        own = points[pairs.isin(best.set_index(["backend", "threads"]).index)]
        columns.append((title, usual(own, "total_s").sort_values("total_s")))
    right = max((own["total_s"].max() for _, own in columns), default=0) * 1e3
    whole = {"color": style.INK, "marker": "|", "markersize": 9, "markeredgewidth": 1.6, "linestyle": ""}

    def paint(axes: Axes, own: pd.DataFrame) -> None:
        at, left = name_rows(axes, named(own)), np.zeros(len(own))
        for phase, colour in style.PHASES.items():
            length = 1e3 * own[phase].fillna(0).to_numpy()
            boxes(axes, at, left, length, color=colour, linewidth=0, label=phase,
                  texts=[f"{name}: {phase.removesuffix('_s')} {words.time(1e-3 * one)} of {words.time(whole)}"
                         for name, one, whole in zip(named(own), length, own["total_s"])])
            left = left + length
        axes.plot(1e3 * own["total_s"], at, label="total_s", **whole)
        few(axes.xaxis)
        axes.set(xlim=(0, 1.02 * right), xlabel="time per step [ms]")

    key = [Patch(facecolor=colour, label=phase.removesuffix("_s")) for phase, colour in style.PHASES.items()]
    key.append(Line2D([], [], label="whole step", **whole))
    return [Panel(title, lambda axes, own=own: paint(axes, own), len(own), key) for title, own in columns]


PHASE_SPLIT = Drawing(
    "phase_split", "Phases of a step",
    "Where the time of a step goes: medians of the phases, stacked; the black mark is the whole step. Each backend "
    "with its best granularity and block, on one thread and on its most.",
    "points", _phase_split)


def _barrier_wait(report: Report) -> list[Panel]:
    points = usual(report.points[report.points["wait_share"].notna() & (report.points["threads"] > 1)], "sum_s")
    points = points[points["threads"] == points.groupby("backend")["threads"].transform("max")]
    points = points.sort_values("wait_share")
    if points.empty:
        return []
    threads = 1e3 * thread_times(report.results).set_index(["point", "thread"])
    threads = threads[threads.index.isin(points.index, level=0)]
    middle = (len(points) + 1) // 2 if len(points) > 8 else len(points)

    def paint(axes: Axes, own: pd.DataFrame) -> None:
        for up, (point, p) in zip(name_rows(axes, named(own)), own.iterrows()):
            each, colour = threads.loc[point], style.colour(p["backend"])
            height = 0.8 / len(each)
            at = up - 0.4 + height * (np.arange(len(each)) + 0.5)
            boxes(axes, at, 0, each["busy_s"], 0.9 * height, color=colour, linewidth=0, label="busy")
            boxes(axes, at, each["busy_s"], each["waiting_s"], 0.9 * height, label="wait", **_wait(colour))
            beside(axes, [each.sum(axis=1).max()], [up], [f"{100 * p['wait_share']:.2g} %"])
        few(axes.xaxis)
        axes.set(xlim=(0, 1.02 * threads.sum(axis=1).max()), xlabel="time per sum [ms]")

    key = [Patch(label="busy (all passes)", facecolor=style.MUTED),
           Patch(label="waiting at barriers", **_wait(style.MUTED))]
    rows = 1.2 + 0.1 * min(points["threads"].max(), 32)
    parts = [own for own in (points[:middle], points[middle:]) if len(own)]
    titles = [""] if len(parts) == 1 else ["least waiting", "most waiting"]
    return [Panel(title, lambda axes, own=own: paint(axes, own), rows * len(own), key)
            for title, own in zip(titles, parts)]


def _wait(colour: str) -> dict:
    return {"facecolor": style.shade(colour, 0.75), "edgecolor": colour, "linewidth": 0.6}


BARRIER_WAIT = Drawing(
    "barrier_wait", "Waiting at barriers",
    "One bar per thread of every backend on its most threads: time spent summing (solid) and waiting for other "
    "threads (light), all passes; the number is the share of the wait.",
    "points", _barrier_wait)
