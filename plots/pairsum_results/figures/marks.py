"""What panels share: rows of names, bars, dots, intervals, labels at line ends, plain ticks."""
from typing import Any, Iterable

import numpy as np
from matplotlib import rcParams
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.ticker import EngFormatter, FuncFormatter, LogLocator, MaxNLocator, NullLocator
from matplotlib.transforms import ScaledTranslation

from ..words import bounded
from .style import INK, RULE, colour


TOLD = "told "  #: what the id of an artist begins with that says more of each of its shapes


def told(artist: Any, shape: str, texts: Iterable[str]) -> None:
    """What a page says of each shape of an artist ("path", or "use" of markers) that somebody points at."""
    artist.set_gid(f"{TOLD}{shape}:" + "\n".join(texts))


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


def boxes(axes: Axes, at: Any, left: Any, length: Any, height: float = 0.7, texts: Iterable[str] = (), **look: Any
          ) -> None:
    """Horizontal bars, as one artist: of many, matplotlib draws that much faster than patches."""
    x, width = np.broadcast_to(left, len(at)), np.asarray(length, dtype=float)
    corners = (np.stack([x, x, x + width, x + width], axis=1),
               np.add.outer(at, height * np.array([-0.5, 0.5, 0.5, -0.5])))
    told(axes.add_collection(PolyCollection(np.stack(corners, axis=2), **look)), "path", texts)


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
    for x, y, text, hue in labels:
        axes.annotate(short(text), (x, y), xytext=(1, 0.5), textcoords=right, va="center", fontsize="small",
                      annotation_clip=False, gid="end", arrowprops={
                          "arrowstyle": "-", "color": hue, "linewidth": 1, "shrinkA": 0, "shrinkB": 3,
                          "relpos": (0, 0.5)})


def intervals(axes: Axes, x: Any, y: Any, low: Any, high: Any, colour: str) -> None:
    """Draws low to high, where they are known, as error bars."""
    reach = np.clip([y - low, high - y], 0, None)
    if not np.isnan(reach).all():
        axes.errorbar(x, y, yerr=reach, fmt="none", ecolor=colour, elinewidth=1.1, capsize=3)


def spans(axes: Axes, at: Any, table: Any, **look: Any) -> None:
    """The intervals of ratios as lines along x, of no length where none is known."""
    axes.hlines(at, table["low"].fillna(table["ratio"]), table["high"].fillna(table["ratio"]), **look)


def dots(axes: Axes, at: Any, table: Any, label: str) -> None:
    """Dots with their intervals on rows of names: columns "ratio", "low", "high" and, for the colour, "backend"."""
    colours = list(map(colour, table["backend"]))
    spans(axes, at, table, color=colours, linewidth=2.4, zorder=3)
    told(axes.scatter(table["ratio"], at, c=colours, s=(0.62 * rcParams["font.size"]) ** 2, edgecolors=INK,
                      linewidths=0.6, zorder=4), "use",
         [f"{e.backend}: {bounded(e.ratio, e.low, e.high, 3)}" for e in table.itertuples()])
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
    steps = ((1e3, (1,)), (60, (1, 2, 5)), (6, (1, 2, 3, 5)), (0, (1, 1.5, 2, 3, 4, 5, 6, 8)))
    subs = next(subs for least, subs in steps if spans > least)
    axis.set_major_locator(LogLocator(subs=subs, numticks=30))
    axis.set_minor_locator(NullLocator())
    axis.set_major_formatter(EngFormatter(sep="\N{THIN SPACE}") if counted else FuncFormatter(plain))
