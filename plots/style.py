"""The one place for colours, markers, line styles and fonts of all figures."""
import matplotlib

matplotlib.use("Agg")

INK = "#222222"       # text and marker edges
MUTED = "#6f6f6f"     # footers, secondary text
RULE = "#9a9a9a"      # reference lines (ideal, equal)
GRID = "#e4e4e4"

#: Okabe-Ito palette and grey, and the dark colours of Tol's muted scheme: safe for colour-blind readers. So many more
#: are not; lines of the strategies are named at their ends. One backend, one colour, everywhere.
BACKENDS = {
    "naive": "#000000",
    "naive_omp": "#E69F00",
    "naive_tbb": "#D55E00",
    "pair_list": "#F0E442",
    "sphysics_sweep": "#CC79A7",
    "ppm_stencil": "#999999",
    "symmetric": "#56B4E9",
    "symmetric_omp": "#0072B2",
    "symmetric_tbb": "#009E73",
    "tiles_omp": "#332288",
    "tiles_tbb": "#117733",
    "naive_tiles_omp": "#882255",
    "atomic_add": "#B2182B",
    "thread_private": "#8C510A",
    "touched_blocks": "#BF812D",
    "per_pass_buffers": "#80CDC1",
    "colour18": "#01665E",
    "colour4": "#35978F",
    "sliced_locks": "#C51B7D",
    "sliced_2colour": "#4D9221",
    "task_conflicts": "#762A83",
    "pair_list_omp": "#B8A900",
    "verlet_list": "#5C5C3D",
    "half_cells": "#3B528B",
}
#: How threads are kept apart (backend_traits::conflicts), a colour each.
KINDS = {
    "serial": "#BDB9A6",
    "gather": "#E69F00",
    "colours": "#0072B2",
    "atomics": "#D55E00",
    "copies": "#009E73",
    "locks": "#CC79A7",
    "tasks": "#56B4E9",
    "unsaid": "#5C5C5C",
}
#: For a backend that this list does not know yet: a colour by its name, the same in each figure.
SPARE = ("#7A4B1E", "#6A5ACD", "#8B8B00", "#8B0000", "#2F4F4F")

#: Phases of a step in their order in time: (field, label, colour).
PHASES = (
    ("index_s", "index", "#56B4E9"),
    ("prepare_s", "prepare", "#CC79A7"),
    ("zero_s", "zero", "#F0E442"),
    ("sum_s", "sum", "#0072B2"),
    ("reduce_s", "reduce", "#D55E00"),
    ("integrate_s", "integrate", "#999999"),
)

HOLDS, FAILS = "#0072B2", "#D55E00"  # a self-test that holds, or does not

_MARKERS = {5: "v", 6: "o", 7: "s", 8: "D", 9: "^", 4: "<", 10: ">"}
_LINES = {"serial": ":", "omp": "-", "tbb": (0, (5, 2))}
#: The runtime of backends whose names do not end in it.
_RUNTIMES = {**dict.fromkeys(("atomic_add", "thread_private", "touched_blocks", "per_pass_buffers", "colour18", "colour4",
                              "sliced_locks", "sliced_2colour", "verlet_list", "half_cells"), "omp"),
             "task_conflicts": "tbb"}

SIZE, SMALL, TITLE = 9.5, 8.5, 13


def colour(backend):
    """Return the colour of a backend, the same in every figure."""
    if backend in BACKENDS:
        return BACKENDS[backend]
    return SPARE[sum(backend.encode()) % len(SPARE)]


def marker(m):
    """Return the marker of a grid parameter M."""
    return _MARKERS.get(m, "X")


def runtime(backend):
    """Return the runtime of a backend: what its name ends in, omp or tbb, else that in a list, else serial."""
    ending = backend.rsplit("_", 1)[-1]
    return ending if ending in _LINES else _RUNTIMES.get(backend, "serial")


def line(backend):
    """Return the line style of a backend: by its runtime."""
    return _LINES[runtime(backend)]


def backend_rank(backend):
    """Sort key that keeps the backends in the same order in every figure."""
    names = list(BACKENDS)
    return (names.index(backend) if backend in names else len(names), backend)


def apply():
    """Set the defaults of all figures (fonts, white background, repeatable SVG)."""
    matplotlib.rcdefaults()
    matplotlib.use("Agg")
    if "text.parse_math" in matplotlib.rcParams:  # a $ in a host's name is a $ (matplotlib 3.6)
        matplotlib.rcParams["text.parse_math"] = False
    matplotlib.rcParams.update({
        "figure.facecolor": "white", "axes.facecolor": "white", "savefig.facecolor": "white",
        "font.family": "DejaVu Sans", "font.size": SIZE, "axes.titlesize": SIZE + 0.5,
        "axes.labelsize": SIZE, "xtick.labelsize": SMALL + 0.5, "ytick.labelsize": SMALL + 0.5,
        "text.color": INK, "axes.labelcolor": INK, "xtick.color": INK, "ytick.color": INK,
        "axes.edgecolor": RULE, "axes.spines.top": False, "axes.spines.right": False,
        "axes.grid": True, "grid.color": GRID, "grid.linewidth": 0.8, "axes.axisbelow": True,
        "axes.titlelocation": "left", "axes.titleweight": "bold", "savefig.dpi": 130,
        "svg.hashsalt": "pairsum", "xtick.minor.visible": False,
    })
