"""Ratios with their intervals as rows of dots: builds against each other, and what the harness says of known ratios."""
import pandas as pd
from matplotlib.axes import Axes

from ..reports import Report
from . import style
from .marks import dots, name_rows, reference
from .parts import Drawing, named
from .sheet import Panel


def _dots(axes: Axes, own: pd.DataFrame, names: list[str], said: list[str], label: str, limits: pd.Series) -> None:
    """Rows of dots with a word behind each."""
    rows = name_rows(axes, names)
    reference(axes, 1.0, label="equal")
    if "expected" in own:
        axes.scatter(own["expected"], rows, marker="|", s=220, linewidths=2.2, color=style.INK, zorder=2,
                     label="expected")
    dots(axes, rows, own, label)
    room = 0.06 * (max(limits.max(), 1) - min(limits.min(), 1)) or 0.05
    axes.set_xlim(min(limits.min(), 1) - room, max(limits.max(), 1) + room)
    for at, text in zip(rows, said):
        axes.annotate(text, (1, at), xycoords=("axes fraction", "data"), xytext=(8, 0), textcoords="offset points",
                      va="center", fontsize="small", annotation_clip=False)


def _compilers(report: Report) -> list[Panel]:
    table, label = report.compiler_comparison.dropna(subset=["ratio"]), "time of the base / time (right of 1: faster)"
    return [Panel(f"{build}\nagainst {base}", lambda axes, own=own: _dots(
        axes, own, named(own), list(own["verdict"]), label, table[["ratio", "low", "high"]].stack()), len(own))
        for (build, base), own in table.groupby(["build", "base_build"], sort=False)]


COMPILERS = Drawing(
    "compilers", "Compilers",
    "The same backends by several builds: time with the base build over time with the other, with 95\u00a0% "
    "intervals; right of 1 the other is faster.",
    "several builds in the same rounds", _compilers, each=False)


def _self_test(report: Report) -> list[Panel]:
    table = report.self_test.sort_values(["expected", "what"], kind="stable")
    if table.empty:
        return []
    table = table.assign(backend=table["base_backend"], isa="")  # a copy has the name and the colour of what it copies
    names = [f"{what}: {place}" for what, place in zip(table["what"], named(table))]
    said = ["holds" if holds else "DOES NOT HOLD" for holds in table["holds"]]
    limits = table[["expected", "ratio", "low", "high"]].astype(float).stack()
    return [Panel("", lambda axes: _dots(axes, table, names, said, "time / time of the base", limits), len(table))]


SELF_TEST = Drawing(
    "self_test", "Self-test",
    "Does the harness find known differences, and none where there is none? Dot: measured ratio; line: its interval, "
    "at 95\u00a0% over the whole table; tall mark: expected.",
    "backends whose behaviour is known", _self_test, each=False)
