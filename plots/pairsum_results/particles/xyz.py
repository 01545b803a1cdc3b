"""Extended XYZ (https://github.com/libAtoms/extxyz), and XYZ without a word about columns."""
import pathlib
import shlex

import numpy as np

from ..rows import ResultsError
from . import frames
from .source import Source, chosen, frame_words, reading, straight


def read(path: pathlib.Path, frame: int) -> list[Source]:
    """A frame. Columns are those of `Properties`, else species and positions; the box is that of `Lattice`."""
    with path.open("rb") as stream:
        heads = list(_heads(path, stream))
    if not heads:
        raise ResultsError(f"{path} is empty")
    number = chosen(path, frame, len(heads))
    rows, comment, span = heads[number]
    with reading(path, "extended XYZ"):
        said = {key.lower(): value for key, _, value in (word.partition("=") for word in shlex.split(comment))}
        widths = _widths(said.get("properties", "species:S:1:pos:R:3"))
        names = [f"{name}:{k}" for name, width in widths.items() for k in range(width)]
        flat = frames.table(path, span, names, rows)
        columns = {name: flat[f"{name}:0"] if width == 1 else
                   np.column_stack([flat[f"{name}:{k}"] for k in range(width)]) for name, width in widths.items()}
        source = Source(path, "extended XYZ", columns, unit="extended XYZ names none, \u00c5 is usual",
                        frame=frame_words(number, len(heads)))
        if "lattice" in said:
            source.box_size = straight(path, np.array(said["lattice"].split(), dtype=float).reshape(3, 3))
            source.box_low = np.array(said.get("origin", "0 0 0").split(), dtype=float).reshape(3)
            source.periodic, source.periodic_from = (True,) * 3, "usual where a file has a Lattice and no pbc"
            if "pbc" in said:
                source.periodic, source.periodic_from = _flags(path, said["pbc"]), ""
        if "time" in said:
            source.time = float(said["time"])
        return [source]


def _heads(path: pathlib.Path, stream):
    """Rows, comment and where the table lies, of each frame."""
    while line := stream.readline().strip():
        try:
            rows = int(line)
        except ValueError:
            raise ResultsError(f"{path}: the number of particles should stand where the file has "
                               f'"{line.decode("utf-8", "replace")}"') from None
        comment = stream.readline().decode("utf-8", "replace")
        yield rows, comment, frames.skip(stream, rows)


def _flags(path: pathlib.Path, text: str) -> tuple[bool, ...]:
    """Three flags, as programs write them: "T F T", "True False True", "1 0 1"."""
    flags = text.lower().split()
    if len(flags) != 3 or not set(flags) <= {"t", "true", "1", "f", "false", "0"}:
        raise ResultsError(f'{path}: pbc is "{text}", should be three of T and F')
    return tuple(flag in ("t", "true", "1") for flag in flags)


def _widths(properties: str) -> dict[str, int]:
    """Columns of each property of "species:S:1:pos:R:3"."""
    words = properties.split(":")
    return dict(zip(words[::3], map(int, words[2::3]), strict=True))
