"""Where each strategy breaks down: how it stands to the base in every world."""
import axes_ticks
from matplotlib.lines import Line2D

import labels
import layout
import panels
import strategies
import style
import thread_lines
from summary import NoData

NAME = "strategy_worlds"
_ROW = 0.32  # inches per backend
_LOOKS = (("o", "#0072B2"), ("s", "#D55E00"), ("D", "#009E73"), ("^", "#CC79A7"), ("v", "#7A4B1E"), ("P", "#6A5ACD"),
          ("X", "#56B4E9"), ("<", "#E69F00"))


def draw(summary):
    """Return the figure, or raise NoData: a row per backend, a marker per world."""
    rows = _rows(summary)
    worlds = list(dict.fromkeys(row["world"] for row in rows))
    if len(worlds) < 2:
        raise NoData('the table "strategy_ladder" has one world only')
    looks = {world: _LOOKS[at % len(_LOOKS)] for at, world in enumerate(worlds)}
    backends = list(dict.fromkeys(row["backend"] for row in sorted(rows, key=lambda row: worlds.index(row["world"])
                                                                   * 1000 + row["rank"])))
    bases = ", ".join(sorted({row["base_backend"] for row in rows}))
    page = layout.Sheet(summary, "Strategies from world to world: times as fast as the base, at most threads",
                        f"base {bases} on as many threads; lines: {thread_lines.confidence(rows)}",
                        {(0, 0): "each at its most threads"}, 5.2, 0.2 + _ROW * len(backends),
                        (labels.tick_room(backends), 0.3), key=[_mark(world, looks[world]) for world in worlds])
    _panel(page.axes[0, 0], rows, backends, looks)
    return page.figure


def _rows(summary):
    """Return the rows of the highest ladder of each series."""
    rows = [row for panel in panels.of_series(summary, "strategy_ladder") for row in panel.rows]
    high = {row["series"] for row in rows if row["at"] == "most_threads"}
    return [row for row in rows if (row["at"] == "most_threads") == (row["series"] in high)]


def _lane(world, worlds):
    """Return how far below the middle of its row a world's marker stands, so that none hides another."""
    return 0.5 * (worlds.index(world) / max(len(worlds) - 1, 1) - 0.5)


def _mark(world, look):
    return Line2D([], [], marker=look[0], color=look[1], markeredgecolor=style.INK, markeredgewidth=0.5, linestyle="",
                  markersize=6.5, label=world)


def _panel(axes, rows, backends, looks):
    axes.axvline(1.0, color=style.RULE, linestyle="--", linewidth=1.2, label="equal", zorder=1)
    for row in rows:
        marker, colour = looks[row["world"]]
        at = backends.index(row["backend"]) + _lane(row["world"], list(looks))
        if row["low"] is not None and row["high"] is not None:
            axes.plot([row["low"], row["high"]], [at, at], color=colour, linewidth=2,
                      label=f"interval of {row['backend']} in {row['world']}", zorder=2)
        axes.plot([row["ratio"]], [at], marker=marker, color=colour, linestyle="", markersize=6.5,
                  markeredgecolor=style.INK, markeredgewidth=0.5, label=f"ratio of {row['backend']} in {row['world']}",
                  zorder=3)
    values = [row[key] for row in rows for key in ("ratio", "low", "high") if row[key] is not None]
    axes_ticks.logarithmic(axes.xaxis, [*values, 1.0], counted=False)
    axes.set_yticks(range(len(backends)), backends)
    axes.set_ylim(len(backends) - 0.4, -0.6)
    axes.tick_params(axis="y", length=0)
    axes.set_xlabel("times as fast as the base")
