"""How backends keep threads apart, and what that costs: ladders of strategies. Times are those of whole evaluations
(prepare, zero, sum and reduce together): the sum alone would flatter those who make lists before it."""
import numpy as np
import pandas as pd

from . import stats
from .compare import compared
from .load import EVALUATION, PLACE, Results
from .self_tests import self_tests

#: Backends of which the first that was measured is the base: the gather, which needs no strategy.
BASES = ["naive_omp", "naive_tbb", "naive"]
_FEWEST = 3  # backends on a ladder
#: How backends keep threads apart whose rows are too old (schema 2) to say so; others with _omp or _tbb as without.
_FORMER = {"naive": "gather", "naive_tiles": "gather", "sphysics_sweep": "serial", "ppm_stencil": "serial",
           "atomic_add": "atomics", "thread_private": "copies", "touched_blocks": "copies", "per_pass_buffers": "copies",
           "sliced_locks": "locks", "task_conflicts": "tasks",
           "pair_list": "serial", **dict.fromkeys(
               ("symmetric", "tiles", "colour18", "colour4", "half_cells", "sliced_2colour", "pair_list_omp",
                "pair_list_tbb", "verlet_list"), "colours")}


def ladder(results: Results) -> pd.DataFrame:
    """The backends of every series with a base and two more, each at its fastest, against the base (see compare; the
    time is that of an evaluation): `at` "one_thread", and "most_threads" of each backend; `rank` `of` so many.

    `over_serial` (one thread): time over that of the serial sweep on the same cells: what keeping threads apart costs
    where there are none. `efficiency` (more threads): speedup over the same on one thread, per thread. Both with `_low`
    and `_high`. `extra_bytes` (and `_per_particle`): memory beyond the leanest. `world`: the series in a few words."""
    rungs = _rungs(results)
    table = compared(results, rungs["base"], rungs["point"], EVALUATION).assign(
        **{name: rungs[name].to_numpy() for name in ("at", "rank", "of")})
    table["world"] = table["series"].map(worlds(results))
    serial, logs = _serial(results, table), results.logs(EVALUATION)
    one = _one_thread(results).reindex(table["point"]).set_axis(table.index).where(table["threads"] > 1)
    for name, base, own, by in (("over_serial", table["point"], serial, 1), ("efficiency", one, table["point"],
                                                                            table["threads"])):
        known = base.notna() & own.notna()
        found = stats.ratios(logs, base[known].astype(int), own[known].astype(int)).set_axis(table.index[known])
        for end, column in (("", "ratio"), ("_low", "low"), ("_high", "high")):
            table[name + end] = found[column].reindex(table.index) / by
    memory = results.points[["wait_share", "workspace_bytes", "n_fluid"]].reindex(table["point"]).set_axis(table.index)
    table[["wait_share", "workspace_bytes"]] = memory[["wait_share", "workspace_bytes"]]
    least = memory["workspace_bytes"].groupby([table["series"], table["at"]]).transform("min")
    table["extra_bytes"] = memory["workspace_bytes"] - least
    table["extra_bytes_per_particle"] = (table["extra_bytes"] / memory["n_fluid"]).where(memory["n_fluid"] > 0)
    return table


def _rungs(results: Results) -> pd.DataFrame:
    """`series`, `at`, `point`, `base`, `rank`, `of` of all ladders: each backend's fastest point, fastest first."""
    points = results.points.assign(time=results.typical(EVALUATION))
    working = points[~points["backend"].isin(self_tests(results).index)]
    most = points.groupby(["series", "backend"])["threads"].transform("max")
    one = working[working["threads"] == 1].assign(at="one_thread")
    parallel = most.groupby(points["series"]).transform("max") > 1
    highest = working[working["threads"].eq(most[working.index]) & parallel[working.index]].assign(at="most_threads")
    rungs = pd.concat([one, highest]).dropna(subset=["time"]).reset_index()
    keys = ["series", "at"]
    rungs = rungs.sort_values([*keys, "time", "point"]).drop_duplicates([*keys, "backend"])
    rungs = rungs.sort_values([*keys, "time", "backend"], ascending=[True, False, True, True])  # one_thread first
    rungs["rank"] = rungs.groupby(keys).cumcount() + 1
    rungs["of"] = rungs.groupby(keys)["backend"].transform("size")
    bases = rungs[rungs["backend"].isin(BASES)]
    bases = bases.assign(order=bases["backend"].map(BASES.index)).sort_values("order").drop_duplicates(keys)
    rungs = rungs.merge(bases[[*keys, "point"]].rename(columns={"point": "base"}), on=keys, how="left")
    rungs = rungs[rungs["base"].notna() & (rungs["of"] >= _FEWEST)]
    return rungs[[*keys, "point", "base", "rank", "of"]].astype({"base": int})


def standings(results: Results) -> pd.DataFrame:
    """Every backend at its fastest on each number of threads, by whole steps, the fastest first: times over those of a
    base, the gather or else the slowest (see compare). `rank` `of` so many in the series and on these threads; `behind`
    with `_low` and `_high`: its time over that of the fastest; `tied`: no difference from that is resolved (Holm, over
    these); `world`: the series in a few words. Nothing where one backend alone was timed."""
    keys = ["series", "threads"]
    points = results.points.assign(time=results.typical("total_s")).dropna(subset=["time"]).reset_index()
    rungs = points[~points["backend"].isin(self_tests(results).index)].sort_values([*keys, "time", "point"])
    rungs = rungs.drop_duplicates([*keys, "backend"])
    groups = rungs.groupby(keys)
    rungs["rank"], rungs["of"] = groups.cumcount() + 1, groups["backend"].transform("size")
    rungs["fastest"], slowest = groups["point"].transform("first"), groups["point"].transform("last")
    order = {name: k for k, name in enumerate(BASES)}
    gathers = rungs.assign(order=rungs["backend"].map(order)).dropna(subset=["order"]).sort_values("order")
    gathers = gathers.drop_duplicates(keys).set_index(keys)["point"]
    rungs["base"] = gathers.reindex(pd.MultiIndex.from_frame(rungs[keys])).set_axis(rungs.index).fillna(slowest)
    rungs = rungs[rungs["of"] > 1].reset_index(drop=True)
    table = compared(results, rungs["base"], rungs["point"], "total_s").assign(
        rank=rungs["rank"], of=rungs["of"], world=lambda t: t["series"].map(worlds(results)))
    behind = compared(results, rungs["point"], rungs["fastest"], "total_s")
    for end, column in (("", "ratio"), ("_low", "low"), ("_high", "high")):
        table[f"behind{end}"] = behind[column]
    verdicts = [stats.verdicts(behind.loc[own.index]) for _, own in table.groupby(keys)]
    table["tied"] = (pd.concat(verdicts) if verdicts else behind["verdict"]).eq("not resolved")
    return table


def families(results: Results) -> pd.Series:
    """How every backend keeps threads apart: "gather", "colours", "copies", "locks", "tasks", "atomics", "serial" or,
    where nobody knows, "other"."""
    said = results.backends["conflicts"]
    names = said.index.to_series()
    said = said.fillna(names.map(_FORMER)).fillna(names.str.replace("_(omp|tbb)$", "", regex=True).map(_FORMER))
    return said.where(said.isin(list(_FORMER.values())), "other")


def _one_thread(results: Results) -> pd.Series:
    """For every point the same on one thread; null if that was not timed."""
    alike, times = results.alike("threads"), results.times(EVALUATION)
    one = pd.Series(times.index[(results.points["threads"] == 1) & times.notna()], dtype=int)
    return alike.map(one.set_axis(alike[one]))


def made_for(results: Results) -> pd.Series:
    """Does each point sum on what its backend is made for: vector units, or none? A backend that does not say so (rows
    of schema 2) is made for what it was measured on, if that is one of the two."""
    points = results.points
    work = self_tests(results)["base_backend"].reindex(points["backend"]).fillna(pd.Series(points["backend"].to_numpy(),
                                                                                           points["backend"]))
    vector = results.backends["vector"].reindex(work).set_axis(points.index)
    on_units = points["isa"] != "scalar"
    return (on_units == vector).where(vector.notna(), on_units.groupby(points["backend"]).transform("nunique") == 1)


def _serial(results: Results, table: pd.DataFrame) -> pd.Series:
    """The serial sweep on the same cells, and the same or the usual instruction set, for what ran on one thread."""
    usual, times = made_for(results), results.times(EVALUATION)
    points = results.points.assign(usual=usual)[times.notna()].reset_index()
    sweeps = points.loc[points["backend"] == "sphysics_sweep", ["series", "grid", "M", "isa", "usual", "point"]]
    rungs = table.loc[table["threads"] == 1, ["series", "grid", "M", "isa", "point"]].reset_index(names="rung")
    rungs["usual"] = usual.reindex(rungs["point"]).to_numpy()
    pairs = rungs.merge(sweeps, on=["series", "grid", "M"], suffixes=("", "_serial"))
    pairs = pairs[(pairs["isa"] == pairs["isa_serial"]) | (pairs["usual"] & pairs["usual_serial"])]
    return pairs.groupby("rung")["point_serial"].min().reindex(table.index)


def worlds(results: Results) -> pd.Series:
    """Every series in a few words: "dam_break 3D", "random_clustered 3D, H = 0.4 dx"."""
    series, words = results.series, []
    reach = series["H"] / series["dx"]
    told = [name for name in ("state", "order", "precision", "interaction", "study", "build_name")
            if series[name].nunique() > 1]
    for k, one in series.iterrows():
        text = f"{one['case']} {one['dim']}D" + (f", H = {reach[k]:.3g} dx" if abs(reach[k] - 2) > 0.005 else "")
        text += "".join(f", {one[name]}" for name in told)
        text += f", {one['ranks']} ranks {one['cut']}" if one["ranks"] > 1 else ""
        like = (series["case"] == one["case"]) & (series["dim"] == one["dim"]) & ((reach - reach[k]).abs() <= 0.005)
        words.append(text + (f", dx = {one['dx']:g}" if (series["dx"][like] != one["dx"]).any() else ""))
    return pd.Series(words, series.index, dtype=object)


def shifts(results: Results, ladders: pd.DataFrame) -> pd.DataFrame:
    """How each backend stands to the base in one series, over how it stands in this one: `ratio` above 1 if it fares
    better here. The two differ in `what`: "sparsity" (fewer neighbours in a domain wider in H),
    "dimension" or "case". Standings are times over the base's in the same rounds, so that a machine that changes
    between the series cancels; they are compared unpaired (Welch). `rank` `of` here, `base_rank` `base_of` there."""
    highest = ladders[(ladders["at"] == "most_threads") | ~ladders["series"].isin(
        ladders.loc[ladders["at"] == "most_threads", "series"])]
    kept = ["series", "world", "point", "backend", "threads", "base", "base_backend", "rank", "of"]
    parts = []
    for (series, at), here in highest.groupby(["series", "at"]):
        there, what = _contrast(results, here, ladders[ladders["at"] == at])
        if what:
            before = ladders.loc[(ladders["series"] == there) & (ladders["at"] == at), ["backend", *kept[:3], "base",
                                                                                        "rank", "of"]]
            parts.append(here.loc[here["point"] != here["base"], kept].merge(
                before.rename(columns=lambda name: name if name == "backend" else f"base_{name}").rename(
                    columns={"base_base": "base_of_base"}), on="backend").assign(what=what))
    if not parts:
        return pd.DataFrame(columns=[*kept, "base_series", "base_world", "what", "base_rank", "base_of", "ratio", "low",
                                     "high", "rounds", "base_rounds", "verdict"])
    table, logs = pd.concat(parts, ignore_index=True), results.logs(EVALUATION)
    now, then = (pd.DataFrame(logs[table[own]].to_numpy() - logs[table[base]].to_numpy(), logs.index)
                 for own, base in (("point", "base"), ("base_point", "base_of_base")))
    known = now.notna().any() & then.notna().any()
    both = pd.concat([now, then.add_prefix("then ")], axis=1)
    found = stats.ratios(both, [f"then {k}" for k in table.index], list(table.index), paired=False)
    table = table.join(found.drop(columns="rounds")).assign(rounds=now.count(), base_rounds=then.count())[known]
    return table.reset_index(drop=True).assign(verdict=lambda t: stats.verdicts(t)).drop(columns="base_of_base")


def _contrast(results: Results, here: pd.DataFrame, ladders: pd.DataFrame) -> tuple[int, str]:
    """The series that a ladder is compared with, and what differs: in sparsity, or else in dimension, or else in the
    case; of several the one with the most particles. (-1, "") if there is none."""
    series = results.series.assign(reach=results.series["H"] / results.series["dx"])
    a = series.loc[here["series"].iloc[0]]
    base = ladders.drop_duplicates("series").set_index("series")["base_backend"]
    others = series.loc[base.index[base == here["base_backend"].iloc[0]]]
    words = ["study", "build", "state", "order", "precision", "interaction", "smoothing", "integrator", "dt", "ranks", "cut"]
    others = others[(others[words] == a[words]).all(axis=1)]
    case, dim = others["case"] == a["case"], others["dim"] == a["dim"]
    like = (others["reach"] - a["reach"]).abs() < 0.005 * others["reach"]
    for what, differ in (("sparsity", case & dim & (others["dx"] == a["dx"]) & (a["reach"] < 0.9 * others["reach"])),
                         ("dimension", case & (others["dim"] == 3) & (a["dim"] < 3) & like),
                         ("case", dim & (others["case"] == "dam_break") & (a["case"] != "dam_break"))):
        if differ.any():
            return int(others.loc[differ, "n_fluid"].idxmax()), what
    return -1, ""


def strategies(results: Results, ladders: pd.DataFrame, shifted: pd.DataFrame) -> pd.DataFrame:
    """The backends of the ladders with what they say of themselves and, in words, where each `breaks_down`: what counts
    is in docs/running.md. Null where it does not, or where rows of that time do not say."""
    found = results.backends.reindex(sorted(set(ladders["backend"])))[
        ["conflicts", "runtime", "aliases", "description", "symmetric", "deterministic"]].rename_axis("backend")
    texts = [(backend, text) for backend in found.index for text in _breakdowns(
        ladders[ladders["backend"] == backend], shifted[shifted["backend"] == backend])]
    said = pd.DataFrame(texts, columns=["backend", "text"]).groupby("backend")["text"].agg("; ".join)
    return found.assign(breaks_down=said.reindex(found.index)).reset_index()


def _breakdowns(own: pd.DataFrame, shifted: pd.DataFrame) -> list[str]:
    found = []

    def worst(excess: pd.Series):
        return own.loc[excess.idxmax()] if (excess > 0).any() else None

    if (e := worst(own["over_serial_low"] / 1.5 - 1)) is not None:
        found.append(f"1 thread: {e.over_serial:.2f} [{e.over_serial_low:.2f}, {e.over_serial_high:.2f}] times the "
                     f"serial sweep ({e.world})")
    if (e := worst(0.75 / own["efficiency_high"] - 1)) is not None:
        found.append(f"{e.threads} threads: efficiency {e.efficiency:.2f} [{e.efficiency_low:.2f}, "
                     f"{e.efficiency_high:.2f}] ({e.world})")
    worse = shifted[(shifted["verdict"] == "slower") & (1 / shifted["ratio"].astype(float) >= 1.25)]
    found += [f"{e.world}: against {e.base_backend} {1 / e.ratio:.2f} [{1 / e.high:.2f}, {1 / e.low:.2f}] times as "
              f"slow as in {e.base_world}; rank {e.rank} of {e.of} after {e.base_rank} of {e.base_of}"
              for e in worse.itertuples()]
    if (e := worst(own["extra_bytes_per_particle"] / 100 - 1)) is not None:
        found.append(f"memory: {e.extra_bytes_per_particle:.0f} bytes a particle more than the leanest, on {e.threads} "
                     f"thread{'' if e.threads == 1 else 's'} ({e.world})")
    return found
