"""The ladder of strategies: how many times as fast as the base each backend gets the rates, fastest on top."""
import axes_ticks
import labels
import layout
import panels
import strategies
import style
import thread_lines
import wording

NAME = "strategy_ladder"
_BAR = 0.23  # inches per bar
_AT = {"one_thread": "1 thread", "most_threads": "each at its most threads"}


def draw(summary):
    """Return the figure, or raise NoData. Per world: 1 thread and most threads."""
    found, common = strategies.worlds(summary, "strategy_ladder")
    split = [[(at, sorted(rows, key=lambda row: row["rank"])) for at, rows in panels.split(panel.rows, "at")]
             for panel in found]
    split = [sorted(columns, key=lambda column: list(_AT).index(column[0])) for columns in split]
    places = layout.arrange(summary, split, most=2)
    heights = {}
    for columns, group in zip(split, places):
        for (_, rows), (row, _) in zip(columns, group):
            heights[row] = max(heights.get(row, 0), 0.15 + _BAR * len(rows))
    titles = {place: f"{strategies.world(panel)}: {_AT[at]}; base {_base(rows[0])}" for columns, panel, group
              in zip(split, found, places) for (at, rows), place in zip(columns, group)}
    all_rows = [row for panel in found for row in panel.rows]
    page = layout.Sheet(summary, "Strategies: times as fast as the base (prepare + zero + sum + reduce)",
                        f"{common}; lines: {thread_lines.confidence(all_rows)}; in brackets: time", titles, 2.7,
                        heights, (labels.tick_room(map(_name, all_rows)), labels.room(map(_value, all_rows))),
                        key=strategies.key(summary, [row["backend"] for row in all_rows]))
    colours = strategies.colours(summary)
    for columns, group in zip(split, places):
        everything = [row for _, rows in columns for row in rows]
        right = min(max(map(_end, everything)), 1.4 * max(row["ratio"] for row in everything))  # wide intervals are cut
        for (_, rows), place in zip(columns, group):
            _panel(page.axes[place], rows, colours, right)
    return page.figure


def _base(row):
    return f"{row['base_backend']}, {wording.threads(row['base_threads'])}, {wording.time(row['base_time_s'])}"


def _name(row):
    cells = panels.m_text(row["M"])
    return panels.joined(row["backend"], cells, f"{row['threads']} thr." if row["at"] == "most_threads" else "")


def _value(row):
    return f"{row['ratio']:.2f} ({wording.time(row['time_s'])})"


def _end(row):
    return row["ratio"] if row["high"] is None else max(row["ratio"], row["high"])


def _panel(axes, rows, colours, right):
    axes.axvline(1.0, color=style.RULE, linestyle="--", linewidth=1.2, label="equal", zorder=1)
    for at, row in enumerate(rows):
        axes.barh(at, row["ratio"], height=0.7, color=colours.get(row["backend"], style.KINDS["unsaid"]),
                  edgecolor=style.INK, linewidth=0.5, label=f"ratio of {row['backend']}", zorder=2)
        if row["low"] is not None and row["high"] is not None:
            axes.plot([row["low"], row["high"]], [at, at], color=style.INK, linewidth=1.6, marker="|", markersize=6,
                      label=f"interval {row['backend']}", zorder=3)
        axes.annotate(_value(row), (min(_end(row), right), at), xytext=(5, 0), textcoords="offset points", va="center",
                      fontsize=style.SMALL)
    axes.set_yticks(range(len(rows)), map(_name, rows))
    axes.set_ylim(len(rows) - 0.4, -0.6)
    axes.set_xlim(0, 1.02 * max(right, 1.0))
    axes_ticks.few(axes.xaxis)
    axes.tick_params(axis="y", length=0)
    axes.grid(False, axis="y")
    axes.set_xlabel("times as fast as the base")
