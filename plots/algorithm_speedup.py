"""How many times faster one algorithm is than another with the same runtime and threads."""
import panels
import style
import thread_lines
from summary import NoData

NAME = "algorithm_speedup"


def draw(summary):
    """Return the figure, or raise NoData. One panel per state (case, dx), runtime and base."""
    groups = []
    for panel in panels.of_table(summary, "algorithm_speedup"):
        columns = []
        for (base_m, _, base), rows in panels.split(_few(panel.rows), "base_M", "runtime",
                                                    "base_backend"):
            lines = [thread_lines.Line(some, "speedup", f"{backend} {panels.m_text(m)}".strip())
                     for (backend, m), some in panels.split(rows, "backend", "M")]
            lines = [line for line in lines if line.rows]
            if lines:
                columns.append((f"base {base} {panels.m_text(base_m)}".strip(), lines))
        if columns:
            groups.append((panel, columns))
    if not groups:
        raise NoData('the table "algorithm_speedup" has no speedup')
    return thread_lines.sheet(summary, "Algorithm speedup: summation time of the base / of the "
                              "labelled backend, same threads", groups, _value_axis, _equal)


def _few(rows):
    """Leave out all M but the talk's, 6 and 7, where many were measured; m_comparison has the others."""
    if len({row["base_M"] for row in rows}) <= 3:
        return rows
    return [row for row in rows if row["base_M"] in (6, 7) and row["M"] in (6, 7)]


def _value_axis(axes, lines, counts):
    highest = max(row[key] for line in lines for row in line.rows for key in ("speedup", "high")
                  if row[key] is not None)
    axes.set_ylim(0, max(1.0, highest) * 1.1)
    axes.set_ylabel("times faster than the base")


def _equal(axes, counts, lines):
    axes.axhline(1.0, color=style.RULE, linestyle="--", linewidth=1.2, label="equal", zorder=1)
    return [(axes.get_xlim()[1], 1.0, "base", style.RULE)]
