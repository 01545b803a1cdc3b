"""Rows with known times, as a program of schema 3 (or 2) writes them."""
import json
import math

HEX = "0123456789abcdef"
#: How much slower than stated everything in rounds 1 to 6 is: the same for all points, so paired ratios are exact.
DISTURBANCE = (1.0, 1.2, 0.8, 1.4, 0.9, 1.1)
MEDIAN = 1.05
_TRAITS = {"naive": (False, False, "gather"), "symmetric": (True, False, "colours"), "tiles": (True, True, "colours"),
           "sphysics": (True, False, "serial"), "locks": (True, False, "locks"), "copies": (True, False, "copies")}


def head(kind, study="talk", schema=3, **more):
    return {"schema": f"pairsum.row/{schema}", "kind": kind, "study": study, "utc": "2026-11-22T15:30:00.123Z", **more}


def environment(name=HEX, **change):
    return head("environment", environment=name, **{
        "host": "node", "cpu": "some model", "caches": {"L1d": 49152, "L3": 272629760}, "cores": 2,
        "governor": "performance", "os_kernel": "Linux 6.1", "compiler": "GNU 12.2.0", "flags": "-O3",
        "libraries": {"fmt": "9.1.0"}, "git": "abc1234", "dirty": False, "binding": "cores_first 0,1",
        "counters": "none: no such file", **change})


def backend(name, environment=HEX):
    """What a backend says of itself: a copy for the self-test by its name."""
    test, _, rest = name.partition("_")
    copies = {"again": ("A/A", 1.0), "slowed": ("slowed 20 %", 1.2), "corrupt": ("corrupt", None)}
    self_test = None
    if test in copies:
        base = rest.removeprefix("20_")
        self_test = {"what": copies[test][0], "base_backend": base, "expected": copies[test][1]}
        name_of_work = base
    else:
        name_of_work = name
    symmetric, vector, conflicts = _TRAITS.get(name_of_work.split("_")[0], (True, False, "other"))
    runtime = name_of_work.rsplit("_", 1)[-1]
    return head("backend", environment=environment, name=name, description=f"{name} in one line", aliases="",
                runtime=runtime if runtime in ("omp", "tbb") else "serial", conflicts=conflicts, symmetric=symmetric,
                deterministic=True, vector=vector, blocks=vector, self_test=self_test)


def point(backend, M=6, threads=1, **change):
    return {"case": "dam_break", "state": "rest", "dx": 0.00594, "H": 0.01188, "n_fluid": 1000000, "n_boundary": 1014966,
            "order": "lattice", "dim": 3, "precision": "double", "interaction": "ferrari09", "smoothing": "wendland_c2",
            "integrator": "euler", "dt": 1e-05, "backend": backend, "grid": "hashed_grid", "M": M, "threads": threads,
            "granularity": "dynamic:32", "isa": "scalar", "block": "none", **change}


def phases(sum_s):
    """Half of the total is the sum, a quarter of it each to prepare... so that an evaluation takes 1.5 of it."""
    return {"index_s": 0.5 * sum_s, "prepare_s": 0.25 * sum_s, "zero_s": 0.0, "sum_s": sum_s, "reduce_s": 0.25 * sum_s,
            "integrate_s": 0.0, "total_s": 2 * sum_s}


def work(**change):
    return {"cells": 1000, "cells_nonempty": 100, "sumF1": 10, "sumF2": 10, "pairs_tested": 8000000,
            "pairs_interacting": 2000000, "pairs_fluid_fluid": 900000, "pairs_fluid_boundary": 1100000,
            "pairs_tested_unfolded": 6000000, "flops": 1e9, "bytes": 1e8, **change}


def sample(place, sum_s, round=1, step=1, **change):
    return head("sample", **{
        "part": "all", "round": round, "slot": 1, "repetition": 1, "step": step, "seed": 1, "environment": HEX,
        "point": place, "phases": phases(sum_s), "threads_busy_s": None, "barrier_wait_s": None, "counters": None,
        "work": work() if step == 1 else None, "peak_rss_bytes": 1000, "workspace_bytes": 500, "lost": 0,
        "threads_worked": place["threads"],
        "verify": {"max_rel_err": 1e-15, "bound": 1e-14, "fingerprint": "fedcba9876543210"}, **change})


def closing(round, rows, **change):
    return head("round", **{"environment": HEX, "round": round, "part": "all", "replicate": round, "plan": HEX, "seed": 1,
                            "rows": rows, "elapsed_s": 1.5, "others_share": 0.01, **change})


def pace(round, threads, flops):
    return head("pace", environment=HEX, round=round, threads=threads, precision="double", flops_per_s=flops)


def peak(threads, flops, bandwidth):
    return head("peak", environment=HEX, threads=threads, precision="double", bandwidth_bytes_per_s=bandwidth,
                flops_per_s=flops)


def study(points, rounds=6, before=()):
    """Rows of rounds in which each point, (place, sum_s) or (place, sum_s, change of its samples), was measured: two
    steps, whose mean is the stated time. A change may be a function of the round."""
    environments = [row for row in before if row["kind"] == "environment"] or [environment()]
    rows = [*environments, *(row for row in before if row["kind"] != "environment")]
    named = sorted({place["backend"] for place, *_ in points})
    rows += [backend(name, one["environment"]) for one in environments for name in named]
    for k in range(1, rounds + 1):
        taken = []
        for place, sum_s, *more in points:
            change = more[0] if more else {}
            change = change(k) if callable(change) else change
            time = change.get("time", 1) * sum_s * DISTURBANCE[(k - 1) % 6]
            rest = {key: value for key, value in change.items() if key != "time"}
            if k <= rest.pop("rounds", rounds):
                taken += [sample(place, time * factor, k, step, **rest) for step, factor in ((1, 0.9), (2, 1.1))]
        rows += taken + [closing(k, len(taken), environment=environments[0]["environment"])]
    return rows


def talk():
    """naive and symmetric, each serial, OpenMP and oneTBB, with factors between them that are known."""
    return [(point("naive"), 1.0), (point("symmetric"), 0.5), (point("naive", 7), 0.9), (point("symmetric", 7), 0.6),
            *((point(f"{name}_{runtime}", 6, threads), time * factor / threads)
              for name, time in (("naive", 1.0), ("symmetric", 0.5)) for runtime, factor in (("omp", 1.0), ("tbb", 1.25))
              for threads in (1, 2))]


def scattered(*logs):
    """A change that multiplies the times of round k by exp(logs[k - 1])."""
    return lambda k: {"time": math.exp(logs[k - 1])}


def write(path, rows):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("".join(json.dumps(row) + "\n" for row in rows))
    return path


def former(row):
    """The row as schema 2 had it; None if it had none of the kind."""
    row = json.loads(json.dumps({**row, "schema": "pairsum.row/2"}))
    if row["kind"] == "backend":
        return None
    for key in ("lost", "threads_worked", "workspace_bytes"):
        row.pop(key, None)
    if row["kind"] == "sample":
        row["point"].pop("block")
        for key in ("flops", "bytes"):
            (row["work"] or {}).pop(key, None)
    return row
