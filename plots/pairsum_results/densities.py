"""What more pairs per particle change: the fastest backend of every family against the fastest gather."""
import numpy as np
import pandas as pd

from .compare import compared
from .load import COMMON, EVALUATION, Results
from .self_tests import self_tests

#: What may differ between the densities of one problem.
_APART = ["H", "n_fluid", "n_boundary"]
_FEWEST = 3  # densities


def density(results: Results) -> pd.DataFrame:
    """Of problems measured at three or more numbers of pairs per particle, which differ in H alone: on every number of
    threads, scalar and on vector units (`units`), the fastest backend of each `family` by whole evaluations (ladders.py)
    against the fastest gather on the same `units`: its `ratio` is what computing each pair once is worth (compare.py).

    `pairs_per_particle`: interacting pairs over fluid particles, each pair once; `ns_per_pair`: of an evaluation;
    `problem`: a number for what all but H is alike in, `world` its words; `fastest_symmetric`: of those with the
    same units, threads and pairs the fastest that computes each pair once."""
    points = results.points.assign(time=results.typical(EVALUATION)).dropna(subset=["time"])
    points = points[~points["backend"].isin(self_tests(results).index) & (points["pairs_interacting"] > 0)]
    points = points.assign(
        family=points["backend"].map(results.backends["conflicts"]).fillna("other"),
        units=np.where(points["isa"] == "scalar", "scalar", "vector"),
        pairs_per_particle=points["pairs_interacting"] / points["n_fluid"],
        problem=points.groupby(["study", "build", *(name for name in COMMON if name not in _APART)], dropna=False,
                               sort=False).ngroup())
    several = points.groupby("problem")["H"].transform("nunique") >= _FEWEST
    place = ["problem", "threads", "units", "pairs_per_particle"]
    best = points[several].reset_index().sort_values([*place, "time", "point"]).drop_duplicates([*place, "family"])
    gather = best.loc[best["family"] == "gather", [*place, "point"]].rename(columns={"point": "base"})
    best = best.merge(gather, on=place)
    once = best["time"].where(best["family"] != "gather")
    best["fastest_symmetric"] = once == once.groupby([best[name] for name in place]).transform("min")
    table = compared(results, best["base"], best["point"], EVALUATION)
    more = ["problem", "units", "family", "pairs_per_particle", "fastest_symmetric"]
    table = table.assign(**{name: best[name].to_numpy() for name in more})
    pairs = results.points["pairs_interacting"].reindex(table["point"]).to_numpy()
    for end in ("", "_low", "_high"):
        time = results.points[EVALUATION + end].reindex(table["point"]).to_numpy(dtype=float)
        table[f"ns_per_pair{end}"] = 1e9 * time / pairs
    table["world"] = table["problem"].map(_worlds(results, table))
    return table


def _worlds(results: Results, table: pd.DataFrame) -> pd.Series:
    """Every problem in a few words: its state, and what else differs between them."""
    first = table.drop_duplicates("problem").set_index("problem")["series"]
    series = results.series.loc[first].set_axis(first.index)
    kept = [name for name in ("case", "state", "precision", "interaction", "smoothing", "dx", "dim", "order")
            if name == "state" or series[name].nunique() > 1]
    return pd.Series(map(", ".join, series[kept].astype(str).to_numpy()), series.index, dtype=object)
