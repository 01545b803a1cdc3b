"""GROMACS .gro by MDAnalysis (https://manual.gromacs.org/current/reference-manual/file-formats.html#gro)."""
import io
import pathlib

import numpy as np

from ..rows import ResultsError
from . import frames
from .source import Source, chosen, frame_words, library, reading


def read(path: pathlib.Path, frame: int) -> list[Source]:
    """A frame, in nm and nm/ps as in the file. MDAnalysis knows the first one alone, so it is given the text of that
    which is wanted. It guesses masses, which are not taken."""
    mdanalysis = library("MDAnalysis", "python3-mdanalysis", path)
    with path.open("rb") as stream:
        spans = list(_spans(path, stream))
        if not spans:
            raise ResultsError(f"{path} is empty")
        number = chosen(path, frame, len(spans))
        stream.seek(spans[number][0])
        text = stream.read(spans[number][1] - spans[number][0]).decode("utf-8", "replace")
    with reading(path, "gro"):
        one = mdanalysis.lib.util.NamedStream(io.StringIO(text), str(path))
        universe = mdanalysis.Universe(one, convert_units=False)
        step, atoms = universe.trajectory.ts, universe.atoms
        columns = {"position": step.positions, "name": atoms.names.astype(str), "resname": atoms.resnames.astype(str)}
        if step.has_velocities:
            columns["velocity"] = step.velocities
        source = Source(path, "gro", columns, unit="nm and nm/ps; MDAnalysis gives single precision",
                        frame=frame_words(number, len(spans)))
        if step.dimensions is not None:
            if np.abs(step.dimensions[3:] - 90).max() > 1e-3:
                raise ResultsError(f"{path} has a triclinic box (angles {step.dimensions[3:].tolist()}); "
                                   "pairsum wants edges along x, y and z")
            source.box_low, source.box_size = np.zeros(3), step.dimensions[:3].astype(float)
            source.periodic, source.periodic_from = (True,) * 3, "GROMACS' default"
        return [source]


def _spans(path: pathlib.Path, stream):
    """The bytes at which each frame begins and ends: a title, the number of particles, these, and the box."""
    begin, number = 0, 0
    while title := stream.readline():
        count = stream.readline().strip()
        if title.strip() or count:
            try:
                rows = int(count)
            except ValueError:
                raise ResultsError(f'{path}: the number of particles should stand where the file has '
                                   f'"{count.decode("utf-8", "replace")}"') from None
            frames.skip(stream, rows)
            if not stream.readline().strip():
                raise ResultsError(f"{path} cannot be read as gro: frame {number} ends before its {rows} particles "
                                   "and its box")
            yield begin, stream.tell()
            number += 1
        begin = stream.tell()
