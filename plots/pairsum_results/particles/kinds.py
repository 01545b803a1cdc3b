"""Which particles of a source are fluid and which are boundary."""
import typing

import numpy as np

from ..rows import ResultsError
from .quantities import column, plain
from .source import Source

FLUID, BOUNDARY = 0, 1
#: What names of groups, types and species hold, in small letters.
_BOUNDARY_WORDS = ("boundary", "wall", "solid", "obstacle", "tank", "container", "floor", "bed", "gate", "box")
_FLUID_WORDS = ("fluid", "water", "liquid")
_NAMED = ("kind", "type", "types", "species", "resname", "name")


def _has(word: str, some: tuple[str, ...]) -> bool:
    return any(one in plain(word) for one in some)


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
    if _has(source.group, _BOUNDARY_WORDS + _FLUID_WORDS):
        of_group = np.full(rows, _has(source.group, _BOUNDARY_WORDS), np.uint8)
        return Kinds(of_group, "read", f"the group's name {source.group}")
    for name, values in sorted(source.columns.items(), key=lambda item: plain(item[0]) != "kind"):
        if plain(name) not in _NAMED or values.shape not in ((rows,), (rows, 1)):
            continue
        there = np.unique(values)
        if values.dtype.kind in "OUS" and all(_has(str(word), _BOUNDARY_WORDS + _FLUID_WORDS) for word in there):
            walls = [word for word in there if _has(str(word), _BOUNDARY_WORDS)]
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
