"""GSD of HOOMD-blue (https://gsd.readthedocs.io/en/stable/schema-hoomd.html)."""
import pathlib

import numpy as np

from .source import Source, chosen, frame_words, library, reading, straight


def read(path: pathlib.Path, frame: int) -> list[Source]:
    """A frame: what was written for it, or for the first one. The schema's defaults, as mass 1, are not taken."""
    hoomd = library("gsd.hoomd", "python3-gsd", path)
    with reading(path, "GSD"), hoomd.open(str(path), "rb") as file:
        number = chosen(path, frame, len(file))
        shot = file[number]
        columns = {"position": shot.particles.position}
        for name in ("velocity", "mass"):
            if any(file.file.chunk_exists(frame=k, name=f"particles/{name}") for k in (number, 0)):
                columns[name] = getattr(shot.particles, name)
        columns["type"] = np.array(shot.particles.types, dtype=str)[shot.particles.typeid]
        lx, ly, lz, xy, xz, yz = map(float, shot.configuration.box)
        flat = shot.configuration.dimensions == 2
        depth = lz or 1.0
        size = straight(path, np.array([[lx, 0, 0], [xy * ly, ly, 0], [xz * depth, yz * depth, lz]]))
        return [Source(path, "GSD", columns, box_low=-size / 2, box_size=size, periodic=(True, True, not flat),
                       dim=2 if flat else 3, unit="GSD names none; single precision",
                       frame=frame_words(number, len(file)))]
