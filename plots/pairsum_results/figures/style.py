"""The one place for colours, markers, line styles and fonts of all figures."""
import contextlib
import dataclasses
from typing import Any, Iterator

import matplotlib
from matplotlib.colors import to_rgb

INK = "#222222"    # text and marker edges
MUTED = "#6f6f6f"  # footers, secondary text
RULE = "#9a9a9a"   # reference lines (ideal, equal)
GRID = "#e4e4e4"

#: Okabe-Ito palette and grey, and the dark colours of Tol's muted scheme: safe for colour-blind readers. So many more
#: are not; lines and rows are always named. One backend, one colour, everywhere; X_tbb has that of X unless it has its
#: own.
BACKENDS = {
    "naive": "#000000", "naive_omp": "#E69F00", "naive_tbb": "#D55E00", "pair_list": "#F0E442",
    "sphysics_sweep": "#CC79A7", "ppm_stencil": "#999999", "symmetric": "#56B4E9",
    "symmetric_omp": "#0072B2", "symmetric_tbb": "#009E73",
    "tiles_omp": "#332288", "tiles_tbb": "#117733", "naive_tiles_omp": "#882255", "atomic_add": "#B2182B",
    "thread_private": "#8C510A", "touched_blocks": "#BF812D", "per_pass_buffers": "#80CDC1", "colour18": "#01665E",
    "colour4": "#35978F", "sliced_locks": "#C51B7D", "sliced_2colour": "#4D9221", "task_conflicts": "#762A83",
    "pair_list_omp": "#B8A900", "verlet_list": "#5C5C3D", "half_cells": "#3B528B",
}
#: For a backend that this list does not know: a colour by its name, the same in each figure.
SPARE = ("#7A4B1E", "#6A5ACD", "#8B8B00", "#8B0000", "#2F4F4F")
#: How threads are kept apart (what backends say of their conflicts): a colour and words for each.
FAMILIES = {"gather": ("#E69F00", "gather: computes each pair twice"), "colours": ("#0072B2", "colours"),
            "copies": ("#009E73", "copies that are joined"), "locks": ("#CC79A7", "locks"),
            "tasks": ("#56B4E9", "tasks that wait"), "atomics": ("#D55E00", "atomic additions"),
            "serial": ("#BDB9A6", "one thread"), "other": ("#8B8B8B", "other")}
#: Phases of a step in their order in time, light and dark in turn.
PHASES = {"index_s": "#56B4E9", "prepare_s": "#8C4A76", "zero_s": "#F0E442", "sum_s": "#0072B2", "reduce_s": "#E69F00",
          "integrate_s": "#5C5C5C"}
EDGE = {"markeredgecolor": INK, "markeredgewidth": 0.6}  #: of markers
BOX = {"edgecolor": INK, "linewidth": 0.5}  #: of bars
_OF_M = {5: "v", 6: "o", 7: "s", 8: "D", 9: "^", 4: "<", 10: ">"}


@dataclasses.dataclass(frozen=True)
class Look:
    """Where figures go: inches of one column of panels, how many stand side by side, points of the text."""
    panel: float = 5.2
    columns: int = 2
    font: float = 9.5
    titled: bool = True  #: with a title, and a footer that says what was measured where
    height: float = 8.4  #: inches of panels on a sheet, as far as they can be parted


PAPER = Look(panel=84 / 25.4, columns=1, font=7, titled=False)  #: a column of a journal


def colour(backend: str) -> str:
    """The colour of a backend, the same in every figure."""
    known = BACKENDS.get(backend) or BACKENDS.get(backend.removesuffix("_tbb"))
    return known or BACKENDS.get(backend.replace("_tbb", "_omp")) or SPARE[sum(backend.encode()) % len(SPARE)]


def line(backend: str) -> Any:
    """The line style of a backend: oneTBB is dashed."""
    return (0, (5, 2)) if backend.endswith("_tbb") else "-"


def marker(m: float) -> str:
    """The marker of a grid parameter M; NaN where the grid takes none."""
    return _OF_M.get(m, "o" if m != m else "X")


def shade(colour: str, towards: float) -> tuple[float, ...]:
    """A colour moved towards white (up to 1) or, below 0, towards black."""
    end = 1.0 if towards > 0 else 0.0
    return tuple((1 - abs(towards)) * channel + abs(towards) * end for channel in to_rgb(colour))


@contextlib.contextmanager
def applied(look: Look) -> Iterator[None]:
    """matplotlib with the settings of a look, whatever a user's own file says; for drawing and for writing."""
    small = look.font * 0.9
    with matplotlib.rc_context():
        matplotlib.rcdefaults()
        matplotlib.rcParams.update({
            "figure.facecolor": "white", "axes.facecolor": "white", "savefig.facecolor": "white", "savefig.dpi": 130,
            "font.family": "DejaVu Sans", "font.size": look.font, "axes.titlesize": look.font * 1.05,
            "axes.labelsize": look.font, "xtick.labelsize": small, "ytick.labelsize": small, "legend.fontsize": small,
            "text.color": INK, "axes.labelcolor": INK, "xtick.color": INK, "ytick.color": INK, "axes.edgecolor": RULE,
            "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True, "grid.color": GRID,
            "grid.linewidth": 0.8, "axes.axisbelow": True, "axes.titlelocation": "left", "axes.titleweight": "bold",
            "axes.titley": 1.0, "legend.frameon": False, "lines.linewidth": 0.18 * look.font,
            "lines.markersize": 0.58 * look.font, "text.parse_math": False, "pdf.fonttype": 42})
        yield
