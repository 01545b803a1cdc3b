"""Where the time of a step goes: stacked bars of the phases, one bar per measured point."""
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator

import labels
import layout
import panels
import style
from summary import NoData

NAME = "phase_split"
_BAR = 0.2  # inches per bar


def draw(summary):
    """Return the figure, or raise NoData. Per state (case, dx, ...) one panel per M."""
    found = panels.of_points(summary, lambda entry: any(
        median(entry, phase) is not None for phase, _, _ in style.PHASES))
    if not found:
        raise NoData('no entry of "points" has the median of a phase')
    common, own = panels.titles(found)
    split = [panels.split(panel.rows, "M") for panel in found]
    bars = [sorted({(row["backend"], row["threads"]) for row in panel.rows}, key=_rank)
            for panel in found]
    places = layout.arrange(summary, split)
    heights = {}
    for group, some in zip(places, bars):
        for row, _ in group:
            heights[row] = max(heights.get(row, 0), 0.15 + _BAR * len(some))
    titles = {place: panels.joined(text, panels.m_text(m)) for columns, text, group
              in zip(split, own, places) for (m, _), place in zip(columns, group)}
    key = [Patch(facecolor=colour, label=name) for _, name, colour in style.PHASES]
    key.append(Line2D([], [], color=style.INK, marker="|", linestyle="", markersize=9,
                      markeredgewidth=1.6, label="whole step"))
    page = layout.Sheet(summary, "Phases of a step (medians)", common, titles, 2.9, heights,
                        (labels.tick_room(_name(bar) for names in bars for bar in names), 0.25),
                        key=key)
    for columns, names, group in zip(split, bars, places):
        axes_of_group = [page.axes[place] for place in group]
        for (_, rows), axes in zip(columns, axes_of_group):
            _panel(axes, rows, names)
        right = max(axes.get_xlim()[1] for axes in axes_of_group)
        for axes in axes_of_group:  # one scale, unless a panel would be too small to read
            own_right = axes.get_xlim()[1]
            axes.set_xlim(0, right if own_right > right / 5 else own_right)
    return page.figure


def median(entry, phase):
    """Return the median of a phase in seconds, or None."""
    return entry["phases"].get(phase, {}).get("median")


def _rank(bar):
    return style.backend_rank(bar[0]), bar[1]


def _name(bar):
    return f"{bar[0]}, {bar[1]} thr."


def _panel(axes, rows, names):
    """Draw one bar per (backend, threads) in `names`; a bar that was not measured stays empty."""
    for row in rows:
        at, left = names.index((row["backend"], row["threads"])), 0.0
        for phase, name, colour in style.PHASES:
            if median(row, phase) is not None:
                length = 1e3 * median(row, phase)
                axes.barh(at, length, left=left, height=0.72, color=colour,
                          label=f"{row['backend']} t={row['threads']} {name}")
                left += length
        if median(row, "total_s") is not None:
            axes.plot([1e3 * median(row, "total_s")], [at], color=style.INK, marker="|",
                      markersize=9, markeredgewidth=1.6, linestyle="",
                      label=f"{row['backend']} t={row['threads']} total")
    axes.set_yticks(range(len(names)), [_name(bar) for bar in names])
    axes.set_ylim(len(names) - 0.4, -0.6)
    axes.tick_params(axis="y", length=0)
    axes.xaxis.set_major_locator(MaxNLocator(4))
    axes.grid(False, axis="y")
    axes.set_xlabel("time per step [ms]")
