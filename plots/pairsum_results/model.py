"""What the work of a point says: time per pair, shares of its distance tests, the least time the machine allows,
and what each thread did."""
import itertools

import numpy as np
import pandas as pd

from .load import Results


def peaks_of(results: Results) -> pd.DataFrame:
    """What the machine does at best with each point's build, threads and precision: a line per point; null if that was
    not measured."""
    peaks = results.peaks.dropna(subset=["build"]).sort_values("flops_per_s", ascending=False, kind="stable")
    keys = ["build", "threads", "precision"]
    peaks = peaks.drop_duplicates(keys).astype({"build": int, "threads": int})
    return results.points[keys].reset_index().merge(peaks, on=keys, how="left").set_index("point")


def shares(results: Results) -> pd.DataFrame:
    """Of every point's distance tests `useful_pair_ratio`, pairs found per test, and `collision_share`, the part that
    would not be made if no cells were folded together."""
    points = results.points
    tests = points["pairs_tested"].where(points["pairs_tested"] > 0)
    return pd.DataFrame({"useful_pair_ratio": points["pairs_interacting"] / tests,
                         "collision_share": 1 - points["pairs_tested_unfolded"] / tests})


def models(results: Results) -> pd.DataFrame:
    """The bound of every point's summation (docs/model.md), by the `flops` and `bytes` that its rows state and the
    peaks of the machine: `bound_s`, `limited_by` ("flops" or "bandwidth"), `share_of_bound` (of the time it takes),
    `achieved_flops_per_s`, `intensity` (flops per byte); `ns_per_pair` of the summation alone. Null where rows of that
    time do not state the work of the model, and of points that lost particles, whose steps have less work."""
    points, peaks, time = results.points, peaks_of(results), results.times()
    work = ["flops", "bytes", "pairs_interacting"]
    points = points.assign(**points[work].where(~(points["lost"] > 0)))
    arithmetic, traffic = points["flops"] / peaks["flops_per_s"], points["bytes"] / peaks["bandwidth_bytes_per_s"]
    bound = np.maximum(arithmetic, traffic).where(time.notna())
    limit = pd.Series(np.where(arithmetic >= traffic, "flops", "bandwidth"), points.index, dtype=object)
    pairs = points["pairs_interacting"].where(points["pairs_interacting"] > 0)
    return pd.DataFrame({"ns_per_pair": 1e9 * points["sum_s"] / pairs, "intensity": points["flops"] / points["bytes"],
                         "bound_s": bound, "limited_by": limit.where(bound.notna(), None),
                         "share_of_bound": bound / time, "achieved_flops_per_s": points["flops"] / time,
                         **peaks[["bandwidth_bytes_per_s", "flops_per_s"]]})


def thread_times(results: Results) -> pd.DataFrame:
    """`busy_s` and `waiting_s` (at barriers) of every `point` and `thread` in the passes of a summation together, means
    over all steps; nothing of points without passes of several threads."""
    names = {"threads_busy_s": "busy_s", "barrier_wait_s": "waiting_s"}
    timed = results.samples[results.samples["counts"]].dropna(subset=list(names))
    passes = {name: timed[row].map(lambda table: [sum(one) for one in itertools.zip_longest(*table, fillvalue=0)])
              for row, name in names.items()}
    table = pd.DataFrame({"point": timed["point"], **passes}).explode(list(names.values())).dropna()
    thread = table.groupby(table.index).cumcount()
    return table.groupby(["point", thread.rename("thread")])[list(names.values())].agg(
        lambda values: values.astype(float).mean()).reset_index()
