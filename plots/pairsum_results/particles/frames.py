"""Text files of several frames, each a head and a table with a row per particle (LAMMPS dump, extended XYZ)."""
import io
import pathlib
from typing import BinaryIO

import numpy as np
import pandas as pd

from ..rows import ResultsError


def skip(stream: BinaryIO, rows: int) -> tuple[int, int]:
    """Skips the rows of a table; returns the bytes at which it begins and ends."""
    begin = stream.tell()
    for _ in range(rows):
        if not stream.readline():
            break
    return begin, stream.tell()


def table(path: pathlib.Path, span: tuple[int, int], names: list[str], rows: int) -> dict[str, np.ndarray]:
    """The columns of a table between two bytes. Raises ResultsError unless it has so many rows and columns."""
    with path.open("rb") as stream:
        stream.seek(span[0])
        text = io.BytesIO(stream.read(span[1] - span[0]))
    try:
        found = pd.read_csv(text, sep=r"\s+", header=None, low_memory=False) if rows else pd.DataFrame(columns=names)
    except (pd.errors.ParserError, pd.errors.EmptyDataError, UnicodeDecodeError) as problem:
        raise ResultsError(f"{path}: the table of particles cannot be read: {problem}") from None
    if found.shape != (rows, len(names)):
        raise ResultsError(f"{path}: the table of particles has {found.shape[0]} rows of {found.shape[1]} columns; "
                           f"the file names {rows} and {len(names)}")
    return {name: found.iloc[:, k].to_numpy() for k, name in enumerate(names)}
