"""The invented worlds, machines and costs that the made summaries are made of."""
import hashlib

from style import runtime

SERIAL = ("naive", "pair_list", "sphysics_sweep", "ppm_stencil", "symmetric")
FEW = ("naive_omp", "naive_tbb", "symmetric_omp", "symmetric_tbb", "tiles_omp", "tiles_tbb", "naive_tiles_omp")
PARALLEL = (*FEW, "atomic_add", "thread_private", "touched_blocks", "per_pass_buffers", "colour18", "colour4", "sliced_locks",
            "sliced_2colour", "task_conflicts", "pair_list_omp", "verlet_list", "half_cells")
#: How each keeps threads apart.
KINDS = {**dict.fromkeys(SERIAL, "serial"), **dict.fromkeys(("naive_omp", "naive_tbb", "naive_tiles_omp"), "gather"),
         **dict.fromkeys(FEW[2:6], "colours"), "colour18": "colours", "colour4": "colours", "sliced_2colour": "colours",
         "atomic_add": "atomics", **dict.fromkeys(("thread_private", "touched_blocks", "per_pass_buffers"), "copies"),
         "sliced_locks": "locks", "task_conflicts": "tasks", "pair_list_omp": "copies", "verlet_list": None,
         "half_cells": "gather"}
#: What a symmetric sum is compared with.
GATHER = {"symmetric": "naive", "symmetric_omp": "naive_omp", "symmetric_tbb": "naive_tbb",
          "tiles_omp": "naive_tiles_omp"}
#: Those of most made summaries; all of them take long to draw.
USUALLY = SERIAL + FEW
BACKENDS = SERIAL + PARALLEL
MS = (5, 6, 7, 8, 9)
#: dx in m -> fluid particles, boundary particles, interacting pairs
WORLDS = {0.00594: (1000000, 1014966, 13592338), 0.01188: (117649, 255188, 1591212)}
USUAL = {"omp": "dynamic:32", "tbb": "auto", "serial": "none"}
_NS = {"naive": 39.3, "pair_list": 31.0, "sphysics_sweep": 30.6, "ppm_stencil": 30.9, "symmetric": 29.8, "tiles": 9.7, "naive_tiles": 13.1,
       "atomic_add": 88.0, "thread_private": 33.0, "touched_blocks": 34.1, "per_pass_buffers": 36.0, "colour18": 32.2,
       "colour4": 31.7, "sliced_locks": 35.2, "sliced_2colour": 31.1, "task_conflicts": 34.8, "verlet_list": 24.0,
       "half_cells": 38.0}
_BANDWIDTH = {1: 11.2e9, 2: 19.8e9, 4: 27.1e9, 8: 34e9, 16: 38e9}
_FLOPS = 41e9


def wobble(*key):
    """Return a number in -1..1 that depends on the key only."""
    return hashlib.sha256(repr(key).encode()).digest()[0] / 127.5 - 1


def family(backend):
    """Return the algorithm without its runtime."""
    return backend.replace("_omp", "").replace("_tbb", "")


def folding(dx, m):
    """Return the distance tests with folding / those without."""
    particles = sum(WORLDS[dx][:2])
    return 1 + 0.63 * (particles / 2014966) * 8.0 ** (6 - m)


def sum_time(state, backend, m, threads, dx=0.00594, granularity=None, slower=1.0):
    """Return an invented summation time in seconds."""
    serial = 0.02 if runtime(backend) == "omp" else 0.035
    scale = serial + (1 - serial) / threads
    fold = 0.55 + 0.45 * folding(dx, m) + 0.05 * max(0, m - 7)
    factor = {"rest": 1.0, "collapsed": 1.35}.get(state, 1.0)
    chunk = (granularity or "").partition(":")[2]
    grain = 1 + 0.004 * abs(int(chunk).bit_length() - 6) ** 2 if chunk else 1.0
    grain *= 1.09 if (granularity or "").startswith("static") else 1.0
    return (1e-9 * _NS[family(backend)] * WORLDS[dx][2] * fold * scale * factor * grain * slower
            * (1 + 0.02 * wobble(backend, m, threads, dx)))


def bandwidth(threads):
    """Return the invented bytes per second of so many threads."""
    return _BANDWIDTH[threads]


def peak(threads, precision="double"):
    """Return the invented flops per second of so many threads."""
    return _FLOPS * threads * 0.985 ** (threads - 1) * (2 if precision == "float" else 1)
