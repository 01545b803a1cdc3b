"""All backends against a base by whole steps: how many times as fast, coloured by how they keep threads apart."""
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.patches import Patch

from .. import words
from ..ladders import families
from ..reports import Report
from . import style
from .marks import beside, boxes, few, name_rows, reference, spans
from .parts import Drawing
from .sheet import Panel


def reach(table: pd.DataFrame) -> float:
    """Where the axis of a ladder ends: wide intervals are cut."""
    return 1.02 * max(1.0, min(table[["ratio", "high"]].max().max(), 1.4 * table["ratio"].max()))


def headline(own: pd.DataFrame) -> str:
    """What one ladder says: its threads and its base."""
    base = own.iloc[0]
    isa = "" if base["base_isa"] == "scalar" else f" {base['base_isa']}"
    return (f"{words.threads_words(base['threads'])}: times as fast as {base['base_backend']}{isa}, "
            f"{words.time(base['base_time_s'])} a step")


def _panels(report: Report) -> list[Panel]:
    table = report.standings
    table = table[table["threads"].isin([table["threads"].min(), table["threads"].max()])]
    kinds = families(report.results)

    def paint(axes: Axes, own: pd.DataFrame) -> None:
        reference(axes, 1.0, label="equal")
        isa = "" if own["isa"].nunique() < 2 else (" " + own["isa"]).replace(" scalar", "")
        at = name_rows(axes, own["backend"] + isa + ["" if pd.isna(m) else f", M={m:.0f}" for m in own["M"]])
        boxes(axes, at, 0, own["ratio"], label="ratio", **style.BOX,
              facecolor=[style.FAMILIES[kinds[backend]][0] for backend in own["backend"]])
        for width, colour in ((3.6, "white"), (1.6, style.INK)):
            spans(axes, at, own, color=colour, linewidth=width)
        beside(axes, own[["ratio", "high"]].max(axis=1).clip(upper=reach(table)), at,
               [f"{e.ratio:.2f} ({words.time(e.time_s)})" for e in own.itertuples()])
        axes.set(xlim=(0, reach(table)), xlabel="times as fast as the base")
        few(axes.xaxis)

    key = [Patch(label=text, facecolor=colour, **style.BOX) for kind, (colour, text) in style.FAMILIES.items()
           if kind in set(kinds.reindex(table["backend"]))]
    return [Panel(headline(own), lambda axes, own=own: paint(axes, own), len(own), key)
            for _, own in table.groupby("threads")]


LADDER = Drawing(
    "ladder", "All backends",
    "How many times as fast as the base each backend is, by whole steps, at its best grid, M and granularity, with "
    "95\u00a0% intervals. Colours: how threads are kept apart that would add to the same particle.",
    "standings", _panels, inline=False)
