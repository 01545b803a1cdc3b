"""How the summation grows with the number of particles: time per sum and per interacting pair."""
import axes_ticks
import choice
import labels
import layout
import panels
import style
import thread_lines
from summary import NoData

NAME = "size_scaling"
_SIZE = ("dx", "n_fluid", "n_boundary", "N", "H", "dt", "series", "grid")


def draw(summary):
    """Return the figure, or raise NoData. Per state and threads: time and time per pair, at the best M."""
    groups = []
    for panel in panels.of_points(summary, lambda entry: choice.sum_time(entry) is not None
                                  and entry["ns_per_pair"] is not None, without=_SIZE):
        columns = []
        for what, rows in (("1 thread", [row for row in panel.rows if row["threads"] == 1]),
                           ("most threads", choice.at_most_threads(panel.rows))):
            lines = [(backend, line) for backend, line in _lines(rows) if len(line) > 1]
            if lines and (what == "1 thread" or any(row["threads"] > 1 for _, line in lines for row in line)):
                columns += [(f"{what}: {title}", lines, *rest) for title, *rest in _VALUES]
        if columns:
            groups.append((panel, columns))
    if not groups:
        raise NoData('"points" has no backend measured at several dx')
    common, own = panels.titles([panel for panel, _ in groups])
    places = layout.arrange(summary, [columns for _, columns in groups], most=2)
    titles = {place: panels.joined(text, column[0]) for (_, columns), text, group
              in zip(groups, own, places) for column, place in zip(columns, group)}
    names = [backend for _, columns in groups for _, lines, *_ in columns for backend, _ in lines]
    most = max(len(lines) for _, columns in groups for _, lines, *_ in columns)
    page = layout.Sheet(summary, "Summation against the number of particles, each at its best M",
                        common, titles, 2.9, max(2.4, most * labels.STEP + 0.1), (0.78, labels.room(names)))
    for (_, columns), group in zip(groups, places):
        for (_, lines, value, label), place in zip(columns, group):
            _panel(page.axes[place], lines, value, label)
    return page.figure


_VALUES = (("time per sum", lambda row: {"low": None, "high": None, **row["phases"]["sum_s"]}, "time per sum [s]"),
           ("per pair", lambda row: {"median": row["ns_per_pair"], "low": None, "high": None},
            "ns per interacting pair"))


def _lines(rows):
    """Return [(backend, its best row at each size)]."""
    found = []
    for backend, some in panels.split(rows, "backend"):
        by_size = panels.split(some, "n_fluid", "n_boundary")
        best = [min(same, key=choice.sum_time) for _, same in by_size]
        found.append((backend, sorted(best, key=_particles)))
    return sorted(found, key=lambda item: style.backend_rank(item[0]))


def _particles(row):
    return row["n_fluid"] + row["n_boundary"]


def _panel(axes, lines, value, label):
    axes.set_xscale("log")
    ends, values = [], []
    for backend, rows in lines:
        spots = [{"x": _particles(row), **value(row)} for row in rows]
        axes.plot([spot["x"] for spot in spots], [spot["median"] for spot in spots],
                  color=style.colour(backend), linestyle=style.line(backend), marker="o", markersize=4.5,
                  markeredgecolor=style.INK, markeredgewidth=0.5, linewidth=1.6, label=backend, zorder=3)
        thread_lines.intervals(axes, spots, "x", "median", f"interval {backend}", style.colour(backend))
        values += [spot["median"] for spot in spots]
        ends.append((spots[-1]["x"], spots[-1]["median"], backend, style.colour(backend)))
    sizes = [_particles(row) for _, rows in lines for row in rows]
    axes_ticks.logarithmic(axes.xaxis, sizes, counted=True)
    axes_ticks.logarithmic(axes.yaxis, values, counted=False)
    axes.set_xlabel("particles (fluid + boundary)")
    axes.set_ylabel(label)
    labels.at_ends(axes, ends)
