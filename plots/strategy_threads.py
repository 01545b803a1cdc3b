"""Strategies over threads: how many times as fast as the base on one thread."""
import axes_ticks
import panels
import strategies
import style
import thread_lines
from summary import NoData

NAME = "strategy_threads"


def draw(summary):
    """Return the figure, or raise NoData. One panel per world, colours by how conflicts are avoided."""
    colours = strategies.colours(summary)
    groups = []
    found, common = strategies.worlds(summary, "strategy_threads")
    for panel in found:
        lines = [thread_lines.Line(rows, "ratio", backend, colours.get(backend, style.KINDS["unsaid"]), "over threads")
                 for backend, rows in panels.split(panel.rows, "backend")]
        lines = [line for line in lines if line.rows and line.rows[-1]["threads"] > 1]
        if lines:
            groups.append((panel, [(f"{strategies.world(panel)}; {_base(panel.rows[0])}", lines)]))
    if not groups:
        raise NoData('the table "strategy_threads" has no backend on several threads')
    backends = [line.backend for _, columns in groups for _, lines in columns for line in lines]
    return thread_lines.sheet(summary, "Strategies over threads: times as fast as the base on 1 thread", groups,
                              _value_axis, lambda axes, counts, lines: [], key=strategies.key(summary, backends), most=2,
                              common=common)


def _base(row):
    return f"base {row['base_backend']}, 1 thread"


def _value_axis(axes, lines, counts):
    highest = max(row[key] for line in lines for row in line.rows for key in ("ratio", "high") if row[key] is not None)
    lowest = min(row[key] for line in lines for row in line.rows for key in ("ratio", "low") if row[key] is not None)
    axes_ticks.logarithmic(axes.yaxis, [lowest, highest], counted=False)
    axes.set_ylabel("times as fast as the base")
