"""Which reader takes a file: by what is in it, as names of particle files say little."""
import pathlib

from ..rows import ResultsError
from . import gro, gsd, h5md, lammps, pysph, vtk, xyz
from .source import Source

_OWN = {".csv": "CSV", ".bi4": "bi4"}  # what the program itself reads
_KNOWN = ("VTK (.vtp, .vtu, .pvtp, .pvtu, .vtk), GROMACS .gro, LAMMPS dump, GSD, H5MD, extended XYZ and PySPH's .npz")


def read(path: pathlib.Path, frame: int = -1, trust_pickles: bool = False) -> list[Source]:
    """What a file holds, one group of particles each. `frame`: of those with several, counted from 0, or from the end.
    Raises ResultsError with one line; OSError if there is no such file."""
    with path.open("rb") as stream:
        head = stream.read(1024)
    suffix = path.suffix.lower()
    if suffix in _OWN:
        raise ResultsError(f"{path}: pairsum reads {_OWN[suffix]} itself; name the file where the particles go")
    if head.startswith(b"\x89HDF"):
        return h5md.read(path, frame)
    if head.startswith(b"# vtk DataFile") or b"<VTKFile" in head:
        return vtk.read(path, legacy=head.startswith(b"#"))
    if head.startswith(b"ITEM:"):
        return lammps.read(path, frame)
    if head[:8] == bytes.fromhex("df65df65df65df65"):
        return gsd.read(path, frame)
    if head.startswith(b"PK") and suffix == ".npz":
        return pysph.read(path, trust_pickles)
    if suffix == ".gro":
        return gro.read(path, frame)
    if suffix in (".xyz", ".extxyz"):
        return xyz.read(path, frame)
    raise ResultsError(f"{path} is no particle file that is known here: {_KNOWN}")
