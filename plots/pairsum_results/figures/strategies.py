"""How threads are kept apart: ladders of strategies, over threads, and from world to world."""
from itertools import cycle

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from .. import words
from ..reports import Report
from . import style
from .marks import beside, boxes, few, log, name_rows, reference, spans
from .parts import Drawing, digits
from .sheet import Panel


def _colours(report: Report, backends: pd.Series) -> tuple[list[str], list[Patch]]:
    """The colours of how backends keep threads apart, or their own where that is not known, and the legend."""
    kinds = report.results.backends["conflicts"].reindex(backends)
    known = [style.KINDS.get(kind) for kind in kinds]
    key = [Patch(label=kind, facecolor=colour, **style.BOX)
           for kind, colour in style.KINDS.items() if kind in set(kinds)]
    return [colour or style.colour(backend) for colour, backend in zip(known, backends)], key


def _ladder(report: Report) -> list[Panel]:
    table = report.ladder
    right = min(table[["ratio", "high"]].max().max(), 1.4 * table["ratio"].max())  # wide intervals are cut

    def paint(axes: Axes, own: pd.DataFrame) -> None:
        reference(axes, 1.0, label="equal")
        at = name_rows(axes, [", ".join(filter(None, (e.backend, "" if pd.isna(e.M) else f"M={e.M:.0f}"))) + (
            f", {e.threads} thr." if e.at == "most_threads" else "") for e in own.itertuples()])
        boxes(axes, at, 0, own["ratio"], label="ratio", facecolor=_colours(report, own["backend"])[0], **style.BOX)
        for width, colour in ((3.6, "white"), (1.6, style.INK)):
            spans(axes, at, own, color=colour, linewidth=width)
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


def _marked(table: pd.DataFrame, column: str, label: str, title: str, apart: float) -> list[Panel]:
    """Rows of backends with a marker for each value of the column, `apart` of a row from the first to the last so that
    none hides another, and a line from the least to the greatest."""
    backends, looks = list(dict.fromkeys(table["backend"])), dict(zip(dict.fromkeys(table[column]), cycle(style.MARKS)))

    def paint(axes: Axes) -> None:
        reference(axes, 1.0, label="equal")
        rows = dict(zip(backends, name_rows(axes, backends)))
        reach = table.groupby("backend")["ratio"].agg(["min", "max"])
        axes.hlines(reach.index.map(rows), reach["min"], reach["max"], color=style.RULE, linewidth=1, zorder=1)
        for k, (what, (mark, colour)) in enumerate(looks.items()):
            own = table[table[column] == what]
            at = own["backend"].map(rows) + apart * (k / max(len(looks) - 1, 1) - 0.5)
            spans(axes, at, own, color=colour, linewidth=2, zorder=2)
            axes.plot(own["ratio"], at, marker=mark, color=colour, linestyle="", zorder=3, label=what, **style.EDGE)
        log(axes, "x", [*table[["ratio", "low", "high"]].stack(), 1.0])
        axes.set_xlabel(label)

    key = [Line2D([], [], marker=mark, color=colour, linestyle="", label=what, **style.EDGE)
           for what, (mark, colour) in looks.items()]
    return [Panel(title, paint, (1 + apart) * len(backends), key)]


def _threads(report: Report) -> list[Panel]:
    table = report.over_threads
    gains = table[table["threads"] > 1].groupby("backend")["ratio"].max()
    table = table[table["backend"].isin(gains.index)].assign(gain=lambda t: t["backend"].map(gains))
    table = table.sort_values(["gain", "backend", "threads"], ascending=[False, True, True])
    table["on"] = table["threads"].map(words.threads_words)
    return _marked(table, "on", "times as fast as the base on 1 thread",
                   f"base {table['base_backend'].iloc[0]}, 1 thread", 0.0) if len(table) else []


THREADS = Drawing(
    "strategy_threads", "Strategies over threads",
    "Times as fast as the base on one thread: a marker per number of threads; the further apart they are, the more "
    "threads gain. Coloured lines: 95\u00a0% intervals.",
    "strategies on several threads", _threads, strategies=True)


def _worlds(report: Report) -> list[Panel]:
    table = report.ladder
    high = table.loc[table["at"] == "most_threads", "series"]
    table = table[(table["at"] == "most_threads") | ~table["series"].isin(high)]
    if table["world"].nunique() < 2:
        return []
    return _marked(table, "world", "times as fast as the base on as many threads",
                   f"base {', '.join(sorted(set(table['base_backend'])))}; each at its most threads", 0.5)


WORLDS = Drawing(
    "strategy_worlds", "From world to world",
    "Each backend against the base in every world, with 95\u00a0% intervals (coloured lines): markers far to the "
    "left of its others are where it breaks down.",
    "strategies in several worlds", _worlds, each=False, strategies=True)
