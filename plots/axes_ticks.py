"""Ticks that read as plain numbers."""
from matplotlib.ticker import (EngFormatter, FixedLocator, FuncFormatter, LogLocator, MaxNLocator,
                               NullLocator)


def whole(axis, values):
    """Tick an axis at these values only, written as plain numbers."""
    axis.set_major_locator(FixedLocator(sorted(values)))
    axis.set_minor_locator(NullLocator())
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))


def threads(axes, counts):
    """Put the measured thread counts on the x axis: linear up to 3 threads, log2 from 4."""
    low, high = min(counts), max(counts)
    if high >= 4:
        axes.set_xscale("log", base=2)
        axes.set_xlim(low / 1.15, high * 1.15)
        if len(counts) > 8:
            counts = [count for count in counts if count & (count - 1) == 0] or counts
    else:
        axes.set_xlim(low - 0.12, high + 0.12)
    whole(axes.xaxis, counts)
    axes.set_xlabel("threads")


def logarithmic(axis, values, counted):
    """Scale an axis by decades with ticks 1, 2, 5; counts read 5 M, 1 G, other values 0.5, 20."""
    across = axis.axis_name == "x"
    (axis.axes.set_xscale if across else axis.axes.set_yscale)("log")
    low, high = min(values), max(values)
    room = (high / low) ** 0.06 if high > low else 1.5
    (axis.axes.set_xlim if across else axis.axes.set_ylim)(low / room, high * room)
    axis.set_major_locator(LogLocator(subs=_subs((high / low) ** (1.6 if across else 1)), numticks=30))
    axis.set_minor_locator(NullLocator())
    axis.set_major_formatter(EngFormatter(sep="\N{THIN SPACE}") if counted else
                             FuncFormatter(lambda value, _: f"{value:g}"))


def _subs(ratio):
    """Return the ticks per decade for a range of values that spans this ratio."""
    if ratio > 1e3:
        return (1,)
    if ratio > 60:
        return (1, 2, 5)
    return (1, 2, 3, 5) if ratio > 6 else (1, 1.5, 2, 3, 4, 5, 6, 8)


def few(axis):
    """Tick an axis at a few round values, written as plain numbers."""
    axis.set_major_locator(MaxNLocator(5))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
