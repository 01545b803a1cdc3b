"""Times over something else than threads: the grid parameter M, the number of particles, the granularity."""
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from .. import words
from ..load import COMMON
from ..reports import Report
from . import style
from .marks import at, ends, intervals, log, room, told
from .parts import LINE, Drawing, fastest, named, usual
from .sheet import Panel


def _line(axes: Axes, x: pd.Series, y: pd.Series, backend: str, **how) -> None:
    how = {"color": style.colour(backend), "linestyle": style.line(backend), "label": backend, "zorder": 3,
           "marker": "o", **style.EDGE, **how}
    told(axes.plot(x, y, **how)[0], "use", [f"{how['label']}, {a:g}: {words.short(b)}" for a, b in zip(x, y)])


#: What does not depend on threads: column -> (title, label, logarithmic).
_WORK = {"pairs_tested": ("candidate tests", "distance tests per step [pairs]", True),
         "collision_share": ("collision share", "distance tests that folding adds / all", False),
         "useful_pair_ratio": ("useful-pair ratio", "interacting pairs / tested pairs", False),
         "cells_nonempty": ("non-empty cells", "non-empty cells", True)}


def _m_comparison(report: Report) -> list[Panel]:
    table = report.m_comparison.join(report.points[["pairs_tested", "cells_nonempty"]], on="point")
    table = usual(table[table.groupby(["backend", "grid", "threads"])["M"].transform("nunique") >= LINE], "sum_s")
    if table.empty:
        return []
    ms = sorted(set(table["M"]))

    def paint(axes: Axes, own: pd.DataFrame, column: str, label: str, logarithmic: bool) -> None:
        labels, values = [], [column, *(f"{column}{end}" for end in ("_low", "_high") if f"{column}{end}" in own)]
        curves: dict[tuple, list[pd.DataFrame]] = {}  # those that coincide are one line
        for _, line in own.groupby(["backend", "grid", "isa"], sort=False):
            curves.setdefault(tuple(line[["M", column]].round(12).to_numpy().ravel()), []).append(line)
        for some in curves.values():
            line, backend = some[0], some[0]["backend"].iloc[0]
            several = [one["backend"].iloc[0] for one in some]
            name = ", ".join(several[:2]) + (f" and {len(several) - 2} more" if len(several) > 2 else "")
            _line(axes, line["M"], line[column], backend, label=name)
            if len(values) > 1:
                intervals(axes, line["M"], line[column], line[values[1]], line[values[2]], style.colour(backend))
            labels.append((line["M"].iloc[-1], line[column].iloc[-1], name, style.colour(backend)))
        if logarithmic and own[column].min() > 0:
            log(axes, "y", own[values].stack(), counted=column != "sum_s")
        else:
            axes.set_ylim(0, 1.06 * own[column].max() or 1)
        axes.set(xlim=(ms[0] - 0.25, ms[-1] + 0.25), xlabel="M", ylabel=label)
        at(axes.xaxis, ms)
        ends(axes, labels)

    shown = [(words.threads_words(n), own, "sum_s", "summation time [s]", True) for n, own in table.groupby("threads")]
    fewest = table[table["threads"] == table.groupby("backend")["threads"].transform("min")]
    shown += [(title, fewest.dropna(subset=[column]), column, label, logarithmic)
              for column, (title, label, logarithmic) in _WORK.items() if fewest[column].nunique() > 1]
    return [Panel(title, lambda axes, how=how: paint(axes, *how), room(how[0]["backend"].nunique()))
            for title, *how in shown if len(how[0])]


M_COMPARISON = Drawing(
    "m_comparison", "Choice of M",
    "Summation time against M (with intervals), then why: distance tests, the share of them that folding cells onto "
    "2^(dM) adds (collisions), useful pairs, and non-empty cells. Lines that coincide are drawn once.",
    "m_comparison", _m_comparison)


def _size_scaling(report: Report) -> list[Panel]:
    apart = ["dx", "H", "n_fluid", "n_boundary", "dt", "particles"]
    points = report.points.dropna(subset=["sum_s"]).assign(size=lambda p: p["n_fluid"] + p["n_boundary"])
    same = ["study", "build", *(name for name in COMMON if name not in apart)]
    panels = []
    for _, own in points.groupby(same, sort=False):
        for title, some in fastest_of_each_size(own):
            panels += [Panel(f"{title}: {what}", lambda axes, how=(some, column, label): paint(axes, *how),
                             room(some["backend"].nunique()))
                       for what, column, label in (("time per sum", "sum_s", "time per sum [s]"),
                                                   ("per pair", "ns_per_pair", "ns per interacting pair"))]

    def paint(axes: Axes, some: pd.DataFrame, column: str, label: str) -> None:
        labels = []
        for backend, line in some.groupby("backend", sort=False):
            _line(axes, line["size"], line[column], backend)
            if column == "sum_s":
                intervals(axes, line["size"], line[column], line["sum_s_low"], line["sum_s_high"],
                          style.colour(backend))
            labels.append((line["size"].iloc[-1], line[column].iloc[-1], backend, style.colour(backend)))
        log(axes, "x", some["size"], counted=True)
        log(axes, "y", some[column])
        axes.set(xlabel="particles (fluid + boundary)", ylabel=label)
        ends(axes, labels)

    return panels


def fastest_of_each_size(points: pd.DataFrame):
    """("1 thread", points) and those at most threads: each backend's fastest at every size, if it has enough."""
    for title, _ in fastest(points, "sum_s"):
        most = points["threads"] == points.groupby("backend")["threads"].transform("max")
        some = points[points["threads"] == 1] if title == "1 thread" else points[most]
        some = some.sort_values("sum_s").drop_duplicates(["backend", "size"]).sort_values(["backend", "size"])
        some = some[some.groupby("backend")["size"].transform("nunique") >= LINE]
        if len(some):
            yield title, some


SIZE_SCALING = Drawing(
    "size_scaling", "Size",
    "Time per sum and per interacting pair against the number of particles, each backend at its best grid, M and "
    "granularity.",
    "points", _size_scaling, each=False)

_SCHEDULES = {"dynamic": ("-", "o"), "static": ((0, (5, 2)), "s"), "guided": (":", "D"), "simple": ("-", "o"),
              "auto": ((0, (1, 1)), "v"), "affinity": ((0, (3, 1, 1, 1)), "^")}


def _granularity(report: Report) -> list[Panel]:
    points = report.points.dropna(subset=["sum_s"])
    parts = points["granularity"].str.extract(r"^([^:]*)(?::([1-9]\d*))?$")
    points = points.assign(schedule=parts[0], chunk=parts[1].astype(float))
    panels = []
    for _, own in points.groupby(["backend", "grid", "isa", "block", "M", "threads"], dropna=False):
        if own["chunk"].nunique() >= LINE:
            panels.append(Panel(named(own.head(1))[0], lambda axes, own=own: paint(axes, own)))

    def paint(axes: Axes, own: pd.DataFrame) -> None:
        chunks, labels, colour = sorted(set(own["chunk"].dropna())) or [1.0], [], style.colour(own["backend"].iloc[0])
        axes.set_xscale("log", base=2)
        axes.set_xlim(chunks[0] / 1.3, chunks[-1] * 1.3)
        at(axes.xaxis, chunks)
        for schedule, some in own.groupby("schedule", sort=False):
            line, mark = _SCHEDULES.get(schedule, ("-", "X"))
            sized = some.dropna(subset=["chunk"]).sort_values("chunk")
            _line(axes, sized["chunk"], sized["sum_s"], own["backend"].iloc[0], linestyle=line, marker=mark,
                  label=schedule)
            intervals(axes, sized["chunk"], sized["sum_s"], sized["sum_s_low"], sized["sum_s_high"], colour)
            labels += [(chunk, time, schedule, colour) for chunk, time in zip(sized["chunk"][-1:], sized["sum_s"][-1:])]
            for time in some.loc[some["chunk"].isna(), "sum_s"]:
                axes.axhline(time, color=colour, linestyle=line, linewidth=1.7, label=schedule)
                labels.append((axes.get_xlim()[1], time, schedule, colour))
        values = own[["sum_s", "sum_s_low", "sum_s_high"]].stack()
        room = 0.12 * np.ptp(values) or 0.1 * values.max()
        axes.set(ylim=(values.min() - room, values.max() + room), xlabel="chunk", ylabel="summation time [s]")
        ends(axes, labels)

    return panels


GRANULARITY = Drawing(
    "granularity", "Granularity",
    "Summation time against the chunk of the parallel loop, a line per schedule, with intervals; a schedule without "
    "a chunk is a level line.",
    "points", _granularity)
