"""The JSON Schema of a row against rows written by the program: it accepts them, and rejects broken
ones exactly where the strict reader does. CTest names the program in PAIRSUM_ROWS_EXAMPLE."""

import copy
import json
import os
import pathlib
import subprocess

import jsonschema
import pytest

PROGRAM = os.environ.get("PAIRSUM_ROWS_EXAMPLE")
SCHEMA = pathlib.Path(__file__).parents[2] / "harness" / "rows" / "row.schema.json"

pytestmark = pytest.mark.skipif(not PROGRAM, reason="PAIRSUM_ROWS_EXAMPLE names no rows_example")


@pytest.fixture(scope="module")
def validator():
    schema = json.loads(SCHEMA.read_text())
    jsonschema.Draft7Validator.check_schema(schema)
    return jsonschema.Draft7Validator(schema)


@pytest.fixture(scope="module")
def rows(tmp_path_factory):
    path = tmp_path_factory.mktemp("rows") / "rows.jsonl"
    subprocess.run([PROGRAM, "write", path], check=True)
    return [json.loads(line) for line in path.read_text().splitlines()]


def reader_accepts(folder, lines):
    path = folder / "check.jsonl"
    path.write_text("".join(json.dumps(line) + "\n" for line in lines))
    return subprocess.run([PROGRAM, "check", path], capture_output=True).returncode == 0


def places(value, at=()):
    """The paths of all keys in a row, nested ones too."""
    for key, inner in value.items():
        yield at + (key,)
        if isinstance(inner, dict):
            yield from places(inner, at + (key,))


def changed(row, place, new):
    """A copy of the row with one value replaced, or removed if `new` is Ellipsis."""
    row = copy.deepcopy(row)
    inner = row
    for key in place[:-1]:
        inner = inner[key]
    if new is ...:
        del inner[place[-1]]
    else:
        inner[place[-1]] = new
    return row


def test_every_kind_is_written_and_valid(rows, validator):
    assert [row["kind"] for row in rows] == ["environment", "peak", "sample", "sample", "pace", "round", "end", "void"]
    for row in rows:
        validator.validate(row)


def test_rows_with_a_key_missing_are_rejected(rows, validator):
    for row in rows:
        for place in places(row):
            free = place[0] in ("caches", "libraries") and len(place) == 2 or place in (("point", "block"), ("workspace_bytes",))
            assert validator.is_valid(changed(row, place, ...)) == free, place


def test_rows_with_an_unknown_key_are_rejected(rows, validator):
    for row in rows:
        objects = [()] + [place for place in places(row)
                          if place[-1] in ("point", "phases", "work", "verify", "counters")]
        for place in objects:
            if place and not isinstance(row[place[0]], dict):
                continue
            assert not validator.is_valid(changed(row, place + ("note",), 1)), place


@pytest.mark.parametrize("new", [None, "text", -1, 0, 1.5, True, [], {}, [0.5], ["text"]])
def test_schema_and_reader_agree_on_changed_values(rows, validator, tmp_path, new):
    environment = rows[0]
    for row in rows:
        if row["kind"] == "round":
            row = dict(row, rows=0)  # it closes a round without samples
        for place in places(row):
            broken = changed(row, place, new)
            lines = [broken] if row is environment else [environment, broken]
            assert validator.is_valid(broken) == reader_accepts(tmp_path, lines), (place, new)


@pytest.mark.parametrize("place, new", [
    (("schema",), "pairsum.row/1"),
    (("kind",), "samples"),
    (("utc",), "2026-11-22 15:30"),
    (("utc",), "2026-11-22T15:30:00"),
    (("environment",), "0123456789ABCDEF"),
    (("verify", "fingerprint"), "0123"),
    (("error",), "text beside phases"),
    (("seed",), 1e30),
])
def test_samples_with_a_wrong_value_are_rejected(rows, validator, tmp_path, place, new):
    broken = changed(rows[2], place, new)
    assert not validator.is_valid(broken)
    assert not reader_accepts(tmp_path, [rows[0], broken])
