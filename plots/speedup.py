"""Speedup of each parallel backend over its own run with one thread, against threads."""
import axes_ticks
import panels
import style
import thread_lines
from summary import NoData

NAME = "speedup"
_DRAWN = ("speedup", "low", "high", "machine_flops_scaling", "machine_bandwidth_scaling")
_MACHINE = (("flops", "-"), ("bandwidth", ":"))  # measured peaks against 1 thread


def draw(summary):
    """Return the figure, or raise NoData. One panel per state (case, dx) and M."""
    groups = parallel_lines(summary, "speedup")
    return thread_lines.sheet(summary, "Speedup of the summation over own 1 thread", groups,
                              _value_axis, _references)


def parallel_lines(summary, value):
    """Return [(panel, [("M=6", [Line])])] of the backends measured beyond one thread."""
    groups = []
    for panel in panels.of_table(summary, "speedup"):
        columns = []
        for m, rows in panels.split(panel.rows, "M"):
            lines = [thread_lines.Line(some, value, backend)
                     for backend, some in panels.split(rows, "backend")]
            lines = [line for line in lines if line.rows and line.rows[-1]["threads"] > 1]
            if lines:
                lines.sort(key=lambda line: style.backend_rank(line.backend))
                columns.append((panels.m_text(m), lines))
        if columns:
            groups.append((panel, columns))
    if not groups:
        raise NoData(f'the table "speedup" has no {value} measured with 2 or more threads')
    return groups


def _value_axis(axes, lines, counts):
    values = [row[key] for line in lines for row in line.rows for key in _DRAWN
              if row[key] is not None and row[key] > 0]
    low, high = min(values + counts), max(values + counts)
    if max(counts) >= 4:
        axes.set_yscale("log", base=2)
        axes.set_ylim(low / 1.15, high * 1.15)
        axes_ticks.whole(axes.yaxis, [2.0 ** k for k in range(-6, 12)
                                      if low / 1.15 <= 2.0 ** k <= high * 1.15])
    else:
        axes.set_ylim(low - 0.1 * (high - low), high + 0.1 * (high - low))
    axes.set_ylabel("speedup over own 1 thread")


def _references(axes, counts, lines):
    """Draw what would be ideal, and how flops and bandwidth of the machine scale if known."""
    axes.plot([min(counts), max(counts)], [min(counts), max(counts)], color=style.RULE,
              linestyle="--", linewidth=1.2, label="ideal", zorder=1)
    ends = [(max(counts), max(counts), "ideal", style.RULE)]
    for what, look in _MACHINE:
        known = {row["threads"]: row[f"machine_{what}_scaling"] for line in lines
                 for row in line.rows if row[f"machine_{what}_scaling"] is not None}
        if len(known) > 1:
            spots = sorted(known.items())
            axes.plot(*zip(*spots), color=style.RULE, linestyle=look, linewidth=2.4, alpha=0.75,
                      label=f"machine {what}", zorder=1)
            ends.append((*spots[-1], f"machine's {what}", style.RULE))
    return ends
