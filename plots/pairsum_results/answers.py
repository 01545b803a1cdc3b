"""Which backend to take, in words and as values."""
import dataclasses
import pathlib
import shlex
from typing import Any

import numpy as np
import pandas as pd

from . import words
from .compare import compared, first_few
from .load import Results
from .self_tests import self_tests
from .stats import FEWEST_FOR_MEDIAN


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


def answer(results: Results) -> Answer | None:
    """None if nothing but self-test backends was measured."""
    points = results.points.assign(time=results.typical("total_s"))
    points = points[points["time"].notna() & ~points["backend"].isin(self_tests(results).index)]
    if (whole := ~(points["lost"] > 0)).any():  # steps that lost particles have less to do
        points = points[whole]
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
    many = f"{p['n_fluid']:,} fluid" + (f" and {p['n_boundary']:,} boundary" if p["n_boundary"] else "") + " particles"
    bases = [one for one in over.values() if one]
    case = (", ".join(pathlib.PurePath(name).name for name in results.particles["files"][p["particles"]])
            if p["case"] == "file" else p["case"])
    particles = _read_from(results, p["particles"])
    if reason:
        text = f"On {where['host']} nothing is decided, because {reason}"
        backends = dict.fromkeys([p["backend"], *points["backend"].reindex(ties), *(points["backend"][one["point"]]
                                                                                    for one in bases)])
        command = _command(p, particles, backend=",".join(backends) if len(others) else "all",
                           rounds=2 * max(FEWEST_FOR_MEDIAN, len(own)))
    else:
        backends = candidates["backend"].nunique()
        measured = f"{backends} backends" if backends > 1 else f"{len(candidates)} variants"
        text = f"On {where['host']} {said[best]} is the fastest of {measured}"
        if ties:
            text += f", tied with {first_few([said[k] for k in ties])}"
        text += ": " * bool(bases) + " and ".join(_times_as_fast(one) for one in bases) + f", on {many}"
        command = _command(p, particles, backend=p["backend"])
    details = (f"{where['cpu']}, {where['cores']} cores: a whole step of {case} ({many}, dx {p['dx']:.10g}, "
               f"{p['state']}, {p['precision']}, {p['interaction']}) takes {words.time(p['total_s'])} with {said[best]}.")
    gathers = candidates[candidates["backend"].isin(_BASES["gather"])].drop(best, errors="ignore")
    if len(gathers) and (nearest := int(gathers["time"].idxmin())) not in [one["point"] for one in bases]:
        details += f" It is {_times_as_fast({**against.loc[nearest], 'name': said[nearest]})}, the fastest gather."
    return Answer(text + ".", details, best, ties, not reason, reason, command, int(p["n_fluid"] + p["n_boundary"]),
                  over["gather"], over["symmetric"])


def said_of(found: Answer | None) -> list[str]:
    """The answer in lines for a terminal, with the command that follows from it."""
    if found is None:
        return ["Nothing can be recommended from these rows: they hold no backend but those of the self-test."]
    said = words.wrapped(found.text, 100) + words.wrapped(found.details, 100)
    return [*said.splitlines(), f"{'Run it' if found.decided else 'Run this'}:  {found.command}",
            "Your case:  pairsum tune --case dam_break --dx 0.015   (others: pairsum list cases)"]


def _times_as_fast(e: Any) -> str:
    return f"{words.bounded(e['ratio'], e['low'], e['high'])} times as fast as {e['name']}"


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
    if rounds < FEWEST_FOR_MEDIAN:
        said = "1 round of {} gives" if rounds == 1 else f"{rounds} rounds of {{}} give"
        return f"{said.format(winner)} no interval ({FEWEST_FOR_MEDIAN} are needed)"
    rest = f"the {others} others" if others > 1 else "the other"
    return f"no difference was resolved between {winner} and {rest}" if ties == others else ""


def _read_from(results: Results, particles: str) -> dict[str, str]:
    """The options of `pairsum run` that read particles of files; none where a case makes them."""
    if particles not in results.particles.index or not results.particles["files"][particles]:
        return {}
    files, facts = results.particles.loc[particles]
    given = {what.removeprefix("--"): shlex.quote(value) for what, value, _, _ in facts if what.startswith("--")}
    return {"particles": shlex.quote(",".join(files)), **given}


def _command(p: Any, of_files: dict[str, str], **more: Any) -> str:
    """`pairsum run` of a point's problem and place; what is the program's default is left out."""
    given = {name: p[name] for name in ("case", "dx", "state", "grid", "threads", "M")}
    if of_files:
        given = of_files | {name: given[name] for name in ("grid", "threads", "M")}
    elif abs(p["H"] - 2 * p["dx"]) > 1e-9 * p["dx"]:
        given["H"] = p["H"]
    given |= {name: p[name] for name, usual in _USUAL.items() if p[name] not in (usual, "none")
              and not (of_files and name == "dim")}
    one = "," not in more["backend"] and more["backend"] != "all"
    if one and p["isa"] != "scalar":
        given["isa"] = p["isa"]
    if one and p["block"] not in ("none", "auto"):
        given["block"] = p["block"]
    if p["ranks"] > 1:
        given |= {"ranks": p["ranks"], "cut": p["cut"]}
    given = {name: value for name, value in given.items() if pd.notna(value)} | more
    return "pairsum run" + "".join(f" --{name} {value:.10g}" if isinstance(value, float) else f" --{name} {value}"
                                   for name, value in given.items())


#: What `pairsum run` takes where no option says otherwise.
_USUAL = {"dim": 3, "precision": "double", "interaction": "ferrari09", "smoothing": "wendland_c2",
          "integrator": "euler", "order": "lattice"}


def _choices(points: pd.DataFrame, best: int) -> pd.Series:
    """ "symmetric_omp (avx2, M = 7, 2 threads)": variants of a backend that has several, then grid, M and threads where
    they are not as of the best."""
    variants = words.variants(points)

    def place(p: Any) -> list[str]:
        return ([p["grid"]] if p["grid"] != "hashed_grid" or np.isnan(p["M"]) else []) + (
            [f"M = {p['M']:.0f}"] if pd.notna(p["M"]) else []) + [words.threads_words(p["threads"])]

    def said(p: Any) -> str:
        found = variants[p.name] + [word for word in place(p) if p.name == best or word not in own]
        return p["backend"] + (f" ({', '.join(found)})" if found else "")

    own = place(points.loc[best])
    return points.apply(said, axis=1)
