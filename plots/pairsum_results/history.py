"""Results over revisions: what a revision made slower or faster, and the same points on two machines."""
import dataclasses
import pathlib
from typing import Iterable

import numpy as np
import pandas as pd

from . import stats, words
from .builds import names
from .compare import judged
from .load import POINT, Results, collect
from .rows import read
from .self_tests import self_tests

#: What tells machines apart, with the way the program was built and bound there.
_MACHINE = ["host", "cpu", "cores", "compiler", "binding"]
_HARDWARE = _MACHINE[:3]
_ROUND = ["file", "study", "round"]


@dataclasses.dataclass
class History:
    """Points by revision and machine. Times in seconds, medians over rounds.

    revisions  index `revision` (0, 1, ... in the order of their environment rows): `git`, `utc`
    machines   index `machine`: host, cpu, cores, compiler, binding, flags (null unless they tell machines apart),
               `name`
    lines      index `line`: a point on a machine: POINT, `seed`, `machine`, `revisions` (how many); if it is compared,
               `label` and `world` (its problem)
    steps      a line per `line` and two successive revisions in which it was measured, `base_revision` and `revision`:
               `base_time_s`, `time_s`; `ratio` (above 1: faster now), `low`, `high`, `p`, `rounds`, `verdict` as in
               compare.py, over all that are `newest` and over all others; `machine_ratio`: what the machine's own pace
               contributed to the ratio of the times, and is taken out (null without paces); `newest`: it is the newest
               revision of its machine
    elsewhere  a line per point that two machines measured with one revision: `line`, `base` (lines), `revision`,
               `time_s`, `base_time_s`, `ratio`, `low`, `high`; `flops_ratio`, `bandwidth_ratio` of the machines' peaks
    dirty      rounds left out: uncommitted changes have no revision
    failed     points with rows that did not pass the verification, but for those of self-test backends
    """
    phase: str
    revisions: pd.DataFrame
    machines: pd.DataFrame
    lines: pd.DataFrame
    steps: pd.DataFrame
    elsewhere: pd.DataFrame
    dirty: int
    failed: pd.DataFrame

    @property
    def slower(self) -> pd.DataFrame:
        """The steps that made the newest revision of a machine slower, worst first."""
        return self.steps[self.steps["newest"] & (self.steps["verdict"] == "slower")].sort_values("ratio")


def load_history(given: str | pathlib.Path | Iterable[str | pathlib.Path], phase: str = "sum_s") -> History:
    """The history of rows files and folders; see history."""
    return history(collect(read(given), allow_mixed=True), phase)


def history(results: Results, phase: str = "sum_s") -> History:
    """Every point's `phase` over revisions, machine by machine. A step compares times multiplied by the machine's pace
    (multiply-adds per second) in the same round, where both revisions have it in 3 rounds: what the round took in
    multiply-adds. Steps are paired where revisions were measured in the same rounds, else by Welch (stats.ratios).

    Studies are not told apart, but numbers of lost particles and of timed steps are: the first step sorts particles,
    which is more work. The summation is the same in every step, so `sum_s` is compared nevertheless."""
    builds, machines, revisions = _builds(results)
    rounds = results.rounds[results.rounds["point"].isin(results.times(phase).dropna().index)]
    rounds = rounds.merge(results.paces, on=[*_ROUND, "build", "threads", "precision"], how="left")
    rounds = rounds.join(builds[["machine", "revision"]], on="build")
    rounds = rounds.join(results.points[["seed", "steps", "lost"]], on="point")
    dirty = rounds.loc[rounds["revision"] < 0, _ROUND].drop_duplicates()
    rounds = rounds[rounds["revision"] >= 0].reset_index(drop=True)
    what = rounds[["seed", "lost", *POINT] + (["steps"] if phase != "sum_s" else [])].fillna(
        {"seed": 0, "M": 0, "lost": 0})
    rounds["what"] = what.groupby(list(what)).ngroup()
    rounds["line"] = rounds.groupby(["machine", "what"]).ngroup()
    rounds["cell"] = rounds.groupby(["line", "revision"]).ngroup()
    lines = rounds.groupby("line")[["machine", "what", "seed", *POINT]].first()
    lines["M"] = rounds.groupby("line")["M"].first()
    lines["revisions"] = rounds.groupby("line")["revision"].nunique()
    rounds["paced"] = rounds[phase] * rounds["flops_per_s"]
    cells = rounds.groupby("cell").agg(line=("line", "first"), revision=("revision", "first"),
                                       time_s=(phase, "median"), paced=("paced", "count"))
    logs, paced = (_logs(rounds, name) for name in (phase, "paced"))
    steps = _steps(cells, logs, paced)
    newest = rounds.groupby("machine")["revision"].max()
    steps["newest"] = steps["revision"] == steps["line"].map(lines["machine"]).map(newest)
    steps = pd.concat([judged(some) for _, some in steps.groupby(~steps["newest"])] or [judged(steps)]).sort_index()
    elsewhere = _elsewhere(results, cells, lines, machines, builds, logs)
    compared = lines[lines.index.isin([*steps["line"], *elsewhere["line"], *elsewhere["base"]])]
    lines["label"], lines["world"] = _labels(compared), _worlds(compared)
    failed = results.failed[~results.failed["backend"].isin(self_tests(results).index)]
    return History(phase, revisions, machines, lines.drop(columns="what"), steps, elsewhere, len(dirty), failed)


def _builds(results: Results) -> tuple[pd.DataFrame, pd.DataFrame, pd.DataFrame]:
    """Of every build its number of the machine and of the revision (-1 with uncommitted changes); machines;
    revisions."""
    builds = results.environments.drop_duplicates("build").set_index("build")
    several = builds.groupby([*_MACHINE, "git"])["flags"].transform("nunique") > 1
    several = several.groupby([builds[name] for name in _MACHINE]).transform("any")
    builds["flags"] = builds["flags"].where(several)
    clean = builds[~builds["dirty"].astype(bool)]
    seen = results.environments[results.environments["git"].isin(clean["git"])]
    first = seen.groupby("git")["utc"].min().sort_values(kind="stable")
    keys = [*_MACHINE, "flags"]
    builds["machine"] = builds.groupby(keys, dropna=False, sort=False).ngroup()
    builds["revision"] = builds["git"].map(pd.Series(range(len(first)), first.index, dtype=float)).where(
        builds.index.isin(clean.index), -1).astype(int)
    machines = builds.drop_duplicates("machine").set_index("machine")[keys]
    machines["name"] = names(machines, keys)
    return builds, machines, first.rename("utc").rename_axis("git").reset_index().rename_axis("revision")


def _labels(lines: pd.DataFrame) -> pd.Series:
    cells = np.where(lines["M"].isna(), "", " M=" + lines["M"].map(words.whole))
    return words.names(lines) + cells + " threads=" + lines["threads"].astype(str)


def _worlds(lines: pd.DataFrame) -> pd.Series:
    """The problem of every point, with what there is several of."""
    world = lines["case"] + " " + lines["dim"].astype(str) + "D dx=" + lines["dx"].map("{:.6g}".format)
    reach = (lines["H"] / lines["dx"]).map("{:.3g}".format)
    world += " H=" + reach + " dx" if reach.nunique() > 1 else ""
    for name in ("state", "order", "precision", "interaction", "smoothing", "integrator"):
        world += " " + lines[name] if lines[name].nunique() > 1 else ""
    return world


def _logs(rounds: pd.DataFrame, value: str) -> pd.DataFrame:
    return np.log(rounds.groupby([*_ROUND, "cell"])[value].mean()).unstack("cell")


def _steps(cells: pd.DataFrame, logs: pd.DataFrame, paced: pd.DataFrame) -> pd.DataFrame:
    now = cells.index[cells["line"].eq(cells["line"].shift())]
    base = now - 1  # cells are ordered by line and revision
    known = (np.minimum(cells["paced"][now], cells["paced"][base].to_numpy()) >= stats.FEWEST_FOR_RATIO).to_numpy()
    raw, found = stats.ratios(logs, base, now), stats.ratios(paced, base, now)
    own, of_base = cells.loc[now].reset_index(drop=True), cells.loc[base].add_prefix("base_").reset_index(drop=True)
    steps = pd.concat([own[["line", "revision", "time_s"]], of_base[["base_revision", "base_time_s"]]], axis=1)
    steps["machine_ratio"] = (raw["ratio"] / found["ratio"]).where(known)
    return steps.join(found.where(pd.Series(known), raw))


def _elsewhere(results: Results, cells: pd.DataFrame, lines: pd.DataFrame, machines: pd.DataFrame,
               builds: pd.DataFrame, logs: pd.DataFrame) -> pd.DataFrame:
    """Each point on another machine against the same on one before it, with the last revision that both measured."""
    own = cells.reset_index().join(lines[["machine", "what", "threads", "precision"]], on="line")
    own["hardware"] = own["machine"].map(machines.groupby(_HARDWARE, sort=False).ngroup())
    pairs = own.merge(own, on=["what", "revision", "threads", "precision"], suffixes=("_base", ""))
    pairs = pairs[pairs["hardware_base"] < pairs["hardware"]].sort_values(["line_base", "line", "revision"])
    pairs = pairs.drop_duplicates(["line_base", "line"], keep="last").reset_index(drop=True)
    table = pairs.rename(columns={"line_base": "base", "time_s_base": "base_time_s"})
    table = table.join(stats.ratios(logs, pairs["cell_base"], pairs["cell"])[["ratio", "low", "high"]])
    peaks = results.peaks.dropna(subset=["build"])
    rates = ["flops_per_s", "bandwidth_bytes_per_s"]
    peaks = peaks.assign(machine=peaks["build"].map(builds["machine"])).groupby(
        ["machine", "threads", "precision"])[rates].max()
    here, there = (peaks.reindex(pd.MultiIndex.from_frame(pairs[[column, "threads", "precision"]])).to_numpy()
                   for column in ("machine", "machine_base"))
    table[["flops_ratio", "bandwidth_ratio"]] = here / there
    return table[["line", "base", "revision", "time_s", "base_time_s", "ratio", "low", "high", "flops_ratio",
                  "bandwidth_ratio"]]
