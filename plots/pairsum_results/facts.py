"""What stands behind the numbers, as tables for people: machines and builds, problems, peaks, failed points."""
from typing import Any, Iterator

import pandas as pd

from . import words
from .ladders import worlds
from .load import cells_words
from .reports import Report
from .tables import Table

_MACHINE = {"host": "host", "cpu": "processor", "cores": "cores", "limits": "limits of control groups", "caches": "caches",
            "os_kernel": "operating system", "governor": "frequency governor", "binding": "binding of threads",
            "counters": "hardware counters", "compiler": "compiler", "flags": "compiler flags", "git": "revision",
            "dirty": "uncommitted changes", "libraries": "libraries"}
_PROBLEM = {"study": "study", "case": "case", "dim": "dimensions", "state": "state", "order": "order in memory",
            "dx": "spacing", "H": "support radius", "n_fluid": "fluid particles", "n_boundary": "boundary particles",
            "precision": "precision", "interaction": "interaction", "smoothing": "smoothing kernel",
            "integrator": "integrator", "dt": "time step", "seed": "seed", "particles": "particles (hash)"}


def facts(report: Report) -> Iterator[Table]:
    """The tables of a report, those that are empty too."""
    r = report.results
    environments = r.environments.reindex(columns=[*_MACHINE])
    yield _turned("Machines and builds", environments, _MACHINE, list(r.environments["host"]))
    yield _turned("Problems that were measured", r.series, _PROBLEM, list(worlds(r)))
    for hash_of, said in r.particles[r.particles.index.isin(r.series["particles"])].iterrows():
        yield Table(f"Where the particles {hash_of} come from", ["what", "value", "how", "from"], said["facts"], 4)
    yield Table(*words.hoisted(
        "Peaks of the machine", ["threads", "precision", "Gflop/s", "GB/s"],
        [[str(e.threads), e.precision, words.short(1e-9 * e.flops_per_s), words.short(1e-9 * e.bandwidth_bytes_per_s)]
         for e in r.peaks.itertuples()], 0))
    yield Table("Points that failed the verification: their times do not count",
                ["backend", "cells", "threads", "case", "rows", "reason"],
                [[e.backend, cells_words(e), str(e.threads), f"{e.case}, {e.state}, spacing {e.dx:g}", str(e.rows),
                  e.error] for e in r.failed.itertuples()], 6)


def _turned(caption: str, frame: pd.DataFrame, names: dict[str, str], columns: list[str]) -> Table:
    """A line per fact, a column per machine or problem; facts that nobody states are left out."""
    rows = [[text, *(_fact(name, value) for value in frame[name])] for name, text in names.items()]
    return Table(caption, ["", *columns], [row for row in rows if any(row[1:])], 99)


def _fact(name: str, value: Any) -> str:
    if isinstance(value, dict):
        return ", ".join(f"{key} {f'{some / 1024:.0f} KiB' if name == 'caches' else some}"
                         for key, some in value.items())
    if pd.isna(value):
        return ""
    if isinstance(value, bool):
        return "yes" if value else "no"
    return words.count(value) if name.startswith("n_") else f"{value:.6g}" if isinstance(value, float) else str(value)
