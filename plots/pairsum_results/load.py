"""Rows to tidy tables: which rows count, which points they are of, and which points may be compared."""
import dataclasses
import pathlib
from typing import Iterable

import numpy as np
import pandas as pd

from . import builds, stats
from .rows import PHASES, ResultsError, read

#: The columns that tell points apart, in the order in which points are listed.
POINT = ["case", "state", "dx", "H", "n_fluid", "n_boundary", "order", "dim", "precision", "interaction", "smoothing",
         "integrator", "dt", "particles", "ranks", "cut", "backend", "grid", "isa", "block", "granularity", "M",
         "threads"]
#: Those in which points of a series may differ.
PLACE = ["backend", "grid", "isa", "block", "granularity", "M", "threads"]
COMMON = [name for name in POINT if name not in PLACE]
#: What it takes to get the rates: prepare, zero, sum and reduce together.
EVALUATION = "evaluation_s"
TIMES = [*PHASES, EVALUATION]
WORK = ["cells", "cells_nonempty", "sumF1", "sumF2", "pairs_tested", "pairs_interacting", "pairs_fluid_fluid",
        "pairs_fluid_boundary", "pairs_tested_unfolded", "flops", "bytes", "vector_units.block", "vector_units.lanes",
        "vector_units.vectors", "vector_units.occupancy"]
_COUNTERS = ["cycles", "instructions", "cache_misses"]


@dataclasses.dataclass
class Results:
    """The rows of some files. Times in seconds; null (NaN) is what was not measured or what rows of that time lack.

    samples       a line per timed step of a finished round, the unverified too: the keys of the row (design.md, section
                  3), `point` (-1 if no round of it counts), `series`, `build`; `counts`: its round is counted
    rounds        a line per point and round: means of its phases over repetitions and steps, `evaluation_s` (prepare,
                  zero, sum and reduce together), what the point is, and `host`, `cpu`, `git`
    points        index `point`: what it is; of TIMES the medians over rounds (`sum_s`) with `sum_s_low`, `sum_s_high`,
                  `confidence`; `rounds`, `repetitions`, `steps`, `wait_share`, `between`, `within` (scatter of sum_s),
                  work, memory, counters, `lost` (by all steps of a repetition, at most), `threads_worked` (the fewest)
    series        index `series`: what its points share; only points of one series are compared
    environments  a line per machine and build that rows name, with `build` (0, 1, ...) and `build_name`
    backends      index `name`: what each says of itself; null in rows of schema 2
    particles     those that no case makes: `particles` (their hash), `files`, `facts` (what, value, how, from)
    peaks, paces  what the machine does at best; what it did in a round
    closed        the round rows of finished rounds
    failed        points with rows that did not pass the verification, which are in no other place
    untimed       verified rows of points that were counted and not timed, as `samples` has others; `untimed`: why
    caveats       what to keep in mind, as texts
    """
    sources: list[str]
    samples: pd.DataFrame
    rounds: pd.DataFrame
    points: pd.DataFrame
    series: pd.DataFrame
    environments: pd.DataFrame
    backends: pd.DataFrame
    particles: pd.DataFrame
    peaks: pd.DataFrame
    paces: pd.DataFrame
    closed: pd.DataFrame
    failed: pd.DataFrame
    untimed: pd.DataFrame
    void_rounds: int
    compares_builds: bool  #: different builds were measured in the same rounds
    caveats: list[str]

    def logs(self, phase: str = "sum_s") -> pd.DataFrame:
        """The logarithms of a phase: a line per round, a column per point that may be compared by it."""
        found = self.rounds[self.rounds["point"].isin(self.times(phase).dropna().index)]
        return np.log(found.pivot(index=["file", "round"], columns="point", values=phase))

    def times(self, phase: str = "sum_s") -> pd.Series:
        """The medians of a phase by point; null unless it took time in every round."""
        least = self.rounds.groupby("point")[phase].min()
        return self.points[phase].where(least.reindex(self.points.index) > 0)

    def typical(self, phase: str = "sum_s") -> pd.Series:
        """The geometric means of a phase over rounds by point, null where `times` is: what is fastest is chosen by
        them, so that no ratio of others to it, which is of geometric means, too, says otherwise."""
        return np.exp(self.logs(phase).mean()).reindex(self.points.index)

    def alike(self, *free: str) -> pd.Series:
        """A number for every point, the same for points of a series that differ in these columns only."""
        keys = ["series", *(name for name in PLACE if name not in free)]
        return self.points.groupby(keys, dropna=False, sort=False).ngroup()


def load(paths: str | pathlib.Path | Iterable[str | pathlib.Path], allow_mixed: bool = False) -> Results:
    """The rows of one or more files, or of the files in folders and the folders below.

    A round counts if it was finished and not voided; a point's round with an unverified row is left out as a whole.
    Raises ResultsError with one line for a bad file, for rows without a finished round, and for rows of different
    machines or builds, unless these were measured in the same rounds (then the study compares them) or allow_mixed."""
    return collect(read(paths), allow_mixed)


def collect(rows: dict[str, pd.DataFrame], allow_mixed: bool = False) -> Results:
    """Tables of rows as `read` gives them; see load."""
    closed = _without_voids(rows["round"], rows["void"])
    samples, paces = (_of(closed, rows[kind]) for kind in ("sample", "pace"))
    if samples.empty:
        raise ResultsError("there is no finished round in the rows; a study that was cut goes on when it is started "
                           "again")
    environments, of_files = builds.builds(rows["environment"], samples)
    samples = samples.merge(of_files[["file", "environment", "build", "cores"]], on=["file", "environment"])
    differ, together = builds.differences(environments), builds.measured_together(samples)
    if differ and not together and not allow_mixed:
        raise ResultsError(f"the rows come from different machines or builds: {differ}; report them apart, or with "
                           "--allow-mixed as series of their own")
    caveats = builds.caveats(closed, environments, differ, together)
    caveats += [f"{source} holds {n} round{'s' * (n > 1)} of {of}, too: taken once"
                for (source, of), n in rows["copies"].groupby(["source", "of"]).size().items()]
    backends = _backends(rows["backend"], samples)
    samples, untimed = _with_times(_with_points(samples))
    caveats += [f"{place_words(p)} has no times: {p.untimed}" for p in untimed.drop_duplicates("key").itertuples()]
    failed = _failed(samples)
    samples, rounds = _rounds(samples)
    points = _points(samples, rounds)
    caveats += [f"{place_words(p)}: its repetitions have {p.fewest_steps} to {p.steps} steps"
                for p in points[points["fewest_steps"] < points["steps"]].itertuples()]
    series = (points.groupby("series")[["study", "build", "seed", *COMMON]].first() if len(points) else
              points.reindex(columns=["study", "build", "seed", *COMMON]))
    first = environments.drop_duplicates("build").set_index("build")
    series = series.join(first[["environment", "build_name"]], on="build")
    rounds = rounds.join(points[["study", "series", "build", *POINT]], on="point")
    rounds = rounds.join(first[["host", "cpu", "git"]], on="build").sort_values(["point", "file", "round"])
    particles = rows["particles"].drop_duplicates("particles").set_index("particles")[["files", "facts"]]
    peaks, paces = _peaks(rows["peak"], paces, environments)
    sources = list(dict.fromkeys(pd.concat([rows[kind]["source"] for kind in rows if kind != "copies"])))
    return Results(sources, samples, rounds.reset_index(drop=True), points.drop(columns="fewest_steps"), series,
                   environments, backends, particles, peaks, paces, closed, failed, untimed[untimed["verified"]],
                   len(rows["void"]), together, caveats)


def cells_words(p) -> str:
    """What tells the cells of a point: "M=6", or "compact_grid" where the grid takes no M."""
    return p.grid if np.isnan(p.M) else ("" if p.grid == "hashed_grid" else f"{p.grid} ") + f"M={p.M:.0f}"


def place_words(p) -> str:
    """A point in a caveat: "symmetric_omp M=6 threads=2", with its block unless that is auto or none, and its
    ranks where there are several."""
    block = "" if p.block in ("none", "auto") else f" {p.block}"
    ranks = f" ranks={p.ranks} {p.cut}" if p.ranks > 1 else ""
    return f"{p.backend} {cells_words(p)}{block} threads={p.threads}{ranks}"


def _without_voids(rounds: pd.DataFrame, voids: pd.DataFrame) -> pd.DataFrame:
    keys = ["file", "study", "round"]
    return rounds[~rounds.set_index(keys).index.isin(voids.set_index(keys).index)].reset_index(drop=True)


def _of(closed: pd.DataFrame, rows: pd.DataFrame) -> pd.DataFrame:
    return rows.merge(closed[["file", "study", "round"]].drop_duplicates(), on=["file", "study", "round"])


def _backends(rows: pd.DataFrame, samples: pd.DataFrame) -> pd.DataFrame:
    """What the measured backends say of themselves, by name: the last word of several. Rows of schema 2 say nothing,
    but the names of self-test backends tell what they are."""
    said = rows.drop_duplicates("name", keep="last").set_index("name").drop(
        columns=["schema", "kind", "study", "utc", "environment", "file", "source"], errors="ignore")
    said = said.reindex(pd.Index(sorted(set(samples["backend"])), name="name"))
    for name in said.index[said["runtime"].isna()]:
        test, _, base = name.partition("_")
        percent, _, slowed = base.partition("_")
        if test in ("again", "corrupt"):
            said.loc[name, ["self_test.what", "self_test.base_backend", "self_test.expected"]] = \
                ("A/A", base, 1.0) if test == "again" else (test, base, np.nan)
        elif test == "slowed" and percent.isdigit():
            said.loc[name, ["self_test.what", "self_test.base_backend", "self_test.expected"]] = \
                f"slowed {percent} %", slowed, 1 + int(percent) / 100
    return said


def _with_points(samples: pd.DataFrame) -> pd.DataFrame:
    """Samples with "key", a number of their point in the order in which points are listed, ordered by it; "seed" is
    null where the particles do not depend on it, and "isa" is scalar where one pair was summed at a time: rows used to
    name that of the build."""
    samples["block"] = samples["block"].fillna("none")
    samples["particles"] = samples["particles"].fillna("")
    samples["ranks"] = samples["ranks"].fillna(1).astype(int)
    samples["cut"] = samples["cut"].fillna("none")
    raw = samples.groupby(["file", *POINT], dropna=False, sort=False).ngroup()
    alone = samples["cells"].notna() & ~(samples["vector_units.lanes"] > 1)
    samples.loc[alone.groupby(raw).transform("any"), "isa"] = "scalar"
    same = (samples["state"] == "rest") & (samples["order"] != "shuffled") & ~samples["case"].str.startswith("random")
    samples["seed"] = samples["seed"].astype("UInt64").mask(same)
    keys = samples[["study", "build", "seed", *POINT]].fillna({"seed": 0, "M": 0})
    samples["key"] = keys.groupby(list(keys)).ngroup()
    samples["verified"] = samples["error"].isna() & samples["fingerprint"].notna()
    return samples.sort_values(["key", "file", "round", "repetition", "step"], kind="stable").reset_index(drop=True)


def _with_times(samples: pd.DataFrame) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Samples without those that were verified and counted, but not timed, and these."""
    untimed = samples[samples["untimed"].notna()]
    if len(untimed) == len(samples):
        raise ResultsError(f"no row has times: {untimed['untimed'].iloc[0]}")
    timed = samples[samples["untimed"].isna()].reset_index(drop=True)
    return timed, untimed[~untimed["key"].isin(timed["key"])].reset_index(drop=True)


def _failed(samples: pd.DataFrame) -> pd.DataFrame:
    wrong = samples[~samples["verified"]]
    found = wrong.assign(error=wrong["error"].fillna("not verified")).groupby("key")[["study", *POINT, "error"]].first()
    found["M"] = wrong.groupby("key")["M"].first()
    return found.assign(rows=wrong.groupby("key").size()).reset_index(drop=True)


def _mean(frame: pd.DataFrame, keys: list[str], columns: list[str]) -> pd.DataFrame:
    """Means of groups; null where one value is."""
    groups = frame.groupby(keys)
    means = groups[columns].mean().where(groups[columns].count().eq(groups.size(), axis=0))
    return means.assign(n=groups.size()).reset_index()


def _rounds(samples: pd.DataFrame) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Samples with "point", and the value of every point in every round that counts."""
    whole = samples.groupby(["key", "file", "round"])["verified"].transform("all")
    points = np.unique(samples.loc[whole, "key"])
    samples["point"] = np.where(samples["key"].isin(points), np.searchsorted(points, samples["key"]), -1)
    samples["counts"] = whole
    repetitions = _mean(samples[whole], ["point", "file", "round", "repetition"], PHASES)
    rounds = _mean(repetitions, ["point", "file", "round"], PHASES).rename(columns={"n": "repetitions"})
    rounds[EVALUATION] = rounds[["prepare_s", "zero_s", "sum_s", "reduce_s"]].sum(axis=1, skipna=False)
    return samples, rounds


def _points(samples: pd.DataFrame, rounds: pd.DataFrame) -> pd.DataFrame:
    counted = samples[samples["counts"]]
    groups = counted.groupby("point")
    points = groups[["study", "build", "seed", *POINT, "cores", *WORK, "fingerprint"]].first()
    points["M"] = groups["M"].first()
    series = points.groupby(["study", "build", "seed", *COMMON], dropna=False, sort=False).ngroup()
    points.insert(0, "series", series)
    samples["series"] = series.reindex(samples["point"]).to_numpy()
    sizes = counted.groupby(["point", "file", "round", "repetition"]).size().groupby("point").agg(["min", "max"])
    points = points.assign(steps=sizes["max"], fewest_steps=sizes["min"],
                           repetitions=rounds.groupby("point")["repetitions"].max(),
                           **groups[["peak_rss_bytes", "workspace_bytes"]].max(), lost=_lost(counted),
                           threads_worked=groups["threads_worked"].min(), **groups[_COUNTERS].mean() // 1)
    points = points.join(stats.medians(rounds[["point", *TIMES]], "point"))
    timed = counted[counted["threads_busy_s"].notna() & counted["barrier_wait_s"].notna()]
    busy, waiting = (timed[name].map(lambda table: sum(map(sum, table))).groupby(timed["point"]).sum()
                     for name in ("threads_busy_s", "barrier_wait_s"))
    points["wait_share"] = (waiting / (busy + waiting)).where(busy + waiting > 0) if len(timed) else np.nan
    repetitions = _mean(counted, ["point", "file", "round", "repetition"], ["sum_s"])
    repetitions["process"] = repetitions.groupby(["file", "round"]).ngroup()
    return points.join(stats.components_of_variance(repetitions[repetitions["sum_s"] > 0], "point", "process", "sum_s"))


def _lost(counted: pd.DataFrame) -> pd.Series:
    """How many particles a repetition of each point lost, at most; null where no row says it."""
    repetitions = counted.groupby(["point", "file", "round", "repetition"])["lost"].sum(min_count=1)
    return repetitions.groupby("point").max()


def _peaks(peaks: pd.DataFrame, paces: pd.DataFrame,
           environments: pd.DataFrame) -> tuple[pd.DataFrame, pd.DataFrame]:
    """The best of each environment, number of threads and precision, and the mean pace of each round."""
    like = ["environment", "threads", "precision"]
    of_environment = environments.drop_duplicates("environment", keep="last").set_index("environment")["build"]
    rates = ["bandwidth_bytes_per_s", "flops_per_s"]
    best = peaks.groupby(like, sort=False)[rates].max().astype(float)
    paces = paces.assign(build=paces["environment"].map(of_environment)).dropna(subset=["build"])
    reached = paces.groupby(like)["flops_per_s"].max().reindex(best.index)
    best["flops_per_s"] = np.fmax(best["flops_per_s"], reached.astype(float))
    paces = paces.groupby(["file", "round", "study", "build", "threads", "precision"])["flops_per_s"].mean()
    best = best.reset_index()
    return best.assign(build=best["environment"].map(of_environment)), paces.reset_index()
