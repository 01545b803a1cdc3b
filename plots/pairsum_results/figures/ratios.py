"""Ratios with their intervals as rows of dots: builds against each other, and what the harness says of known ratios."""
from ..reports import Report
from .parts import Drawing, named
from .sheet import Panel, ratio_rows


def _compilers(report: Report) -> list[Panel]:
    table = report.compiler_comparison.dropna(subset=["ratio"])
    return [ratio_rows(f"{build}\nagainst {base}", own, named(own), own["verdict"], table,
                       "time of the base / time (right of 1: faster)")
            for (build, base), own in table.groupby(["build", "base_build"], sort=False)]


COMPILERS = Drawing(
    "compilers", "Compilers",
    "The same backends by several builds: time with the base build over time with the other, with 95\u00a0% "
    "intervals; right of 1 the other is faster.",
    "compiler_comparison", _compilers, each=False)


def _self_test(report: Report) -> list[Panel]:
    table = report.self_test.sort_values(["expected", "what"], kind="stable")
    if table.empty:
        return []
    table = table.assign(backend=table["base_backend"], isa="")  # a copy has the name and the colour of what it copies
    names = [f"{what}: {place}" for what, place in zip(table["what"], named(table))]
    said = table["holds"].map({True: "holds", False: "DOES NOT HOLD"})
    return [ratio_rows("", table, names, said, table, "time / time of the base")]


SELF_TEST = Drawing(
    "self_test", "Self-test",
    "Does the harness find known differences, and none where there is none? Dot: measured ratio; line: its interval, "
    "at 95\u00a0% over the whole table; tall mark: expected.",
    "self_test", _self_test, each=False)
