"""Parallel efficiency (speedup over own one thread / threads) against threads."""
import speedup
import style
import thread_lines

NAME = "efficiency"


def draw(summary):
    """Return the figure, or raise NoData. One panel per state (case, dx) and M."""
    groups = speedup.parallel_lines(summary, "efficiency")
    return thread_lines.sheet(summary, "Parallel efficiency of the summation over own 1 thread",
                              groups, _value_axis, _ideal)


def _value_axis(axes, lines, counts):
    highest = max(row["efficiency"] for line in lines for row in line.rows)
    axes.set_ylim(0, max(1.0, highest) * 1.08)
    axes.set_ylabel("efficiency: speedup / threads")


def _ideal(axes, counts, lines):
    axes.plot([min(counts), max(counts)], [1.0, 1.0], color=style.RULE, linestyle="--",
              linewidth=1.2, label="ideal", zorder=1)
    return [(max(counts), 1.0, "ideal", style.RULE)]
