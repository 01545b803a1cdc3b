"""Columns by their own names to quantities by the names of GADGET."""
import re

import numpy as np

from ..rows import ResultsError
from ..words import unknown
from .source import Source

#: Names in small letters, letters and digits alone, the likeliest first. A vector's components have a name each or one
#: name with "0" or "x" behind it.
_VECTORS = {"Coordinates": (["points", "position", "positions", "coordinates", "pos", ""], []),
            "Velocities": (["velocity", "velocities", "vel", "velo", "v"], [("u", "v", "w")])}
_SCALARS = {"Density": ["density", "densities", "rho", "rhop", "hydrodynamicdensity", "massdensity"],
            "Masses": ["mass", "masses", "m", "particlemass"],
            "SmoothingLength": ["smoothinglength", "smoothinglengths", "h", "hsml", "hvar"],
            "SupportRadius": ["supportradius"],
            "ParticleIDs": ["id", "ids", "idp", "particleid", "particleids", "originalid", "index", "gid"]}
#: What `--column` takes.
WORDS = {"x": ("Coordinates", 0), "y": ("Coordinates", 1), "z": ("Coordinates", 2), "vx": ("Velocities", 0),
         "vy": ("Velocities", 1), "vz": ("Velocities", 2), "rho": ("Density", None), "m": ("Masses", None),
         "h": ("SmoothingLength", None)}


def plain(name: str) -> str:
    """ "Vel.x [m/s]" as "velx"."""
    return re.sub(r"[^a-z0-9]", "", re.sub(r"\[.*?\]", "", name).lower())


def column(source: Source, name: str) -> np.ndarray | None:
    """A column by the name that a user gives it: as in the file, or with its component, as in "Points:0"."""
    if name in source.columns:
        return source.columns[name]
    base, _, component = name.rpartition(":")
    values = source.columns.get(base)
    if values is None or values.ndim != 2 or component not in map(str, range(values.shape[1])):
        return None
    return values[:, int(component)]


def quantities(source: Source, named: dict[str, str]) -> tuple[dict[str, np.ndarray], dict[str, str]]:
    """What a source has of the quantities, shapes (N,) and (N, 3), and the columns that these come from.

    `named`: words to columns (`--column`), which go before the table of names. Raises ResultsError without positions,
    and for values that are no finite numbers, with the number of the first such row, counted from 0.
    """
    found: dict[str, np.ndarray] = {}
    origin: dict[str, str] = {}
    for quantity, (names, triples) in _VECTORS.items():
        if (hit := _vector(source, names, triples)) is not None:
            found[quantity], origin[quantity] = hit
    rows = len(found["Coordinates"]) if "Coordinates" in found else None
    known = {plain(name): name for name in reversed(source.columns)}
    for quantity, names in _SCALARS.items():
        name = next((known[word] for word in names if word in known and source.columns[known[word]].size == rows), None)
        if name is not None:
            found[quantity], origin[quantity] = source.columns[name].reshape(-1), name
    for word, name in named.items():
        quantity, component = WORDS[word]
        if (values := column(source, name)) is None:
            continue
        values = _numbers(source, name, values)
        if component is None:
            found[quantity], origin[quantity] = values, name
            continue
        found[quantity] = found[quantity].copy() if quantity in found else np.zeros((len(values), 3))
        found[quantity][:, component] = values
        origin[quantity] = ", ".join(filter(None, [origin.get(quantity), f"{word}: {name}"]))
    if "Coordinates" not in found:
        raise ResultsError(f"{source.path} has no column of positions among {', '.join(source.columns) or 'none'}; say "
                           "--column x=NAME --column y=NAME")
    rows = len(found["Coordinates"])
    found = {quantity: _finite(source, origin[quantity], values) for quantity, values in found.items()
             if len(values) == rows}
    return found, {quantity: origin[quantity] for quantity in found}


def check_names(sources: list[Source], names: list[str]) -> None:
    """Raises ResultsError for a column that no source has."""
    for name in names:
        if all(column(source, name) is None for source in sources):
            have = [word for source in sources for word in source.columns]
            raise ResultsError(f"no file has it: {unknown('column', name, dict.fromkeys(have))}")


def _vector(source: Source, names: list[str], triples: list[tuple[str, ...]]) -> tuple[np.ndarray, str] | None:
    """A vector of two or three components as three, and where it is from."""
    known = {plain(name): name for name in reversed(source.columns)}
    for name in names:
        values = source.columns.get(known.get(name, ""))
        if values is not None and values.ndim == 2 and values.shape[1] in (1, 2, 3):
            return _three(source, known[name], values), known[name]
    for name in names:
        triples = [*triples, tuple(name + c for c in "xyz"), tuple(name + c for c in "012")]
    for triple in triples:
        parts = [known[word] for word in triple if word in known and source.columns[known[word]].ndim == 1]
        if parts and triple[0] in known and len(parts) == sum(word in known for word in triple):
            name = ", ".join(parts)
            return _three(source, name, np.column_stack([source.columns[part] for part in parts])), name
    return None


def _three(source: Source, name: str, values: np.ndarray) -> np.ndarray:
    values = _numbers(source, name, values)
    return np.pad(values, ((0, 0), (0, 3 - values.shape[1])))


def _numbers(source: Source, name: str, values: np.ndarray) -> np.ndarray:
    try:
        return values.astype(float)
    except (ValueError, TypeError):
        raise ResultsError(f"{source.path}: column {name} holds other things than numbers") from None


def _finite(source: Source, name: str, values: np.ndarray) -> np.ndarray:
    if not np.issubdtype(values.dtype, np.integer):
        values = _numbers(source, name, values)
    wrong = ~np.isfinite(values)
    if wrong.any():
        row = int(np.argmax(wrong.reshape(len(values), -1).any(axis=1)))
        raise ResultsError(f"{source.name}: row {row}, counted from 0, has {name} = {values[row]}, which is not finite")
    return values
