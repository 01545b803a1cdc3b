"""Sources together as one set of particles, and what is said of it."""
import dataclasses

import numpy as np

from ..rows import ResultsError
from .domain import Fact, box, dimension, time
from .kinds import BOUNDARY, FLUID, Kinds, kinds
from .quantities import quantities
from .source import Source

MOST = 2**32 - 1025


@dataclasses.dataclass
class Particles:
    """`quantities` by the names of GADGET, shapes (N,) and (N, 3); of lengths the unit is the files'."""
    quantities: dict[str, np.ndarray]
    smoothing_length_is: str
    dim: int
    box_low: np.ndarray | None
    box_size: np.ndarray | None
    periodic: tuple[bool, ...]
    time: float | None
    facts: list[Fact]


def joined(sources: list[tuple[Source, str]], named: dict[str, str], rule: str) -> Particles:
    """`sources` with "fluid", "boundary" or "" for kinds that the file says; `named`: see `quantities`; `rule`: see
    `kinds`. Raises ResultsError for what cannot be one set."""
    parts, facts = [], []
    check_count(sum(len(next(iter(source.columns.values()), ())) for source, _ in sources))
    for source, kind in sources:
        held, origin = quantities(source, named)
        rows = len(held["Coordinates"])
        if kind:
            known = Kinds(np.full(rows, BOUNDARY if kind == "boundary" else FLUID, np.uint8), "given", f"--{kind}")
        else:
            known = kinds(source, rows, rule)
        held["Kind"], origin["Kind"] = known.values, known.column
        parts.append((source, held, origin))
        words = ", ".join(filter(None, [source.format, source.frame]))
        facts.append(Fact(source.name, f"{counted(held['Kind'])} ({words})", known.how, known.by))
    named_files = ", ".join(source.name for source, _ in sources)
    if not any(len(held["Kind"]) for _, held, _ in parts):
        raise ResultsError(f"{named_files or 'the files'}: no particles")
    together, smoothing, more = _together(parts)
    if together["Kind"].all() and not all(kind for _, kind in sources):
        raise ResultsError(f"{named_files}: no particle is fluid; --boundary-kind none takes all for fluid, --fluid "
                           "FILE those of a file")
    files = [source for source, _ in sources]
    box_low, box_size, periodic, of_box = box(files)
    dim, of_dim = dimension(together, files)
    at, of_time = time(files)
    facts = [Fact("particles", counted(together["Kind"]), "", ""), *facts, of_dim, *more, *of_box, *of_time,
             *_extents(together, parts), *_unused(parts)]
    return Particles(together, smoothing, dim, box_low, box_size, periodic, at, facts)


def counted(kind: np.ndarray) -> str:
    boundary = int(np.count_nonzero(kind))
    return f"{len(kind) - boundary} fluid, {boundary} boundary"


def check_count(rows: int) -> None:
    """Raises ResultsError for more particles than pairsum numbers."""
    if rows > MOST:
        raise ResultsError(f"{rows} particles are more than pairsum takes, {MOST} (2^32 - 1025)")


def _together(parts) -> tuple[dict[str, np.ndarray], str, list[Fact]]:
    """The quantities that all sources have. Velocities that only fluid has are 0 elsewhere: walls at rest."""
    found, facts = {}, []
    names = {name: None for _, held, _ in parts for name in held}
    for name in (n for n in names if n != "Kind"):
        lacking = [source.name for source, held, _ in parts if name not in held]
        columns = ", ".join(dict.fromkeys(origin[name] for _, _, origin in parts if name in origin))
        if lacking and name == "Velocities" and all(held["Kind"].all() for _, held, _ in parts if name not in held):
            values = [held.get(name, np.zeros_like(held["Coordinates"])) for _, held, _ in parts]
            facts.append(Fact(name, f"{columns}; 0 in {', '.join(lacking)}", "assumed", "walls at rest"))
        elif lacking:
            there = np.concatenate([held[name] for _, held, _ in parts if name in held])
            always = f"; elsewhere it is {there[0]:g}" if there.ndim == 1 and len(np.unique(there)) == 1 else ""
            facts.append(Fact(name, columns, "left out", f"not in {', '.join(lacking)}{always}"))
            continue
        else:
            values = [held[name] for _, held, _ in parts]
            facts.append(Fact(name, columns, "read", ""))
        found[name] = np.concatenate(values)
    found["Kind"] = np.concatenate([held["Kind"] for _, held, _ in parts])
    if (ids := found.get("ParticleIDs")) is not None:
        twice = len(ids) - len(np.unique(ids))
        if twice or ids.min() < 0 or (ids != np.floor(ids)).any():
            why = f"{twice} occur more than once" if twice else "some are no whole numbers from 0"
            facts = [Fact(f.what, f.value, "left out", why) if f.what == "ParticleIDs" else f for f in facts]
            del found["ParticleIDs"]
    smoothing = "h"
    if "SmoothingLength" in found:
        found.pop("SupportRadius", None)
        facts = [f for f in facts if f.what != "SupportRadius"]
    elif "SupportRadius" in found:
        found["SmoothingLength"], smoothing = found.pop("SupportRadius"), "support"
    return found, smoothing, facts


def _extents(found, parts) -> list[Fact]:
    x = found["Coordinates"]
    units = ", ".join(dict.fromkeys(source.unit for source, _, _ in parts))
    spans = [Fact("xyz"[d], f"{x[:, d].min():g} to {x[:, d].max():g}", "read", "") for d in range(3)]
    return [*spans, Fact("unit", "as in the files", "read", units)]


def _unused(parts) -> list[Fact]:
    used = {part for _, _, origin in parts for text in origin.values() for part in text.split(", ")}
    rest = dict.fromkeys(name for source, _, _ in parts for name in source.columns if name not in used)
    return [Fact("not used", ", ".join(rest), "", "")] if rest else []
