"""The figures of a report, each drawn from its tables. To add one: write its panels here and list it in ALL."""
import gc
import io
import multiprocessing
import pathlib
import sys
import textwrap
from typing import Any, Callable, Iterable

from ..reports import Report
from ..rows import ResultsError
from ..summary import write_file

try:
    import matplotlib
    from matplotlib.figure import Figure
except ImportError as problem:
    raise ResultsError(f"figures need matplotlib for {sys.executable}: {problem} (Debian: python3-matplotlib)"
                       ) from None

from . import bars, over, ratios, roofline, strategies, threads
from .parts import Drawing, of_series, working
from .sheet import sheet
from .style import PAPER, Look, applied  # noqa: F401

ALL: list[Drawing] = [
    bars.LADDER, threads.SPEEDUP, threads.EFFICIENCY, threads.ALGORITHM_SPEEDUP, over.M_COMPARISON, bars.PHASE_SPLIT,
    bars.BARRIER_WAIT, roofline.ROOFLINE, over.SIZE_SCALING, over.GRANULARITY, ratios.COMPILERS, ratios.SELF_TEST,
    strategies.LADDER, strategies.THREADS, strategies.WORLDS]


Part = tuple[str, Report]


def parts(report: Report) -> dict[bool, list[Part]]:
    """What figures are drawn of, by Drawing.each: every series, if there are several with words for it; or all."""
    own = working(report)
    return {True: list(of_series(own)), False: [("", own)]}


def draw(drawing: Drawing, report: Report, look: Look = Look(), shown: list[Part] | None = None) -> Figure | None:
    """The figure, with panels of all its parts, or of these alone; None if the study has nothing to show."""
    panels = []
    for world, part in shown or parts(report)[drawing.each]:
        for panel in drawing.panels(part):
            panel.title = ", ".join(filter(None, (world, panel.title)))
            panels.append(panel)
    if not panels:
        return None
    with applied(look):
        return sheet(panels, look, f"{drawing.heading}: {report.title}", footer(report))


def footer(report: Report) -> str:
    """Where the numbers come from: what was measured, machine, compiler, revision, caveats."""
    first, more = report.results.environments.iloc[0], len(report.results.environments) - 1
    s = report.results.series.iloc[0]
    text = (f"{s['case']}, {s['state']}, dx {s['dx']:g} m, {s['n_fluid']} fluid + {s['n_boundary']} boundary particles"
            f", {s['precision']}, {s['interaction']}. " if len(report.results.series) == 1 else "")
    text += f"{first['cpu']}, {first['cores']} cores, {first['build_name']}"
    text += f"; and {more} more environment{'s' * (more > 1)}." if more else "."
    said = [textwrap.shorten(caveat, 140, placeholder=" ...") for caveat in report.caveats[:2]]
    more = len(report.caveats) - len(said)
    return text + (f" Caveats: {'; '.join(said)}" if said else "") + (f"; and {more} more." if more else "")


def draw_all(report: Report, folder: pathlib.Path) -> list[pathlib.Path]:
    """Writes every figure that the study has something for as SVG and PNG, each file whole or not at all; returns the
    paths. One that it has nothing for takes away the files that an earlier report left. Raises ResultsError."""
    shown = parts(report)

    def files(drawing: Drawing) -> dict[str, bytes | None]:
        figure = draw(drawing, report, shown=shown[drawing.each])
        return {f"{drawing.name}.{kind}": figure and rendered(figure, kind) for kind in ("svg", "png")}

    found = {name: content for some in on_all_cores(files, ALL) for name, content in some.items()}
    for name, content in found.items():
        if content is None:
            (folder / name).unlink(missing_ok=True)
        else:
            write_file(folder / name, content)
    return [folder / name for name, content in found.items() if content is not None]


def rendered(figure: Figure, kind: str, look: Look = Look(), inline: str = "") -> bytes:
    """The figure as bytes of a file of this kind, the same for the same figure. An SVG that stands in a page keeps its
    text as text, and its ids depend on `inline`, which is another for every figure of the page."""
    stream = io.BytesIO()
    stamp = {"svg": {"Date": None, "Creator": None}, "pdf": {"CreationDate": None}}.get(kind)
    with applied(look), matplotlib.rc_context({"svg.hashsalt": inline or "pairsum",
                                                     "svg.fonttype": "none" if inline else "path"}):
        figure.savefig(stream, format=kind, metadata=stamp)
    return stream.getvalue()


_work: Callable[[Any], Any] | None = None


def on_all_cores(work: Callable[[Any], Any], tasks: Iterable[Any]) -> list[Any]:
    """work(k) of every task in forked processes, to which nothing needs to be sent but the number of the task."""
    global _work
    tasks = list(tasks)
    gc.freeze()
    _work = lambda k: work(tasks[k])  # noqa: E731
    with multiprocessing.get_context("fork").Pool() as pool:
        return pool.map(_called, range(len(tasks)), chunksize=1)


def _called(k: int) -> Any:
    return _work(k)
