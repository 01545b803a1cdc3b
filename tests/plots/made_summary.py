"""Build summaries whose numbers are invented but have the shape of measured ones."""
import hashlib

SERIAL = ("naive", "pair_list", "sphysics_sweep", "ppm_stencil", "symmetric")
PARALLEL = ("naive_omp", "naive_tbb", "symmetric_omp", "symmetric_tbb")
BACKENDS = SERIAL + PARALLEL
MS = (5, 6, 7, 8, 9)
PHASES = ("index_s", "prepare_s", "zero_s", "sum_s", "reduce_s", "integrate_s")
COST = {"naive": 1.0, "pair_list": 0.72, "sphysics_sweep": 0.58, "ppm_stencil": 0.56,
        "symmetric": 0.52}
FLUID, BOUNDARY, INTERACTING = 1000000, 1014966, 61234567


def wobble(*key):
    """Return a number in -1..1 that depends on the key only."""
    return hashlib.sha256(repr(key).encode()).digest()[0] / 127.5 - 1


def sum_time(state, backend, m, threads):
    """Return an invented summation time in seconds."""
    family = backend.replace("_omp", "").replace("_tbb", "")
    best = 7 if family == "naive" else 6
    shape = 1 + (0.09 if m > best else 0.42) * abs(m - best)
    serial = 0.03 if backend.endswith("_omp") else 0.05
    scale = serial + (1 - serial) / threads
    factor = {"rest": 1.0, "collapsed": 1.35}.get(state, 1.0)
    return 4.0 * COST[family] * shape * scale * factor * (1 + 0.02 * wobble(backend, m, threads))


def make(thread_counts=(1, 2), states=("rest", "collapsed"), ms=MS, intervals=True):
    """Return a whole summary in the form of docs/design.md section 4."""
    points = [_point(state, backend, m, threads, intervals)
              for state in states for backend in BACKENDS for m in ms
              for threads in (thread_counts if backend in PARALLEL else (1,))]
    return {"schema": "pairsum.summary/1", "sources": ["made/host.jsonl"],
            "environments": [{"host": "host", "cpu": "Example CPU 9000 @ 2.00GHz",
                              "cores": max(thread_counts), "compiler": "GNU 12.2.0",
                              "git": "abc1234", "dirty": False}],
            "series": [{"case": "dam_break", "study": "made", "environment": "0123456789abcdef"}],
            "points": points,
            "speedup": [_speedup(state, backend, m, t, intervals) for state in states
                        for backend in BACKENDS for m in ms
                        for t in (thread_counts if backend in PARALLEL else (1,))],
            "algorithm_speedup": [
                _algorithm(state, runtime, base_m, backend, 6, t, intervals)
                for state in states for runtime, others in _runtimes() for base_m in (6, 7)
                for backend in others for t in (thread_counts if runtime != "serial" else (1,))],
            "m_comparison": [_m_row(entry) for entry in points],
            "caveats": ["the numbers are invented to test the figures"]}


def _runtimes():
    return (("serial", ("symmetric", "ppm_stencil", "sphysics_sweep", "pair_list")),
            ("omp", ("symmetric_omp",)), ("tbb", ("symmetric_tbb",)))


def _spread(value, intervals, width=0.03):
    if not intervals:
        return {"low": None, "high": None}
    return {"low": value * (1 - width), "high": value * (1 + width)}


def _point(state, backend, m, threads, intervals):
    total = sum_time(state, backend, m, threads)
    prepare = 0.6 if backend == "pair_list" else 0.04
    parts = (0.05, prepare, 0.03 * 2 ** (m - 6), 1.0, 0.02, 0.06)
    values = {phase: total * part for phase, part in zip(PHASES, parts)}
    values["total_s"] = 1.01 * sum(values.values())
    phases = {phase: {"median": value, **_spread(value, intervals),
                      "confidence": 0.969 if intervals else None}
              for phase, value in values.items()}
    per_pair = {phase[:-2]: 1e9 * values[phase] / INTERACTING for phase in PHASES[1:5]}
    per_pair["all"] = 1.005 * sum(per_pair.values())  # medians need not add up
    twice = 2 if backend.startswith("naive") else 1
    tested = int(INTERACTING * twice * 6.5 * (1 + 3.0 * 8.0 ** (5 - m)))
    cells = {5: 32768, 6: 190000, 7: 410000, 8: 450000, 9: 452000}.get(m, 1000)
    work = {"cells": 8 ** m, "cells_nonempty": cells, "pairs_tested": tested,
            "pairs_interacting": INTERACTING}
    point = {"case": "dam_break", "state": state, "dx": 0.00594, "H": 0.01188, "n_fluid": FLUID,
             "n_boundary": BOUNDARY, "order": "lattice", "dim": 3, "precision": "double",
             "interaction": "ferrari09", "smoothing": "wendland_c2", "integrator": "euler",
             "dt": 1e-05, "backend": backend, "grid": "hashed_grid", "M": m, "threads": threads,
             "isa": "native"}
    return {"point": point, "study": "made", "repetitions": 6, "steps": 5, "phases": phases,
            "ns_per_pair": 1e9 * total / INTERACTING, "ns_per_pair_parts": per_pair,
            "useful_pair_ratio": INTERACTING / tested, "work": work,
            "peak_rss_bytes": 1, "fingerprint": "0" * 16}


def _speedup(state, backend, m, threads, intervals):
    one, now = (sum_time(state, backend, m, t) for t in (1, threads))
    return {"case": "dam_break", "state": state, "dx": 0.00594, "M": m, "backend": backend,
            "threads": threads, "time_s": now, "base_backend": backend, "base_threads": 1,
            "base_time_s": one, "speedup": one / now, **_spread(one / now, intervals),
            "efficiency": one / now / threads}


def _algorithm(state, runtime, base_m, backend, m, threads, intervals):
    base = "naive" if runtime == "serial" else f"naive_{runtime}"
    before, now = sum_time(state, base, base_m, threads), sum_time(state, backend, m, threads)
    return {"case": "dam_break", "state": state, "dx": 0.00594, "runtime": runtime,
            "threads": threads, "base_backend": base, "base_M": base_m, "base_time_s": before,
            "backend": backend, "M": m, "time_s": now, "speedup": before / now,
            **_spread(before / now, intervals)}


def _m_row(entry):
    point, work = entry["point"], entry["work"]
    return {**{key: point[key] for key in ("case", "state", "dx", "backend", "threads", "M")},
            "time_s": entry["phases"]["sum_s"]["median"],
            "total_s": entry["phases"]["total_s"]["median"], **work,
            "useful_pair_ratio": entry["useful_pair_ratio"]}
