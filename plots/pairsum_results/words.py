"""Numbers and points in words, for people."""
from typing import Iterable

import numpy as np
import pandas as pd


def ms(seconds: float) -> str:
    """Seconds as milliseconds with about five digits and never an exponent; "-" without a value."""
    value = seconds * 1e3 if pd.notna(seconds) else np.inf
    if not np.isfinite(value):
        return "-"
    return f"{value:.{4 if value < 10 else 3 if value < 100 else 2 if value < 1000 else 1 if value < 10000 else 0}f}"


def fixed(value: float, digits: int) -> str:
    return "-" if pd.isna(value) else f"{value:.{digits}f}"


def percent(value: float) -> str:
    return "-" if pd.isna(value) else f"{100 * value:.1f} %"


def whole(value: float) -> str:
    return "-" if pd.isna(value) else f"{value:.0f}"


def bounded(value: float, low: float, high: float, digits: int = 2, missing: str = "") -> str:
    """ "1.23 [1.20, 1.26]", or without the interval, if there is none, the value and what is said instead."""
    if pd.isna(value):
        return "-"
    return fixed(value, digits) + (missing if pd.isna(low) else f" [{low:.{digits}f}, {high:.{digits}f}]")


def threads_words(n: int) -> str:
    return f"{n} thread{'' if n == 1 else 's'}"


def names(points: pd.DataFrame, with_grid: bool = True) -> pd.Series:
    """What tells points apart beside M and threads: the backend, with the grid unless that is hashed_grid, and with
    isa, block and granularity where the backend has several of them among these points."""
    text = points["backend"]
    if with_grid:
        text = text.where(points["grid"] == "hashed_grid", text + "/" + points["grid"])
    for name in ("isa", "block", "granularity"):
        several = points.groupby("backend")[name].transform("nunique") > 1
        text = text.where(~several, text + " " + points[name])
    return text


def wrapped(text: str, width: int = 120) -> str:
    """Lines of at most `width` characters; all but the first are indented."""
    lines, line = [], ""
    for word in text.split():
        if line and len(line) + 1 + len(word) > width:
            lines.append(line)
            line = "    " + word
        else:
            line += (" " if line else "") + word
    return "\n".join([*lines, line]) + "\n"


def text_table(header: list[str], rows: Iterable[list[str]], left: int) -> str:
    """A table whose first `left` columns are aligned to the left, the others to the right."""
    lines = [header, *rows]
    widths = [max(map(len, column)) for column in zip(*lines)]
    return "".join("  ".join(f"{cell:{'<' if k < left else '>'}{widths[k]}}" for k, cell in enumerate(line)).rstrip()
                   + "\n" for line in lines)


def markdown_table(header: list[str], rows: Iterable[list[str]], left: int) -> str:
    """The same in Markdown."""
    def line(cells: Iterable[str]) -> str:
        return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |\n"

    rule = "|" + "|".join("---" if k < left else "---:" for k in range(len(header))) + "|\n"
    return line(header) + rule + "".join(map(line, rows))
