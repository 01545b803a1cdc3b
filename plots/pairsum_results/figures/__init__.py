"""The figures of a report, each drawn from its tables. To add one: write its panels here and list it in ALL."""
import ctypes
import dataclasses
import gc
import io
import multiprocessing
import os
import pathlib
import re
import signal
import sys
import textwrap
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
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

from . import bars, cases, density, ladder, over, ranks, ratios, roofline, threads
from .parts import Drawing, of_series, working
from .sheet import Panel, packed, sheet
from .style import PAPER, Look, applied  # noqa: F401

ALL: list[Drawing] = [
    ladder.LADDER, cases.CASES, threads.SPEEDUP, threads.ALGORITHM_SPEEDUP, over.M_COMPARISON, bars.PHASE_SPLIT,
    bars.BARRIER_WAIT, roofline.ROOFLINE, over.SIZE_SCALING, density.DENSITY, ranks.RANKS, over.GRANULARITY,
    ratios.COMPILERS, ratios.SELF_TEST]
_DPI, _PIXELS = 130, (1600, 1200)  # a PNG is to fit a slide


@dataclasses.dataclass(frozen=True)
class Sheet:
    """Panels of a drawing that are one file; `world`: the series in a few words, if it is of one of several."""
    name: str
    drawing: Drawing
    world: str
    panels: list[Panel]


def sheets(report: Report, look: Look = Look()) -> list[Sheet]:
    """What the report has something to show for: NAME, NAME-2, ... of every drawing."""
    own = working(report)
    series, found = list(of_series(own)), []
    for drawing in ALL:
        some = [(world, panels) for world, part in (series if drawing.each else [("", own)])
                for panels in packed(drawing.panels(part), look)]
        found += [Sheet(drawing.name + (f"-{k}" if k > 1 else ""), drawing, *one) for k, one in enumerate(some, 1)]
    return found


def draw(one: Sheet, report: Report, look: Look = Look()) -> Figure:
    heading = ", ".join(filter(None, (one.drawing.heading, one.world)))
    with applied(look):
        return sheet(one.panels, look, f"{heading}: {report.title}", footer(report))


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


def draw_all(report: Report, folder: pathlib.Path | None, look: Look = Look()) -> list[tuple[Sheet, str]]:
    """Draws every sheet: as SVG for a page, which is returned, and, given a folder, as NAME.png in it, each file whole
    or not at all. PNGs of an earlier report that there is nothing for are taken away. Raises ResultsError."""
    from .inline import inline

    def drawn(one: Sheet) -> tuple[bytes, str]:
        figure = draw(one, report, look)
        png = rendered(figure, "png", look) if folder else b""
        label = f"{one.drawing.heading}{f', {one.world}' if one.world else ''}. {one.drawing.caption}"
        return png, inline(figure, look, f"{report.title} {one.name}", label) if one.drawing.inline else ""

    tasks = sheets(report, look)
    found = on_all_cores(drawn, tasks)
    if folder:
        for one, (png, _) in zip(tasks, found):
            write_file(folder / f"{one.name}.png", png)
        own = re.compile(rf"({'|'.join(drawing.name for drawing in ALL)})(-\d+)?")
        for path in folder.glob("*.png"):
            if own.fullmatch(path.stem) and path.stem not in [one.name for one in tasks]:
                path.unlink()
    return [(one, svg) for one, (_, svg) in zip(tasks, found)]


def rendered(figure: Figure, kind: str, look: Look = Look(), inline: str = "") -> bytes:
    """The figure as bytes of a file of this kind, the same for the same figure. An SVG that stands in a page keeps its
    text as text, and its ids depend on `inline`, which is another for every figure of the page."""
    stream = io.BytesIO()
    stamp = {"svg": {"Date": None, "Creator": None}, "pdf": {"CreationDate": None}}.get(kind)
    dpi = min(_DPI, *(most / inches for most, inches in zip(_PIXELS, figure.get_size_inches())))
    with applied(look), matplotlib.rc_context({"svg.hashsalt": inline or "pairsum",
                                               "svg.fonttype": "none" if inline else "path"}):
        figure.savefig(stream, format=kind, metadata=stamp, dpi=dpi if kind == "png" else "figure")
    return stream.getvalue()


_work: Callable[[Any], Any] | None = None


def on_all_cores(work: Callable[[Any], Any], tasks: Iterable[Any]) -> list[Any]:
    """work(k) of every task in forked processes, to which nothing needs to be sent but the number of the task."""
    global _work
    tasks = list(tasks)
    gc.freeze()
    _work = lambda k: work(tasks[k])  # noqa: E731
    cores, fork = len(os.sched_getaffinity(0)), multiprocessing.get_context("fork")
    with ProcessPoolExecutor(cores, fork, _end_with_parent) as pool:
        try:
            return list(pool.map(_called, range(len(tasks))))
        except BrokenProcessPool:
            raise ResultsError("a process that drew figures was killed, perhaps for want of memory") from None


def _end_with_parent() -> None:
    """Of a helper: it ends when this program does, however that ends, and leaves Ctrl-C to it."""
    ctypes.CDLL(None).prctl(1, signal.SIGKILL)  # PR_SET_PDEATHSIG
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def _called(k: int) -> Any:
    return _work(k)
