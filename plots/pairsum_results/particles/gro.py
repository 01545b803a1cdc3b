"""GROMACS .gro by MDAnalysis (https://manual.gromacs.org/current/reference-manual/file-formats.html#gro)."""
import pathlib

import numpy as np

from ..rows import ResultsError
from .source import Source, library, reading


def read(path: pathlib.Path) -> list[Source]:
    """The first frame, in nm and nm/ps as in the file. MDAnalysis guesses masses, which are not taken."""
    mdanalysis = library("MDAnalysis", "python3-mdanalysis", path)
    with reading(path, "gro"):
        universe = mdanalysis.Universe(str(path), convert_units=False)
        step, atoms = universe.trajectory.ts, universe.atoms
        columns = {"position": step.positions, "name": atoms.names.astype(str), "resname": atoms.resnames.astype(str)}
        if step.has_velocities:
            columns["velocity"] = step.velocities
        source = Source(path, "gro", columns, unit="nm and nm/ps; MDAnalysis gives single precision")
        if step.dimensions is not None:
            if np.abs(step.dimensions[3:] - 90).max() > 1e-3:
                raise ResultsError(f"{path} has a triclinic box (angles {step.dimensions[3:].tolist()}); "
                                   "pairsum wants edges along x, y and z")
            source.box_low, source.box_size = np.zeros(3), step.dimensions[:3].astype(float)
            source.periodic, source.periodic_from = (True,) * 3, "GROMACS' default"
        return [source]
