"""For a paper: figures as PDF for a column of 84 mm, tables and a paragraph of methods in LaTeX."""
import pathlib
import re

import pandas as pd

from .figures import PAPER, draw, on_all_cores, rendered, sheets
from .load import COMMON
from .page import every_table
from .reports import Report
from .stats import FEWEST_FOR_RATIO, LEVEL
from .summary import write_file
from .words import threads_words

_LEVEL = f"{100 * LEVEL:g} %"
_HEAD = "% In the preamble: \\usepackage{booktabs}\n"


def write(report: Report, folder: pathlib.Path) -> list[pathlib.Path]:
    """Writes FIGURE.pdf (FIGURE-2.pdf, ... where one has no room for all), tables.tex and methods.tex, each whole or not at all;
    returns the paths. Raises ResultsError."""
    tasks = sheets(report, PAPER)
    drawn = on_all_cores(lambda one: rendered(draw(one, report, PAPER), "pdf", PAPER), tasks)
    files = {f"{one.name}.pdf": content for one, content in zip(tasks, drawn)}
    files |= {"tables.tex": latex_tables(report), "methods.tex": methods(report)}
    for name, content in files.items():
        write_file(folder / name, content)
    return [folder / name for name in files]


def escaped(text: str) -> str:
    """Text as LaTeX."""
    special = {"\\": r"\textbackslash{}", "^": r"\textasciicircum{}", "~": r"\textasciitilde{}", "<": r"\textless{}",
               ">": r"\textgreater{}", "|": r"\textbar{}", '"': "''"}
    return re.sub(r'[\\^~<>|"&%$#_{}]', lambda c: special.get(c[0], "\\" + c[0]), text)


def latex_tables(report: Report) -> str:
    """The tables of the report, each as a float as wide as the page."""
    found = []
    for world, table in every_table(report):
        frame = pd.DataFrame(table.rows, columns=table.header).applymap(escaped).rename(columns=escaped)
        caption = escaped(" ".join(f"{table.caption}{f' ({world})' if world else ''}.".split()))
        found.append(frame.style.hide(axis="index").to_latex(
            hrules=True, environment="table*", position="tbp", position_float="centering", caption=caption,
            column_format="l" * table.left + "r" * (len(table.header) - table.left)))
    return _HEAD + "\n".join(found)


def methods(report: Report) -> str:
    """A paragraph that states machine, build, particles, rounds and statistics."""
    results, points = report.results, report.points
    said = [_build(e) for e in results.environments.drop_duplicates("build").itertuples()]
    said += [f"The case {s.case} ({s.dim}D, {s.state}, {s.order} order) has {s.n_fluid} fluid and {s.n_boundary} "
             f"boundary particles (dx = {s.dx:g}, H = {s.H:g}); interaction {s.interaction}, smoothing {s.smoothing}, "
             f"integrator {s.integrator}, {s.precision} precision."
             for s in results.series[COMMON].drop_duplicates().itertuples()]
    threads = sorted(set(points["threads"]))
    rounds, others = len(results.closed) + results.void_rounds, results.closed["others_share"].max()
    disturbed = f"; other processes took at most {100 * others:.2g} % of the processor time of a round"
    said += [
        f"{len(points)} points (backend, grid and parameters) were measured on "
        + (threads_words(threads[0]) if len(threads) == 1 else f"{threads[0]} to {threads_words(threads[-1])}")
        + f", each in {_counted(points['rounds'], 'round')} of {_counted(points['repetitions'], 'repetition')} of "
        f"{_counted(points['steps'], 'step')}.",
        "A round is a new process, in which the points of a part take turns; every result was verified against a "
        f"reference before its time counted. Of {rounds} rounds {results.void_rounds} were void"
        + (disturbed if pd.notna(others) else "") + ".",
        "The value of a point in a round is the mean over its steps and repetitions; times are medians over rounds "
        f"with distribution-free intervals (order statistics) at {_LEVEL} or more. Ratios are geometric means over "
        f"the rounds that both points share, with Student's t intervals on the logarithms at {_LEVEL} (from "
        f"{FEWEST_FOR_RATIO} rounds on; Welch's where no round is shared). Differences are called resolved if they "
        f"pass Holm's test over all comparisons of a table at {100 - 100 * LEVEL:.3g} %."]
    return "\n".join(map(escaped, said)) + "\n"


def _build(e) -> str:
    dirty = " with uncommitted changes" if e.dirty else ""
    governor = f", governor {e.governor}" if isinstance(e.governor, str) else ""
    return (f"Times were measured with pairsum at revision {e.git}{dirty}, built by {e.compiler} ({e.flags}), on "
            f"{e.cpu} with {e.cores} cores ({e.os_kernel}{governor}); binding of threads: {e.binding}.")


def _counted(values: pd.Series, what: str) -> str:
    low, high = int(values.min()), int(values.max())
    return f"{low if low == high else f'{low} to {high}'} {what}{'' if high == 1 else 's'}"
