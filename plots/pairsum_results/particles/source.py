"""What a particle file holds, as a reader gives it, and what readers share."""
import contextlib
import dataclasses
import importlib
import pathlib
import types

import numpy as np

from ..rows import ResultsError


@dataclasses.dataclass
class Source:
    """Particles of a file, or of a group in it.

    columns            by the file's own names: shape (N,) or (N, components), N alike
    box_low, box_size  per axis, shape (3,), in the file's unit; None: the file names no box
    periodic           per axis; None: the file does not say
    periodic_from      who says so, if it is assumed
    unit               of lengths and velocities, in words
    """
    path: pathlib.Path
    format: str
    columns: dict[str, np.ndarray]
    group: str = ""
    box_low: np.ndarray | None = None
    box_size: np.ndarray | None = None
    periodic: tuple[bool, ...] | None = None
    periodic_from: str = ""
    time: float | None = None
    dim: int | None = None
    unit: str = "the file names none"
    frame: str = ""

    @property
    def name(self) -> str:
        return self.path.name + (f":{self.group}" if self.group else "")


def library(module: str, package: str, path: pathlib.Path) -> types.ModuleType:
    """A module that only some files need. Raises ResultsError that names its Debian package if it is not there."""
    try:
        return importlib.import_module(module)
    except ImportError as problem:
        raise ResultsError(f"{path} needs Python's {module.partition('.')[0]} (Debian: {package}): {problem}") from None


@contextlib.contextmanager
def reading(path: pathlib.Path, what: str):
    """Turns whatever a library raises about a file into one line."""
    try:
        yield
    except (ResultsError, MemoryError):
        raise
    except Exception as problem:  # noqa: BLE001 libraries raise what they like
        text = " ".join(str(problem).split()) or type(problem).__name__
        raise ResultsError(f"{path} cannot be read as {what}: {text}") from None


def straight(path: pathlib.Path, edges: np.ndarray) -> np.ndarray:
    """The lengths of a box, from its edges as rows, shape (3, 3). Raises ResultsError for a triclinic one."""
    if (tilt := np.abs(edges - np.diag(np.diag(edges))).max()) > 1e-6 * np.abs(edges).max():
        raise ResultsError(f"{path} has a triclinic box (tilted by {tilt:g}); pairsum wants edges along x, y and z")
    return np.diag(edges).astype(float)


def chosen(path: pathlib.Path, frame: int, frames: int) -> int:
    """The number of a frame, counted from 0; a negative one counts from the end."""
    if not -frames <= frame < frames:
        raise ResultsError(f"{path} has {frames} frame{'' if frames == 1 else 's'}, so no frame {frame}")
    return frame % frames


def frame_words(number: int, frames: int) -> str:
    """ "frame 4 of 0 to 9"; nothing of a single one."""
    return f"frame {number} of 0 to {frames - 1}" if frames > 1 else ""
