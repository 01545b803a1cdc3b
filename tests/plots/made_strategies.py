"""The tables of strategies of a made summary, as `pairsum report` derives them from the points."""
from made_points import spread
from made_worlds import KINDS, family, runtime

_PLACE = ("case", "state", "dx", "grid", "granularity", "isa", "block", "M", "backend", "threads")
_PARTS = ("prepare_s", "zero_s", "sum_s", "reduce_s")


def tables(data, intervals):
    """Return the four tables of the made points of all backends but copies and other grids."""
    ladders = [ladder for series in range(len(data["series"])) for at in ("one_thread", "most_threads")
               for ladder in _ladders(data, series, at)]
    rows = [_rung(data, rungs, number, at, intervals) for at, rungs in ladders for number in range(len(rungs))]
    backends = sorted({row["backend"] for row in rows})
    return {"strategies": [_strategy(backend) for backend in backends], "strategy_ladder": rows,
            "strategy_threads": [row for at, rungs in ladders if at == "most_threads"
                                 for row in _threads(data, rungs, intervals)],
            "strategy_shifts": _shifts(rows, intervals)}


def _time(entry):
    return sum(entry["phases"][part]["median"] for part in _PARTS)


def _ladders(data, series, at):
    """Return [(at, the fastest entry of each backend)], empty if there is no such ladder."""
    own = [entry for entry in data["points"] if entry["series"] == series]
    most = {}
    for entry in own:
        most[entry["point"]["backend"]] = max(most.get(entry["point"]["backend"], 1), entry["point"]["threads"])
    best = {}
    for entry in own:
        point = entry["point"]
        if point["threads"] == (1 if at == "one_thread" else most[point["backend"]]):
            before = best.get(point["backend"])
            best[point["backend"]] = entry if before is None else min(before, entry, key=_time)
    return [(at, sorted(best.values(), key=_time))] if max(most.values()) > 1 or at == "one_thread" else []


def _base(rungs):
    return next(entry for entry in rungs if entry["point"]["backend"] == "naive_omp")


def _row(data, entry, base, intervals):
    point = entry["point"]
    ratio = _time(base) / _time(entry)
    return {**{key: point[key] for key in _PLACE}, "series": entry["series"],
            "world": f"dam_break 3D, {point['state']}, dx = {point['dx']:g}", "time_s": _time(entry),
            "base_backend": base["point"]["backend"], "base_threads": base["point"]["threads"],
            "base_time_s": _time(base), "ratio": ratio, **spread(ratio, intervals),
            "confidence": 0.95 if intervals else None, "rounds": 6}


def _estimate(value, intervals):
    return {"value": value, **spread(value, intervals), "confidence": 0.95 if intervals else None, "rounds": 6}


def _rung(data, rungs, number, at, intervals):
    entry, base = rungs[number], _base(rungs)
    point = entry["point"]
    serial = next(other for other in rungs if other["point"]["backend"] == "sphysics_sweep")
    extra = 40 * point["n_fluid"] * point["threads"] if KINDS[point["backend"]] == "copies" else 8 * point["n_fluid"]
    return {**_row(data, entry, base, intervals), "at": at, "rank": number + 1, "of": len(rungs),
            "over_serial": _estimate(_time(entry) / _time(serial), intervals) if point["threads"] == 1 else None,
            "efficiency": None if point["threads"] == 1 else _estimate(0.9, intervals),
            "wait_share": 0.02 if point["threads"] > 1 else None, "workspace_bytes": extra + 1000, "extra_bytes": extra,
            "extra_bytes_per_particle": extra / point["n_fluid"],
            "verdict": "not resolved" if entry is base else "faster" if _time(entry) < _time(base) else "slower"}


def _threads(data, rungs, intervals):
    for best in rungs:
        like = {**best["point"], "threads": None}
        for entry in data["points"]:
            if entry["series"] == best["series"] and {**entry["point"], "threads": None} == like:
                one = next(other for other in data["points"] if other["series"] == best["series"]
                           and {**other["point"], "threads": 1} == {**_base(rungs)["point"], "threads": 1}
                           and other["point"]["threads"] == 1)
                yield _row(data, entry, one, intervals)


def _strategy(backend):
    return {"backend": backend, "conflicts": KINDS[backend], "runtime": runtime(backend),
            "aliases": f"what the field calls {family(backend)}", "description": f"the made {backend}",
            "symmetric": KINDS[backend] != "gather", "deterministic": KINDS[backend] not in ("atomics", "locks"),
            "breaks_down": "4 threads: efficiency 0.61 [0.55, 0.67] (dam_break 3D)" if backend == "atomic_add" else None}


def _shifts(rows, intervals):
    high = [row for row in rows if row["at"] == "most_threads"]
    first = {row["backend"]: row for row in high if row["series"] == 0}
    return [{"series": row["series"], "world": row["world"], "base_series": 0, "base_world": other["world"],
             "what": "case", "backend": row["backend"], "threads": row["threads"], "base_backend": row["base_backend"],
             "rank": row["rank"], "of": row["of"], "base_rank": other["rank"], "base_of": other["of"],
             **_estimate(row["ratio"] / other["ratio"], intervals), "base_rounds": 6, "verdict": "not resolved",
             "ratio": row["ratio"] / other["ratio"]}
            for row in high if row["series"] and row["backend"] != row["base_backend"]
            for other in [first.get(row["backend"])] if other]
