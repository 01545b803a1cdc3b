"""Build summaries (pairsum.summary/2) whose numbers are invented but shaped like measured ones."""
import made_points
import made_strategies
import made_tables
from made_worlds import BACKENDS, MS, PARALLEL, USUAL, USUALLY, bandwidth, family, peak, runtime

GNU = {"environment": "0123456789abcdef", "host": "host", "cpu": "Example CPU 9000 @ 2.00GHz",
       "compiler": "GNU 12.2.0", "flags": "-O3 -march=native", "git": "abc1234", "dirty": False,
       "caches": {"L1d": 49152, "L2": 2097152, "L3": 33554432}, "governor": "performance",
       "os_kernel": "Linux 6.1", "libraries": {"fmt": "9.1.0", "oneTBB": "2021.8"},
       "binding": "cores_first 0,1,2,3", "counters": "none: perf_event_open is not permitted"}
CLANG = {**GNU, "environment": "fedcba9876543210", "compiler": "Clang 14.0.6"}
CHUNKS = ("dynamic:1", "dynamic:8", "dynamic:128", "dynamic:1024", "static:32", "static:256", "guided:1")


def make(thread_counts=(1, 2), states=("rest", "collapsed"), ms=MS, intervals=True, dxs=(0.00594,), backends=USUALLY):
    """Return a whole summary of one machine and compiler in the form of docs/design.md section 4."""
    worlds = [(state, dx) for dx in dxs for state in states]
    points = [made_points.point(place, number, backend, m, threads, intervals)
              for number, place in enumerate(worlds) for backend in backends for m in ms
              for threads in (thread_counts if backend in PARALLEL else (1,))]
    data = {"schema": "pairsum.summary/2", "title": "Made numbers: is the symmetric sum twice as fast?",
            "sources": ["made/host.jsonl"],
            "environments": [{**GNU, "cores": max(thread_counts)}],
            "series": [_series(place) for place in worlds], "points": points,
            "peaks": [{"environment": GNU["environment"], "threads": threads, "precision": precision,
                       "bandwidth_bytes_per_s": bandwidth(threads),
                       "flops_per_s": peak(threads, precision)}
                      for precision in ("double", "float") for threads in thread_counts],
            "rounds": {"finished": 6, "void": 1, "others_share": 0.013}, "failed": [],
            "compiler_comparison": [], "caveats": ["the numbers are invented to test the figures"]}
    return {**data, **made_tables.tables(data, intervals), **made_strategies.tables(data, intervals)}


def field(thread_counts=(1, 2)):
    """Return a summary of every backend in two worlds."""
    return make(thread_counts, ms=(6,), backends=BACKENDS)


def full(ms=MS):
    """Return a summary with every key filled: 2 compilers, 2 sizes, granularities, all passes."""
    data = make((1, 2, 4), states=("rest",), ms=ms, dxs=(0.00594, 0.01188))
    data["environments"].append({**CLANG, "cores": 4})
    clang = len(data["series"])
    data["series"].append({**_series(("rest", 0.00594)), "environment": CLANG["environment"]})
    data["peaks"] += [{**row, "environment": CLANG["environment"]} for row in data["peaks"]]
    data["points"] += [made_points.point(("rest", 0.00594), 0, "symmetric_omp", 7, 4, True, grain)
                       for grain in CHUNKS]
    data["points"] += [made_points.point(("rest", 0.00594), 0, "symmetric_tbb", 7, 4, True, grain)
                       for grain in ("simple:8", "simple:128", "static", "affinity")]
    data["points"] += [made_points.point(("rest", 0.00594), clang, backend, 7, threads, True,
                                         slower=0.97 if family(backend) == "naive" else 1.06)
                       for backend in USUALLY for threads in ((1, 4) if backend in PARALLEL else (1,))]
    copy = made_points.point(("rest", 0.00594), 0, "symmetric_omp", 7, 4, True, slower=1.05)
    copy["point"]["backend"] = "slowed_5_symmetric_omp"
    data["points"].append(copy)
    compact = [made_points.point(("rest", 0.00594), 0, backend, 9, threads, True, slower=0.6, grid="compact_grid")
               for backend in ("symmetric_omp", "tiles_omp") for threads in (1, 2, 4)]
    data["points"] += compact
    data["speedup"] += made_tables.speedups(compact, True)
    data["compiler_comparison"] = made_tables.compilers(data, clang)
    data["caveats"] += ["the machine was shared: other processes took up to 1.3 % of its time",
                        "no counters: perf_event_open is not permitted",
                        "4 threads on 4 cores leave none to the system"]
    return data


def _series(place):
    state, dx = place
    return {"case": "dam_break", "state": state, "dx": dx, "study": "made",
            "environment": GNU["environment"]}


__all__ = ["make", "full", "USUAL", "runtime"]
