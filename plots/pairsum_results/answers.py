"""Which backend to take, and the talk's questions, in words and as values."""
import dataclasses
from typing import Any

import numpy as np
import pandas as pd

from . import words
from .compare import compared, first_few, judged
from .load import PLACE, Results
from .self_tests import self_tests

_READABLE = 8  # values that are all said


@dataclasses.dataclass
class Answer:
    """For the largest problem that was measured, the point whose whole step takes least."""
    text: str
    details: str
    point: int
    base: int  #: the fastest naive backend on as many threads; the point itself if there is none
    ties: list[int]  #: points that cannot be told from it (Holm, 95 %)
    ratio: dict[str, float]  #: base over point: ratio, low, high, rounds


def answer(results: Results) -> Answer | None:
    """None if nothing but self-test backends was measured."""
    points = results.points.assign(time=results.times("total_s"))
    points = points[points["time"].notna() & ~points["backend"].isin(self_tests(results).index)]
    of_first = points[points["build"] == 0]
    if of_first.empty:
        return None
    sizes = of_first.groupby("series").agg(n_fluid=("n_fluid", "first"), points=("n_fluid", "size"))
    series = sizes.sort_values(["n_fluid", "points"], ascending=False, kind="stable").index[0]
    # What was measured at another time, when the machine may have been another one, is not compared.
    rounds = results.rounds[results.rounds["point"].isin(of_first.index[of_first["series"] == series])]
    most = rounds.groupby(["file", "round"]).size().idxmax()
    together = rounds.set_index(["file", "round"]).loc[[most], "point"]
    candidates = points.loc[together]
    best = int(candidates["time"].idxmin())
    naive = candidates[candidates["backend"].str.startswith("naive")]
    as_many = naive[naive["threads"] == points["threads"][best]]
    naive = as_many if len(as_many) else naive
    base = int(naive["time"].idxmin()) if len(naive) else best
    others = candidates.index.drop(best)
    against = compared(results, others, [best] * len(others), "total_s")
    ties = [int(k) for k in against.loc[against["verdict"] == "not resolved", "base"]]
    ratio = compared(results, [base], [best], "total_s").iloc[0]
    said = _choices(candidates)
    p, where = points.loc[best], results.environments.drop_duplicates("build").set_index("build").loc[0]
    text = f"On {where['host']} take {said[best]}"
    if base != best:
        bounds = words.bounded(ratio["ratio"], ratio["low"], ratio["high"])
        value, _, interval = bounds.partition(" ")
        text += f": {value} times {interval or '(no interval: too few rounds)'} as fast as {said[base]}"
    details = (f"On {where['host']} ({where['cpu']}, {where['cores']} cores) a whole step of {p['n_fluid']} fluid "
               f"particles (dx {p['dx']:.10g}, {p['state']}, {p['precision']}, {p['interaction']}) takes "
               f"{words.ms(p['time'])} ms")
    if naive.empty:
        details += "; no naive backend was measured beside it."
    elif base == best:
        details += ". It is the fastest naive backend itself."
    else:
        details += f", with {said[base]} {words.ms(points['time'][base])} ms."
    if ties:
        details += f" No difference was resolved from {first_few([said[k] for k in ties])}."
    return Answer(text + ".", details, best, base, ties, ratio[["ratio", "low", "high", "rounds"]].to_dict())


def _choices(points: pd.DataFrame) -> pd.Series:
    """ "symmetric_omp with M = 7 and 2 threads", "tiles_omp on compact_grid and 2 threads" """
    def words_of(name: str, p) -> str:
        grid = f" on {p.grid}" if p.grid != "hashed_grid" or np.isnan(p.M) else ""
        cells = "" if np.isnan(p.M) else f" with M = {p.M:.0f}"
        return f"{name}{grid}{cells} and {words.threads_words(p.threads)}"

    named = zip(words.names(points, False), points.itertuples())
    return pd.Series([words_of(name, p) for name, p in named], points.index)


def questions(results: Results, series: int, tables: dict[str, pd.DataFrame]) -> list[dict[str, str]]:
    """The talk's questions as {"question", "answer"}, as far as they were measured in the series: is the symmetric sum
    twice as fast, does it scale as well, which M for which algorithm and why, OpenMP or oneTBB, how far from what the
    machine can do. `tables`: speedup, algorithm_speedup, m_comparison, runtime_comparison, points."""
    own = {name: table[(table["series"] == series) & ~table["backend"].isin(self_tests(results).index)]
           for name, table in tables.items()}
    found = [("Is the symmetric sum twice as fast here?", _twice(own["algorithm_speedup"])),
             ("Does it scale as well?", _scaling(results, own["speedup"], own["points"])),
             ("Which M for which algorithm, and why?", _which_m(results, own["m_comparison"])),
             ("OpenMP or oneTBB?", _runtime(own["runtime_comparison"])),
             ("How far is that from what the machine can do?", _bound(own["points"]))]
    return [{"question": question, "answer": text} for question, text in found if text]


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


def _with_bounds(e: pd.Series, name: str = "") -> str:
    value = f"{name}_" if name else ""
    return words.bounded(e[name or "ratio"], e[f"{value}low"], e[f"{value}high"], missing=" (no interval)")


def _twice(table: pd.DataFrame) -> str:
    table = _on_most_threads(table)
    if table.empty:
        return ""
    runtimes = {"omp": "OpenMP", "tbb": "oneTBB", "serial": "serial"}
    texts = [f"{runtimes[e['runtime']]} {e['base_backend'].removesuffix('_' + e['runtime'])} {_cells(e, 'base_')} over "
             f"{e['backend'].removesuffix('_' + e['runtime'])} {_cells(e)}{e['variant']}: {_with_bounds(e)}"
             for _, e in table.iterrows()]
    reach = table["high"].fillna(table["ratio"])
    yes = bool((reach >= 2).all())
    faster = f"No, {_range(table['ratio'])} times" if (reach > 1).any() else "No, it is not faster"
    return (f"{'Yes' if yes else faster}, on {words.threads_words(table['threads'].iloc[0])}: {', '.join(texts)}. Each "
            "pair is computed once instead of twice, but its distance is tested and both particles are written"
            + ("." if yes else ", so half the evaluations is not half the time."))


def _spread(values: pd.Series, texts: pd.Series) -> str:
    """All, or, where they are too many to read, the least and the greatest."""
    if len(values) <= _READABLE:
        return ", ".join(texts)
    order = pd.DataFrame({"value": values, "text": texts}).sort_values(["value", "text"])["text"]
    return f"from {order.iloc[0]} to {order.iloc[-1]}, {len(order) - 2} others between"


def _scaling(results: Results, table: pd.DataFrame, points: pd.DataFrame) -> str:
    table = _on_most_threads(table)
    if table.empty or table["threads"].iloc[0] < 2:
        return ""
    symmetric = table["backend"].map(results.backends["symmetric"])
    if symmetric.nunique() < 2:
        return ""
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
    return text + (f" In the symmetric passes threads spend {100 * waits.mean():.1f} % of the time waiting at barriers."
                   if len(waits) else "")


def _which_m(results: Results, table: pd.DataFrame) -> str:
    """For each backend over M, at one grid and granularity and on as many threads as were measured with several M."""
    alike = [name for name in PLACE if name != "M"]
    table = table[table["best_M"].notna()].join(results.points["cells_nonempty"], on="point")
    table = table[table.groupby(alike)["M"].transform("nunique") > 1]
    if table.empty:
        return ""
    order = table.sort_values(["backend", "threads", "grid", "granularity", "isa", "block"],
                              ascending=[True, False, True, True, True, True])
    chosen = order.drop_duplicates("backend")[alike]
    texts, work = [], {}
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
        if kind in ("naive", "symmetric"):
            known = over_m.dropna(subset=["collision_share", "cells_nonempty"])
            work.setdefault(kind, ", ".join(f"M = {e.M:.0f}: {100 * e.collision_share:.0f} % in "
                                            f"{e.cells_nonempty:.0f} cells" for e in known.itertuples()))
    kinds = {"naive": "Of the gather", "symmetric": "Of the symmetric sums"}
    why = "".join(f" {label}: {work[kind]}." for kind, label in kinds.items() if work.get(kind))
    return (f"{', '.join(texts)}. A smaller M folds more cells together, and distances are tested in vain. A larger "
            "one costs nothing in the sweep, because only cells that hold particles are visited; what it costs is in "
            "the index, whose table has 2^(dM) entries."
            + (" Share of the distance tests in vain, and cells with particles:" + why if why else ""))


def _runtime(table: pd.DataFrame) -> str:
    if table.empty:
        return ""
    count = table["verdict"].value_counts()
    return (f"Of {len(table)} comparisons oneTBB is faster in {count.get('faster', 0)}, OpenMP in "
            f"{count.get('slower', 0)}, no difference is resolved in {count.get('not resolved', 0)}; OpenMP's time is "
            f"{table['ratio'].min():.3f} to {table['ratio'].max():.3f} of oneTBB's.")


def _bound(points: pd.DataFrame) -> str:
    known = points.dropna(subset=["share_of_bound"])
    if known.empty:
        return ""
    p = known.loc[known["share_of_bound"].idxmax()]
    return (f"The nearest is {p['backend']} {'' if pd.isna(p['M']) else 'with '}{_cells(p)} and "
            f"{words.threads_words(p['threads'])}: its "
            f"{'arithmetic' if p['limited_by'] == 'flops' else 'memory traffic'} could not be done in less than "
            f"{words.ms(p['bound_s'])} ms, and that is {100 * p['share_of_bound']:.1f} % of the time it takes.")
