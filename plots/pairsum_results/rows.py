"""Reads rows files strictly: every line is checked, and an error names the file, the line and what is wrong.

Keys and meaning are those of docs/design.md, section 3.
"""
import codecs
import json
import math
import pathlib
import re
from typing import Any, Callable, Iterable, Iterator

import numpy as np
import pandas as pd

from .words import one_line

SCHEMAS = ("pairsum.row/3", "pairsum.row/2")
PHASES = ["index_s", "prepare_s", "zero_s", "sum_s", "reduce_s", "integrate_s", "total_s"]

#: A row of each kind: key -> what it holds; "?" behind it where null may stand.
_POINT = {"case": "text", "state": "text", "dx": "number", "H": "number", "n_fluid": "count", "n_boundary": "count",
          "order": "text", "dim": "from one", "precision": "text", "interaction": "text", "smoothing": "text",
          "integrator": "text", "dt": "number", "backend": "text", "grid": "text", "M": "from one?",
          "threads": "from one", "granularity": "text", "isa": "text", "block": "text", "particles": "hex",
          "ranks": "from one", "cut": "cut?"}
_WORK = {**dict.fromkeys(("cells", "cells_nonempty", "sumF1", "sumF2", "pairs_tested", "pairs_interacting",
                          "pairs_fluid_fluid", "pairs_fluid_boundary"), "count"),
         "pairs_tested_unfolded": "count?", "flops": "amount?", "bytes": "amount?",
         "vector_units": {"block": "text", "lanes": "count", "vectors": "count", "occupancy": "number"}}
_IN_ROUND = {"environment": "hex", "round": "from one"}
_KINDS: dict[str, dict[str, Any]] = {
    "sample": {**_IN_ROUND, "part": "text", "slot": "from one", "repetition": "from one", "step": "from one",
               "seed": "count", "point": _POINT, "phases?": dict.fromkeys(PHASES, "amount?"),
               "threads_busy_s": "times?", "barrier_wait_s": "times?",
               "counters?": dict.fromkeys(("cycles", "instructions", "cache_misses"), "count?"), "work?": _WORK,
               "peak_rss_bytes": "count?", "workspace_bytes": "count?", "lost": "count?", "threads_worked": "count?",
               "verify": {"max_rel_err": "number?", "bound": "number?", "fingerprint": "hex?"}, "error": "text",
               "ranks": "ranks", "untimed": "text"},
    "environment": {"environment": "hex", "caches": "counts", "cores": "from one", "governor": "text?",
                    "libraries": "texts", "dirty": "flag",
                    **dict.fromkeys(("host", "cpu", "os_kernel", "compiler", "flags", "git", "binding", "counters",
                                     "limits"), "text")},
    "backend": {"environment": "hex",
                **dict.fromkeys(("name", "description", "aliases", "runtime", "conflicts"), "text"),
                **dict.fromkeys(("symmetric", "deterministic", "vector", "blocks"), "flag"),
                "self_test?": {"what": "text", "base_backend": "text", "expected": "amount?"}},
    "peak": {"environment": "hex", "threads": "from one", "precision": "text", "bandwidth_bytes_per_s": "positive",
             "flops_per_s": "positive"},
    "pace": {**_IN_ROUND, "threads": "from one", "precision": "text", "flops_per_s": "positive"},
    "round": {**_IN_ROUND, "part": "text", "replicate": "from one", "plan": "hex", "seed": "count", "rows": "count",
              "elapsed_s": "positive", "others_share": "amount?"},
    "void": {"round": "from one", "reason": "text"},
    "end": {"plan": "hex", "reason": "text"},
    "particles": {"particles": "hex", "files": "list of texts", "facts": "facts"}}
_OPTIONAL = {"error", "untimed", "ranks", "work.vector_units", "limits", "point.particles", "point.ranks", "point.cut"}
#: The one key of a row whose column has another name: that of a point is a number.
_COLUMN = {"ranks": "by_rank"}
_SINCE_3 = {"lost", "threads_worked", "work.flops", "work.bytes"}
_SELDOM_IN_2 = {"point.block", "workspace_bytes"}
#: Objects whose keys are columns by their full names; those of the others, as "sum_s", tell what they are.
_DOTTED = ("vector_units", "self_test")


_LONGEST = 16 << 20  #: bytes of a line
_UTF_16 = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)


class ResultsError(Exception):
    """Input that cannot be used; the text is one line for the user."""


def _is_number(value: Any) -> bool:
    return type(value) in (int, float) and math.isfinite(value)


def _is_text(value: Any) -> bool:
    return type(value) is str and (value.isprintable() or not _CONTROLS.search(value))


_NUMBERS = ("number", "amount", "positive", "count", "from one")
_HEX = re.compile("[0-9a-f]{16}")
_CONTROLS = re.compile("[\x00-\x1f\x7f-\x9f\ud800-\udfff]")
_UTC = re.compile(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d(\.\d+)?Z", re.ASCII)
_TESTS: dict[str, tuple[Callable[[Any], bool], str]] = {
    "text": (_is_text, "a string without control characters"),
    "hex": (lambda v: type(v) is str and _HEX.fullmatch(v) is not None, "16 hex digits"),
    "utc": (lambda v: type(v) is str and _UTC.fullmatch(v) is not None, "a UTC time like 2026-11-22T15:30:00.123Z"),
    "flag": (lambda v: type(v) is bool, "true or false"),
    "number": (_is_number, "a number"),
    "amount": (lambda v: _is_number(v) and v >= 0, "a number >= 0"),
    "positive": (lambda v: _is_number(v) and v > 0, "a number > 0"),
    "count": (lambda v: type(v) is int and 0 <= v < 2**64, "an integer >= 0"),
    "from one": (lambda v: type(v) is int and 1 <= v < 2**31, "an integer >= 1"),
    "counts": (lambda v: type(v) is dict and all(type(n) is int and n >= 0 for n in v.values()),
               "an object of integers >= 0"),
    "texts": (lambda v: type(v) is dict and all(map(_is_text, v.values())), "an object of strings"),
    "list of texts": (lambda v: type(v) is list and all(map(_is_text, v)), "an array of strings"),
    "facts": (lambda v: type(v) is list and all(type(f) is list and len(f) == 4 and all(map(_is_text, f)) for f in v),
              "an array of arrays of 4 strings"),
    "times": (lambda v: type(v) is list and all(type(one) is list and all(_is_number(s) and s >= 0 for s in one)
                                                for one in v), "an array of arrays of numbers >= 0")}


_RANK = {"host": "text", "cores": "text", "busy_s": "amount?", "waiting_s": "amount?",
         **dict.fromkeys(("own", "ghosts", "boundary", "pairs", "cut"), "count"),
         **dict.fromkeys(("halo", "migrate", "send_back", "partition"), "traffic")}
_TESTS["traffic"] = (lambda v: type(v) is dict and v.keys() == {"messages", "bytes"}
                     and all(map(_TESTS["count"][0], v.values())), "an object of messages and bytes")


def _is_rank(value: Any) -> bool:
    return type(value) is dict and value.keys() == _RANK.keys() and all(
        kind.endswith("?") and value[key] is None or _TESTS[kind.rstrip("?")][0](value[key])
        for key, kind in _RANK.items())


_TESTS["cut"] = (lambda v: v in ("twice", "once"), '"twice" or "once"')
_TESTS["ranks"] = (lambda v: type(v) is list and len(v) > 1 and all(map(_is_rank, v)),
                   "an array of at least 2 objects with " + ", ".join(_RANK))


def describe(value: Any) -> str:
    """What a JSON value is, in words."""
    words = {type(None): "null", bool: "a boolean", list: "an array", dict: "an object"}
    return words.get(type(value)) or (json.dumps(value)[:80] if isinstance(value, str) else f"the number {value}")


class _Checked:
    """The columns of the rows of one kind and schema; what is wrong goes to `faults` as (line, text)."""

    def __init__(self, faults: list[tuple[int, str]], former: bool):
        self.faults, self.former = faults, former

    def frame(self, lines: list[int], objects: list[dict], spec: dict[str, Any], prefix: str = "",
              dotted: str = "") -> pd.DataFrame:
        """One line per object, with the line's number as index; nothing but nulls where an object is null."""
        keys = {key.rstrip("?") for key in spec}
        keys -= {key for key in keys if self.former and prefix + key in _SINCE_3}
        columns, parts = {}, []
        for line, one in zip(lines, objects):
            if not keys.issuperset(one):
                self.fault(line, f'key "{prefix}{min(one.keys() - keys)}" is not known in this kind of row')
        for key, kind in spec.items():
            name = key.rstrip("?")
            at, values = self._present(lines, objects, name, prefix)
            if isinstance(kind, dict):
                inner = [(line, one) for line, one in zip(at, values) if not (key != name and one is None)]
                for line, one in inner:
                    if type(one) is not dict:
                        self.fault(line, f'key "{prefix}{name}" should be an object, is {describe(one)}')
                inner = [(line, one) for line, one in inner if type(one) is dict]
                parts.append(self.frame([line for line, _ in inner], [one for _, one in inner], kind,
                                        f"{prefix}{name}.", f"{name}." if name in _DOTTED else ""))
                continue
            test, words = _TESTS[kind.rstrip("?")]
            nullable = kind.endswith("?")
            wrong = [k for k, value in enumerate(values) if not (test(value) or nullable and value is None)]
            if wrong:
                self.fault(at[wrong[0]], f'key "{prefix}{name}" should be {words}{" or null" if nullable else ""}, '
                                         f"is {describe(values[wrong[0]])}")
            elif kind.rstrip("?") in _NUMBERS and (nullable or not values):
                columns[dotted + name] = pd.Series(values, at, dtype=float)  # null is NaN
                continue
            columns[_COLUMN.get(prefix + name, dotted + name)] = pd.Series(values, at,
                                                                           dtype=object if values == [] else None)
        return pd.concat([pd.DataFrame(columns, index=lines), *parts], axis=1)

    def _present(self, lines: list[int], objects: list[dict], name: str, prefix: str) -> tuple[list[int], list]:
        try:
            return lines, [one[name] for one in objects]
        except KeyError:
            found = [(line, one[name]) for line, one in zip(lines, objects) if name in one]
        full = prefix + name
        if full not in _OPTIONAL and not (self.former and full in _SINCE_3 | _SELDOM_IN_2):
            self.fault(next(line for line, one in zip(lines, objects) if name not in one), f'key "{full}" is missing')
        return [line for line, _ in found], [value for _, value in found]

    def fault(self, line: int, text: str) -> None:
        self.faults.append((line, text))


def _no_constant(name: str) -> None:
    raise ValueError(name)


def _keys_of(value: dict[str, Any]) -> int:
    return len(value) + sum([_keys_of(part) for part in value.values() if type(part) is dict])


def _doubled_key(line: str, row: dict[str, Any]) -> str | None:
    """A key that an object of a row says twice. Where the parser has kept as many keys as the line has, there is none
    to be looked for."""
    if line.count('":') == _keys_of(row) and '" ' not in line and '"\t' not in line and '"\r' not in line:
        return None
    found = []

    def look(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        keys = [key for key, _ in pairs]
        if len(set(keys)) < len(keys):
            found.append(next(key for k, key in enumerate(keys) if key in keys[:k]))
        return dict(pairs)

    json.loads(line, object_pairs_hook=look)
    return found[0] if found else None


def _lines(path: pathlib.Path) -> Iterator[tuple[str, bool, bool]]:
    """Of every line of a file its text, whether its end is missing, and whether it is the last."""
    try:
        if path.exists() and not path.is_file():
            raise ResultsError(f"{path}: is no regular file, should be a rows file")
        with path.open("rb") as file:
            line, number = file.readline(_LONGEST), 1
            if not line:
                raise ResultsError(f"{path}: is empty, should hold rows of {SCHEMAS[0]}")
            if line[:2] in _UTF_16 or line[:2].count(0) == 1:
                raise ResultsError(f"{path}: is UTF-16, should be UTF-8")
            line = line.removeprefix(codecs.BOM_UTF8)
            while line:
                if len(line) >= _LONGEST:
                    raise ResultsError(f"{path}:{number}: the line has more than 16 MB")
                after = file.readline(_LONGEST)
                yield line.decode("utf-8", errors="replace").removesuffix("\n"), not line.endswith(b"\n"), not after
                line, number = after, number + 1
    except OSError as problem:
        raise ResultsError(f"{path}: cannot be read: {problem.strerror}") from None


def _parsed(path: pathlib.Path) -> list[dict]:
    """The JSON objects of the lines."""
    rows: list[dict] = []
    decode = json.JSONDecoder(parse_constant=_no_constant).decode
    for number, (line, cut, last) in enumerate(_lines(path), 1):
        try:
            row = decode(line)
        except (ValueError, RecursionError):
            row = None
        if number == 1 and not (type(row) is dict and "schema" in row or row is None and line.startswith('{"')):
            raise ResultsError(f'{path}:1: this is no rows file: its first line should be a JSON object with "schema":'
                               f'"{SCHEMAS[0]}"')
        if last and (cut or row is None):
            raise ResultsError(f"{path}:{number}: the last line is cut; remove it to keep the {len(rows)} whole rows "
                               "before it")
        if type(row) is not dict:
            raise ResultsError(f"{path}:{number}: " + ("it is no whole JSON value" if row is None else
                                                       f"a row should be an object, is {describe(row)}"))
        if (twice := _doubled_key(line, row)) is not None:
            raise ResultsError(f"{path}:{number}: key {json.dumps(twice)} is there twice in its object")
        rows.append(row)
    return rows


def _order_faults(rows: Iterable[tuple[int, dict]]) -> Iterable[tuple[int, str]]:
    """What is wrong with the order of rows that are right by themselves."""
    known, backends, particles, closed, samples = set(), set(), set(), set(), {}
    for line, row in rows:
        kind, environment, of_round = row["kind"], row.get("environment"), (row["study"], row.get("round"))
        if kind == "environment":
            known.add(environment)
        elif environment is not None and environment not in known:
            yield line, f'key "environment" should name an environment row before it, is "{environment}"'
        if kind == "backend":
            backends.add((environment, row["name"]))
        if kind == "particles":
            particles.add(row["particles"])
        if kind == "sample" and row["point"].get("particles", "") not in {"", *particles}:
            yield line, f'key "point.particles" should name a particles row before it, is "{row["point"]["particles"]}"'
        why = next((key for key in ("error", "untimed") if key in row), None)
        if kind == "sample" and (why is not None) == (row["phases"] is not None):
            yield line, ('key "phases" should be ' + (f'null in a row with "{why}"' if why else
                                                      'an object in a row without "error"')
                         + f', is {describe(row["phases"])}')
        if kind == "sample" and row["schema"] == SCHEMAS[0] and (environment, row["point"]["backend"]) not in backends:
            yield line, ('key "point.backend" should name a backend row of its environment before it, is '
                         f'"{row["point"]["backend"]}"')
        if kind in ("sample", "pace", "round") and of_round in closed:
            yield line, f'key "round" names round {of_round[1]}, which a round row before it has closed'
        if kind == "sample":
            samples[of_round] = samples.get(of_round, 0) + 1
        if kind == "round":
            closed.add(of_round)
            if row["rows"] != samples.get(of_round, 0):
                yield line, (f'key "rows" should be the number of samples of the round, {samples.get(of_round, 0)}, '
                             f'is {row["rows"]}')


def read_file(path: pathlib.Path) -> dict[str, pd.DataFrame]:
    """The rows of one file by kind, in file order; index: line number. Raises ResultsError with one line."""
    rows = _parsed(path)
    faults: list[tuple[int, str]] = []
    groups: dict[tuple[str, str], tuple[list[int], list[dict]]] = {}
    for line, row in enumerate(rows, 1):
        schemas = SCHEMAS[:1] if row.get("kind") in ("backend", "particles") else SCHEMAS
        for key, words in (("schema", schemas), ("kind", tuple(_KINDS))):
            if row.get(key) not in words:
                said = " or ".join(json.dumps(w) for w in words)
                faults.append((line, f'key "{key}" should be {said}, is {describe(row[key])}' if key in row
                               else f'key "{key}" is missing'))
                break
        else:
            lines, objects = groups.setdefault((row["kind"], row["schema"]), ([], []))
            lines.append(line)
            objects.append(row)
    frames: dict[str, list[pd.DataFrame]] = {kind: [] for kind in _KINDS}
    for (kind, schema), (lines, objects) in groups.items():
        spec = {"schema": "text", "kind": "text", "study": "text", "utc": "utc", **_KINDS[kind]}
        frames[kind].append(_Checked(faults, schema != SCHEMAS[0]).frame(lines, objects, spec))
    end = min(faults)[0] if faults else len(rows) + 1
    faults += _order_faults((line, row) for line, row in enumerate(rows, 1) if line < end)
    if faults:
        line, text = min(faults)
        raise ResultsError(f"{path}:{line}: {text}")
    empty = _Checked([], False)
    return {kind: pd.concat(parts).sort_index() if parts else empty.frame([], [], {"study": "text", "utc": "utc",
                                                                                  **_KINDS[kind]})
            for kind, parts in frames.items()}


def rows_paths(given: str | pathlib.Path | Iterable[str | pathlib.Path]) -> list[pathlib.Path]:
    """The rows files of files and folders, each once; of a folder those below, too, without the empty ones that runs
    leave which were ended at once. Raises ResultsError with one line."""
    paths: list[pathlib.Path] = []
    for path in map(pathlib.Path, [given] if isinstance(given, (str, pathlib.Path)) else given):
        inside = [path]
        if path.is_dir():
            inside = sorted(p for p in path.rglob("*.jsonl") if p.is_file() and p.stat().st_size > 0)
            if not inside:
                raise ResultsError(f"{path}: has no rows files (*.jsonl) in it, nor in the folders below")
        paths += inside
    if not paths:
        raise ResultsError("a report needs at least one rows file or folder")
    return list({path.resolve(): path for path in reversed(paths)}.values())[::-1]


def read(given: str | pathlib.Path | Iterable[str | pathlib.Path]) -> dict[str, pd.DataFrame]:
    """The rows of all files by kind, with "file" (0, 1, ...) and "source" (folder and file name) as columns, and as kind
    "copies" what was left out: rounds that an earlier file holds, too. Raises ResultsError with one line for a bad
    file, and for one that holds a round of another with other values."""
    paths, files = rows_paths(given), []
    for number, path in enumerate(paths):
        source = one_line((pathlib.Path(path.parent.name) / path.name).as_posix())
        files.append({kind: frame.assign(file=number, source=source) for kind, frame in read_file(path).items()})
    # Without the empty ones, whose columns of floats would make floats of integers.
    found = {kind: pd.concat([rows[kind] for rows in files if len(rows[kind])] or [files[0][kind]], ignore_index=True)
             for kind in _KINDS}
    return _without_copies(found, paths)


#: What no two rounds have in common: study, machine and build, plan, seed, time and number.
IDENTITY = ["study", "environment", "plan", "seed", "utc", "round"]
_PLACE = ["file", "study", "round"]


def _without_copies(found: dict[str, pd.DataFrame], paths: list[pathlib.Path]) -> dict[str, pd.DataFrame]:
    """Of rounds that several files hold only the first, which is void if one of them is."""
    closed = found["round"]
    first = closed.groupby(IDENTITY, sort=False)["file"].transform("first")
    copies = closed.assign(of_file=first).loc[first != closed["file"], [*_PLACE, "source", "of_file"]]
    copies["of"] = copies["of_file"].map(closed.drop_duplicates("file").set_index("file")["source"])
    for kind in ("sample", "pace", "void", "round") if len(copies) else ():
        frame = found[kind]
        of = frame[_PLACE].merge(copies[[*_PLACE, "of_file"]], how="left")["of_file"]
        if kind == "sample":
            _check_copies(frame, frame[of.notna()].assign(file=of.dropna().astype(int)), paths)
        found[kind] = (frame.assign(file=of.fillna(frame["file"]).astype(int)) if kind == "void" else
                       frame[of.isna()].reset_index(drop=True))
    return found | {"copies": copies}


def _check_copies(samples: pd.DataFrame, copies: pd.DataFrame, paths: list[pathlib.Path]) -> None:
    """Raises unless the samples of copied rounds, under the number of the file they are copies of, are in that, too."""
    values = [*_PLACE, "slot", "repetition", "step", "total_s", "sum_s", "error"]
    known, said = (pd.MultiIndex.from_frame(frame[values].fillna(-1)) for frame in (samples, copies))
    for _, wrong in copies[~said.isin(known)].iterrows():
        raise ResultsError(f"{paths[wrong['file']]} and another file hold round {wrong['round']} of {wrong['study']} "
                           "with different values: one of them was changed; leave it out")


