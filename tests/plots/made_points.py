"""The entries of "points" of a made summary."""
from made_worlds import USUAL, WORLDS, bandwidth, family, folding, peak, runtime, sum_time, wobble

PHASES = ("index_s", "prepare_s", "zero_s", "sum_s", "reduce_s", "integrate_s")


def spread(value, intervals, width=0.03):
    """Return low and high around a value, or nulls."""
    if not intervals:
        return {"low": None, "high": None}
    return {"low": value * (1 - width), "high": value * (1 + width)}


def point(place, series, backend, m, threads, intervals, granularity=None, slower=1.0, grid="hashed_grid"):
    """Return one entry; place is (state, dx). A grid that takes no M folds nothing: m = 9 makes its numbers."""
    (state, dx), granularity = place, granularity or USUAL[runtime(backend)]
    fluid, boundary, pairs = WORLDS[dx]
    total = sum_time(state, backend, m, threads, dx, granularity, slower)
    parts = (0.05, 0.6 if family(backend) == "pair_list" else 0.04, 0.03 * 2 ** (m - 7), 1.0, 0.004, 0.06)
    values = {phase: total * part for phase, part in zip(PHASES, parts)}
    values["total_s"] = 1.01 * sum(values.values())
    phases = {phase: {"median": value, **spread(value, intervals),
                      "confidence": 0.969 if intervals else None} for phase, value in values.items()}
    per_pair = {phase[:-2]: 1e9 * values[phase] / pairs for phase in PHASES[1:5]}
    per_pair["all"] = 1.005 * sum(per_pair.values())  # medians need not add up
    unfolded = int(pairs * 8.2 * (1.9 if family(backend) == "naive" else 1))
    tested = int(unfolded * folding(dx, m))
    work = {"cells": 8 ** m, "cells_nonempty": min(8 ** m, int(fluid / 3.1 + boundary / 7)),
            "sumF1": 1, "sumF2": 13, "pairs_tested": tested, "pairs_tested_unfolded": unfolded,
            "pairs_interacting": pairs, "pairs_fluid_fluid": pairs, "pairs_fluid_boundary": 0}
    if backend.startswith("tiles"):
        work["vector_units"] = {"block": "brick:4", "lanes": 8, "vectors": pairs // 6, "occupancy": 0.75}
    where = {"case": "dam_break", "state": state, "dx": dx, "H": 2 * dx, "n_fluid": fluid,
             "n_boundary": boundary, "order": "lattice", "dim": 3, "precision": "double",
             "interaction": "ferrari09", "smoothing": "wendland_c2", "integrator": "euler", "dt": 1e-05,
             "backend": backend, "grid": grid, "M": m if grid == "hashed_grid" else None, "threads": threads, "isa": "avx512",
             "granularity": granularity, "block": "auto" if backend.startswith("tiles") else "none"}
    return {"point": where, "study": "made", "series": series, "rounds": 6, "repetitions": 1,
            "steps": 5, "phases": phases, "ns_per_pair": 1e9 * total / pairs,
            "ns_per_pair_parts": per_pair, "useful_pair_ratio": pairs / tested, "work": work,
            "round_s": [total * (1 + 0.02 * wobble(backend, m, threads, number)) for number in range(6)],
            "variance": {"between": 0.012, "within": 0.004}, "counters": None,
            "passes": _passes(backend, threads, total), "model": _model(backend, threads, tested, pairs, total),
            "peak_rss_bytes": 961056768, "fingerprint": "0" * 16}


def _passes(backend, threads, total):
    if threads == 1:
        return None
    count = 8 if family(backend) == "symmetric" else 1
    waits = [[total / count * (0.04 + 0.03 * wobble(backend, number, thread))
              for thread in range(threads)] for number in range(count)]
    busy = [[total / count - wait for wait in some] for some in waits]
    return {"busy_s": busy, "barrier_wait_s": waits,
            "wait_share": sum(map(sum, waits)) / (total * threads)}


def _model(backend, threads, tested, pairs, total):
    flops = 9.0 * tested + 62.0 * pairs * (2 if family(backend) == "naive" else 1)
    moved = 1.9 * tested + 36.0 * pairs
    by_flops, by_bytes = flops / peak(threads), moved / bandwidth(threads)
    bound = max(by_flops, by_bytes)
    return {"flops": flops, "bytes": moved, "intensity": flops / moved,
            "bandwidth_bytes_per_s": bandwidth(threads), "flops_per_s": peak(threads), "bound_s": bound,
            "limited_by": "flops" if by_flops >= by_bytes else "bandwidth",
            "share_of_bound": bound / total, "achieved_flops_per_s": flops / total}
