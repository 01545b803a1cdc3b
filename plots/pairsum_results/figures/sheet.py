"""Figures of panels, and what panels share: rows of names, labels at line ends that do not overlap, plain ticks."""
import dataclasses
import math
import re
import textwrap
from typing import Any, Callable, Iterable

import numpy as np
from matplotlib import rcParams
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from matplotlib.ticker import EngFormatter, FuncFormatter, LogLocator, MaxNLocator, NullLocator
from matplotlib.transforms import ScaledTranslation

from .style import INK, MUTED, RULE, Look, colour

ROW = 0.024  #: inches of a row of text, per point of the font


@dataclasses.dataclass
class Panel:
    """Axes to be: `paint` draws them; `rows` is how many lines of text need room above one another."""
    title: str
    paint: Callable[[Axes], None]
    rows: float = 8.0
    key: list[Any] = dataclasses.field(default_factory=list)  #: what the legend above the panels shows


def sheet(panels: list[Panel], look: Look, heading: str = "", footer: str = "") -> Figure:
    """The figure of these panels, under matplotlib's settings for the look: columns of one width, axes as high as their rows,
    around them what their texts need."""
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
    key = list({handle.get_label(): handle for panel in panels for handle in panel.key}.values())
    key_columns, key_lines = _wrapped(key, (width - sides[0][0]) / font)
    key_top, top = top, top + 0.021 * font * key_lines
    places = []
    for first in range(0, len(panels), columns):
        row = range(first, min(first + columns, len(panels)))
        lines = max(_titled(figure.axes[k], panels[k].title, look.panel - sides[k - first][0], margins[k, 3]) for k in row)
        top += margins[row, 3].max() + font * (0.018 * lines + 0.006)
        places += [((k - first) * look.panel + sides[k - first][0], top, look.panel - sum(sides[k - first]), heights[k])
                   for k in row]
        top += max(heights[k] + margins[k, 2] for k in row) + 0.012 * font
    if look.titled:
        texts.append((top, textwrap.wrap(footer, int(140 * width / font)), 0.8, {"color": MUTED}))
        top += 0.015 * font * (len(texts[1][1]) + 0.5)
    figure.set_size_inches(width, top)
    for k, (x, y, wide, high) in enumerate(places):
        figure.axes[k].set_position((x / width, 1 - (y + high) / top, wide / width, high / top))
        _spread(figure.axes[k], font)
    for y, lines, size, how in texts:
        figure.text(0.01 * font / width, 1 - y / top, "\n".join(lines), va="top", fontsize=size * font, **how)
    if key:
        figure.legend(handles=key, loc="upper left", bbox_to_anchor=(sides[0][0] / width, 1 - key_top / top), borderpad=0.2,
                      ncol=key_columns, borderaxespad=0, handlelength=1.4, columnspacing=1.2)
    return figure


def _titled(axes: Axes, title: str, width: float, above: float) -> int:
    """Sets a title of this width above what stands there (inches); returns its lines."""
    whole = re.sub(r"(\d|base) (?=thread|\w)", "\\1\N{NO-BREAK SPACE}", title)
    lines = textwrap.wrap(whole, max(20, int(94 * width / rcParams["font.size"])), break_long_words=False)
    axes.set_title("\n".join(lines), pad=72 * above + 0.3 * rcParams["font.size"])
    return len(lines)


def _wrapped(key: list[Any], width: float) -> tuple[int, int]:
    """Wraps the entries of a legend into a width (inches per point); returns its columns and its lines of text."""
    for handle in key:
        handle.set_label(textwrap.fill(handle.get_label(), int((width - 0.05) / 0.0085)))
    lines = [handle.get_label().splitlines() for handle in key]
    longest = max((len(line) for some in lines for line in some), default=0)
    columns = max(1, min(len(key), int(width / (0.0085 * longest + 0.045))))
    return columns, math.ceil(sum(map(len, lines)) / columns)


def room(lines: int) -> float:
    """The rows that a panel with so many labelled lines needs."""
    return max(8.0, 0.75 * lines + 1)


def short(name: str, most: int = 48) -> str:
    """A name that leaves room for what it names."""
    return name if len(name) <= most else name[:most - 1] + "\N{HORIZONTAL ELLIPSIS}"


def name_rows(axes: Axes, names: Iterable[str]) -> np.ndarray:
    """Makes the y axis one of named rows, the first on top; returns their heights."""
    names = list(map(short, names))
    axes.set_yticks(range(len(names)), names)
    axes.set_ylim(len(names) - 0.4, -0.6)
    axes.tick_params(axis="y", length=0)
    axes.grid(False, axis="y")
    return np.arange(len(names))


def boxes(axes: Axes, at: Any, left: Any, length: Any, height: float = 0.7, **look: Any) -> None:
    """Horizontal bars, as one artist: of many, matplotlib draws that much faster than patches."""
    x, width = np.broadcast_to(left, len(at)), np.asarray(length, dtype=float)
    corners = np.stack([x, x, x + width, x + width], axis=1), np.add.outer(at, np.array([-0.5, 0.5, 0.5, -0.5]) * height)
    axes.add_collection(PolyCollection(np.stack(corners, axis=2), **look))


def beside(axes: Axes, x: Iterable[float], y: Iterable[float], texts: Iterable[str]) -> None:
    """Writes texts right of points."""
    right = axes.transData + ScaledTranslation(0.07, 0, axes.figure.dpi_scale_trans)
    for at, up, text in zip(x, y, texts):
        axes.text(at, up, text, transform=right, va="center", fontsize="small")


def reference(axes: Axes, x: float | None = None, y: float | None = None, **how: Any) -> None:
    """A dashed grey line across the panel: what would be equal, or ideal."""
    look = {"color": RULE, "linestyle": "--", "linewidth": 1.2, "zorder": 1, **how}
    axes.axvline(x, **look) if y is None else axes.axhline(y, **look)


def ends(axes: Axes, labels: Iterable[tuple[float, float, str, str]]) -> None:
    """Labels line ends, (x, y, text, colour), right of the panel; sheet() moves them apart."""
    right = axes.transAxes + ScaledTranslation(0.22, 0, axes.figure.dpi_scale_trans)
    for x, y, text, colour in labels:
        axes.annotate(short(text), (x, y), xytext=(1, 0.5), textcoords=right, va="center", fontsize="small", annotation_clip=False,
                      gid="end", arrowprops={"arrowstyle": "-", "color": colour, "linewidth": 1, "shrinkA": 0, "shrinkB": 3,
                                             "relpos": (0, 0.5)})


def _spread(axes: Axes, font: float) -> None:
    """Moves the labels of line ends apart to their height, as little as possible (isotonic regression)."""
    labels = [text for text in axes.texts if text.get_gid() == "end"]
    step = 0.0175 * font * axes.figure.dpi / axes.get_window_extent().height
    to_panel = axes.transData + axes.transAxes.inverted()
    wanted = sorted(((min(max(to_panel.transform(text.xy)[1], 0), 1), text) for text in labels), key=lambda pair: pair[0])
    blocks: list[list[float]] = []  # sum and number of wanted[k] - k step
    for k, (at, _) in enumerate(wanted):
        blocks.append([at - k * step, 1])
        while len(blocks) > 1 and blocks[-2][0] / blocks[-2][1] > blocks[-1][0] / blocks[-1][1]:
            total, count = blocks.pop()
            blocks[-1] = [blocks[-1][0] + total, blocks[-1][1] + count]
    last = 1 - (len(wanted) - 1) * step
    low = min(0.0, last / 2) if last < 0 else 0.0
    places = [min(max(total / count, low), max(last, low)) for total, count in blocks for _ in range(int(count))]
    for k, (place, (_, text)) in enumerate(zip(places, wanted)):
        text.set_position((1, place + k * step))


def intervals(axes: Axes, x: Any, y: Any, low: Any, high: Any, colour: str) -> None:
    """Draws low to high, where they are known, as error bars."""
    reach = np.clip([y - low, high - y], 0, None)
    if not np.isnan(reach).all():
        axes.errorbar(x, y, yerr=reach, fmt="none", ecolor=colour, elinewidth=1.1, capsize=3)


def dots(axes: Axes, at: Any, table: Any, label: str) -> None:
    """Dots with their intervals on rows of names: columns "ratio", "low", "high" and, for the colour, "backend"."""
    colours = list(map(colour, table["backend"]))
    axes.hlines(at, table["low"], table["high"], color=colours, linewidth=2.4, zorder=3)
    axes.scatter(table["ratio"], at, c=colours, s=(0.62 * rcParams["font.size"]) ** 2, edgecolors=INK, linewidths=0.6, zorder=4)
    axes.set_xlabel(label)
    few(axes.xaxis)


def plain(value: float, _: Any = None) -> str:
    return f"{value:g}"


def few(axis: Any) -> None:
    """Ticks an axis at round values, as many as its length has room for, written as plain numbers."""
    axis.set_major_locator(MaxNLocator("auto", steps=[1, 2, 2.5, 5, 10]))
    axis.set_major_formatter(FuncFormatter(plain))


def at(axis: Any, values: Iterable[float]) -> None:
    """Ticks an axis at these values only."""
    values = sorted(set(values))
    axis.set_ticks(values, map(plain, values))
    axis.set_minor_locator(NullLocator())


def threads_axis(axes: Axes, counts: Iterable[float]) -> None:
    """Measured numbers of threads on the x axis: linear up to 3, log2 from 4."""
    counts = sorted(set(counts))
    if counts[-1] >= 4:
        axes.set_xscale("log", base=2)
        axes.set_xlim(counts[0] / 1.15, counts[-1] * 1.15)
        counts = [c for c in counts if len(counts) <= 8 or int(c) & (int(c) - 1) == 0] or counts
    else:
        axes.set_xlim(counts[0] - 0.12, counts[-1] + 0.12)
    at(axes.xaxis, counts)
    axes.set_xlabel("threads")


def log(axes: Axes, along: str, values: Iterable[float], counted: bool = False) -> None:
    """A logarithmic axis with ticks like 1, 2, 5 over positive values; counts read 5 M."""
    axis = axes.xaxis if along == "x" else axes.yaxis
    values = [v for v in values if v > 0]
    low, high = min(values), max(values)
    room = (high / low) ** 0.06 if high > low else 1.5
    axes.set(**{f"{along}scale": "log", f"{along}lim": (low / room, high * room)})
    spans = (high / low) ** (1.6 if along == "x" else 1)
    subs = (1,) if spans > 1e3 else (1, 2, 5) if spans > 60 else (1, 2, 3, 5) if spans > 6 else (1, 1.5, 2, 3, 4, 5, 6, 8)
    axis.set_major_locator(LogLocator(subs=subs, numticks=30))
    axis.set_minor_locator(NullLocator())
    axis.set_major_formatter(EngFormatter(sep="\N{THIN SPACE}") if counted else FuncFormatter(plain))
