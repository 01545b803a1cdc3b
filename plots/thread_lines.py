"""Lines against the number of threads: what speedup, efficiency and algorithm speedup share."""
import axes_ticks
import labels
import layout
import panels
import style


class Line:
    """One line: rows of one backend and M, sorted by threads, without rows whose value is null.

    Its colour is the backend's unless another is said; then it is named by `named` before the backend.
    """

    def __init__(self, rows, value, text, colour=None, named=""):
        self.rows = sorted((row for row in rows if row[value] is not None),
                           key=lambda row: row["threads"])
        self.value, self.text = value, text
        self.backend, self.m = rows[0]["backend"], rows[0]["M"]
        self.name = f"{named} {self.backend} {panels.cells(rows[0])}".strip()
        self.colour = colour or style.colour(self.backend)

    def draw(self, axes):
        """Draw the line, named "backend M=m", and its intervals where they are known."""
        x = [row["threads"] for row in self.rows]
        y = [row[self.value] for row in self.rows]
        look = {"color": self.colour, "linestyle": style.line(self.backend),
                "marker": style.marker(self.m), "markeredgecolor": style.INK,
                "markeredgewidth": 0.6, "markersize": 5.5, "linewidth": 1.8, "zorder": 3}
        axes.plot(x, y, label=self.name, **look)
        intervals(axes, self.known(), "threads", self.value, f"interval {self.name}", look["color"])

    def known(self):
        """Return the rows with an interval; the summary holds them for these values only."""
        return [row for row in self.rows if self.value in ("speedup", "ratio")
                and row["low"] is not None and row["high"] is not None]

    def end(self):
        """Return what labels.at_ends needs."""
        last = self.rows[-1]
        return last["threads"], last[self.value], self.text, self.colour


def sheet(summary, title, groups, value_axis, references, key=(), most=3, common=None):
    """Draw groups of panels and return the figure.

    groups: per panels.Panel a list of (column text, [Line]); value_axis(axes, lines, counts) sets
    the y axis; references(axes, counts, lines) draws lines and returns their ends for the labels; `most` panels
    stand side by side. The titles say what tells the panels apart, unless `common` is given.
    """
    keys = [panel for panel, _ in groups]
    own = [""] * len(keys)
    if common is None:
        common, own = panels.titles(keys)
    places = layout.arrange(summary, [columns for _, columns in groups], most)
    titles = {place: panels.joined(text, column) for (_, columns), text, group
              in zip(groups, own, places) for (column, _), place in zip(columns, group)}
    lines = [line for _, columns in groups for _, some in columns for line in some]
    if any(line.known() for line in lines):
        common += f"; error bars: {confidence(row for line in lines for row in line.known())}"
    ends = max(len(some) for _, columns in groups for _, some in columns) + 3
    page = layout.Sheet(summary, title, common, titles, 2.9, max(2.35, ends * labels.STEP + 0.1),
                        (0.62, labels.room([line.text for line in lines] + ["machine's bandwidth"])), key)
    counts = sorted({row["threads"] for line in lines for row in line.rows})
    for (_, columns), group in zip(groups, places):
        for (_, some), place in zip(columns, group):
            axes = page.axes[place]
            for line in some:
                line.draw(axes)
            axes_ticks.threads(axes, counts)
            value_axis(axes, lines, counts)
            ends = references(axes, counts, some)
            labels.at_ends(axes, [line.end() for line in some], ends)
    return page.figure


def intervals(axes, rows, field, value, name, colour):
    """Draw low to high of the rows that know both as error bars at their fields' values."""
    known = [row for row in rows if row["low"] is not None and row["high"] is not None]
    if known:
        values = [row[value] for row in known]
        reach = [[max(at - row["low"], 0) for at, row in zip(values, known)],
                 [max(row["high"] - at, 0) for at, row in zip(values, known)]]
        axes.errorbar([row[field] for row in known], values, yerr=reach, fmt="none", ecolor=colour,
                      elinewidth=1.1, capsize=3, label=name)


def confidence(rows):
    """Say which confidence the intervals of these rows have."""
    levels = sorted({f"{100 * row['confidence']:.3g} %" for row in rows
                     if row.get("confidence") is not None})
    return f"{' / '.join(levels)} intervals" if levels else "intervals of the summary"
