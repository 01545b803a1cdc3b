"""What more pairs per particle change: the fastest backend of every family against the fastest gather."""
import numpy as np
import pandas as pd

from .compare import compared
from .ladders import families
from .load import COMMON, EVALUATION, Results
from .self_tests import self_tests

#: What may differ between the densities of one problem; the hash of files depends on H, their names stand for it.
_APART = ["H", "n_fluid", "n_boundary", "particles"]
_FEWEST = 3  # densities


def density(results: Results) -> pd.DataFrame:
    """Of problems measured at three or more numbers of pairs per particle, which differ in H alone: on every number of
    threads, scalar and on vector units (`units`), the fastest backend of each `family` by whole evaluations (see
    ladders) against the fastest gather on the same `units` (see compare). Nothing where no gather was measured.

    A backend that computes each pair twice is of the family "gather", serial or not. `pairs_per_particle`: interacting
    pairs over fluid particles, each pair once; `ns_per_pair` (and `_low`, `_high`): of an evaluation; `problem`: a
    number for what all but H is alike in, `world` its words; `fastest_symmetric`: of those with the same units, threads
    and pairs the fastest that computes each pair once, whose `ratio` says what that is worth."""
    points = results.points.assign(time=results.typical(EVALUATION)).dropna(subset=["time"])
    points = points[~points["backend"].isin(self_tests(results).index) & (points["pairs_interacting"] > 0)]
    family, once = families(results), results.backends["symmetric"]
    family = family.where(once.isna() | once.eq(True), "gather").mask(family.index == "naive", "gather")
    points = points.assign(
        family=points["backend"].map(family), units=np.where(points["isa"] == "scalar", "scalar", "vector"),
        pairs_per_particle=points["pairs_interacting"] / points["n_fluid"], problem=_problems(results, points))
    several = points.groupby("problem")["H"].transform("nunique") >= _FEWEST
    place = ["problem", "threads", "units", "pairs_per_particle"]
    best = points[several].reset_index().sort_values([*place, "time", "point"]).drop_duplicates([*place, "family"])
    gather = best.loc[best["family"] == "gather", [*place, "point"]].rename(columns={"point": "base"})
    best = best.merge(gather, on=place)
    symmetric = best["time"].where(best["family"] != "gather")
    best["fastest_symmetric"] = symmetric == symmetric.groupby([best[name] for name in place]).transform("min")
    table = compared(results, best["base"], best["point"], EVALUATION)
    more = ["problem", "units", "family", "pairs_per_particle", "fastest_symmetric"]
    table = table.assign(**{name: best[name].to_numpy() for name in more})
    pairs = results.points["pairs_interacting"].reindex(table["point"]).to_numpy()
    for end in ("", "_low", "_high"):
        time = results.points[EVALUATION + end].reindex(table["point"]).to_numpy(dtype=float)
        table[f"ns_per_pair{end}"] = 1e9 * time / pairs
    table["world"] = table["problem"].map(_worlds(results, table))
    return table


def _problems(results: Results, points: pd.DataFrame) -> pd.Series:
    files = points["particles"].map(results.particles["files"].astype(str)).fillna("")
    alike = [points[name] for name in ("study", "build", *COMMON) if name not in _APART]
    return points.groupby([*alike, files.rename("files")], dropna=False, sort=False).ngroup()


def _worlds(results: Results, table: pd.DataFrame) -> pd.Series:
    """Every problem in a few words: its state, and what else differs between them."""
    first = table.drop_duplicates("problem").set_index("problem")["series"]
    series = results.series.loc[first].set_axis(first.index)
    told = ["state", *(name for name in ("study", "build_name", *COMMON)
                       if name not in ("state", *_APART) and series[name].nunique() > 1)]
    return pd.Series(map(", ".join, series[told].astype(str).to_numpy()), series.index, dtype=object)
