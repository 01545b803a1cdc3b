"""Does the harness find what it should: known slowdowns, no difference with itself, a wrong sum."""
import intervals
import panels
import style
import thread_lines
from summary import NoData

NAME = "self_test"


def draw(summary):
    """Return the figure, or raise NoData. One row per check; checks without a ratio say only if they hold."""
    rows = summary["self_test"]
    if not rows:
        raise NoData('the table "self_test" is empty')
    dots = [intervals.Dot(row, _name(row), style.colour(row["base_backend"]),
                          "holds" if row["holds"] else "DOES NOT HOLD", row["expected"]) for row in rows]
    return intervals.sheet(summary, "Self-test of the harness: measured time ratio against the expected one",
                           f"dot: ratio; line: {thread_lines.confidence(rows)}; tall mark: expected",
                           [("", dots)], "time / time of the base")


def _name(row):
    who = row["base_backend"]
    if not row["backend"].endswith(who):  # a copy's name ends in that of its base
        who = f"{row['backend']} / {who}"
    return f"{row['what']}: {who}, {panels.cells(row)}, {row['threads']} thr."
