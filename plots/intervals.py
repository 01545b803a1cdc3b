"""Ratios with their intervals as rows of dots: what self_test and compilers share."""
import axes_ticks
import labels
import layout
import style

_ROW = 0.27  # inches per row


class Dot:
    """One row: a ratio with low and high (or None), what was expected, and a word behind it."""

    def __init__(self, row, name, colour, verdict, expected=None):
        self.row, self.name, self.colour, self.verdict = row, name, colour, verdict
        self.expected = expected

    def values(self):
        """Return the numbers that the row shows."""
        return [value for value in (self.row["ratio"], self.row["low"], self.row["high"], self.expected)
                if value is not None]


def sheet(summary, title, subtitle, groups, label):
    """Draw groups of dots, [(panel title, [Dot])], and return the figure."""
    places = [place for group in layout.arrange(summary, [[group] for group in groups], most=2) for place in group]
    heights = {}
    for (row, _), (_, dots) in zip(places, groups):
        heights[row] = max(heights.get(row, 0), 0.2 + _ROW * len(dots))
    everything = [dot for _, dots in groups for dot in dots]
    page = layout.Sheet(summary, title, subtitle, dict(zip(places, [text for text, _ in groups])), 3.1,
                        heights, (labels.tick_room(dot.name for dot in everything),
                                  labels.room(dot.verdict for dot in everything)))
    for place, (_, dots) in zip(places, groups):
        _panel(page.axes[place], dots, [value for dot in everything for value in dot.values()], label)
    return page.figure


def _panel(axes, dots, values, label):
    axes.axvline(1.0, color=style.RULE, linestyle="--", linewidth=1.2, label="equal", zorder=1)
    for at, dot in enumerate(dots):
        row = dot.row
        if dot.expected is not None:
            axes.plot([dot.expected], [at], marker="|", markersize=15, markeredgewidth=2.2, linestyle="",
                      color=style.INK, label=f"expected {dot.name}", zorder=2)
        if row["ratio"] is not None:
            if row["low"] is not None and row["high"] is not None:
                axes.plot([row["low"], row["high"]], [at, at], color=dot.colour, linewidth=2.4,
                          label=f"interval {dot.name}", zorder=3)
            axes.plot([row["ratio"]], [at], marker="o", markersize=6, color=dot.colour, linestyle="",
                      markeredgecolor=style.INK, markeredgewidth=0.6, label=dot.name, zorder=4)
        axes.annotate(dot.verdict, (1, at), xycoords=("axes fraction", "data"), xytext=(8, 0),
                      textcoords="offset points", va="center", fontsize=style.SMALL, annotation_clip=False)
    axes.set_yticks(range(len(dots)), [dot.name for dot in dots])
    axes.set_ylim(len(dots) - 0.4, -0.6)
    low, high = min([*values, 1.0]), max([*values, 1.0])
    room = 0.06 * (high - low) or 0.05
    axes.set_xlim(low - room, high + room)
    axes_ticks.few(axes.xaxis)
    axes.tick_params(axis="y", length=0)
    axes.set_xlabel(label)
