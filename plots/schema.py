"""What the plots need of a summary.json (docs/design.md section 4): field -> kind.

Other fields may be there and are ignored.
"""
import json
import math

SCHEMA = "pairsum.summary/2"

TEXT, NUMBER, OPTIONAL = "text", "a number", "a number or null"
WORD = "text or null"
COUNT, POSITIVE = "a whole number from 1", "a positive number or null"
FLAG = "true or false"
_PLACE = {"case": TEXT, "state": TEXT, "dx": NUMBER}
_INTERVAL = {"low": OPTIONAL, "high": OPTIONAL}
_RATIO = {"ratio": OPTIONAL, **_INTERVAL, "confidence": OPTIONAL}
_SPEEDUP = {"speedup": POSITIVE, **_INTERVAL, "confidence": OPTIONAL}

TABLES = {
    "speedup": {**_PLACE, "backend": TEXT, "M": OPTIONAL, "threads": COUNT, "base_backend": TEXT,
                "base_threads": COUNT, "base_time_s": OPTIONAL, "efficiency": OPTIONAL, **_SPEEDUP,
                "machine_flops_scaling": POSITIVE, "machine_bandwidth_scaling": POSITIVE},
    "algorithm_speedup": {**_PLACE, "runtime": TEXT, "threads": COUNT, "base_backend": TEXT,
                          "base_M": OPTIONAL, "base_time_s": OPTIONAL, "backend": TEXT,
                          "M": OPTIONAL, **_SPEEDUP, "verdict": TEXT},
    "m_comparison": {**_PLACE, "backend": TEXT, "threads": COUNT, "M": OPTIONAL,
                     "time_s": OPTIONAL, **_INTERVAL, "total_s": OPTIONAL,
                     "cells_nonempty": OPTIONAL, "pairs_tested": OPTIONAL,
                     "useful_pair_ratio": OPTIONAL, "collision_share": OPTIONAL},
    "compiler_comparison": {**_PLACE, "backend": TEXT, "M": OPTIONAL, "threads": COUNT,
                            "granularity": TEXT, "base_compiler": TEXT, "base_time_s": OPTIONAL,
                            "compiler": TEXT, "time_s": OPTIONAL, **_RATIO, "verdict": TEXT},
    "self_test": {"what": TEXT, "backend": TEXT, "base_backend": TEXT, "M": OPTIONAL,
                  "threads": COUNT, "expected": OPTIONAL, **_RATIO, "holds": FLAG, "text": TEXT},
    "peaks": {"environment": TEXT, "threads": COUNT, "precision": TEXT,
              "bandwidth_bytes_per_s": POSITIVE, "flops_per_s": POSITIVE},
    "questions": {"question": TEXT, "answer": TEXT},
}
#: Tables that summaries of before there were strategies lack.
_STRATEGY = {**_PLACE, "series": OPTIONAL, "world": TEXT, "backend": TEXT, "M": OPTIONAL, "threads": COUNT,
             "time_s": NUMBER, "base_backend": TEXT, "base_threads": COUNT, "base_time_s": NUMBER, **_RATIO}
LATER = {
    "strategies": {"backend": TEXT, "conflicts": WORD, "runtime": WORD, "aliases": WORD, "breaks_down": WORD,
                   "description": WORD},
    "strategy_ladder": {**_STRATEGY, "ratio": NUMBER, "at": TEXT, "rank": COUNT, "of": COUNT, "verdict": TEXT,
                        "wait_share": OPTIONAL, "extra_bytes": OPTIONAL, "extra_bytes_per_particle": OPTIONAL},
    "strategy_threads": {**_STRATEGY, "ratio": NUMBER},
    "strategy_shifts": {"world": TEXT, "base_world": TEXT, "what": TEXT, "backend": TEXT, "threads": COUNT, **_RATIO,
                        "rank": COUNT, "base_rank": COUNT, "verdict": TEXT},
}
LISTS = ("environments", "points", "caveats", *TABLES)
POINT = {**_PLACE, "n_fluid": NUMBER, "n_boundary": NUMBER, "precision": TEXT, "granularity": TEXT,
         "interaction": TEXT, "backend": TEXT, "M": OPTIONAL, "threads": COUNT}
ENTRY = {"ns_per_pair": OPTIONAL, "rounds": COUNT}
ANSWER = {"text": TEXT, "backend": TEXT, "M": OPTIONAL, "threads": COUNT, "time_s": NUMBER,
          "base_backend": TEXT, "base_M": OPTIONAL, "base_threads": COUNT, "base_time_s": NUMBER,
          **_SPEEDUP}
TIE = {"backend": TEXT, "M": OPTIONAL, "threads": COUNT}
MODEL = {"intensity": POSITIVE, "achieved_flops_per_s": POSITIVE, "share_of_bound": OPTIONAL}
PHASES = ("index_s", "prepare_s", "zero_s", "sum_s", "reduce_s", "integrate_s", "total_s")
PAIR_PARTS = ("prepare", "zero", "sum", "reduce", "all")
#: Other fields that may tell panels apart.
SCALARS = ("H", "order", "dim", "smoothing", "integrator", "dt", "isa", "grid", "block", "study", "series",
           "granularity")


def fault(row, fields):
    """Return what is wrong with a row, or None."""
    if not isinstance(row, dict):
        return " is not an object"
    for field in SCALARS:
        if isinstance(row.get(field), (dict, list)):
            return f': "{field}" is not one word or number'
    for field, kind in fields.items():
        if field not in row:
            return f' has no "{field}"'
        if not _is(row[field], kind):
            return f': "{field}" is {json.dumps(row[field])[:60]}, expected {kind}'
    return None


def _is(value, kind):
    if kind == WORD:
        return value is None or isinstance(value, str)
    if kind in (TEXT, FLAG):
        return isinstance(value, str if kind is TEXT else bool)
    if value is None:
        return kind in (OPTIONAL, POSITIVE)
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return False
    try:
        if not math.isfinite(value):
            return False
    except OverflowError:
        return False
    return value > 0 if kind is POSITIVE else kind is not COUNT or (value >= 1 and value % 1 == 0)
