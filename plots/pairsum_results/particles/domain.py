"""Dimension, box and time of a set of particles."""
import typing

import numpy as np

from ..rows import ResultsError
from .source import Source


class Fact(typing.NamedTuple):
    """A line of the table: `how` is read, given, derived, assumed or left out."""
    what: str
    value: str
    how: str
    source: str


def dimension(found: dict[str, np.ndarray], sources: list[Source]) -> tuple[int, Fact]:
    """As many as axes along which particles differ or move, and no fewer than a file declares."""
    x, v = found["Coordinates"], found.get("Velocities")
    moves = [len(x) == 1 or np.ptp(x[:, d]) > 0 or (v is not None and v[:, d].any()) for d in range(3)]
    flat = " and ".join("xyz"[d] for d in range(3) if not moves[d])
    dim = max(sum(moves), 1, *(source.dim or 0 for source in sources))
    return dim, Fact("dimension", str(dim), "derived" if dim == sum(moves) else "read",
                     f"{flat} {'are' if ' ' in flat else 'is'} the same everywhere" if flat else "")


def box(sources: list[Source]) -> tuple[np.ndarray | None, np.ndarray | None, tuple[bool, ...], list[Fact]]:
    """Low corner, edges and periodic axes that sources agree on; those that say nothing agree. Raises ResultsError
    where two differ."""
    boxed = [source for source in sources if source.box_size is not None and (source.box_size > 0).any()]
    if not boxed:
        return None, None, (False,) * 3, [Fact("box", "none", "assumed", "open: no file names one")]
    first = boxed[0]
    for other in boxed[1:]:
        if not (np.allclose(first.box_size, other.box_size) and np.allclose(first.box_low, other.box_low)
                and first.periodic == other.periodic):
            raise ResultsError(f"{first.name} and {other.name} have different boxes; convert them one by one")
    periodic = tuple(bool(p and s > 0) for p, s in zip(first.periodic or (False,) * 3, first.box_size))
    corners = ", ".join(f"{low:g} to {low + size:g}" for low, size in zip(first.box_low, first.box_size))
    along = ", ".join("xyz"[d] for d in range(3) if periodic[d]) or "none"
    return first.box_low, first.box_size, periodic, [
        Fact("box", corners, "read", ""),
        Fact("periodic", along, "assumed" if first.periodic_from else "read", first.periodic_from)]


def time(sources: list[Source]) -> tuple[float | None, list[Fact]]:
    """The latest time, with the source's name if others have another."""
    times = [(source.time, source.name) for source in sources if source.time is not None]
    if not times:
        return None, []
    latest, name = max(times)
    return latest, [Fact("time", f"{latest:g}", "read", name if len({t for t, _ in times}) > 1 else "")]
