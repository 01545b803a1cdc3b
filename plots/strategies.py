"""What the figures of strategies share: worlds in their order, and the colour of how conflicts are avoided."""
from matplotlib.patches import Patch

import panels
import style
from summary import NoData


def worlds(summary, table):
    """Return ([panels.Panel] of a strategy table, one per series, what is common to all), or raise NoData."""
    found = panels.of_series(summary, table)
    if not found:
        raise NoData(f'the table "{table}" has no row')
    return found, panels.titles(found)[0]


def world(panel):
    """Say which world a panel shows."""
    return panel.rows[0]["world"]


def kinds(summary):
    """Return {backend: how it avoids conflicts}, "unsaid" where that is not known."""
    return {row["backend"]: row["conflicts"] or "unsaid" for row in summary["strategies"]}


def colours(summary):
    """Return {backend: the colour of how it avoids conflicts}."""
    return {backend: style.KINDS.get(kind, style.KINDS["unsaid"]) for backend, kind in kinds(summary).items()}


def key(summary, backends):
    """Return the legend's entries for these backends, in the order of style.KINDS."""
    known = kinds(summary)
    there = {known.get(backend, "unsaid") for backend in backends}
    return [Patch(label=kind, facecolor=colour, edgecolor=style.INK, linewidth=0.5)
            for kind, colour in style.KINDS.items() if kind in there]
