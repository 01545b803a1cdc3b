"""Numbers and points in words, for people."""
import difflib
import textwrap
from typing import Callable, Iterable

import numpy as np
import pandas as pd


_LONGEST_WORD, _LONGEST_LINE = 300, 3000


def one_line(text: str) -> str:
    """The text for a message: without control characters (`\\n`, `\\x1b` stand for them), long words and the whole cut."""
    text = " ".join(word[:_LONGEST_WORD] + "[...]" * (len(word) > _LONGEST_WORD) for word in text.split(" "))
    line = "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text[:_LONGEST_LINE])
    return line + " [...]" * (len(text) > _LONGEST_LINE)


def ms(seconds: float) -> str:
    """Seconds as milliseconds with about five digits and never an exponent; "-" without a value."""
    value = seconds * 1e3 if pd.notna(seconds) else np.inf
    if not np.isfinite(value):
        return "-"
    return f"{value:.{4 if value < 10 else 3 if value < 100 else 2 if value < 1000 else 1 if value < 10000 else 0}f}"


def fixed(value: float, digits: int) -> str:
    return "-" if pd.isna(value) else f"{value:.{digits}f}"


def short(value: float) -> str:
    """Three digits, and never an exponent: "1.25", "12.5", "125", "12500"; "-" without a value."""
    if not np.isfinite(value):
        return "-"
    return f"{value:.{max(0, 2 - int(np.floor(np.log10(abs(value)))))}f}" if value else "0"


def count(value: float) -> str:
    """A number of things: "216", "99.2 k", "237 M"; "-" without a value."""
    if pd.isna(value):
        return "-"
    for least, unit in ((1e9, "G"), (1e6, "M"), (1e4, "k")):
        if value >= least:
            return f"{value / (1e3 if unit == 'k' else least):.3g} {unit}"
    return f"{value:.0f}"


def time(seconds: float) -> str:
    """ "4.21 ms", "1.25 s", "315 \u00b5s" """
    if pd.isna(seconds):
        return "-"
    size, unit = next(((size, unit) for size, unit in ((1, "s"), (1e-3, "ms")) if seconds >= size), (1e-6, "\u00b5s"))
    return f"{short(seconds / size)} {unit}"


def between(low: float, high: float, say: Callable[[float], str]) -> str:
    """ "95 % interval 1.31 to 1.40", or that there is none."""
    return "no interval: too few rounds" if pd.isna(low) else f"95 % interval {say(low)} to {say(high)}"


def percent(value: float) -> str:
    return "-" if pd.isna(value) else f"{100 * value:.1f} %"


def whole(value: float) -> str:
    return "-" if pd.isna(value) else f"{value:.0f}"


def bounded(value: float, low: float, high: float, digits: int = 2, missing: str = "") -> str:
    """ "1.23 [1.20, 1.26]", or without the interval, if there is none, the value and what is said instead."""
    if pd.isna(value):
        return "-"
    return fixed(value, digits) + (missing if pd.isna(low) else f" [{low:.{digits}f}, {high:.{digits}f}]")


def hint(word: str, valid: Iterable[str]) -> str:
    """ " did you mean ...?" with the nearest of the valid words, or nothing if none is near."""
    return "".join(f" did you mean {near}?" for near in difflib.get_close_matches(word, list(valid), 1))


def unknown(what: str, word: str, valid: Iterable[str]) -> str:
    """What is said of a word that is none of the valid ones."""
    near, all_words = hint(word, valid), list(valid)
    return f'unknown {what} "{word}";{near}' + ("" if near and len(all_words) > 12 else f' valid: {", ".join(all_words)}')


def threads_words(n: int) -> str:
    return f"{n} thread{'' if n == 1 else 's'}"


def variants(points: pd.DataFrame) -> pd.Series:
    """Lists of the isa, block and granularity of every point, where its backend has several of them among these."""
    found: list[list[str]] = [[] for _ in points.index]
    for name in ("isa", "block", "granularity"):
        several = points.groupby("backend")[name].transform("nunique") > 1
        for words, word, one in zip(found, points[name], several):
            words += [word] if one else []
    return pd.Series(found, points.index, dtype=object)


def names(points: pd.DataFrame, with_grid: bool = True) -> pd.Series:
    """What tells points apart beside M and threads: the backend, with the grid unless that is hashed_grid, and with
    isa, block and granularity where the backend has several of them among these points."""
    text = points["backend"]
    if with_grid:
        text = text.where(points["grid"] == "hashed_grid", text + "/" + points["grid"])
    return text + variants(points).map(lambda found: "".join(f" {word}" for word in found))


def hoisted(caption: str, header: list[str], rows: list[list[str]], left: int
            ) -> tuple[str, list[str], list[list[str]], int]:
    """The table without columns, but the first, that are the same in all its lines: what these say stands in the
    caption. `left`: the columns aligned to the left, which are words; of a single line numbers stay."""
    same = [k for k in range(1, len(header) if len(rows) > 1 else left) if len({row[k] for row in rows}) == 1]
    kept = [k for k in range(len(header)) if k not in same]
    said = [f"{header[k]}: {rows[0][k]}" for k in same if rows[0][k] not in ("", "-")]
    return ("; ".join([caption, *said]), [header[k] for k in kept], [[row[k] for k in kept] for row in rows],
            left - sum(k < left for k in same))


def wrapped(text: str, width: int = 120) -> str:
    """Lines of at most `width` characters; all but the first are indented."""
    return textwrap.fill(" ".join(text.split()), width, subsequent_indent="    ", break_long_words=False,
                         break_on_hyphens=False) + "\n"


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
