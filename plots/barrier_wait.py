"""Busy against waiting at barriers: per measured point one bar per thread, passes added up."""
from matplotlib.colors import to_rgb
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator

import labels
import layout
import panels
import style
from summary import NoData

NAME = "barrier_wait"
_THREAD = 0.11  # inches per thread of a bar


def draw(summary):
    """Return the figure, or raise NoData. Per state (case, dx, ...) one panel per M."""
    found = panels.of_points(summary, lambda entry: entry.get("passes") is not None
                             and entry["point"]["threads"] > 1)
    if not found:
        raise NoData('no entry of "points" with 2 or more threads has "passes"')
    common, own = panels.titles(found)
    split = [panels.split(panel.rows, "M") for panel in found]
    places = layout.arrange(summary, split)
    names, heights = [_names(panel.rows) for panel in found], {}
    for group, some in zip(places, names):
        for row, _ in group:
            heights[row] = max(heights.get(row, 0), 0.15 + sum(map(_height, some)))
    titles = {place: panels.joined(text, panels.m_text(m)) for columns, text, group
              in zip(split, own, places) for (m, _), place in zip(columns, group)}
    key = [Patch(label="busy (all passes)", facecolor=style.MUTED),
           Patch(label="waiting at barriers", **_waiting(style.MUTED))]
    page = layout.Sheet(summary, "Summation phase: busy and waiting at barriers, one bar per thread",
                        common + "; number: share of the wait", titles, 2.9, heights,
                        (labels.tick_room(_name(bar) for some in names for bar in some), 0.6), key=key)
    for columns, some, group in zip(split, names, places):
        for (_, rows), place in zip(columns, group):
            _panel(page.axes[place], rows, some)
    return page.figure


def _names(rows):
    return sorted({(row["backend"], row["threads"]) for row in rows},
                  key=lambda bar: (style.backend_rank(bar[0]), bar[1]))


def _height(bar):
    return _THREAD * (max(bar[1], 2) + 1)


def _name(bar):
    return f"{bar[0]}, {bar[1]} thr."


def _waiting(colour):
    light = tuple(0.25 * channel + 0.75 for channel in to_rgb(colour))
    return {"facecolor": light, "edgecolor": colour, "linewidth": 0.6}


def _panel(axes, rows, names):
    """Draw the bars; a point that was not measured stays empty. Times are stacked, not averaged."""
    tops = {bar: sum(map(_height, names[:at])) for at, bar in enumerate(names)}
    for row in rows:
        bar, passes = (row["backend"], row["threads"]), row["passes"]
        busy, wait = ([1e3 * sum(some[thread] for some in passes[field])
                       for thread in range(len(passes[field][0]))]
                      for field in ("busy_s", "barrier_wait_s"))
        at = [tops[bar] + _THREAD * (thread + 1) for thread in range(len(busy))]
        name, colour = f"{bar[0]} t={bar[1]}", style.colour(bar[0])
        axes.barh(at, busy, height=0.9 * _THREAD, color=colour, label=f"{name} busy")
        axes.barh(at, wait, left=busy, height=0.9 * _THREAD, label=f"wait of {name}", **_waiting(colour))
        if passes["wait_share"] is not None:
            axes.annotate(f"{100 * passes['wait_share']:.2g} %",
                          (max(map(sum, zip(busy, wait))), sum(at) / len(at)), xytext=(4, 0),
                          textcoords="offset points", va="center", fontsize=style.SMALL)
    axes.set_yticks([tops[bar] + _THREAD * (bar[1] + 1) / 2 for bar in names], map(_name, names))
    axes.set_ylim(sum(map(_height, names)), 0)
    axes.tick_params(axis="y", length=0)
    axes.xaxis.set_major_locator(MaxNLocator(4))
    axes.grid(False, axis="y")
    axes.set_xlim(0, axes.get_xlim()[1])
    axes.set_xlabel("time per sum [ms]")
