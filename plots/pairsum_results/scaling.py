"""What ranks gain and cost: speedups of ranks x threads, POP metrics of the sum, and what ranks exchange."""
import numpy as np
import pandas as pd

from . import stats
from .load import POINT, Results, place_words
from .words import count

#: Phases in which ranks send messages.
TRAFFIC = ["halo", "migrate", "send_back", "partition"]
#: Particles per rank differ by no more than this where they are taken for equal: weak scaling.
WEAK_WITHIN = 0.05
_REACH_WITHIN = 0.005  # of H/dx
_APART = ["ranks", "cut", "threads"]
_PROBLEM = ["study", "build", "seed", *(name for name in POINT if name not in _APART)]
_SIZE = ["dx", "H", "dt", "n_fluid", "n_boundary", "particles"]
_TIMES = ["step_s", "sum_s"]
_POP = ["load_balance", "communication_efficiency"]
_COUNTS = ["hosts", "cut_pairs", "cut_share", "ghosts_per_particle", "imbalance",
           *(f"{phase}_{what}" for phase in TRAFFIC for what in ("messages", "bytes"))]
_ENDS = ["", "_low", "_high"]
_COLUMNS = ["scaling", "world", "problem", "point", "base", "threads_base", *(n for n in _PROBLEM if n != "seed"),
            *_APART, "cores", "particles_per_rank", "timed", "why_untimed", "rounds",
            *(f"{name}{end}" for name in _TIMES for end in _ENDS),
            *(f"{name}{end}" for name in ("speedup", "efficiency", "sum_speedup", "sum_efficiency", "over_threads",
                                          "sum_over_threads", "computation_scaling") for end in _ENDS),
            "paired_rounds", "threads_paired_rounds", "verdict", *_POP, "parallel_efficiency", *_COUNTS]


def scaling(results: Results) -> pd.DataFrame:
    """What is said of ranks, a line per point and kind of `scaling`; nothing where all points are of one rank.

    "weak": one rank with one thread was measured on a smaller problem with as many fluid particles per rank, within 5
    %, and the same H/dx; `base` is that point. "strong": all others, and `base` has the same particles. `cores` is
    ranks times threads. `step_s` is a step's evaluation, from index to reduce, with messages and waits; `sum_s` the sum
    of the last rank. `speedup` is the time of the base over that of the point, times its particles over those of the
    base; `efficiency` is that per core; `sum_speedup` and `sum_efficiency` are of the sum. `over_threads` is the step
    of one rank with as many threads as there are cores (`threads_base`) over that of the point, `verdict` what that
    says over the whole table. All are paired in rounds, at 95 %.

    POP metrics are of the sum, where useful times are known: `load_balance` is mean over greatest useful time of ranks,
    `communication_efficiency` the greatest over the run until the last rank is through, both medians over rounds;
    `parallel_efficiency` is their product. `computation_scaling` is the useful time of the base, per particle and of
    all threads together, over that of the point. Counts are means over steps, of all ranks together: `cut_pairs` each
    once, `cut_share` of all pairs, `imbalance` the greatest over the mean number of pairs of a rank. Points that were
    counted but not timed have counts, `timed` false, and `why_untimed`."""
    places = _places(results)
    if places.empty:
        return pd.DataFrame(columns=_COLUMNS)
    table = _measured(results, _lines(places))
    table["verdict"] = stats.verdicts(table.rename(columns={"over_threads": "ratio"}))
    table.loc[table["over_threads"].isna(), "verdict"] = None
    return table[_COLUMNS].reset_index(drop=True)


def unlike(results: Results) -> list[str]:
    """Caveats on points whose ranks do not add up: their particles to those of the problem, or their pairs, each once,
    to those of the sum. Pairs are those of the last evaluation, so that only steps of one evaluation are checked."""
    places = _places(results)
    if places.empty:
        return []
    samples = _samples(results)
    found: dict[int, str] = {}
    for e in samples[samples["by_rank"].map(type) == list].itertuples():
        held, pairs = sum(one["own"] for one in e.by_rank), _once(e.by_rank, e.cut)
        if e.lost == 0 and held > e.n_fluid or e.step == 1 and e.lost == 0 and held != e.n_fluid:
            found.setdefault(e.key, f"{place_words(e)}: its ranks hold {held} fluid particles, not {e.n_fluid}")
        elif e.integrator == "euler" and e.pairs_interacting >= 0 and pairs != e.pairs_interacting:
            found.setdefault(e.key, f"{place_words(e)}: its ranks sum {pairs:.0f} pairs, each once, not "
                                    f"{e.pairs_interacting:.0f}")
    return list(found.values())


def _samples(results: Results) -> pd.DataFrame:
    return pd.concat([results.samples[results.samples["counts"]], results.untimed], ignore_index=True)


def _places(results: Results) -> pd.DataFrame:
    """What was measured or counted of every problem with points of several ranks, by key."""
    if not (results.points["ranks"] > 1).any() and not (results.untimed["ranks"] > 1).any():
        return pd.DataFrame()
    groups = _samples(results).groupby("key")
    places = groups[["study", "build", "seed", *POINT, "point", "untimed"]].first()
    places = places.rename(columns={"untimed": "why_untimed"}).astype({"point": float})
    places["problem"] = places.groupby(_PROBLEM, dropna=False, sort=False).ngroup()
    places["family"] = places.groupby([n for n in _PROBLEM if n not in _SIZE], dropna=False, sort=False).ngroup()
    family_has = places["ranks"].gt(1).groupby(places["family"]).transform("any")
    places = places[family_has].assign(cores=places["ranks"] * places["threads"], timed=places["why_untimed"].isna())
    return places.assign(particles_per_rank=places["n_fluid"] / places["ranks"])


def _lines(places: pd.DataFrame) -> pd.DataFrame:
    """The lines of the table: each with its base and that of threads alone, points of one rank first."""
    alone = places[(places["ranks"] == 1) & places["timed"]]
    serial = alone[alone["threads"] == 1]
    strong = serial.set_index("problem")["point"]
    weak = {key: _weak_base(p, serial) for key, p in places[places["ranks"] > 1].iterrows()}
    weak = {key: base for key, base in weak.items() if base is not None}
    own_base = places["problem"].map(strong)
    is_strong = (places["ranks"] == 1) | own_base.notna() | ~places.index.isin(weak)
    has_ranks = places["problem"].isin(places.loc[is_strong & (places["ranks"] > 1), "problem"])
    lines = [places[is_strong & has_ranks].assign(scaling="strong", base=own_base)]
    if weak:
        own = places.loc[[*weak]].assign(base=[serial.loc[key, "point"] for key in weak.values()])
        bases = serial.loc[sorted(set(weak.values()))]
        lines.append(pd.concat([bases.assign(base=bases["point"]), own]).assign(scaling="weak"))
    table = pd.concat(lines).reset_index(names="key")
    threads = alone.set_index(["problem", "threads"])["point"]
    table["threads_base"] = threads.reindex(pd.MultiIndex.from_frame(table[["problem", "cores"]])).to_numpy()
    table["threads_base"] = table["threads_base"].where(table["ranks"] > 1)
    of_base = table["base"].map(places.dropna(subset=["point"]).set_index("point")["particles_per_rank"])
    table["world"] = _worlds(table, of_base)
    order = ["scaling", "world", "backend", "grid", "isa", "block", "granularity", "M", "cores", "ranks", "cut"]
    return table.sort_values(order, kind="stable")


def _weak_base(p: pd.Series, serial: pd.DataFrame) -> int | None:
    """The key of the one thread whose particles are nearest to those of a rank of this point."""
    like = serial[(serial["family"] == p["family"]) & (serial["problem"] != p["problem"])]
    reach, own = like["H"] / like["dx"], p["H"] / p["dx"]
    off = (like["n_fluid"] / p["particles_per_rank"] - 1).abs()
    off = off[((reach - own).abs() <= _REACH_WITHIN * own) & (off <= WEAK_WITHIN)]
    return off.idxmin() if len(off) else None


def _worlds(table: pd.DataFrame, of_base: pd.Series) -> list[str]:
    """The problem of every line in a few words."""
    told = [name for name in ("state", "order", "precision", "interaction", "study", "build")
            if table[name].nunique() > 1]
    reach = [f"H = {far:.3g} dx" for far in table["H"] / table["dx"]]
    found = []
    for e, of, far in zip(table.to_dict("records"), of_base, reach):
        size = f"dx = {e['dx']:g}" if e["scaling"] == "strong" else f"{count(of)} particles a rank"
        words = [f"build {e[name]}" if name == "build" else str(e[name]) for name in told]
        found.append(", ".join([f"{e['case']} {e['dim']}D", size, *([far] if len(set(reach)) > 1 else []), *words]))
    return found


def _measured(results: Results, table: pd.DataFrame) -> pd.DataFrame:
    """The lines with times, ratios, metrics and counts."""
    samples = _samples(results)
    samples = samples[samples["key"].isin(table["key"])]
    rounds = results.rounds[results.rounds["point"].isin(table["point"].dropna())].copy()
    rounds["step_s"] = rounds["total_s"] - rounds["integrate_s"]
    of_rounds = samples[samples["untimed"].isna()].groupby(["point", "file", "round"])
    pop = pd.DataFrame([_pop(own, *key) for key, own in of_rounds],
                       columns=["point", "file", "round", *_POP, "useful_s"])
    rounds = rounds.merge(pop, on=["point", "file", "round"], how="left")
    medians = stats.medians(rounds[["point", *_TIMES]], "point").drop(columns="confidence")
    table = table.join(medians, on="point").join(rounds.groupby("point")[_POP].median(), on="point")
    table["parallel_efficiency"] = table["load_balance"] * table["communication_efficiency"]
    sizes = table.dropna(subset=["point"]).drop_duplicates("point").set_index("point")["n_fluid"]
    more = table["n_fluid"] / table["base"].map(sizes)
    for name, column, base, scale in (("speedup", "step_s", "base", more), ("sum_speedup", "sum_s", "base", more),
                                      ("computation_scaling", "useful_s", "base", more),
                                      ("sum_over_threads", "sum_s", "threads_base", 1),
                                      ("over_threads", "step_s", "threads_base", 1)):
        found = _ratios(rounds, column, table, base)
        for end in _ENDS:
            table[name + end] = found["ratio" if not end else end[1:]] * scale
        table["threads_paired_rounds" if base == "threads_base" else "paired_rounds"] = found["rounds"]
        table["p"] = found["p"]  # at last of over_threads
    for name in ("", "sum_"):
        for end in _ENDS:
            table[f"{name}efficiency{end}"] = table[f"{name}speedup{end}"] / table["cores"]
    return table.join(_counts(samples), on="key")


def _ratios(rounds: pd.DataFrame, column: str, table: pd.DataFrame, base: str) -> pd.DataFrame:
    """stats.ratios of lines that have both times; null elsewhere."""
    whole = rounds.groupby("point")[column].transform(lambda values: (values > 0).all())
    logs = np.log(rounds[whole].pivot(index=["file", "round"], columns="point", values=column))
    known = table["point"].isin(logs.columns) & table[base].isin(logs.columns)
    found = stats.ratios(logs, table.loc[known, base], table.loc[known, "point"]).set_axis(table.index[known])
    return found.reindex(table.index)


def _pop(own: pd.DataFrame, point: float, file: int, round: int) -> tuple:
    """Metrics of a point's round, over its steps: useful times are those of the ranks' own sums."""
    threads = own["threads"].iloc[0]
    if not (own["by_rank"].map(type) == list).all():
        return point, file, round, np.nan, np.nan, own["sum_s"].mean() * threads
    useful, waiting = (np.array([[one[name] for one in ranks] for ranks in own["by_rank"]], dtype=float)
                       for name in ("busy_s", "waiting_s"))
    of_rank, run = useful.sum(axis=0), (useful + waiting).max(axis=1).sum()
    if not of_rank.max() > 0:
        return point, file, round, np.nan, np.nan, np.nan
    return point, file, round, of_rank.mean() / of_rank.max(), of_rank.max() / run, of_rank.sum() * threads / len(own)


def _once(ranks: list[dict], cut: str) -> float:
    """The pairs of all ranks, each once."""
    return sum(one["pairs"] for one in ranks) - (sum(one["cut"] for one in ranks) / 2 if cut == "twice" else 0)


def _counts(samples: pd.DataFrame) -> pd.DataFrame:
    """Means over steps of what the ranks of a point hold and send together."""
    found = []
    for e in samples[samples["by_rank"].map(type) == list].itertuples():
        held = {name: np.array([one[name] for one in e.by_rank], dtype=float)
                for name in ("own", "ghosts", "pairs", "cut")}
        pairs, cut = held["pairs"], held["cut"].sum() / (2 if e.cut == "twice" else 1)
        once = _once(e.by_rank, e.cut)
        found.append({
            "key": e.key, "hosts": len({one["host"] for one in e.by_rank}), "cut_pairs": cut,
            "cut_share": cut / once if once else np.nan,
            "ghosts_per_particle": held["ghosts"].sum() / held["own"].sum() if held["own"].any() else np.nan,
            "imbalance": pairs.max() / pairs.mean() if pairs.any() else np.nan,
            **{f"{phase}_{what}": sum(one[phase][what] for one in e.by_rank)
               for phase in TRAFFIC for what in ("messages", "bytes")}})
    return pd.DataFrame(found, columns=["key", *_COUNTS]).groupby("key").mean()
