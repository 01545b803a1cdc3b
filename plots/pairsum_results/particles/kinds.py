"""Which particles of a source are fluid and which are boundary."""
import re
import typing

import numpy as np

from ..rows import ResultsError
from .quantities import column, plain
from .source import Source

FLUID, BOUNDARY = 0, 1
#: Words in names of groups, types and species, without the s of a plural: those that pairsum's own reader knows, too.
_BOUNDARY_WORDS = {"boundary", "boundarie", "wall", "solid", "obstacle", "tank", "container", "floor", "bed", "gate",
                   "box"}
_FLUID_WORDS = {"fluid", "water", "liquid", "gas", "oil", "air"}
_BODY_WORDS = {"body", "bodie", "rigid", "floating"}
_NAMED = ("kind", "type", "types", "species", "resname", "name")


def named_kind(name: str) -> int | str | None:
    """FLUID, BOUNDARY or "body" (which moves) by the words of a name, between digits, signs and capitals; those for
    fluid come first. None: none of them."""
    words = {word.lower() for word in re.findall("[A-Z]+(?![a-z])|[A-Z]?[a-z]+", name)}
    words = {word.removesuffix("s") if len(word) > 3 else word for word in words}
    kinds_of = ((_FLUID_WORDS, FLUID), (_BOUNDARY_WORDS, BOUNDARY), (_BODY_WORDS, "body"))
    return next((kind for some, kind in kinds_of if words & some), None)


class Kinds(typing.NamedTuple):
    """`values`, shape (N,): FLUID or BOUNDARY; `how` and `by` what they are known; the column that says it, or ""."""
    values: np.ndarray
    how: str
    by: str
    column: str = ""


def boundary_rule(text: str) -> tuple[str, set[str]] | None:
    """ "Type=0,1" as the column and its values; None for "none". Raises ResultsError for anything else."""
    name, _, values = text.rpartition("=")
    if text == "none":
        return None
    if not name or not values:
        raise ResultsError(f'--boundary-kind "{text}" should be none, or a column and the values of boundary '
                           "particles, as Type=0,1")
    return name, set(values.split(","))


def kinds(source: Source, rows: int, rule: str) -> Kinds:
    """`rule`: what `boundary_rule` takes, or "": then a group's name, a column of kinds, or all are fluid."""
    if rule:
        parsed = boundary_rule(rule)
        values = None
        if parsed:
            values = np.full(rows, source.group) if parsed[0] == "name" and source.group else column(source, parsed[0])
        is_boundary = np.zeros(rows, bool) if values is None else np.isin(_texts(values), list(parsed[1]))
        return Kinds(is_boundary.astype(np.uint8), "given", f"--boundary-kind {rule}", parsed[0] if parsed else "")
    if (kind := named_kind(source.group)) == "body":
        raise ResultsError(f"{source.path}: the group {source.group} is a body that moves, by its name, which pairsum "
                           f"does not sum; --boundary-kind name={source.group} takes it for boundary, none all "
                           "particles for fluid")
    if kind is not None:
        return Kinds(np.full(rows, kind, np.uint8), "read", f"the group's name {source.group}")
    for name, values in sorted(source.columns.items(), key=lambda item: plain(item[0]) != "kind"):
        if plain(name) not in _NAMED or values.shape not in ((rows,), (rows, 1)):
            continue
        there = np.unique(values)
        if values.dtype.kind in "OUS" and all(named_kind(str(word)) in (FLUID, BOUNDARY) for word in there):
            walls = [word for word in there if named_kind(str(word)) == BOUNDARY]
            return Kinds(np.isin(values.reshape(-1), walls).astype(np.uint8), "read", name, name)
        if plain(name) == "kind" and set(there) <= {FLUID, BOUNDARY}:
            return Kinds(values.reshape(-1).astype(np.uint8), "read", f"{name}: 0 fluid, 1 boundary", name)
        if plain(name) == "type" and source.format.startswith("VTK"):
            return _of_dualsphysics(source, name, values.reshape(-1))
    return Kinds(np.zeros(rows, np.uint8), "assumed", "nothing says otherwise" + _types(source, rows))


def _of_dualsphysics(source: Source, name: str, values: np.ndarray) -> Kinds:
    """0 fixed, 1 moving, 2 floating, 3 fluid."""
    if 2 in values:
        raise ResultsError(f"{source.path} has floating bodies ({name} = 2 of DualSPHysics), which pairsum does not "
                           "know; --boundary-kind none takes all particles for fluid")
    if not np.isin(values, (0, 1, 3)).all():
        there = ", ".join(_texts(np.unique(values))[:8])
        raise ResultsError(f"{source.path}: {name} has the values {there}, should have 0 or 1 (wall) and 3 (fluid); "
                           f'for others say --boundary-kind "{name}=0,1", --boundary-kind none, --fluid or --boundary')
    return Kinds((values != 3).astype(np.uint8), "read", f"{name} of DualSPHysics: 3 fluid, 0 and 1 boundary", name)


def _types(source: Source, rows: int) -> str:
    """The columns that might say kinds, with their values."""
    for name, values in source.columns.items():
        if plain(name) in _NAMED and values.shape == (rows,) and 1 < len(there := np.unique(values)) < 9:
            return f'; {name} has {", ".join(_texts(there))}: --boundary-kind "{name}=..."'
    return ""


def _texts(values: np.ndarray) -> np.ndarray:
    """As a user writes them: 1.0 as "1"."""
    values = np.asarray(values).reshape(-1)
    if values.dtype.kind == "f" and (values == np.round(values)).all():
        values = values.astype(int)
    return values.astype(str)
