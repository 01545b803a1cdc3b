"""All backends at their best M: time per interacting pair, fastest on top."""
import labels
import layout
import panels
import style
from summary import NoData

NAME = "ladder"
_BAR = 0.26  # inches per bar


def draw(summary):
    """Return the figure, or raise NoData. Per state (case, dx, ...): 1 thread and most threads."""
    groups = []
    for panel in panels.of_points(summary, lambda entry: entry["ns_per_pair"] is not None):
        one = best(row for row in panel.rows if row["threads"] == 1)
        most = best(_at_most_threads(panel.rows))
        columns = [("1 thread", one)] if one else []
        if any(row["threads"] > 1 for row in most):
            columns.append(("each at its most threads", most))
        groups.append((panel, columns))
    if not groups:
        raise NoData('no entry of "points" has ns_per_pair')
    common, own = panels.titles([panel for panel, _ in groups])
    places = layout.arrange([columns for _, columns in groups], most=2)
    rows = max(len(some) for _, columns in groups for _, some in columns)
    names = [_name(row) for _, columns in groups for _, some in columns for row in some]
    titles = {place: panels.joined(text, column) for (_, columns), text, group
              in zip(groups, own, places) for (column, _), place in zip(columns, group)}
    page = layout.Sheet(summary, "Time per interacting pair, each backend at its best M", common,
                        titles, 3.1, 0.15 + _BAR * rows,
                        (labels.tick_room(names), 0.45))
    for (_, columns), group in zip(groups, places):
        right = max(row["ns_per_pair"] for _, some in columns for row in some)
        for (_, some), place in zip(columns, group):
            _panel(page.axes[place], some, right)
    return page.figure


def best(rows):
    """Return each backend's row with the smallest ns_per_pair, fastest first."""
    return sorted((min(some, key=lambda row: row["ns_per_pair"])
                   for _, some in panels.split(rows, "backend")),
                  key=lambda row: row["ns_per_pair"])


def _at_most_threads(rows):
    most = {backend: max(row["threads"] for row in some)
            for backend, some in panels.split(rows, "backend")}
    return [row for row in rows if row["threads"] == most[row["backend"]]]


def _name(row):
    return f"{row['backend']}, {panels.m_text(row['M'])}, {row['threads']} thr."


def _value(nanoseconds):
    return f"{nanoseconds:.1f}" if nanoseconds >= 10 else f"{nanoseconds:#.3g}"


def _panel(axes, rows, right):
    for at, row in enumerate(rows):
        axes.barh(at, row["ns_per_pair"], height=0.7, color=style.colour(row["backend"]),
                  edgecolor=style.INK, linewidth=0.5,
                  label=f"{row['backend']} {panels.m_text(row['M'])}")
        axes.annotate(_value(row["ns_per_pair"]), (row["ns_per_pair"], at), xytext=(4, 0),
                      textcoords="offset points", va="center", fontsize=style.SMALL)
    axes.set_yticks(range(len(rows)), [_name(row) for row in rows])
    axes.set_ylim(len(rows) - 0.4, -0.6)
    axes.set_xlim(0, right * 1.02)
    axes.tick_params(axis="y", length=0)
    axes.grid(False, axis="y")
    axes.set_xlabel("time per interacting pair [ns]")
