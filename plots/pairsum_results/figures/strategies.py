"""How threads are kept apart: ladders of strategies, over threads, and from world to world."""
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from .. import words
from ..reports import Report
from . import style
from .marks import beside, boxes, few, log, name_rows, reference
from .parts import Drawing, digits
from .sheet import Panel


def _colours(report: Report, backends: pd.Series) -> tuple[list[str], list[Patch]]:
    """The colours of how backends keep threads apart, or their own where that is not known, and the legend."""
    kinds = report.results.backends["conflicts"].reindex(backends)
    known = [style.KINDS.get(kind) for kind in kinds]
    key = [Patch(label=kind, facecolor=colour, edgecolor=style.INK, linewidth=0.5)
           for kind, colour in style.KINDS.items() if kind in set(kinds)]
    return [colour or style.colour(backend) for colour, backend in zip(known, backends)], key


def _ladder(report: Report) -> list[Panel]:
    table = report.ladder
    right = min(table[["ratio", "high"]].max().max(), 1.4 * table["ratio"].max())  # wide intervals are cut

    def paint(axes: Axes, own: pd.DataFrame) -> None:
        reference(axes, 1.0, label="equal")
        at = name_rows(axes, [", ".join(filter(None, (e.backend, "" if pd.isna(e.M) else f"M={e.M:.0f}"))) + (
            f", {e.threads} thr." if e.at == "most_threads" else "") for e in own.itertuples()])
        boxes(axes, at, 0, own["ratio"], label="ratio", facecolor=_colours(report, own["backend"])[0],
              edgecolor=style.INK, linewidth=0.5)
        for width, colour in ((3.6, "white"), (1.6, style.INK)):
            axes.hlines(at, own["low"], own["high"], color=colour, linewidth=width)
        reach = own[["ratio", "high"]].max(axis=1).clip(upper=right)
        beside(axes, reach, at, [f"{e.ratio:.2f} ({digits(1e3 * e.time_s)} ms)" for e in own.itertuples()])
        axes.set(xlim=(0, 1.02 * max(right, 1)), xlabel="times as fast as the base")
        few(axes.xaxis)

    panels, titles = [], {"one_thread": "1 thread", "most_threads": "each at its most threads"}
    for (_, at), own in table.groupby(["series", "at"], sort=False):
        base = own.iloc[0]
        panels.append(Panel(
            f"{titles[at]}; base {base['base_backend']}, {words.threads_words(base['base_threads'])}, "
            f"{digits(1e3 * base['base_time_s'])} ms", lambda axes, own=own: paint(axes, own), len(own),
            _colours(report, own["backend"])[1]))
    return panels


LADDER = Drawing(
    "strategy_ladder", "Ladder of strategies",
    "How many times as fast as the base each backend gets the rates: prepare, zero, sum and reduce together, mean "
    "over the steps; in brackets the time. Black lines: 95\u00a0% intervals. Colours: how threads are kept apart, "
    "where backends say it.",
    "a gather and two more backends", _ladder, strategies=True)


def _threads(report: Report) -> list[Panel]:
    table = report.over_threads
    counts = sorted(set(table["threads"]))
    if not counts or counts[-1] < 2:
        return []
    best = table[table["threads"] > 1].groupby("backend")["ratio"].max().sort_values(ascending=False)
    table = table[table["backend"].isin(best.index)]
    looks = {count: (mark, towards) for count, (mark, _), towards in zip(
        counts, style.MARKS, np.linspace(0.75, 0, len(counts)))}
    looks |= {count: ("o", 0.0) for count in counts if count not in looks}

    def paint(axes: Axes) -> None:
        reference(axes, 1.0, label="equal")
        for up, backend in zip(name_rows(axes, best.index), best.index):
            own, colour = table[table["backend"] == backend].sort_values("threads"), style.colour(backend)
            axes.plot(own["ratio"], np.full(len(own), up), color=colour, linewidth=1.4, zorder=2, label=backend)
            for e in own.itertuples():
                mark, towards = looks[e.threads]
                axes.plot([e.low, e.high], [up, up], color=colour, linewidth=3.4, alpha=0.45, zorder=2)
                axes.plot(e.ratio, up, marker=mark, color=style.shade(colour, towards), markeredgecolor=style.INK,
                          markeredgewidth=0.5, linestyle="", zorder=3, label=f"{backend} {e.threads} thr.")
        log(axes, "x", [*table[["ratio", "low", "high"]].stack(), 1.0])
        axes.set_xlabel("times as fast as the base on 1 thread")

    key = [Line2D([], [], marker=looks[n][0], color=style.shade(style.MUTED, looks[n][1]), markeredgecolor=style.INK,
                  markeredgewidth=0.5, linestyle="", label=words.threads_words(n)) for n in counts]
    return [Panel(f"base {table['base_backend'].iloc[0]}, 1 thread", paint, len(best), key)]


THREADS = Drawing(
    "strategy_threads", "Strategies over threads",
    "Times as fast as the base on one thread: a marker per number of threads; the further apart they are, the more "
    "threads gain. Thick: 95\u00a0% intervals.",
    "strategies on several threads", _threads, strategies=True)


def _worlds(report: Report) -> list[Panel]:
    table = report.ladder
    high = table.loc[table["at"] == "most_threads", "series"]
    table = table[(table["at"] == "most_threads") | ~table["series"].isin(high)]
    worlds = list(dict.fromkeys(table["world"]))
    if len(worlds) < 2:
        return []
    backends = list(dict.fromkeys(table["backend"]))
    looks = {world: style.MARKS[k % len(style.MARKS)] for k, world in enumerate(worlds)}

    def paint(axes: Axes) -> None:
        reference(axes, 1.0, label="equal")
        rows = dict(zip(backends, name_rows(axes, backends)))
        for k, (world, own) in enumerate(table.groupby("world", sort=False)):
            mark, colour = looks[world]
            at = own["backend"].map(rows) + 0.5 * (k / (len(worlds) - 1) - 0.5)  # so that none hides another
            axes.hlines(at, own["low"], own["high"], color=colour, linewidth=2, zorder=2)
            axes.plot(own["ratio"], at, marker=mark, color=colour, linestyle="", markeredgecolor=style.INK,
                      markeredgewidth=0.5, zorder=3, label=world)
        log(axes, "x", [*table[["ratio", "low", "high"]].stack(), 1.0])
        axes.set_xlabel("times as fast as the base on as many threads")

    key = [Line2D([], [], marker=mark, color=colour, markeredgecolor=style.INK, markeredgewidth=0.5, linestyle="",
                  label=world) for world, (mark, colour) in looks.items()]
    return [Panel(f"base {', '.join(sorted(set(table['base_backend'])))}; each at its most threads", paint,
                  1.5 * len(backends), key)]


WORLDS = Drawing(
    "strategy_worlds", "From world to world",
    "Each backend against the base in every world, with 95\u00a0% intervals: markers far to the left of its others "
    "are where it breaks down.",
    "strategies in several worlds", _worlds, each=False, strategies=True)
