"""Figures of panels placed in inches: room for labels at line ends, a title, a footer."""
import math
import textwrap

from matplotlib.figure import Figure

import labels
import style
import usual

_LINE = 0.17  # inches per line of the footer


def for_page(summary, side_by_side):
    """Return the summary for figures inside a page: that many panels side by side, no title, no footer."""
    return {**summary, "page": side_by_side}


def arrange(summary, groups, most=3):
    """Place groups of panels: [(row, column)] per group, each group on rows of its own.

    Groups of one panel each share rows. Rows hold at most `most` panels, fewer on a page.
    """
    most = min(most, summary.get("page") or most)
    if all(len(group) == 1 for group in groups):
        return [[place] for place in _flow(len(groups), most, 0)]
    placed, row = [], 0
    for group in groups:
        placed.append(_flow(len(group), most, row))
        row = placed[-1][-1][0] + 1
    return placed


def _flow(count, most, first):
    rows = math.ceil(count / most)
    columns = math.ceil(count / rows)
    return [(first + index // columns, index % columns) for index in range(count)]


class Sheet:
    """A figure with panels of one width (inches); `gaps` are left and right of each.

    titles: {(row, column): title of the panel there}; heights: {row: inches}, or one for all rows;
    key: what the legend above the panels shows.
    """

    def __init__(self, summary, title, subtitle, titles, width, heights, gaps, key=()):
        rows = 1 + max(row for row, _ in titles)
        columns = 1 + max(column for _, column in titles)
        if not isinstance(heights, dict):
            heights = {row: heights for row in range(rows)}
        (left, right), below = gaps, 0.62
        wrapped = {place: textwrap.wrap(text, int((width + 0.5 * right) * 10.5),
                                        break_long_words=False)
                   for place, text in titles.items()}
        above = 0.26 + 0.165 * max(map(len, wrapped.values()))
        self.size = [max(4.4 if summary.get("page") else 7.6, columns * (left + width + right) + 0.15), 0.0]
        wrap = int(self.size[0] * 12.2)
        on_page = summary.get("page")
        title = [] if on_page else textwrap.wrap(title, int(self.size[0] * 8.2))
        self.figure = Figure()
        self.figure.subtitle = subtitle  # a page says it in its own text
        subtitle = [] if on_page else textwrap.wrap(subtitle, wrap)
        footer = [] if on_page else footer_lines(summary, int(wrap * 1.15))
        under = 0.05 + 0.25 * len(title)
        most = _key_columns(key, self.size[0])
        head = 0.04 + 0.24 * math.ceil(len(key) / most) if key else 0.0
        head += under + (0.12 if on_page else 0.52 + 0.19 * (len(subtitle) - 1))
        foot = 0.0 if on_page else 0.22 + _LINE * len(footer)
        self.size[1] = head + foot + sum(heights.values()) + rows * (above + below)
        self.figure.set_size_inches(self.size)
        self.axes = {}
        for (row, column), lines in wrapped.items():
            top = head + above + sum(heights[r] + above + below for r in range(row))
            self.axes[row, column] = self._panel(0.1 + column * (left + width + right) + left,
                                                 top, width, heights[row])
            self.axes[row, column].set_title("\n".join(lines), pad=7)
        self._text(0.16, 0.20, "\n".join(title), fontsize=style.TITLE, fontweight="bold", va="top",
                   linespacing=1.3)
        self._text(0.16, under + 0.19, "\n".join(subtitle), fontsize=style.SIZE, va="top",
                   linespacing=1.35)
        self._text(0.16, self.size[1] - foot + 0.08, "\n".join(footer), fontsize=style.SMALL - 1,
                   color=style.MUTED, va="top", linespacing=1.4)
        if key:
            top = head - 0.18 - 0.24 * math.ceil(len(key) / most)
            self.figure.legend(handles=key, loc="upper left", ncol=most, frameon=False, borderaxespad=0,
                               bbox_to_anchor=(0.1 / self.size[0], 1 - top / self.size[1]),
                               handlelength=1.4, columnspacing=1.2, borderpad=0.2)

    def _panel(self, x, top, width, height):
        return self.figure.add_axes([x / self.size[0], 1 - (top + height) / self.size[1],
                                     width / self.size[0], height / self.size[1]])

    def _text(self, x, top, text, **options):
        self.figure.text(x / self.size[0], 1 - top / self.size[1], text, **options)


def _key_columns(key, width):
    """Return in how many columns the entries of a legend fit into a width in inches."""
    longest = max((labels.text_width(entry.get_label(), style.SIZE) for entry in key), default=0)
    return max(1, min(len(key), int((width - 0.2) / (longest + 0.5))))


def footer_lines(summary, wrap):
    """Say where the numbers come from: host cpu, compiler, git; then the summary's caveats."""
    environments = summary["environments"]
    lines = ["environment not recorded"]
    if environments:
        first = environments[0]
        parts = [first.get("cpu"), f"{first['cores']} cores" if first.get("cores") else None,
                 first.get("compiler"), f"git {first['git']}" if first.get("git") else None]
        text = ", ".join(str(part) for part in parts if part) or lines[0]
        text += " (with uncommitted changes)" if first.get("dirty") else ""
        more = len(environments) - 1
        text += f"; and {more} more environment{'s' * (more > 1)}" if more else ""
        lines = textwrap.wrap(text, wrap)
    words = usual.text(summary)
    lines += textwrap.wrap(f"Of those measured in several ways this shows: {words}", wrap) if words else []
    for caveat in summary["caveats"][:3]:
        some = textwrap.wrap(f"Caveat: {caveat}", wrap)
        lines += some if len(some) < 3 else [some[0], some[1] + " ..."]
    if len(summary["caveats"]) > 3:
        lines.append(f"{len(summary['caveats']) - 3} more caveats are in the summary.")
    return lines
