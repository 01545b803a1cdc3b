"""The tables, the answer, the questions and the self-test of a made summary."""
from made_points import spread
from made_worlds import GATHER, bandwidth, family, peak, runtime

_PLACE = ("case", "state", "dx")


def tables(data, intervals):
    """Return what `pairsum report` derives from the points."""
    times = {_key(entry): entry["phases"]["sum_s"]["median"] for entry in data["points"]}
    algorithm = [row for entry in data["points"] for row in _algorithm(entry, times, intervals)]
    return {"speedup": [_speedup(entry, times, intervals) for entry in data["points"]],
            "algorithm_speedup": algorithm, "runtime_comparison": _runtimes(data, times, intervals),
            "m_comparison": [_m_row(entry) for entry in data["points"] if entry["point"]["M"] is not None],
            "self_test": self_test(intervals), "answer": _answer(data, times, intervals),
            "questions": [
                {"question": "Is the symmetric sum twice as fast here?",
                 "answer": "No: symmetric (M=7) takes 0.41 s, naive (M=7) 0.53 s; 1.3 times, not 2."},
                {"question": "Does folding cost time?",
                 "answer": "Yes with M = 5 and 6: a third of the distance tests are of folded cells."}]}


def speedups(entries, intervals):
    """Return the rows of "speedup" of points alone."""
    times = {_key(entry): entry["phases"]["sum_s"]["median"] for entry in entries}
    return [_speedup(entry, times, intervals) for entry in entries]


def _key(entry, **other):
    point = {**entry["point"], **other}
    return tuple(point[field] for field in ("state", "dx", "backend", "M", "threads"))


def _confidence(intervals):
    return {"confidence": 0.95 if intervals else None}


_UNKNOWN = {"value": None, "low": None, "high": None, "confidence": None, "rounds": 0}


def _speedup(entry, times, intervals):
    point, threads = entry["point"], entry["point"]["threads"]
    now, one = times[_key(entry)], times[_key(entry, threads=1)]
    return {**{key: point[key] for key in (*_PLACE, "M", "backend", "threads", "grid", "granularity")},
            "series": entry["series"], "time_s": now, "base_backend": point["backend"],
            "base_threads": 1, "base_time_s": one, "speedup": one / now,
            **spread(one / now, intervals), **_confidence(intervals), "efficiency": one / now / threads,
            "machine_flops_scaling": peak(threads) / peak(1),
            "machine_bandwidth_scaling": bandwidth(threads) / bandwidth(1),
            "machine_speedup": dict(_UNKNOWN), "of_machine": dict(_UNKNOWN)}


def _algorithm(entry, times, intervals):
    point = entry["point"]
    kind, base = runtime(point["backend"]), GATHER.get(point["backend"])
    if base is None or point["M"] != 6:
        return
    for base_m in (6, 7):
        if _key(entry, backend=base, M=base_m) in times:
            before, now = times[_key(entry, backend=base, M=base_m)], times[_key(entry)]
            yield {**{key: point[key] for key in (*_PLACE, "M", "backend", "threads", "granularity")},
                   "series": entry["series"], "runtime": kind, "base_backend": base, "base_M": base_m,
                   "base_time_s": before, "time_s": now, "speedup": before / now,
                   **spread(before / now, intervals), **_confidence(intervals), "verdict": "faster"}


def _runtimes(data, times, intervals):
    rows = []
    for entry in data["points"]:
        point = entry["point"]
        other = _key(entry, backend=family(point["backend"]) + "_tbb")
        if runtime(point["backend"]) == "omp" and other in times:
            omp, tbb = times[_key(entry)], times[other]
            rows.append({**{key: point[key] for key in (*_PLACE, "M", "threads")},
                         "series": entry["series"], "algorithm": family(point["backend"]),
                         "omp_time_s": omp, "tbb_time_s": tbb, "ratio": omp / tbb,
                         **spread(omp / tbb, intervals, 0.02), **_confidence(intervals),
                         "verdict": "not resolved"})
    return rows


def _m_row(entry):
    point, work, time = entry["point"], entry["work"], entry["phases"]["sum_s"]
    share = 1 - work["pairs_tested_unfolded"] / work["pairs_tested"]
    return {**{key: point[key] for key in (*_PLACE, "backend", "threads", "M", "granularity")},
            "series": entry["series"], "time_s": time["median"], "low": time["low"], "high": time["high"],
            "total_s": entry["phases"]["total_s"]["median"], **work,
            "useful_pair_ratio": entry["useful_pair_ratio"], "collision_share": share}


def self_test(intervals):
    """Return an A/A check, two slowed backends (one missed) and a corrupted result."""
    rows = []
    for what, backend, expected, ratio, holds in (
            ("A/A", "again_symmetric_omp", 1.0, 1.003, True), ("A/A", "again_naive_omp", 1.0, 0.996, True),
            ("slowed 5 %", "slowed_5_symmetric_omp", 1.05, 1.047, True),
            ("slowed 20 %", "slowed_20_naive_omp", 1.2, 1.31, False)):
        base = "symmetric_omp" if backend.endswith("symmetric_omp") else "naive_omp"
        rows.append({"what": what, "backend": backend, "base_backend": base, "M": 7, "threads": 1,
                     "expected": expected, "ratio": ratio, **spread(ratio, intervals, 0.02),
                     **_confidence(intervals), "holds": holds,
                     "text": f"{what}: {backend} measured {ratio} times, expected {expected}"})
    rows.append({"what": "corrupt", "backend": "corrupt_naive_omp", "base_backend": "naive_omp", "M": 7,
                 "threads": 1, "expected": None, "ratio": None, "low": None, "high": None,
                 "confidence": None, "holds": True, "text": "a wrong rate was refused"})
    return rows


def compilers(data, series):
    """Return the points of a series against those of the first one."""
    rows = []
    for entry in data["points"]:
        if entry["series"] == series:
            base = next(other for other in data["points"] if other["series"] == 0 and all(
                other["point"][key] == entry["point"][key] for key in ("backend", "M", "threads", "granularity")))
            before, now = (some["phases"]["sum_s"]["median"] for some in (base, entry))
            rows.append({**{key: entry["point"][key] for key in
                            (*_PLACE, "backend", "grid", "M", "threads", "granularity")},
                         "base_compiler": "GNU 12.2.0", "base_time_s": before, "compiler": "Clang 14.0.6",
                         "time_s": now, "ratio": before / now, **spread(before / now, True, 0.02),
                         "confidence": 0.95, "verdict": "faster" if before > 1.02 * now else
                         "slower" if now > 1.02 * before else "not resolved"})
    return rows


def _answer(data, times, intervals):
    best = min((entry for entry in data["points"] if entry["series"] == 0),
               key=lambda entry: entry["phases"]["sum_s"]["median"])
    m = 6 if any(entry["point"]["M"] == 6 for entry in data["points"]) else best["point"]["M"]
    point, base = best["point"], times[_key(best, backend="naive", M=m, threads=1)]
    time = times[_key(best)]
    return {"text": f"On host take {point['backend']} with M = {point['M']} and {point['threads']} threads: "
                    f"{1e3 * time:.0f} ms per sum.",
            **{key: point[key] for key in ("backend", "M", "threads", "granularity")}, "series": 0,
            "time_s": time, "base_backend": "naive", "base_M": m, "base_threads": 1,
            "base_time_s": base, "speedup": base / time, **spread(base / time, intervals),
            **_confidence(intervals),
            "ties": [{"backend": "symmetric_tbb", "M": point["M"], "threads": point["threads"],
                      "granularity": "auto"}]}
