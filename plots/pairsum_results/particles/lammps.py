"""LAMMPS dumps in text (https://docs.lammps.org/dump.html)."""
import pathlib

import numpy as np

from ..rows import ResultsError
from . import frames
from .source import Source, chosen, frame_words, straight


def read(path: pathlib.Path, frame: int) -> list[Source]:
    """A frame. Scaled positions (xs) are scaled back; of several kinds of positions x is taken, then xu, xs and xsu."""
    with path.open("rb") as stream:
        heads = list(_heads(path, stream))
    if not heads:
        raise ResultsError(f'{path} has no line "ITEM: ATOMS"')
    number = chosen(path, frame, len(heads))
    head = heads[number]
    low, size, periodic = _box(path, head)
    columns = frames.table(path, head["span"], head["columns"], head["rows"])
    if "x" not in columns:
        for names, scale, shift in ((("xu", "yu", "zu"), 1.0, 0.0), (("xs", "ys", "zs"), size, low),
                                    (("xsu", "ysu", "zsu"), size, low)):
            if set(names) <= set(columns):
                columns["position"] = np.column_stack([columns.pop(n) for n in names]).astype(float) * scale + shift
                break
    unit = f"LAMMPS' {head['UNITS']}" if "UNITS" in head else "LAMMPS', which the file does not name"
    time = float(head["TIME"]) if "TIME" in head else None
    return [Source(path, "LAMMPS dump", columns, box_low=low, box_size=size, periodic=periodic, time=time, unit=unit,
                   frame=frame_words(number, len(heads)))]


def _heads(path: pathlib.Path, stream):
    """What stands before each table, and where that lies."""
    head: dict = {}
    while line := stream.readline():
        item = line.decode("utf-8", "replace").removeprefix("ITEM:").strip()
        if not line.startswith(b"ITEM:"):
            raise ResultsError(f'{path}: "ITEM: ..." should stand where the file has "{item}"')
        if item.startswith("ATOMS"):
            try:
                rows = int(head["NUMBER OF ATOMS"])
            except (KeyError, ValueError):
                raise ResultsError(f'{path} does not say the "NUMBER OF ATOMS"') from None
            yield {**head, "columns": item.split()[1:], "rows": rows, "span": frames.skip(stream, rows)}
            head = {}
        elif item.startswith("BOX BOUNDS"):
            head["bounds"] = item.split()[2:], [stream.readline().split() for _ in range(3)]
        else:
            head[item] = stream.readline().decode("utf-8", "replace").strip()


def _box(path: pathlib.Path, head: dict) -> tuple[np.ndarray, np.ndarray, tuple[bool, ...]]:
    try:
        words, lines = head["bounds"]
        bounds = np.array(lines, dtype=float)
        edges = np.diag(bounds[:, 1] - bounds[:, 0])
        if "abc" in words:  # a general triclinic box: three vectors and its origin
            edges = bounds[:, :3]
        elif bounds.shape[1] > 2:
            edges[1, 0], edges[2, 0], edges[2, 1] = bounds[:, 2]
    except (KeyError, ValueError, IndexError):
        raise ResultsError(f'{path}: "BOX BOUNDS" should have three lines of numbers') from None
    size = straight(path, edges)
    flags = [word for word in words if len(word) == 2 and word not in ("xy", "xz", "yz")]
    return (bounds[:, 3] if "abc" in words else bounds[:, 0]), size, tuple(f == "pp" for f in flags) or (True,) * 3
