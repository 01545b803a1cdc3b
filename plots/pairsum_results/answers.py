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
    """The fastest whole step of the largest problem that was measured, against all that was measured in the same
    rounds. `over_gather` and `over_symmetric` say how many times as fast as the fastest of naive* and symmetric* it is,
    on as many threads if there is one: `point`, `name`, `ratio`, `low`, `high`, `rounds`, `verdict`."""
    text: str
    details: str
    point: int
    ties: list[int]  #: points that cannot be told from it (Holm, 95 %)
    decided: bool
    reason: str  #: why nothing is decided; "" if something is
    command: str  #: the winner as a command line, or what to run to come to a decision
    n_particles: int
    over_gather: dict[str, Any] | None
    over_symmetric: dict[str, Any] | None


#: The gather and the talk's symmetric sum, scalar, on any runtime.
_BASES = {"symmetric": ["symmetric", "symmetric_omp", "symmetric_tbb"], "gather": ["naive", "naive_omp", "naive_tbb"]}
_NEEDED = 6  # rounds, for an interval of the median


def answer(results: Results) -> Answer | None:
    """None if nothing but self-test backends was measured."""
    points = results.points.assign(time=results.times("total_s"))
    points = points[points["time"].notna() & ~points["backend"].isin(self_tests(results).index)]
    of_first = points[points["build"] == 0]
    if of_first.empty:
        return None
    sizes = of_first.groupby("series").agg(n_fluid=("n_fluid", "first"), points=("n_fluid", "size"))
    series = sizes.sort_values(["n_fluid", "points"], ascending=False, kind="stable").index[0]
    best = int(of_first["time"][of_first["series"] == series].idxmin())
    # What was measured at another time, when the machine may have been another one, is not compared.
    rounds = results.rounds[results.rounds["point"].isin(of_first.index[of_first["series"] == series])]
    own = rounds.loc[rounds["point"] == best, ["file", "round"]]
    candidates = points.loc[sorted(set(rounds.merge(own)["point"]))]
    others = candidates.index.drop(best)
    against = compared(results, others, [best] * len(others), "total_s").set_index("base")
    ties = [int(k) for k in against.index[against["verdict"] == "not resolved"]]
    said, p = _choices(candidates, best), points.loc[best]
    over = {kind: _over(kind, candidates.drop(best), against, said, p["backend"], p["threads"]) for kind in _BASES}
    reason = _undecided(len(own), len(others), len(ties), said[best])
    where = results.environments.drop_duplicates("build").set_index("build").loc[0]
    n_particles = int(p["n_fluid"] + p["n_boundary"])
    bases = [one for one in over.values() if one]
    if reason:
        text = f"On {where['host']} nothing is decided, because {reason}"
        backends = dict.fromkeys([p["backend"], *points["backend"].reindex(ties), *(points["backend"][one["point"]]
                                                                                    for one in bases)])
        command = _command(p, backend=",".join(backends) if len(others) else "all", rounds=2 * max(_NEEDED, len(own)))
    else:
        text = f"On {where['host']} {said[best]} is the fastest of {len(candidates)} measured"
        text += ": " + " and ".join(f"{words.bounded(one['ratio'], one['low'], one['high'])} times as fast as "
                                    f"{one['name']}" for one in bases) if bases else ""
        text += f", on {n_particles:,} particles"
        command = _command(p, backend=p["backend"])
    details = (f"{where['cpu']}, {where['cores']} cores: a whole step of {p['case']} ({p['n_fluid']:,} fluid and "
               f"{p['n_boundary']:,} boundary particles, dx {p['dx']:.10g}, {p['state']}, {p['precision']}, "
               f"{p['interaction']}) takes {words.ms(p['time'])} ms with {said[best]}.")
    if ties:
        details += f" No difference was resolved from {first_few([said[k] for k in ties])}."
    return Answer(text + ".", details, best, ties, not reason, reason, command, n_particles, over["gather"],
                  over["symmetric"])


def said_of(found: Answer | None) -> list[str]:
    """The answer in lines for a terminal, with the command that follows from it."""
    if found is None:
        return ["Nothing can be recommended from these rows: they hold no backend but those of the self-test."]
    return [found.text, found.details, f"{'Run it' if found.decided else 'Run this'}:  {found.command}"]


def _over(kind: str, candidates: pd.DataFrame, against: pd.DataFrame, said: pd.Series,
          winner: str, threads: int) -> dict[str, Any] | None:
    """The ratio of the fastest of this kind over the winner; None if the winner is of the kind itself, or none is."""
    if winner in _BASES[kind]:
        return None
    found = candidates[candidates["backend"].isin(_BASES[kind]) & (candidates["isa"] == "scalar")]
    as_many = found[found["threads"] == threads]
    found = as_many if len(as_many) else found
    if found.empty:
        return None
    point = int(found["time"].idxmin())
    return {"point": point, "name": said[point],
            **against.loc[point, ["ratio", "low", "high", "rounds", "verdict"]].to_dict()}


def _undecided(rounds: int, others: int, ties: int, winner: str) -> str:
    if others == 0:
        return f"only {winner} was measured"
    if rounds < _NEEDED:
        return f"{rounds} round{'' if rounds == 1 else 's'} of {winner} give no interval ({_NEEDED} are needed)"
    rest = f"the {others} others" if others > 1 else "the other"
    return f"no difference was resolved between {winner} and {rest}" if ties == others else ""


def _command(p: Any, **more: Any) -> str:
    """`pairsum run` of a point's problem and place; what is the program's default is left out."""
    given = {name: p[name] for name in ("case", "dx", "state", "grid", "threads", "M")}
    given |= {name: p[name] for name, usual in _USUAL.items() if p[name] != usual}
    if abs(p["H"] - 2 * p["dx"]) > 1e-9 * p["dx"]:
        given["H"] = p["H"]
    one = "," not in more["backend"] and more["backend"] != "all"
    if one and p["isa"] != "scalar":
        given["isa"] = p["isa"]
    if one and p["block"] not in ("none", "auto"):
        given["block"] = p["block"]
    given = {name: value for name, value in given.items() if pd.notna(value)} | more
    return "pairsum run" + "".join(f" --{name} {value:.10g}" if isinstance(value, float) else f" --{name} {value}"
                                   for name, value in given.items())


#: What `pairsum run` takes where no option says otherwise.
_USUAL = {"dim": 3, "precision": "double", "interaction": "ferrari09", "smoothing": "wendland_c2",
          "integrator": "euler", "order": "lattice"}


def _choices(points: pd.DataFrame, best: int) -> pd.Series:
    """ "symmetric_omp (avx2, M = 7, 2 threads)": variants of a backend that has several, then grid, M and threads where
    they are not as of the best."""
    variants = ["isa", "block", "granularity"]
    several = points.groupby("backend")[variants].transform("nunique") > 1

    def place(p: Any) -> list[str]:
        return ([p["grid"]] if p["grid"] != "hashed_grid" or np.isnan(p["M"]) else []) + (
            [f"M = {p['M']:.0f}"] if pd.notna(p["M"]) else []) + [words.threads_words(p["threads"])]

    def said(p: Any) -> str:
        found = [p[name] for name in variants if several[name][p.name]]
        found += [word for word in place(p) if p.name == best or word not in own]
        return p["backend"] + (f" ({', '.join(found)})" if found else "")

    own = place(points.loc[best])
    return points.apply(said, axis=1)


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
