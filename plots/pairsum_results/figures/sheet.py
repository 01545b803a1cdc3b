"""Figures of panels: where they stand, their titles, legend, footer, and labels of line ends that do not overlap."""
import dataclasses
import math
import re
import textwrap
from typing import Any, Callable, Iterable, Iterator

import numpy as np
import pandas as pd
from matplotlib import rcParams
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from . import marks
from .style import INK, MUTED, Look

ROW = 0.024  #: inches of a row of text, per point of the font
_AROUND = 0.09  # inches of title and axis around a panel, per point of the font


@dataclasses.dataclass
class Panel:
    """Axes to be: `paint` draws them; `rows` is how many lines of text need room above one another."""
    title: str
    paint: Callable[[Axes], None]
    rows: float = 8.0
    key: list[Any] = dataclasses.field(default_factory=list)  #: what the legend above the panels shows


def sheet(panels: list[Panel], look: Look, heading: str = "", footer: str = "") -> Figure:
    """The figure of these panels, under matplotlib's settings for the look: columns of one width, axes as high as their
    rows, around them what their texts need."""
    columns, font = min(look.columns, len(panels)), look.font
    width, figure = columns * look.panel, Figure(figsize=(columns * look.panel, 4.0))
    renderer = FigureCanvasAgg(figure).get_renderer()
    heights = [ROW * font * max(panel.rows, 2.5) for panel in panels]
    margins = np.empty((len(panels), 4))  # left, right, below, above, in inches
    for k, panel in enumerate(panels):
        axes = figure.add_axes((0.2 / columns, 0.5, 0.6 / columns, heights[k] / 4))
        panel.paint(axes)
        inner, outer = axes.get_window_extent(), axes.get_tightbbox(renderer, for_layout_only=True)
        margins[k] = inner.x0 - outer.x0, outer.x1 - inner.x1, inner.y0 - outer.y0, outer.y1 - inner.y1
    margins = margins / figure.dpi + 0.006 * font
    sides = [margins[k::columns, :2].max(axis=0) for k in range(columns)]
    top, texts = 0.01 * font, []
    if look.titled:
        texts.append((top, textwrap.wrap(heading, int(80 * width / font)), 1.3, {"fontweight": "bold"}))
        top += 0.024 * font * len(texts[0][1])
    start = top
    key = list({handle.get_label(): handle for panel in panels for handle in panel.key}.values())
    key_columns, key_lines = _wrapped(key, (width - sides[0][0]) / font)
    key_top, top = top, top + 0.021 * font * key_lines
    places = []
    for first in range(0, len(panels), columns):
        row = range(first, min(first + columns, len(panels)))
        lines = max(_titled(figure.axes[k], panels[k].title, look.panel - sides[k - first][0], margins[k, 3])
                    for k in row)
        top += margins[row, 3].max() + font * (0.018 * lines + 0.006)
        places += [((k - first) * look.panel + sides[k - first][0], top, look.panel - sum(sides[k - first]), heights[k])
                   for k in row]
        top += max(heights[k] + margins[k, 2] for k in row) + 0.012 * font
    end = top
    if look.titled:
        texts.append((top, textwrap.wrap(footer, int(140 * width / font)), 0.8, {"color": MUTED}))
        top += 0.015 * font * (len(texts[1][1]) + 0.5)
    figure.set_size_inches(width, top)
    figure.inner = start, end  # inches from the top between which there is neither title nor footer
    for k, (x, y, wide, high) in enumerate(places):
        figure.axes[k].set_position((x / width, 1 - (y + high) / top, wide / width, high / top))
        _spread(figure.axes[k], font)
    for y, lines, size, how in texts:
        figure.text(0.01 * font / width, 1 - y / top, "\n".join(lines), va="top", fontsize=size * font, **how)
    if key:
        figure.legend(handles=key, loc="upper left", bbox_to_anchor=(sides[0][0] / width, 1 - key_top / top),
                      ncol=key_columns, borderpad=0.2, borderaxespad=0, handlelength=1.4, columnspacing=1.2)
    return figure


def packed(panels: list[Panel], look: Look) -> Iterator[list[Panel]]:
    """The panels in sheets that are about as high as the look has room for; a panel that is higher stands alone."""
    some, used = [], 0.0
    for first in range(0, len(panels), look.columns):
        row = panels[first:first + look.columns]
        high = look.font * (ROW * max(panel.rows for panel in row) + _AROUND)
        if some and used + high > look.height:
            yield some
            some, used = [], 0.0
        some, used = some + row, used + high
    if some:
        yield some


def _titled(axes: Axes, title: str, width: float, above: float) -> int:
    """Sets a title of this width above what stands there (inches); returns its lines."""
    whole = re.sub(r"(\d|base) (?=thread|\w)", "\\1\N{NO-BREAK SPACE}", title)
    lines = textwrap.wrap(whole, max(20, int(94 * width / rcParams["font.size"])), break_long_words=False)
    axes.set_title("\n".join(lines), pad=72 * above + 0.3 * rcParams["font.size"])
    return len(lines)


def _wrapped(key: list[Any], width: float) -> tuple[int, int]:
    """Wraps the entries of a legend into a width (inches per point); returns its columns and its lines of text."""
    for handle in key:
        handle.set_label(textwrap.fill(handle.get_label(), int((width - 0.05) / 0.0075)))
    lines = [handle.get_label().splitlines() for handle in key]
    longest = max((len(line) for some in lines for line in some), default=0)
    rows = math.ceil(len(key) / max(1, int(width / (0.0075 * longest + 0.045))))
    return math.ceil(len(key) / max(rows, 1)), rows * max(map(len, lines), default=0)


def ratio_rows(title: str, own: pd.DataFrame, names: Iterable[str], said: Iterable[str], every: pd.DataFrame,
               label: str) -> Panel:
    """Rows of ratios with their intervals, where there are such what was "expected", and a word behind each; the axis
    spans `every` line, of other panels too."""
    limits = [1.0, *every[[c for c in ("ratio", "low", "high", "expected") if c in every]].astype(float).stack()]
    edge = 0.06 * (max(limits) - min(limits)) or 0.05

    def paint(axes: Axes) -> None:
        rows = marks.name_rows(axes, names)
        marks.reference(axes, 1.0, label="equal")
        if "expected" in own:
            axes.scatter(own["expected"], rows, marker="|", s=220, linewidths=2.2, color=INK, label="expected")
        marks.dots(axes, rows, own, label)
        axes.set_xlim(min(limits) - edge, max(limits) + edge)
        marks.beside(axes, [max(limits) + edge] * len(own), rows, said)

    return Panel(title, paint, len(own))


def _spread(axes: Axes, font: float) -> None:
    """Moves the labels of line ends apart: up as far as they need, then down as far as there is no room."""
    to_panel = axes.transData + axes.transAxes.inverted()
    labels = sorted((to_panel.transform(text.xy)[1], k) for k, text in enumerate(axes.texts) if text.get_gid() == "end")
    step = 0.0175 * font * axes.figure.dpi / axes.get_window_extent().height
    at = np.clip([y for y, _ in labels], 0, 1)
    for k in range(1, len(at)):
        at[k] = max(at[k], at[k - 1] + step)
    for k, most in zip(range(len(at) - 1, -1, -1), 1 - step * np.arange(len(at))):
        at[k] = min(at[k], most)
    for y, (_, k) in zip(at, labels):
        axes.texts[k].set_position((1, y))
