"""summary.json: the report as values for other programs, and the files of a report."""
import dataclasses
import json
import os
import pathlib
from typing import Any, BinaryIO

import numpy as np
import pandas as pd

from . import tables
from .load import PLACE
from .reports import Report
from .rows import ResultsError

SCHEMA = "pairsum.summary/3"
_POINT = ["series", *PLACE, "rounds", "repetitions", "steps", "confidence",
          *(f"{phase}{end}" for phase in ("sum_s", "evaluation_s", "total_s") for end in ("", "_low", "_high")),
          "ns_per_pair", "share_of_bound", "limited_by", "wait_share", "between", "within", "workspace_bytes",
          "useful_pair_ratio", "collision_share", "fingerprint"]
_SERIES = ["study", "case", "state", "dx", "H", "n_fluid", "n_boundary", "order", "dim", "precision", "interaction",
           "smoothing", "integrator", "dt", "seed", "environment", "build_name"]
_RATIO = ["point", "base", "ratio", "low", "high", "rounds", "verdict"]
_TABLES = {"speedup": [*_RATIO, "efficiency", "machine_speedup", "of_machine"],
           "algorithm_speedup": [*_RATIO, "runtime"], "runtime_comparison": [*_RATIO, "algorithm"],
           "compiler_comparison": [*_RATIO, "build", "base_build"],
           "m_comparison": [*_RATIO, "best_M", "over_best"],
           "density": [*_RATIO, "series", "units", "family", "pairs_per_particle", "ns_per_pair", "fastest_symmetric"],
           "ladder": [*_RATIO, "series", "at", "rank", "of", "over_serial", "efficiency", "extra_bytes_per_particle"],
           "shifts": ["series", "base_series", "what", "backend", *_RATIO[2:], "rank", "base_rank"],
           "strategies": ["backend", "breaks_down"],
           "scaling": ["scaling", "world", "point", "base", "threads_base", "backend", "M", "ranks", "cut", "threads",
                       "cores", "timed", "why_untimed", "step_s", "sum_s", "verdict",
                       *(f"{name}{end}" for name in ("speedup", "efficiency", "over_threads", "computation_scaling")
                         for end in ("", "_low", "_high")),
                       "load_balance", "communication_efficiency", "parallel_efficiency", "cut_pairs",
                       "ghosts_per_particle", "imbalance"],
           "self_test": ["what", "backend", "threads", "expected", *_RATIO[2:5], "confidence", "holds", "text"]}
_WHOLE = {"M", "best_M", "point", "base", "threads_base", "seed", "workspace_bytes", "rounds"}


def summary(report: Report) -> dict[str, Any]:
    """What people and programs ask for: the answer, points, ratios, caveats (summary.schema.json). `point` and `base`
    are places in "points", `series` in "series". Times in seconds, medians over rounds; ratios at 95 %."""
    r = report.results
    answer = report.answer and {**dataclasses.asdict(report.answer),
                                **report.points.loc[report.answer.point, [*PLACE, "total_s"]].to_dict()}
    several = ["ranks", "cut"] if (r.series["ranks"] > 1).any() else []
    content = {"schema": SCHEMA, "title": report.title, "sources": r.sources, "answer": answer,
               "questions": report.questions, "caveats": report.caveats,
               "rounds": {"finished": len(r.closed), "void": r.void_rounds,
                          "others_share": r.closed["others_share"].max()},
               "environments": _records(r.environments, ["environment", "host", "cpu", "cores", "compiler", "flags",
                                                         "git", "dirty", "binding", "governor", "os_kernel"]),
               "peaks": _records(r.peaks, ["threads", "precision", "bandwidth_bytes_per_s", "flops_per_s"]),
               "series": _records(r.series, _SERIES + several), "points": _records(report.points, _POINT),
               **{name: _records(report.tables[name], columns) for name, columns in _TABLES.items()
                  if name != "scaling" or len(report.scaling)},
               "failed": _records(r.failed, ["study", "case", "state", "dx", *PLACE, "rows", "error"])}
    return plain(content)


def _records(table: pd.DataFrame, columns: list[str]) -> list[dict[str, Any]]:
    return table[columns].to_dict(orient="records")


def plain(value: Any, name: str = "") -> Any:
    """The value as JSON has it: whole numbers whole, null for what is not there."""
    if isinstance(value, dict):
        return {key: plain(one, key) for key, one in value.items()}
    if isinstance(value, list):
        return [plain(one) for one in value]
    if value is None or value is pd.NA or isinstance(value, (float, np.floating)) and not np.isfinite(value):
        return None
    value = value.item() if isinstance(value, np.generic) else value
    return int(value) if name in _WHOLE and isinstance(value, float) else value


def _printed(content: dict[str, Any]) -> str:
    """JSON with a line per record."""
    def lines(value: Any) -> str:
        if not (isinstance(value, list) and value):
            return json.dumps(value, allow_nan=False)
        return "[\n" + ",\n".join(json.dumps(one, allow_nan=False) for one in value) + "]"

    return "{" + ",\n".join(f"{json.dumps(key)}: {lines(value)}" for key, value in content.items()) + "}\n"


def rounds(report: Report) -> pd.DataFrame:
    """One line per point and round, with host, cpu and revision: for people's own analysis."""
    first = ["study", "file", "round", "host", "cpu", "git", "point", "series"]
    table = report.results.rounds
    return table[[*first, *(name for name in table.columns if name not in (*first, "build"))]]


def write(report: Report, folder: pathlib.Path) -> str:
    """Writes summary.json, tables.txt, tables.md, rounds.csv and csv/TABLE.csv; returns the text. Each file appears
    whole or not at all; a table without lines takes away the file that an earlier report left."""
    text = tables.text(report)
    for name, content in (("tables.txt", text), ("tables.md", tables.markdown(report)),
                          ("summary.json", _printed(summary(report))),
                          ("rounds.csv", rounds(report).to_csv(index=False))):
        write_file(folder / name, content)
    for name, table in report.tables.items():
        path = folder / "csv" / f"{name}.csv"
        if len(table):
            write_file(path, table.drop(columns="p", errors="ignore").to_csv(index=name == "points"))
        else:
            path.unlink(missing_ok=True)
    return text


def write_file(path: pathlib.Path, content: str | bytes) -> None:
    """Writes a file that appears whole or not at all, and leaves no other, even if the program is killed while it
    writes. Raises ResultsError with one line."""
    unfinished = path.with_name(f"{path.name}.{os.getpid()}.tmp")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with _without_a_name(unfinished) as file:
            file.write(content.encode() if isinstance(content, str) else content)
            file.flush()
            if isinstance(file.name, int):
                # The name is absolute; with a folder given, link follows it to the file that it stands for.
                os.link(f"/proc/self/fd/{file.name}", unfinished, src_dir_fd=file.name)
        os.replace(unfinished, path)
    except OSError as problem:
        unfinished.unlink(missing_ok=True) if unfinished.parent.is_dir() else None
        raise ResultsError(f"cannot write {path}: {problem.strerror}") from None


def _without_a_name(path: pathlib.Path) -> BinaryIO:
    """A file in the folder of `path` that has no name yet, or that one where the file system has no such files."""
    try:
        return open(os.open(path.parent, os.O_TMPFILE | os.O_WRONLY, 0o666), "wb")
    except OSError:
        return path.open("wb")
