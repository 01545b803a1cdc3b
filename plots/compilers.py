"""The same backend built by several compilers."""
import intervals
import panels
import style
import thread_lines
from summary import NoData

NAME = "compilers"


def draw(summary):
    """Return the figure, or raise NoData. A panel per state (case, dx) and pair of compilers."""
    groups, found = [], panels.of_table(summary, "compiler_comparison", lambda row: row["ratio"] is not None)
    if not found:
        raise NoData('the table "compiler_comparison" has no ratio')
    common, own = panels.titles(found)
    for panel, text in zip(found, own):
        for (base, compiler), rows in panels.split(panel.rows, "base_compiler", "compiler"):
            rows = sorted(rows, key=lambda row: (style.backend_rank(row["backend"]), row["M"] or 0,
                                                 row["threads"]))
            dots = [intervals.Dot(row, _name(row), style.colour(row["backend"]), row["verdict"])
                    for row in rows]
            groups.append((panels.joined(text, f"{compiler} against {base}"), dots))
    level = thread_lines.confidence(row for panel in found for row in panel.rows)
    return intervals.sheet(summary, "Summation time by compiler", f"{common}; dot: ratio; line: {level}",
                           groups, "time of the base compiler / time (right of 1: faster)")


def _name(row):
    return f"{row['backend']}, {panels.cells(row)}, {row['threads']} thr."
