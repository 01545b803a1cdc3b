"""Text files of several frames, each a head and a table with a row per particle (LAMMPS dump, extended XYZ)."""
import io
import itertools
import pathlib
from typing import BinaryIO

import numpy as np
import pandas as pd

from ..rows import ResultsError


def skip(stream: BinaryIO, rows: int) -> None:
    """Skips the rows of a table."""
    next(itertools.islice(stream, rows, rows), None)


def table(path: pathlib.Path, offset: int, names: list[str], rows: int) -> dict[str, np.ndarray]:
    """The columns of a table that begins at a byte. Raises ResultsError unless it has so many rows and columns."""
    with path.open("rb") as stream:
        stream.seek(offset)
        text = io.BytesIO(b"".join(itertools.islice(stream, rows)))
    try:
        found = pd.read_csv(text, sep=r"\s+", header=None, low_memory=False) if rows else pd.DataFrame(columns=names)
    except (pd.errors.ParserError, pd.errors.EmptyDataError, UnicodeDecodeError) as problem:
        raise ResultsError(f"{path}: the table of particles cannot be read: {problem}") from None
    if found.shape != (rows, len(names)):
        raise ResultsError(f"{path}: the table of particles has {found.shape[0]} rows of {found.shape[1]} columns; "
                           f"the file names {rows} and {len(names)}")
    return {name: found.iloc[:, k].to_numpy() for k, name in enumerate(names)}
