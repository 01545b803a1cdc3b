"""Load and check a summary.json. Every error is one clear line."""
import json

import schema
from schema import PAIR_PARTS, PHASES, SCHEMA, TABLES


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
    return {**dict.fromkeys(schema.LATER, []), **data}


def check(data, path="the summary"):
    """Raise SummaryError unless `data` has the tables and fields that the plots read."""
    if not isinstance(data, dict) or data.get("schema") != SCHEMA:
        found = data.get("schema") if isinstance(data, dict) else None
        what = f'its "schema" is {json.dumps(found)[:60]}' if found else 'it has no "schema"'
        raise SummaryError(f'{path} is not a pairsum summary: {what}, expected "{SCHEMA}"')
    for table in schema.LISTS:
        if not isinstance(data.get(table), list):
            raise SummaryError(f'{path} has no list "{table}"')
    _check_row({"title": data.get("title")}, {"title": schema.TEXT}, path)
    for table in schema.LATER:
        if not isinstance(data.get(table, []), list):
            raise SummaryError(f'{path}: "{table}" is no list')
    for table, fields in {**TABLES, **schema.LATER}.items():
        for number, row in enumerate(data.get(table, [])):
            _check_row(row, fields, f"{path}: {table}[{number}]")
    for number, entry in enumerate(data["points"]):
        _check_entry(entry, f"{path}: points[{number}]")
    for number, row in enumerate(data["environments"]):
        _check_row(row, {}, f"{path}: environments[{number}]")
    for number, text in enumerate(data["caveats"]):
        if not isinstance(text, str):
            raise SummaryError(f"{path}: caveats[{number}] is not text")
    _check_answer(data, path)


def _check_entry(entry, where):
    _check_row(entry, schema.ENTRY, where)
    _check_row(entry.get("ns_per_pair_parts", dict.fromkeys(PAIR_PARTS)),
               dict.fromkeys(PAIR_PARTS, schema.OPTIONAL), f"{where}.ns_per_pair_parts")
    _check_row(entry.get("point"), schema.POINT, f"{where}.point")
    if not isinstance(entry.get("phases"), dict):
        raise SummaryError(f'{where} has no object "phases"')
    for phase in PHASES:
        _check_row(entry["phases"].get(phase, {"median": None}), {"median": schema.OPTIONAL},
                   f"{where}.phases.{phase}")
    if entry.get("model") is not None:
        _check_row(entry["model"], schema.MODEL, f"{where}.model")
    if entry.get("passes") is not None:
        _check_passes(entry["passes"], f"{where}.passes")


def _check_passes(passes, where):
    _check_row(passes, {"wait_share": schema.OPTIONAL}, where)
    shapes = []
    for field in ("busy_s", "barrier_wait_s"):
        table = passes.get(field)
        if not isinstance(table, list) or not table or not all(
                isinstance(some, list) and some and len(some) == len(table[0]) for some in table):
            raise SummaryError(f'{where} has no table "{field}" of passes and threads')
        for some in table:
            for value in some:
                _check_row({field: value}, {field: schema.NUMBER}, where)
        shapes.append((len(table), len(table[0])))
    if shapes[0] != shapes[1]:
        raise SummaryError(f"{where}: busy_s and barrier_wait_s differ in passes or threads")


def _check_answer(data, path):
    if "answer" not in data:
        raise SummaryError(f'{path} has no "answer" (null if nothing can be recommended)')
    if data["answer"] is not None:
        _check_row(data["answer"], schema.ANSWER, f"{path}: answer")
        ties = data["answer"].get("ties")
        if not isinstance(ties, list):
            raise SummaryError(f'{path}: answer has no list "ties"')
        for number, row in enumerate(ties):
            _check_row(row, schema.TIE, f"{path}: answer.ties[{number}]")


def doubles(data):
    """Return one note per table that holds several rows for what its keys call one point."""
    notes = []
    for table in ("speedup", "algorithm_speedup", "m_comparison"):
        keys = [tuple((field, value) for field, value in row.items() if isinstance(value, str)
                      or field in ("dx", "M", "threads", "base_M", "series"))
                for row in data[table]]
        again = len(keys) - len(set(keys))
        if again:
            notes.append(f'{table}: {again} rows repeat the case, state, dx, backend, M and '
                         "threads of another; all are drawn")
    return notes


def _check_row(row, fields, where):
    wrong = schema.fault(row, fields)
    if wrong:
        raise SummaryError(where + wrong)


def _no_constant(name):
    raise ValueError(f"{name} is not a JSON number")
