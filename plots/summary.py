"""Load and check a summary.json (docs/design.md section 4). Every error is one clear line."""
import json
import math

SCHEMA = "pairsum.summary/1"

TEXT, NUMBER, OPTIONAL = "text", "a number", "a number or null"
COUNT, POSITIVE = "a whole number from 1", "a positive number or null"
_PLACE = {"case": TEXT, "state": TEXT, "dx": NUMBER}
_SPEEDUP = {"speedup": POSITIVE, "low": OPTIONAL, "high": OPTIONAL}

#: What the plots need of each table: field -> kind. Other fields may be there and are ignored.
TABLES = {
    "speedup": {**_PLACE, "backend": TEXT, "M": OPTIONAL, "threads": COUNT, "base_backend": TEXT,
                "base_threads": COUNT, "efficiency": OPTIONAL, **_SPEEDUP},
    "algorithm_speedup": {**_PLACE, "runtime": TEXT, "threads": COUNT, "base_backend": TEXT,
                          "base_M": OPTIONAL, "backend": TEXT, "M": OPTIONAL, **_SPEEDUP},
    "m_comparison": {**_PLACE, "backend": TEXT, "threads": COUNT, "M": OPTIONAL,
                     "total_s": OPTIONAL, "cells_nonempty": OPTIONAL, "pairs_tested": OPTIONAL,
                     "useful_pair_ratio": OPTIONAL},
}
POINT = {**_PLACE, "n_fluid": NUMBER, "n_boundary": NUMBER, "precision": TEXT,
         "interaction": TEXT, "backend": TEXT, "M": OPTIONAL, "threads": COUNT}
#: Other fields that may tell panels apart.
_SCALARS = ("H", "order", "dim", "smoothing", "integrator", "dt", "isa", "grid", "study", "series")
PHASES = ("index_s", "prepare_s", "zero_s", "sum_s", "reduce_s", "integrate_s", "total_s")
PAIR_PARTS = ("prepare", "zero", "sum", "reduce", "all")


class SummaryError(Exception):
    """The input cannot be drawn; the text is one line for the user."""


class NoData(Exception):
    """A figure has nothing to show; the text says what is missing."""


def load(path):
    """Return the checked summary at `path` as a dict; raise SummaryError with one line."""
    try:
        with open(path, encoding="utf-8") as stream:
            text = stream.read()
    except OSError as problem:
        raise SummaryError(f"cannot read {path}: {problem.strerror}") from None
    except UnicodeDecodeError:
        raise SummaryError(f"{path} is not a text file, expected a summary.json") from None
    try:
        data = json.loads(text, parse_constant=_no_constant)
    except json.JSONDecodeError as problem:
        if problem.msg == "Extra data":
            raise SummaryError(f"{path} holds more than one JSON value; if these are rows, make a "
                               "summary of them with `pairsum report`") from None
        raise SummaryError(f"{path} is not complete JSON (line {problem.lineno}, column "
                           f"{problem.colno}: {problem.msg}); was it cut off?") from None
    except (ValueError, RecursionError) as problem:
        raise SummaryError(f"{path} is not usable JSON: {problem}") from None
    check(data, path)
    return data


def check(data, path="the summary"):
    """Raise SummaryError unless `data` has the tables and fields that the plots read."""
    if not isinstance(data, dict) or data.get("schema") != SCHEMA:
        found = data.get("schema") if isinstance(data, dict) else None
        what = f'its "schema" is {json.dumps(found)}' if found else 'it has no "schema"'
        raise SummaryError(f'{path} is not a pairsum summary: {what}, expected "{SCHEMA}"')
    for table in ("environments", "points", "caveats", *TABLES):
        if not isinstance(data.get(table), list):
            raise SummaryError(f'{path} has no list "{table}"')
    for table, fields in TABLES.items():
        for number, row in enumerate(data[table]):
            _check_row(row, fields, f"{path}: {table}[{number}]")
    for number, entry in enumerate(data["points"]):
        where = f"{path}: points[{number}]"
        _check_row(entry, {"ns_per_pair": OPTIONAL}, where)
        _check_row(entry.get("ns_per_pair_parts", dict.fromkeys(PAIR_PARTS)),
                   dict.fromkeys(PAIR_PARTS, OPTIONAL), f"{where}.ns_per_pair_parts")
        _check_row(entry.get("point"), POINT, f"{where}.point")
        if not isinstance(entry.get("phases"), dict):
            raise SummaryError(f'{where} has no object "phases"')
        for phase in PHASES:
            _check_row(entry["phases"].get(phase, {"median": None}), {"median": OPTIONAL},
                       f"{where}.phases.{phase}")
    for number, row in enumerate(data["environments"]):
        _check_row(row, {}, f"{path}: environments[{number}]")


def doubles(data):
    """Return one note per table that holds several rows for what its keys call one point."""
    notes = []
    for table in TABLES:
        keys = [tuple((field, value) for field, value in row.items() if isinstance(value, str)
                      or field in ("dx", "M", "threads", "base_M", "series"))
                for row in data[table]]
        again = len(keys) - len(set(keys))
        if again:
            notes.append(f'{table}: {again} rows repeat the case, state, dx, backend, M and '
                         "threads of another; all are drawn")
    return notes


def _check_row(row, fields, where):
    if not isinstance(row, dict):
        raise SummaryError(f"{where} is not an object")
    for field in _SCALARS:
        if isinstance(row.get(field), (dict, list)):
            raise SummaryError(f'{where}: "{field}" is not one word or number')
    for field, kind in fields.items():
        if field not in row:
            raise SummaryError(f'{where} has no "{field}"')
        if not _is(row[field], kind):
            raise SummaryError(f'{where}: "{field}" is {json.dumps(row[field])[:60]}, '
                               f"expected {kind}")


def _is(value, kind):
    if kind is TEXT:
        return isinstance(value, str)
    if value is None:
        return kind in (OPTIONAL, POSITIVE)
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return False
    try:
        if not math.isfinite(value):
            return False
    except OverflowError:
        return False
    return value > 0 if kind is POSITIVE else kind is not COUNT or (value >= 1 and value % 1 == 0)


def _no_constant(name):
    raise ValueError(f"{name} is not a JSON number")
