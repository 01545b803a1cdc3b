"""All backends at their best M: time per interacting pair and its parts, fastest on top."""
from matplotlib.colors import to_rgb
from matplotlib.patches import Patch

import choice
import labels
import layout
import panels
import style
from summary import PAIR_PARTS, NoData

NAME = "ladder"
_BAR = 0.26  # inches per bar
#: Parts in their order in time: (key, how far towards white, or below 0 towards black).
_PARTS = (("prepare", 0.6), ("zero", 0.85), ("sum", 0.0), ("reduce", -0.45))


def draw(summary):
    """Return the figure, or raise NoData. Per state (case, dx, ...): 1 thread and most threads."""
    groups = []
    for panel in panels.of_points(summary, _known, without=("grid",)):
        one = choice.best((row for row in panel.rows if row["threads"] == 1), _all)
        most = choice.best(choice.at_most_threads(panel.rows), _all)
        columns = [("1 thread", one)] if one else []
        if any(row["threads"] > 1 for row in most):
            columns.append(("each at its most threads", most))
        groups.append((panel, columns))
    if not groups:
        raise NoData('no entry of "points" has all ns_per_pair_parts')
    common, own = panels.titles([panel for panel, _ in groups])
    places = layout.arrange(summary, [columns for _, columns in groups], most=2)
    rows = max(len(some) for _, columns in groups for _, some in columns)
    names = [_name(row) for _, columns in groups for _, some in columns for row in some]
    titles = {place: panels.joined(text, column) for (_, columns), text, group
              in zip(groups, own, places) for (column, _), place in zip(columns, group)}
    values = [_value(row) for _, columns in groups for _, some in columns for row in some]
    page = layout.Sheet(summary, "prepare + zero + sum + reduce, ns per interacting pair",
                        f"{common}; number: all (sum alone), at the best M",
                        titles, 3.1, 0.15 + _BAR * rows,
                        (labels.tick_room(names), labels.room(values)),
                        key=[Patch(label=part, **_look(shade, style.MUTED)) for part, shade in _PARTS])
    for (_, columns), group in zip(groups, places):
        right = max(_end(row) for _, some in columns for row in some)
        for (_, some), place in zip(columns, group):
            _panel(page.axes[place], some, right)
    return page.figure


def _known(entry):
    parts = entry.get("ns_per_pair_parts", {})
    return all(parts.get(part) is not None for part in PAIR_PARTS)


def _all(row):
    return row["ns_per_pair_parts"]["all"]


def _end(row):
    """Return where the bar ends: the medians of the parts need not add up to that of all."""
    return sum(row["ns_per_pair_parts"][part] for part, _ in _PARTS)


def _name(row):
    return f"{row['backend']}, {panels.cells(row)}, {row['threads']} thr."


def _value(row):
    return f"{_number(_all(row))} ({_number(row['ns_per_pair_parts']['sum'])})"


def _number(nanoseconds):
    return f"{nanoseconds:.1f}" if nanoseconds >= 10 else f"{nanoseconds:#.3g}"


def _look(shade, colour):
    """Return how a part is drawn in the colour of its backend."""
    towards = 1.0 if shade > 0 else 0.0
    face = tuple((1 - abs(shade)) * channel + abs(shade) * towards for channel in to_rgb(colour))
    return {"facecolor": face, "edgecolor": style.INK, "linewidth": 0.5}


def _panel(axes, rows, right):
    for at, row in enumerate(rows):
        left, name = 0.0, f"{row['backend']} {panels.cells(row)}"
        for part, shade in _PARTS:
            length = row["ns_per_pair_parts"][part]
            axes.barh(at, length, left=left, height=0.7,
                      label=name if part == "sum" else f"{part} of {name}",
                      **_look(shade, style.colour(row["backend"])))
            left += length
        axes.annotate(_value(row), (left, at), xytext=(4, 0),
                      textcoords="offset points", va="center", fontsize=style.SMALL)
    axes.set_yticks(range(len(rows)), [_name(row) for row in rows])
    axes.set_ylim(len(rows) - 0.4, -0.6)
    axes.set_xlim(0, right * 1.02)
    axes.tick_params(axis="y", length=0)
    axes.grid(False, axis="y")
    axes.set_xlabel("time per interacting pair [ns]")
