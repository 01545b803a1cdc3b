"""PySPH's .npz (pysph/solver/output.py): a pickled dictionary of particle arrays."""
import pathlib

import numpy as np

from ..rows import ResultsError
from .source import Source, reading


def read(path: pathlib.Path, trust_pickles: bool) -> list[Source]:
    """One source per particle array. Raises ResultsError unless pickles are trusted."""
    if not trust_pickles:
        raise ResultsError(f"{path} holds pickles, which may run any program when they are read; add --trust-pickles "
                           "if you know who wrote it, or let PySPH write .hdf5")
    with reading(path, "PySPH's .npz"), np.load(path, allow_pickle=True, encoding="bytes") as file:
        if "version" not in file or int(file["version"]) not in (1, 2):
            raise ResultsError(f"{path} is no .npz of PySPH: it has no version 1 or 2")
        held = _named(file["particles" if int(file["version"]) == 2 else "arrays"].item())
        solver = _named(file["solver_data"].item()) if "solver_data" in file else {}
        return [Source(path, "PySPH .npz", {key: np.asarray(value) for key, value in
                                            _named(array.get("arrays", array)).items()},
                       group=name, time=float(solver["t"]) if "t" in solver else None, unit="SI by PySPH's habit")
                for name, array in ((name, _named(array)) for name, array in held.items())]


def _named(held: dict) -> dict:
    """With texts as keys, which are bytes if Python 2 wrote them."""
    return {key.decode() if isinstance(key, bytes) else key: value for key, value in held.items()}
