"""Is B faster than A, by how much, and how sure is that? Two backends, two rows files, or two git revisions."""
import dataclasses
import pathlib
from typing import Any

import numpy as np
import pandas as pd

from . import stats
from .builds import differences, names
from .compare import best
from .ladders import made_for
from .load import PLACE, POINT, Results, cells_words, collect, load, place_words
from .rows import IDENTITY, PHASES, ResultsError, read
from .summary import plain
from .words import bounded, hint, ms, one_line, text_table, unknown, wrapped

SCHEMA = "pairsum.compare/1"

_LEVELS = ["state", "order", "precision", "interaction", "smoothing", "grid", "M", "threads", "isa", "block"]


@dataclasses.dataclass
class Comparison:
    """Of two sides. `pairs` has a line per point that both have: `point_a`, `point_b` (rows of the sides' points),
    `ratio` (time of A over that of B), `low`, `high`, `rounds` that pair them (0: not paired) and `verdict` on B."""
    a: str
    b: str
    phase: str
    pairs: pd.DataFrame
    sides: list[Results]  #: the same twice, if both are of the same rows
    differ: str  #: what else differs between the two; empty if nothing
    failed: pd.DataFrame

    def text(self) -> str:
        """A table and a sentence."""
        text = f"A: {one_line(self.a)}\nB: {one_line(self.b)}\n"
        if (self.pairs["rounds"] == 0).any():
            text += wrapped("measured apart, so not paired: what disturbed one of them alone is in the ratio")
        text += wrapped(f"they differ in {self.differ}") if self.differ else ""
        text += "".join(f"left out, not verified: {place_words(f)}: {f.error}\n" for f in self.failed.itertuples())
        return text + _table(self.pairs, self.sides, f"{self.phase}_s")

    def document(self) -> dict[str, Any]:
        """The same as values (comparison.schema.json). Times in seconds; ratios and verdicts at 95 %."""
        columns, time = ["study", "build_name", "seed", *POINT, "rounds"], f"{self.phase}_s"
        points = [side.points.join(side.series["build_name"], on="series").rename(columns={time: "time_s"})
                  for side in self.sides]
        own, of_base = (some.loc[self.pairs[f"point_{name}"], [*columns, "time_s"]].to_dict(orient="records")
                        for some, name in zip(points, "ab"))
        ratios = self.pairs[["ratio", "low", "high", "rounds", "verdict"]].to_dict(orient="records")
        return plain({"schema": SCHEMA, "a": self.a, "b": self.b, "phase": self.phase, "differ": self.differ or None,
                      "pairs": [{"a": p, "b": q, **ratio} for p, q, ratio in zip(own, of_base, ratios)],
                      "left_out": self.failed[["study", "case", "state", "dx", *PLACE, "error"]]
                      .to_dict(orient="records")})


def compare_sides(a: str, b: str, inputs: list[str], phase: str = "sum", allow_mixed: bool = False) -> Comparison:
    """Every point that both sides have, compared. Backends, with words like precision=mixed for what else may differ,
    are compared within each study and build. They, and revisions measured in the same rounds, are paired by round;
    what was measured apart is not (Welch). Raises ResultsError with one line for sides that are neither, or that must
    not be compared."""
    phases = [name.removesuffix("_s") for name in PHASES]
    if phase not in phases:
        raise ResultsError(unknown("phase", phase, phases))
    if a == b:
        raise ResultsError(f'a comparison needs two different things, not "{a}" twice')
    are_files = [pathlib.Path(side).exists() for side in (a, b)]
    if any(are_files) and not all(are_files):
        raise ResultsError(f'"{a if are_files[0] else b}" is a file, "{b if are_files[0] else a}" is none; a '
                           "comparison takes two backends, two rows files or two revisions")
    differ = ""
    if all(are_files):
        sides = [load(side, allow_mixed) for side in (a, b)]
        logs = pd.concat([side.logs(f"{phase}_s").add_prefix(name) for side, name in zip(sides, "ab")], keys="ab")
    elif (rows := read(inputs)) and _are_backends(a, b, rows):
        sides = [collect(rows, allow_mixed=True)] * 2  # a pair is of one build
    else:
        sides = [collect(_of_revision(rows, side), allow_mixed) for side in (a, b)]
    if sides[0] is not sides[1]:
        for side, name in zip(sides, (a, b)):
            if side.compares_builds:
                raise ResultsError(f'"{name}" holds rows of several builds, and a comparison takes one a side; pairsum '
                                   "report compares them")
        differ = _differences(sides, allow_mixed)
    if not all(are_files):
        logs = pd.concat([side.logs(f"{phase}_s").add_prefix(name) for side, name in zip(sides, "ab")], axis=1)
    pairs = (_backend_pairs(sides[0], _side(a), _side(b), f"{phase}_s") if sides[0] is sides[1] else _timed(
        sides[0], phase).merge(_timed(sides[1], phase), on=["study", "seed", "lost", *POINT], suffixes=("_a", "_b")))
    if pairs.empty:
        raise ResultsError(f'"{a}" and "{b}" have no point in common (same study, seed, case, dx, grid, M, threads, '
                           f'particles lost{"" if sides[0] is sides[1] else ", backend"})')
    if all(are_files) and len(sides[0].closed.merge(sides[1].closed, on=IDENTITY)):
        raise ResultsError(f'"{a}" and "{b}" hold the same rounds: nothing can be compared')
    pairs = pairs.sort_values(["point_a", "point_b"], ignore_index=True)
    pairs = pairs.join(stats.ratios(logs, "a" + pairs["point_a"].astype(str), "b" + pairs["point_b"].astype(str)))
    failed = pd.concat([side.failed for side in (sides[:1] if sides[0] is sides[1] else sides)])
    return Comparison(a, b, phase, pairs.assign(verdict=stats.verdicts(pairs)), sides, differ, failed)


def _is_revision(word: str, git: str) -> bool:
    return len(word) >= 4 and (git.startswith(word) or git != "" and word.startswith(git))


def _are_backends(a: str, b: str, rows: dict[str, pd.DataFrame]) -> bool:
    """Are the sides two backends of these rows? Else they are two revisions, or it is an error."""
    backends, gits = set(rows["sample"]["backend"]), set(rows["environment"]["git"])
    if {a.split(" ")[0], b.split(" ")[0]} <= backends:
        return True
    of_a, of_b = ({git for git in gits if _is_revision(side, git)} for side in (a, b))
    if of_a and of_a == of_b:
        raise ResultsError(f'"{a}" and "{b}" both name the revision {", ".join(sorted(of_a))}')
    if of_a and of_b:
        return False
    for backend, other, revisions in ((a, b, of_b), (b, a, of_a)):
        if backend in backends and revisions:
            raise ResultsError(f'"{backend}" is a backend, "{other}" a revision; a comparison takes two of the same '
                               "kind")
    word = b if a.split(" ")[0] in backends or of_a else a
    raise ResultsError(f'"{word}" is neither a backend nor a revision of these rows;'
                       f'{hint(word.split(" ")[0], backends | gits)} there are the backends '
                       f'{", ".join(sorted(backends))} and the revisions {", ".join(sorted(gits))}')


def _of_revision(rows: dict[str, pd.DataFrame], word: str) -> dict[str, pd.DataFrame]:
    """The rows that one revision wrote."""
    own = rows["environment"][[_is_revision(word, git) for git in rows["environment"]["git"]]]
    own = pd.MultiIndex.from_frame(own[["file", "environment"]])
    return {kind: frame[frame.set_index(["file", "environment"]).index.isin(own)]
            if kind in ("sample", "environment", "backend", "pace", "peak") else frame for kind, frame in rows.items()}


def _differences(sides: list[Results], allow_mixed: bool) -> str:
    """What else differs between the two; what must not be mixed is refused."""
    both = pd.concat([side.environments for side in sides])
    text = differences(both)
    if not allow_mixed and both.groupby(["host", "cpu"]).ngroups > 1:
        raise ResultsError(f"the two were measured on different machines ({text}), which says nothing of the programs; "
                           "--allow-mixed compares them nevertheless")
    if not allow_mixed and both["dirty"].any():
        raise ResultsError(f"rows were built from a tree with uncommitted changes ({text}), which no revision names; "
                           "--allow-mixed compares them nevertheless")
    return text


def _side(text: str) -> tuple[str, dict[str, str]]:
    """ "tiles_omp precision=mixed grid=compact_grid" as the backend and its levels."""
    backend, *rest = text.split()
    levels = {}
    for word in rest:
        level, _, value = word.partition("=")
        if not value:
            raise ResultsError(f'"{word}" behind {backend} is no level with its word, like precision=mixed')
        if level not in _LEVELS:
            raise ResultsError(unknown("level", level, _LEVELS))
        levels[level] = value
    return backend, levels


def _timed(side: Results, phase: str) -> pd.DataFrame:
    timed = side.points[side.times(f"{phase}_s").notna()].reset_index().astype({"seed": str}).fillna({"lost": 0})
    return timed[["point", "study", "seed", "lost", *POINT]]


def _backend_pairs(results: Results, a: tuple[str, dict[str, str]], b: tuple[str, dict[str, str]],
                   phase: str) -> pd.DataFrame:
    """Points of two backends, each with its fastest granularity, that do the same but for the levels that are named."""
    fastest = best(results, "granularity", phase=phase) == results.points.index
    points = results.points.assign(seed=results.points["seed"].astype(str), usual=made_for(results))
    points = points.fillna({"lost": 0})
    points = points[fastest].reset_index()
    words = points[_LEVELS].assign(M=points["M"].map(lambda m: "none" if np.isnan(m) else f"{m:.0f}")).astype(str)
    free = {"backend", "granularity", "isa", "block", *a[1], *b[1]}
    free |= {"M"} if "grid" in free else set()
    own = [points[(points["backend"] == backend) & (words[list(levels)] == pd.Series(levels, dtype=object)).all(axis=1)]
           for backend, levels in (a, b)]
    keys = ["study", "build", "seed", "lost", *(name for name in POINT if name not in free)]
    kept = ["point", *(name for name in POINT if name in free), "usual"]
    pairs = own[0][[*keys, *kept]].merge(own[1][[*keys, *kept]], on=keys, suffixes=("_a", "_b"))
    blocks = (pairs["block_a"] == pairs["block_b"]) | (pairs[["block_a", "block_b"]] == "none").any(axis=1)
    isas = (pairs["isa_a"] == pairs["isa_b"]) | (pairs["usual_a"] & pairs["usual_b"])
    named = {*a[1], *b[1]}
    return pairs[(pairs["point_a"] != pairs["point_b"]) & (blocks | ("block" in named)) & (isas | ("isa" in named))]


def _variant(p: Any) -> str:
    """Which vector units and blocks, if any."""
    return ("" if p.isa == "scalar" else f" {p.isa}") + ("" if p.block in ("none", "auto") else f" {p.block}")


def _rare(points: pd.DataFrame) -> list[str]:
    """The words of points that are the same in most studies, as far as dx does not decide them."""
    names = ["precision", "interaction", "smoothing", "integrator", "order", "H", "dim"]
    words = points[names].assign(H=points["H"].map("H={:.10g}".format), dim=points["dim"].map("{}D".format))
    several = [name for name in names if len(points[["dx", name]].drop_duplicates()) > points["dx"].nunique()]
    return ["".join(f" {word}" for word in line) for line in words[several].to_numpy()]


def _origins(pairs: pd.DataFrame, sides: list[Results]) -> list[str]:
    """Study, build and seed of the points of each pair, as far as there are several, like "talk, 8a2a02cd207b: "."""
    found = []
    for side, name in zip(sides, "ab"):
        builds = side.environments.drop_duplicates("build").set_index("build")
        builds = names(builds.assign(git=builds["revision"].str[:12]), [
            "git", "host", "cpu", "compiler", "revision", "flags", "binding"])
        own = side.points.loc[pairs[f"point_{name}"], ["study", "build", "seed"]]
        found.append(own.assign(build=own["build"].map(builds)))
    several = [name for name in found[0] if any(own[name].nunique() > 1 for own in found)]
    lines = zip(*(own[several].fillna({"seed": 0}).to_numpy() for own in found))
    return ["".join([", ".join(map(_both, a, b)), ": "] if several else []) for a, b in lines]


def _both(a: Any, b: Any) -> str:
    return str(a) if a == b else f"{a}/{b}"


def _place(p: Any, q: Any, before: str, rare: str) -> str:
    """What a point and its counterpart are, in the words that tell the pairs apart."""
    a, b = _variant(p), _variant(q)
    variants = a if a == b else f"{a or ' scalar'} /{b or ' scalar'}"
    return (f"{before}{p.case} {_both(p.state, q.state)} dx={p.dx:.10g} {_both(cells_words(p), cells_words(q))} "
            f"threads={_both(p.threads, q.threads)}{variants}{rare}")


def _table(pairs: pd.DataFrame, sides: list[Results], phase: str) -> str:
    first, second = (list(side.points.loc[pairs[f"point_{name}"]].itertuples()) for side, name in zip(sides, "ab"))
    words = zip(_origins(pairs, sides), _rare(sides[0].points.loc[pairs["point_a"]]))
    lines = [[_place(p, q, origin + ("" if sides[0] is sides[1] else f"{p.backend} "), rare), f"{p.rounds}/{q.rounds}",
              ms(getattr(p, phase)), ms(getattr(q, phase)),
              bounded(e.ratio, e.low, e.high, 3, "  too few rounds"), e.verdict]
             for p, q, e, (origin, rare) in zip(first, second, pairs.itertuples(), words)]
    count = pairs["verdict"].value_counts()
    return text_table(["point", "rounds", *(f"{side} {phase.removesuffix('_s')} ms" for side in "AB"), "A/B [low, high]", "B is"],
                      lines, 1) + (
        f"Of {len(pairs)} comparison{'' if len(pairs) == 1 else 's'} B is faster in {count.get('faster', 0)}, slower "
        f"in {count.get('slower', 0)}, no difference is resolved in {count.get('not resolved', 0)} (95 % confidence "
        "over all of them).\n") + ("Times are those of the sum alone; --phase total compares whole steps.\n" * (phase == "sum_s"))
