"""Comparisons between points of a series: tables with a line per pair of points.

Every table has the columns `series`, `point` and `base` (rows of Results.points), the point's PLACE and the same of the
base (`base_backend`, ...), `time_s` and `base_time_s`, and `ratio` = time of the base over that of the point (above 1
the point is faster) with `low`, `high` (95 %), `rounds` that pair them (0: not paired) and, over the whole table
(Holm), `verdict`: what the point is against its base. Times are those of the summation, `sum_s`, unless it is said
otherwise.
"""
import numpy as np
import pandas as pd

from . import stats
from .load import PLACE, Results, place_words
from .model import peaks_of, shares

#: The gather and the symmetric sum that differ in nothing else, and their runtime.
ALGORITHMS = [("naive", "symmetric", "serial"), ("naive_omp", "symmetric_omp", "omp"),
              ("naive_tbb", "symmetric_tbb", "tbb"), ("naive_tiles_omp", "tiles_omp", "omp")]


def compared(results: Results, base, point, phase: str = "sum_s") -> pd.DataFrame:
    """The table of these pairs of points, paired in the rounds that both were measured in. That of a point with itself
    is no comparison: its p-value is null. Both need a time of the phase in every round (Results.times)."""
    times, places = results.times(phase), results.points[PLACE]
    own, of_base = (np.asarray(ids, dtype=int) for ids in (point, base))
    table = pd.DataFrame({"series": results.points["series"].reindex(own).to_numpy(), "point": own, "base": of_base})
    table = table.join(places, on="point").join(places.add_prefix("base_"), on="base")
    table["time_s"], table["base_time_s"] = times.reindex(own).to_numpy(), times.reindex(of_base).to_numpy()
    table = table.join(stats.ratios(results.logs(phase), of_base, own))
    table.loc[table["point"] == table["base"], "p"] = np.nan
    return judged(table)


def judged(table: pd.DataFrame) -> pd.DataFrame:
    """The table with the verdicts of all its ratios together."""
    return table.assign(verdict=stats.verdicts(table))


def best(results: Results, *free: str, phase: str = "sum_s") -> pd.Series:
    """Of the points that differ in these columns only, the one that is fastest by the phase (Results.typical), for every
    point; null where none was timed."""
    times, alike = results.typical(phase), results.alike(*free)
    fastest = times.dropna().groupby(alike).idxmin()
    return alike.map(fastest)


def labels(results: Results) -> pd.Series:
    """Every point in the words of a caveat: with several series, the problem too."""
    points = results.points
    words = pd.Series([place_words(p) for p in points.itertuples()], points.index, dtype=object)
    if len(results.series) < 2:
        return words
    return words + [f" ({p.case}, {p.state}, dx {p.dx:.10g}, {p.order}, {p.precision}, {p.interaction}, "
                    f"{p.smoothing}, {p.integrator}, study {p.study})" for p in points.itertuples()]


def first_few(texts: list[str], most: int = 3) -> str:
    """ "A, B, C and 2 more" """
    return ", ".join(texts[:most]) + (f" and {len(texts) - most} more" if len(texts) > most else "")


def speedup(results: Results) -> pd.DataFrame:
    """Every point against itself on one thread, with `efficiency` (the ratio per thread); the machine's own scaling by
    its peaks (`machine_flops_scaling`, `machine_bandwidth_scaling`); and, as medians over rounds with `_low` and
    `_high`, how many times as many multiply-adds it made in the same rounds (`machine_speedup`) and what part of that
    the sums reach (`of_machine`)."""
    points, alike, timed = results.points, results.alike("threads"), results.times().notna()
    several = points.groupby(alike)["threads"].transform("nunique") > 1
    bases = pd.Series(points.index[(points["threads"] == 1) & timed], dtype=int)
    base = alike.map(bases.set_axis(alike[bases]))
    own = points.index[timed & base.notna() & ((points["threads"] > 1) | several)]
    table = compared(results, base[own], own)
    table["efficiency"] = table["ratio"] / table["threads"]
    peaks = peaks_of(results)[["flops_per_s", "bandwidth_bytes_per_s"]]
    table[["machine_flops_scaling", "machine_bandwidth_scaling"]] = (
        peaks.reindex(table["point"]).to_numpy() / peaks.reindex(table["base"]).to_numpy())
    return table.join(_against_machine(results, table))


def without_base(results: Results) -> list[str]:
    """The caveat on points whose speedup is not known, if there are any."""
    timed, alike = results.times().notna(), results.alike("threads")
    serial = set(alike[timed & (results.points["threads"] == 1)])
    lacking = timed & (results.points["threads"] > 1) & ~alike.isin(serial)
    texts = list(labels(results)[lacking])
    return [f"no speedup over 1 thread, which was not measured: {first_few(texts)}"] if texts else []


def _against_machine(results: Results, table: pd.DataFrame) -> pd.DataFrame:
    """(t_base f_base)/(t_own f_own) of each round, and f_own/f_base. Medians, because what disturbs a round hits the
    two differently: threads that share a core for a while halve the multiply-adds and may leave a sum as it was."""
    keys = ["file", "round", "study", "build", "threads", "precision"]
    rounds = results.rounds.merge(results.paces, on=keys, how="left")
    own = rounds[["point", "file", "round", "sum_s", "flops_per_s"]]
    pairs = table[["point", "base"]].reset_index(names="pair").merge(own, on="point").merge(
        own.rename(columns={"point": "base"}), on=["base", "file", "round"], suffixes=("", "_base"))
    pairs["machine_speedup"] = pairs["flops_per_s"] / pairs["flops_per_s_base"]
    pairs["of_machine"] = pairs["sum_s_base"] / pairs["sum_s"] / pairs["machine_speedup"]
    found = stats.medians(pairs[["pair", "machine_speedup", "of_machine"]].dropna(), "pair")
    names = [f"{name}{end}" for name in ("machine_speedup", "of_machine") for end in ("", "_low", "_high")]
    return found.reindex(table.index, columns=[*names, "rounds"]).rename(columns={"rounds": "machine_rounds"})


def algorithm_speedup(results: Results) -> pd.DataFrame:
    """naive over symmetric on as many threads: each M with itself, and naive at M = 7 over symmetric at M = 6; each
    with its best granularity. `runtime`: "serial", "omp" or "tbb"."""
    points = results.points[best(results, "granularity") == results.points.index].reset_index()
    same = ["series", "grid", "threads", "isa", "block"]
    columns = ["point", "M", "backend", *same]
    order = pd.DataFrame(ALGORITHMS, columns=["backend_base", "backend", "runtime"]).reset_index(names="order")
    pairs = order.merge(points[columns].rename(columns={"backend": "backend_base"}), on="backend_base")
    pairs = pairs.merge(points[columns], on=["backend", *same], suffixes=("_base", ""))
    like = (pairs["M_base"] == pairs["M"]) | (pairs["M_base"].isna() & pairs["M"].isna())
    pairs = pairs[like | ((pairs["M_base"] == 7) & (pairs["M"] == 6))].sort_values(["order", "point_base", "point"])
    return compared(results, pairs["point_base"], pairs["point"]).assign(runtime=pairs["runtime"].to_numpy())


def runtime_comparison(results: Results) -> pd.DataFrame:
    """OpenMP (the base) over oneTBB for every `algorithm`, each with its best granularity."""
    points = results.points[best(results, "granularity") == results.points.index].reset_index()
    points[["algorithm", "runtime"]] = points["backend"].str.extract("(.*)_(omp|tbb)$")
    omp, tbb = (points[points["runtime"] == word] for word in ("omp", "tbb"))
    pairs = omp.merge(tbb, on=["series", "algorithm", "grid", "isa", "block", "M", "threads"], suffixes=("", "_tbb"))
    pairs = pairs.sort_values(["point", "point_tbb"])
    return compared(results, pairs["point"], pairs["point_tbb"]).assign(algorithm=pairs["algorithm"].to_numpy())


def compiler_comparison(results: Results) -> pd.DataFrame:
    """Every point of the first build (`base_build`) against the same of the others (`build`, as compiler and revision),
    if builds are what the study compares."""
    points = results.points.reset_index()
    points = points[points["point"].map(results.times().notna())].astype({"seed": str})
    if not results.compares_builds:
        points = points.iloc[:0]
    same = [name for name in results.series.columns if name in points and name != "build"] + PLACE
    pairs = points[points["build"] == 0].merge(points[points["build"] > 0], on=same, suffixes=("_base", ""))
    pairs = pairs.sort_values(["point_base", "point"])
    names = results.series["build_name"]
    build, base = (results.points["series"].map(names).reindex(pairs[of]).to_numpy() for of in ("point", "point_base"))
    return compared(results, pairs["point_base"], pairs["point"]).assign(build=build, base_build=base)


def m_comparison(results: Results) -> pd.DataFrame:
    """Every point of a grid that takes M against the one with the best M, by whole steps (`time_s` is `total_s`):
    `best_M`, `over_best` (its time over the best one's), the verdict on it, its summation (`sum_s`) and `shares`."""
    points = results.points
    own = points.index[points["M"].notna()]
    fastest = best(results, "M", phase="total_s").reindex(own)
    timed = fastest.notna() & results.times("total_s").reindex(own).notna()
    table = compared(results, fastest[timed], own[timed], "total_s")
    rest = compared(results, [], []).reindex(columns=table.columns)
    rest["point"] = own[~timed]
    rest = rest.drop(columns=["series", *PLACE]).join(points[["series", *PLACE]], on="point")
    table = pd.concat([table, rest])[table.columns] if len(rest) else table
    table["best_M"] = table["point"].map(points["M"].reindex(fastest).set_axis(own))
    table["over_best"] = (1 / table["ratio"]).where(table["point"] != table["base"], 1.0).where(table["base"].notna())
    table["verdict"] = table["verdict"].fillna("not resolved")
    table = table.join(points[["sum_s", "sum_s_low", "sum_s_high"]], on="point").join(shares(results), on="point")
    order = ["series", "backend", "grid", "granularity", "isa", "block", "threads", "M"]
    return table.sort_values(order, kind="stable").reset_index(drop=True)
