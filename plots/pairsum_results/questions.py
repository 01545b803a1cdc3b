"""The talk's questions, each with a verdict, one number, and what stands behind both in words."""
from typing import Any

import numpy as np
import pandas as pd

from . import stats, words
from .load import PLACE, Results
from .self_tests import self_tests

YES, NO, OPEN = "Yes", "No", "Not decided"
#: What a symmetric sum may lose of the gather's speedup and still scale as well.
_AS_WELL = 0.95
#: The share of the least possible time that counts as near to it.
_NEAR = 0.5
#: What the talk takes: the grid parameter M of gathers and of symmetric sums.
_TALKS_M = {"naive": 7, "symmetric": 6}
_READABLE = 8  # values that are all said
#: Verdict, one number in words, details.
_Answer = tuple[str, str, str]


def questions(results: Results, series: int, tables: dict[str, pd.DataFrame]) -> list[dict[str, str]]:
    """The talk's questions as {"question", "verdict", "number", "answer"}, as far as they were measured in the series:
    is the symmetric sum twice as fast, does it scale as well, are the talk's M the best, OpenMP or oneTBB, how far from
    what the machine can do. The verdict is "Yes", "No" or "Not decided" and belongs to the number; "answer" has the
    details. `tables`: speedup, algorithm_speedup, m_comparison, runtime_comparison, points."""
    own = {name: table[(table["series"] == series) & ~table["backend"].isin(self_tests(results).index)]
           for name, table in tables.items()}
    pairs = own["algorithm_speedup"]
    found = {"Is the symmetric sum twice as fast as the gather?": _twice(pairs),
             "Does it scale as well, within 5 %?": _scaling(results, pairs, own["speedup"], own["points"]),
             "Is M = 7 best for the gather, M = 6 for the symmetric sum?": _which_m(results, own["m_comparison"]),
             "Is oneTBB faster than OpenMP?": _runtime(own["runtime_comparison"]),
             "Does a sum reach half of what the machine can do?": _bound(own["points"])}
    return [{"question": question, **dict(zip(("verdict", "number", "answer"), said))}
            for question, said in found.items() if said]


def _verdict(low: float, high: float, limit: float) -> str:
    """Does a value with this interval reach the limit? Without an interval nothing is decided."""
    return YES if low >= limit else NO if high < limit else OPEN


def _cells(p: Any, base: str = "") -> str:
    m = p[f"{base}M"]
    return f"on {p[f'{base}grid']}" if pd.isna(m) else f"M = {m:.0f}"


def _range(values: pd.Series) -> str:
    least, most = f"{values.min():.2f}", f"{values.max():.2f}"
    return least if least == most else f"{least} to {most}"


def _variants(table: pd.DataFrame) -> pd.Series:
    """What tells lines of a backend, or of backends with blocks, apart: ", avx2, slab:4"."""
    text = pd.Series("", table.index)
    several = table.groupby("backend")["isa"].transform("nunique") > 1
    text = text.where(~several, ", " + table["isa"])
    blocks = table["block"] != "none"
    return text.where(~blocks | (table.loc[blocks, "block"].nunique() < 2), text + ", " + table["block"])


def _on_most_threads(table: pd.DataFrame) -> pd.DataFrame:
    table = table[table["threads"] == table["threads"].max()]
    return table.assign(variant=_variants(table) if len(table) else "")


def _talks(pairs: pd.DataFrame) -> pd.Series:
    """The pair that the talk's questions are about: of those without vector units, if there are such, the fastest."""
    scalar = pairs[pairs["isa"] == "scalar"]
    pairs = scalar if len(scalar) else pairs
    return pairs.loc[pairs["time_s"].idxmin()]


def _with_bounds(e: pd.Series, name: str = "") -> str:
    value = f"{name}_" if name else ""
    return words.bounded(e[name or "ratio"], e[f"{value}low"], e[f"{value}high"], missing=" (no interval)")


def _twice(table: pd.DataFrame) -> _Answer | None:
    """Of the talk's sum: the fastest symmetric one on most threads without vector units, if there is one."""
    table = _on_most_threads(table)
    if table.empty:
        return None
    runtimes = {"omp": "OpenMP", "tbb": "oneTBB", "serial": "serial"}
    texts = [f"{runtimes[e['runtime']]} {e['base_backend'].removesuffix('_' + e['runtime'])} {_cells(e, 'base_')} over "
             f"{e['backend'].removesuffix('_' + e['runtime'])} {_cells(e)}{e['variant']}: {_with_bounds(e)}"
             for _, e in table.iterrows()]
    e = _talks(table)
    verdict = _verdict(e["low"], e["high"], 2)
    return (verdict, f"{_with_bounds(e)} times ({e['backend']} over {e['base_backend']})",
            f"On {words.threads_words(table['threads'].iloc[0])}: {', '.join(texts)}. Each pair is computed once instead "
            "of twice, but its distance is tested and both particles are written"
            + ("." if verdict == YES else ", so half the evaluations is not half the time."))


def _spread(values: pd.Series, texts: pd.Series) -> str:
    """All, or, where they are too many to read, the least and the greatest."""
    if len(values) <= _READABLE:
        return ", ".join(texts)
    order = pd.DataFrame({"value": values, "text": texts}).sort_values(["value", "text"])["text"]
    return f"from {order.iloc[0]} to {order.iloc[-1]}, {len(order) - 2} others between"


def _scaling(results: Results, pairs: pd.DataFrame, table: pd.DataFrame, points: pd.DataFrame) -> _Answer | None:
    """The speedup of the fastest symmetric sum over that of its gather, in the same rounds."""
    table = _on_most_threads(table)
    if table.empty or table["threads"].iloc[0] < 2:
        return None
    symmetric = table["backend"].map(results.backends["symmetric"])
    if symmetric.nunique() < 2:
        return None
    name = [f"{e['backend']} {_cells(e)}{e['variant']}: " for _, e in table.iterrows()]
    said = name + table.apply(_with_bounds, axis=1)
    gathers, sums = (_range(table["ratio"][symmetric.eq(kind)]) for kind in (False, True))
    text = (f"On {words.threads_words(table['threads'].iloc[0])} gathers are {gathers} times as fast as on one, "
            f"symmetric sums {sums} times ({_spread(table['ratio'], said)}).")
    known = table["of_machine"].notna()
    machine = table["machine_flops_scaling"].iloc[-1]
    if known.any():
        shares = (pd.Series(name, table.index) + table.apply(_with_bounds, axis=1, name="of_machine"))[known]
        text += (f" In the same rounds the machine itself made {_range(table['machine_speedup'][known])} times as many "
                 "multiply-adds; of that the sums reach (medians over rounds; above 1 where the two were disturbed "
                 f"differently): {_spread(table['of_machine'][known], shares)}.")
    elif pd.notna(machine):
        text += f" The machine itself does {machine:.2f} times as many multiply-adds."
    waits = points.loc[points["backend"].str.startswith("symmetric_") & (points["threads"] == table["threads"].iloc[0]),
                       "wait_share"].dropna()
    if len(waits):
        text += f" In the symmetric passes threads spend {100 * waits.mean():.1f} % of the time waiting at barriers."
    return *_as_well(results, pairs, table), text


def _as_well(results: Results, pairs: pd.DataFrame, table: pd.DataFrame) -> tuple[str, str]:
    one = table.set_index("point")["base"]
    pairs = pairs[pairs["point"].isin(one.index) & pairs["base"].isin(one.index)]
    if pairs.empty:
        return OPEN, "no pair of a gather and a symmetric sum on one thread and on more"
    e, logs = _talks(pairs), results.logs()
    gains = pd.DataFrame({at: logs[one[e[at]]] - logs[e[at]] for at in ("point", "base")})
    found = stats.ratios(gains, ["point"], ["base"]).iloc[0]
    return (_verdict(found["low"], found["high"], _AS_WELL),
            f"{_with_bounds(found)} of the speedup of {e['base_backend']} ({e['backend']})")


def _which_m(results: Results, table: pd.DataFrame) -> _Answer | None:
    """For each backend over M, at one grid and granularity and on as many threads as were measured with several M."""
    alike = [name for name in PLACE if name != "M"]
    table = table[table["best_M"].notna()].join(results.points["cells_nonempty"], on="point")
    table = table[table.groupby(alike)["M"].transform("nunique") > 1]
    if table.empty:
        return None
    order = table.sort_values(["backend", "threads", "grid", "granularity", "isa", "block"],
                              ascending=[True, False, True, True, True, True])
    chosen = order.drop_duplicates("backend")[alike]
    texts, work, claims = [], {}, {}
    for _, one in chosen.iterrows():
        over_m = table[(table[alike] == one).all(axis=1)].sort_values("M")
        best = over_m[over_m["M"] == over_m["best_M"]].iloc[0]
        others = over_m.drop(best.name)
        slower = others["verdict"] == "slower"
        said = [f"M = {e.M:.0f} takes {e.over_best:.2f} times as long" for e in others[slower].itertuples()]
        tied = [f"{m:.0f}" for m in others["M"][~slower]]
        texts.append(f"{one['backend']} M = {best['M']:.0f} ({words.ms(best['time_s'])} ms a step"
                     + ("; " + ", ".join(said) if said else "")
                     + (f"; no difference resolved from M = {', '.join(tied)}" if tied else "") + ")")
        kind = one["backend"].split("_")[0]
        if kind in _TALKS_M:
            claims.setdefault(kind, _claim(one["backend"], over_m, best, _TALKS_M[kind]))
            known = over_m.dropna(subset=["collision_share", "cells_nonempty"])
            work.setdefault(kind, ", ".join(f"M = {e.M:.0f}: {100 * e.collision_share:.0f} % in "
                                            f"{e.cells_nonempty:.0f} cells" for e in known.itertuples()))
    kinds = {"naive": "Of the gather", "symmetric": "Of the symmetric sums"}
    why = "".join(f" {label}: {work[kind]}." for kind, label in kinds.items() if work.get(kind))
    verdicts = [claims.get(kind, (OPEN, ""))[0] for kind in _TALKS_M]
    return (NO if NO in verdicts else OPEN if OPEN in verdicts else YES,
            next((number for verdict in (NO, OPEN, YES) for found, number in claims.values() if found == verdict), ""),
            f"{', '.join(texts)}. A smaller M folds more cells together, and distances are tested in vain. A larger "
            "one costs nothing in the sweep, because only cells that hold particles are visited; what it costs is in "
            "the index, whose table has 2^(dM) entries."
            + (" Share of the distance tests in vain, and cells with particles:" + why if why else ""))


def _claim(backend: str, over_m: pd.DataFrame, best: pd.Series, m: int) -> tuple[str, str]:
    """Is this M the best of the backend? Against the best or, if it is that itself, against the next best."""
    own, rest = over_m[over_m["M"] == m], over_m[over_m["M"] != m]
    if own.empty:
        return OPEN, f"{backend}: M = {m} was not measured"
    e = own.iloc[0] if m != best["M"] else rest.loc[rest["over_best"].idxmin()]
    low, high = 1 / e["high"], 1 / e["low"]
    time = words.bounded(1 / e["ratio"], low, high, missing=" (no interval)")
    return ((YES if m == best["M"] else NO) if low > 1 else OPEN,
            f"{backend}: M = {e['M']:.0f} takes {time} times M = {best['M']:.0f}")


def _runtime(table: pd.DataFrame) -> _Answer | None:
    """Of the fastest pair."""
    if table.empty:
        return None
    count = table["verdict"].value_counts()
    e = table.loc[np.fmin(table["time_s"], table["base_time_s"]).idxmin()]
    verdict = {"faster": YES, "slower": NO}.get(e["verdict"], OPEN)  # of all comparisons together
    return (verdict, f"{_with_bounds(e)} times ({e['algorithm']})",
            f"Of {len(table)} comparisons oneTBB is faster in {count.get('faster', 0)}, OpenMP in "
            f"{count.get('slower', 0)}, no difference is resolved in {count.get('not resolved', 0)}; OpenMP's time is "
            f"{table['ratio'].min():.3f} to {table['ratio'].max():.3f} of oneTBB's.")


def _bound(points: pd.DataFrame) -> _Answer | None:
    known = points.dropna(subset=["share_of_bound"])
    if known.empty:
        return None
    p = known.loc[known["share_of_bound"].idxmax()]
    low, high = (p["bound_s"] / p[f"sum_s_{end}"] for end in ("high", "low"))
    share = words.bounded(100 * p["share_of_bound"], 100 * low, 100 * high, 0, " (no interval)")
    return (_verdict(low, high, _NEAR), f"{share} % ({p['backend']})",
            f"The nearest is {p['backend']} {'' if pd.isna(p['M']) else 'with '}{_cells(p)} and "
            f"{words.threads_words(p['threads'])}: its "
            f"{'arithmetic' if p['limited_by'] == 'flops' else 'memory traffic'} could not be done in less than "
            f"{words.ms(p['bound_s'])} ms, and that is {100 * p['share_of_bound']:.1f} % of the time it takes.")
