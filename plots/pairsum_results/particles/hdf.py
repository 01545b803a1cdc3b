"""Writes particles as HDF5 with the names of GADGET, and as VTKHDF with links to the same data for ParaView."""
import os
import pathlib

import numpy as np

from ..rows import ResultsError
from .joined import Particles
from .source import library

_TYPES = {"ParticleIDs": np.uint64, "Kind": np.uint8}


def write(particles: Particles, path: pathlib.Path) -> None:
    """Writes a file that appears whole or not at all. Raises ResultsError with one line."""
    h5py = library("h5py", "python3-h5py", path)
    unfinished = unfinished_name(path, os.getpid())
    try:
        with h5py.File(unfinished, "w") as file:
            _fill(file, particles)
        os.replace(unfinished, path)
    except OSError as problem:
        raise ResultsError(f"cannot write {path}: {problem.strerror or ' '.join(str(problem).split())}") from None
    finally:
        if unfinished.parent.is_dir():
            unfinished.unlink(missing_ok=True)


def unfinished_name(path: pathlib.Path, process: int) -> pathlib.Path:
    """What a file is called while a process writes it."""
    return path.with_name(f"{path.name}.{process}.tmp")


def _fill(file, particles: Particles) -> None:
    rows = len(particles.quantities["Coordinates"])
    header = file.create_group("Header").attrs
    for name in ("NumPart_ThisFile", "NumPart_Total"):
        header[name] = np.array([rows, 0, 0, 0, 0, 0], np.uint32)
    header["MassTable"] = np.zeros(6)
    header["NumFilesPerSnapshot"] = np.int32(1)
    header["Dimension"] = np.int32(particles.dim)
    header["Periodic"] = np.array(particles.periodic, np.int32)
    header["KindNames"] = np.bytes_("fluid,boundary")
    if particles.box_size is not None:
        header["BoxSize"], header["BoxLow"] = particles.box_size, particles.box_low
        header["BoxHigh"] = particles.box_low + particles.box_size
    if particles.time is not None:
        header["Time"] = particles.time
    data = file.create_group("PartType0")
    for name, values in particles.quantities.items():
        data.create_dataset(name, data=np.ascontiguousarray(values, _TYPES.get(name, np.float64)))
    if "SmoothingLength" in data:
        header["SmoothingLengthIs"] = np.bytes_(particles.smoothing_length_is)
    _link(file.create_group("VTKHDF"), data, rows)


def _link(group, data, rows: int) -> None:
    """UnstructuredGrid 1.0 (https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html#vtkhdf-file-format): a
    vertex cell per particle, which packs to nearly nothing."""
    group.attrs["Version"] = np.array([1, 0], np.int64)
    group.attrs["Type"] = np.bytes_("UnstructuredGrid")
    for name in ("NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"):
        group[name] = np.array([rows], np.int64)
    packed = {"chunks": True, "compression": "gzip", "compression_opts": 1, "shuffle": True}
    group.create_dataset("Connectivity", data=np.arange(rows, dtype=np.int64), **packed)
    group.create_dataset("Offsets", data=np.arange(rows + 1, dtype=np.int64), **packed)
    group.create_dataset("Types", data=np.ones(rows, np.uint8), **packed)  # 1: VTK_VERTEX
    group["Points"] = data["Coordinates"]
    values = group.create_group("PointData")
    for name in data:
        if name != "Coordinates":
            values[name] = data[name]
