"""Files of other programs to one `.hdf`, with the table of what was read."""
import dataclasses
import os
import pathlib
from typing import Sequence

from ..rows import ResultsError
from ..words import text_table, unknown
from . import formats, hdf, kinds
from .joined import joined
from .quantities import WORDS, check_names


@dataclasses.dataclass
class Asked:
    """Files whose kinds are theirs to say (`inputs`), or given; the words of `pairsum convert --help`."""
    out: str
    inputs: Sequence[str] = ()
    fluid: Sequence[str] = ()
    boundary: Sequence[str] = ()
    boundary_kind: str = ""
    column: Sequence[str] = ()
    frame: int = -1
    trust_pickles: bool = False


def convert(asked: Asked) -> str:
    """Writes `asked.out`; returns the table of what was read, assumed and derived. Raises ResultsError with one line,
    and then leaves the file as it was; OSError for a file that is not there."""
    out = pathlib.Path(asked.out)
    files = [(pathlib.Path(name), kind) for names, kind in
             ((asked.fluid, "fluid"), (asked.boundary, "boundary"), (asked.inputs, "")) for name in names]
    if not files:
        raise ResultsError("convert wants the files to read and, last, the .hdf to write")
    if out.suffix != ".hdf":
        raise ResultsError(f"{out}, the file to write, should end in .hdf, by which ParaView knows it")
    if any(out.exists() and path.exists() and os.path.samefile(out, path) for path, _ in files):
        raise ResultsError(f"{out} is to be read and to be written; name another file to write")
    named = dict(_named(text) for text in asked.column)
    rule = kinds.boundary_rule(asked.boundary_kind) if asked.boundary_kind else None
    sources = [(source, kind) for path, kind in files
               for source in formats.read(path, asked.frame, asked.trust_pickles)]
    check_names([source for source, _ in sources], list(named.values()))
    if rule and not (rule[0] == "name" and any(source.group for source, _ in sources)):
        check_names([source for source, kind in sources if not kind], [rule[0]])
    particles = joined(sources, named, asked.boundary_kind)
    hdf.write(particles, out)
    return text_table(["what", "value", "how", "from"], map(list, particles.facts), left=4)


def _named(text: str) -> tuple[str, str]:
    word, _, name = text.partition("=")
    if word not in WORDS:
        raise ResultsError(f"--column: {unknown('quantity', word, WORDS)}")
    if not name:
        raise ResultsError(f'--column "{text}" should name a column, as rho=c_rho')
    return word, name
