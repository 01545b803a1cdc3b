"""What the grid parameter M costs and saves: time, distance tests, collisions, cells."""
import axes_ticks
import labels
import layout
import panels
import style
import thread_lines
from summary import NoData

NAME = "m_comparison"

#: Panels that do not depend on the threads: (field, panel title, axis label, logarithmic).
WORK = (("pairs_tested", "candidate tests", "distance tests per step [pairs]", True),
        ("collision_share", "collision share", "distance tests that folding adds / all", False),
        ("useful_pair_ratio", "useful-pair ratio", "interacting pairs / tested pairs", False),
        ("cells_nonempty", "non-empty cells", "non-empty cells", True))


def draw(summary):
    """Return the figure, or raise NoData. Per state (case, dx): time by threads, then work."""
    groups = []
    for panel in panels.of_table(summary, "m_comparison", lambda row: row["M"] is not None):
        shown = []
        for threads, rows in panels.split(panel.rows, "threads"):
            shown.append(("time_s", f"{threads} thread{'s' * (threads != 1)}",
                          "summation time [s]", True, _series(rows, "time_s")))
        for field, title, label, logarithmic in WORK:
            shown.append((field, title, label, logarithmic, _series(panel.rows, field)))
        shown = [item for item in shown if item[-1]]
        if shown:
            groups.append((panel, [item for item in shown if item[0] == "time_s"],
                           [item for item in shown if item[0] != "time_s"]))
    if not groups:
        raise NoData('the table "m_comparison" has no row with an M and a value')
    return _sheet(summary, groups)


def _series(rows, field):
    """Return [(backend, rows by M)]; of several thread counts (the work is the same) the fewest."""
    series = []
    for backend, some in panels.split([r for r in rows if r[field] is not None], "backend"):
        by_m = panels.split(some, "M")
        series.append((backend, [row for _, same in by_m for row in same
                                 if row["threads"] == min(r["threads"] for r in same)]))
    return sorted(series, key=lambda item: style.backend_rank(item[0]))


def _sheet(summary, groups):
    common, own = panels.titles([panel for panel, _, _ in groups])
    halves = [half for _, time, work in groups for half in (time, work) if half]
    texts = [text for (_, time, work), text in zip(groups, own) for half in (time, work) if half]
    if len(halves) > 1 and all(len(half) == 1 for half in halves):
        places = [[(row, 0)] for row in range(len(halves))]
    else:
        places = layout.arrange(summary, halves)
    names = [backend for half in halves for item in half for backend, _ in item[-1]]
    most = max(len(item[-1]) for half in halves for item in half)
    titles = {place: panels.joined(text, item[1]) for half, text, group
              in zip(halves, texts, places) for item, place in zip(half, group)}
    page = layout.Sheet(summary, "Summation time and work of the cell search against M (grid of "
                        "2^(dM) hashed cells)", common + _bars(groups),
                        titles, 2.9, max(2.35, most * labels.STEP + 0.1),
                        (0.78, labels.room(names)))
    for half, group in zip(halves, places):
        for item, place in zip(half, group):
            _panel(page.axes[place], item)
    return page.figure


def _bars(groups):
    """Say what the error bars are, if there are some."""
    rows = [row for _, time, _ in groups for item in time for _, some in item[-1] for row in some]
    known = any(row["low"] is not None and row["high"] is not None for row in rows)
    return f"; error bars: {thread_lines.confidence(rows)}" if known else ""


def _panel(axes, item):
    """Draw one panel. Lines that coincide stay visible: earlier ones are wider."""
    field, _, label, logarithmic, series = item
    if field != "time_s":  # low and high are of the time
        series = [(backend, [{**row, "low": None, "high": None} for row in rows])
                  for backend, rows in series]
    drawn = [[(row["M"], row[field]) for row in rows] for _, rows in series]
    for index, (backend, rows) in enumerate(series):
        wider = drawn[index + 1:].count(drawn[index])
        axes.plot([row["M"] for row in rows], [row[field] for row in rows],
                  color=style.colour(backend), linestyle=style.line(backend), marker="o",
                  markersize=4.5 + 0.6 * wider, markeredgecolor=style.INK,
                  markeredgewidth=0.5, linewidth=1.6 + 0.7 * wider, zorder=3,
                  label=backend)
        thread_lines.intervals(axes, rows, "M", field, f"interval {backend}", style.colour(backend))
    values = [row[key] for _, rows in series for row in rows for key in (field, "low", "high")
              if row[key] is not None]
    if logarithmic and min(values) > 0:
        axes_ticks.logarithmic(axes.yaxis, values, counted=field != "time_s")
    else:
        axes.set_ylim(0, 1.06 * max(values) or 1)
    ms = sorted({row["M"] for _, rows in series for row in rows})
    axes.set_xlim(ms[0] - 0.25, ms[-1] + 0.25)
    axes_ticks.whole(axes.xaxis, ms)
    axes.set_xlabel("M")
    axes.set_ylabel(label)
    labels.at_ends(axes, [(rows[-1]["M"], rows[-1][field], backend, style.colour(backend))
                          for backend, rows in series])
