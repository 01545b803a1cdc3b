"""H5MD (https://www.nongnu.org/h5md/h5md.html)."""
import pathlib

import numpy as np

from ..rows import ResultsError
from .source import Source, chosen, frame_words, library, reading, straight


def read(path: pathlib.Path, frame: int) -> list[Source]:
    """A frame of every group of particles. The box begins at 0."""
    h5py = library("h5py", "python3-h5py", path)
    with reading(path, "H5MD"), h5py.File(path, "r") as file:
        if "h5md" not in file:
            raise ResultsError(f"{path} is HDF5 but not H5MD; pairsum reads the other kinds of HDF5 itself: name the "
                               "file where the particles go")
        return [_group(path, name, group, frame) for name, group in file["particles"].items() if "position" in group]


def _group(path: pathlib.Path, name: str, group, frame: int) -> Source:
    frames = len(group["position/value"]) if "position/value" in group else 1
    number = chosen(path, frame, frames)

    def element(of, what: str):
        """Of a frame, or what holds for all; the number of frames need not be the same for all."""
        found = of[what]
        return found[()] if not hasattr(found, "keys") else found["value"][min(number, len(found["value"]) - 1)]

    columns = {what: np.asarray(element(group, what)) for what, values in group.items()
               if what != "box" and (not hasattr(values, "keys") or "value" in values)}
    values = group["position"]["value"] if "position/value" in group else group["position"]
    source = Source(path, "H5MD", columns, group=name, frame=frame_words(number, frames))
    if "unit" in values.attrs:
        source.unit = _text(values.attrs["unit"])
    if "position/time" in group:
        time = group["position/time"]
        source.time = float(time[number]) if time.shape else float(time[()]) * number
    source.dim = columns["position"].shape[1]
    if "box" in group and "edges" in group["box"]:
        edges = np.asarray(element(group["box"], "edges"), dtype=float)
        size = straight(path, edges if edges.ndim == 2 else np.diag(edges))
        source.box_size = np.concatenate([size, np.zeros(3 - len(size))])
        source.box_low = np.zeros(3)
        flags = [_text(flag) == "periodic" for flag in np.atleast_1d(group["box"].attrs.get("boundary", "none"))]
        source.periodic = tuple((flags * 3)[:3] if len(flags) == 1 else [*flags, False, False][:3])
    return source


def _text(value) -> str:
    return value.decode() if isinstance(value, bytes) else str(value)
