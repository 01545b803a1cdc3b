"""What the granularity (schedule and chunk of the parallel loop) costs: a line per schedule."""
import axes_ticks
import choice
import labels
import layout
import panels
import style
import thread_lines
from summary import NoData

NAME = "granularity"
_LINES = {"dynamic": ("-", "o"), "static": ((0, (5, 2)), "s"), "guided": (":", "D"), "simple": ("-", "o"),
          "auto": ((0, (1, 1)), "v"), "affinity": ((0, (3, 1, 1, 1)), "^")}


def draw(summary):
    """Return the figure, or raise NoData. Per state one panel per backend, M and threads."""
    groups = []
    for panel in panels.of_points(summary, lambda entry: choice.sum_time(entry) is not None, every=True):
        columns = [(panels.joined(backend, panels.m_text(m), f"{threads} thr."), rows) for (backend, m, threads), rows
                   in panels.split(panel.rows, "backend", "M", "threads")
                   if len({row["point"]["granularity"] for row in rows}) > 1]
        if columns:
            groups.append((panel, columns))
    if not groups:
        raise NoData('no entry of "points" was measured with several granularities')
    common, own = panels.titles([panel for panel, _ in groups])
    places = layout.arrange(summary, [columns for _, columns in groups])
    titles = {place: panels.joined(text, column) for (_, columns), text, group
              in zip(groups, own, places) for (column, _), place in zip(columns, group)}
    names = [row["point"]["granularity"] for _, columns in groups for _, rows in columns for row in rows]
    level = thread_lines.confidence(row["phases"]["sum_s"] for _, columns in groups
                                    for _, rows in columns for row in rows)
    page = layout.Sheet(summary, "Summation time against granularity (schedule:chunk)",
                        f"{common}; error bars: {level}", titles, 2.9, 2.35, (0.78, labels.room(names)))
    for (_, columns), group in zip(groups, places):
        for (_, rows), place in zip(columns, group):
            _panel(page.axes[place], rows)
    return page.figure


def parts(word):
    """Return (schedule, chunk) of a granularity; the chunk is None where it has none."""
    schedule, _, chunk = word.partition(":")
    return schedule, int(chunk) if chunk.isdigit() and int(chunk) > 0 else None


def _panel(axes, rows):
    """Draw a line per schedule; a schedule without a chunk is one level across the panel."""
    spots = [{"low": None, "high": None, **row["phases"]["sum_s"],
              "schedule": parts(row["point"]["granularity"])[0],
              "chunk": parts(row["point"]["granularity"])[1]} for row in rows]
    chunks = sorted({spot["chunk"] for spot in spots} - {None}) or [1]
    colour, ends = style.colour(rows[0]["backend"]), []
    axes.set_xscale("log", base=2)
    axes.set_xlim(chunks[0] / 1.3, chunks[-1] * 1.3)
    axes_ticks.whole(axes.xaxis, chunks)
    for schedule, some in panels.split(spots, "schedule"):
        line, marker = _LINES.get(schedule, ("-", "X"))
        look = {"color": colour, "linestyle": line, "linewidth": 1.7, "label": schedule, "zorder": 3}
        sized = sorted((spot for spot in some if spot["chunk"]), key=lambda spot: spot["chunk"])
        if sized:
            axes.plot([spot["chunk"] for spot in sized], [spot["median"] for spot in sized], marker=marker,
                      markersize=5, markeredgecolor=style.INK, markeredgewidth=0.5, **look)
            thread_lines.intervals(axes, sized, "chunk", "median", f"interval {schedule}", colour)
            if sized[-1]["chunk"] == chunks[-1]:
                ends.append((sized[-1]["chunk"], sized[-1]["median"], schedule, colour))
            else:  # the label would be far away
                axes.annotate(schedule, (sized[-1]["chunk"], sized[-1]["median"]), xytext=(6, 6),
                              textcoords="offset points", fontsize=style.SMALL)
        for spot in some:
            if not spot["chunk"]:
                axes.axhline(spot["median"], **look)
                ends.append((axes.get_xlim()[1], spot["median"], schedule, colour))
    values = [spot[key] for spot in spots for key in ("low", "median", "high") if spot[key] is not None]
    room = 0.12 * (max(values) - min(values)) or 0.1 * max(values)
    axes.set_ylim(min(values) - room, max(values) + room)
    axes.set_xlabel("chunk")
    axes.set_ylabel("summation time [s]")
    labels.at_ends(axes, ends)
