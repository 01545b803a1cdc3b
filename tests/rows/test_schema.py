"""The JSON Schema of a row against rows written by the program: it accepts them, and rejects broken
ones exactly where the strict readers of the program and of Python do. CTest names the program in
PAIRSUM_ROWS_EXAMPLE. Every committed rows file is held against it, too."""

import copy
import json
import os
import pathlib
import subprocess
import sys

import jsonschema
import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "plots"), str(ROOT / "tests")]
from committed import committed  # noqa: E402
from pairsum_results.rows import ResultsError, read_file  # noqa: E402

PROGRAM = os.environ.get("PAIRSUM_ROWS_EXAMPLE")
SCHEMA = ROOT / "harness" / "rows" / "row.schema.json"
COMMITTED = committed("results/*/*.jsonl")

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


@pytest.fixture(scope="module")
def sample(rows):
    return next(row for row in rows if row["kind"] == "sample")


@pytest.fixture(scope="module")
def former(sample):
    """The sample as schema 2 wrote it."""
    row = dict(sample, schema="pairsum.row/2", work=dict(sample["work"]))
    for inner, key in ((row, "lost"), (row, "threads_worked"), (row["work"], "flops"), (row["work"], "bytes")):
        del inner[key]
    return row


def before(rows, row):
    """What a file must hold before the row: its environment and, for a sample, its backend, whatever it is called."""
    environment, backend = (next(r for r in rows if r["kind"] == kind) for kind in ("environment", "backend"))
    if row["kind"] == "environment":
        return []
    if row["kind"] == "sample" and isinstance(row["point"], dict) and isinstance(row["point"].get("backend"), str):
        named = row["point"].get("particles")
        return [environment, dict(backend, name=row["point"]["backend"]),
                *(dict(r, particles=named) for r in rows if r["kind"] == "particles" and isinstance(named, str))]
    return [environment]


def readers_accept(folder, lines):
    """Whether both readers do; they must agree."""
    path = folder / "check.jsonl"
    path.write_text("".join(json.dumps(line) + "\n" for line in lines))
    accepts = subprocess.run([PROGRAM, "check", path], capture_output=True).returncode == 0
    try:
        read_file(path)
    except ResultsError as problem:
        assert not accepts, problem
    else:
        assert accepts, lines[-1]
    return accepts


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
    assert [row["kind"] for row in rows] == ["environment", "peak", "backend", "particles", "sample", "sample", "sample", "sample", "sample",
                                           "pace", "round", "end", "void"]
    for row in rows:
        validator.validate(row)


def test_rows_with_a_key_missing_are_rejected(rows, former, validator):
    for row in [*rows, former]:
        for place in places(row):
            free = place[0] in ("caches", "libraries") and len(place) == 2
            free = free or row["kind"] == "environment" and place == ("limits",)
            free = free or place in (("point", "particles"), ("point", "ranks"), ("point", "cut"), ("ranks",))
            free = free or row is former and place in (("point", "block"), ("workspace_bytes",))
            assert validator.is_valid(changed(row, place, ...)) == free, place


def test_rows_with_an_unknown_key_are_rejected(rows, former, validator):
    for row in [*rows, former]:
        objects = [()] + [place for place in places(row)
                          if place[-1] in ("point", "phases", "work", "verify", "counters", "self_test")]
        for place in objects:
            if place and not isinstance(row[place[0]], dict):
                continue
            assert not validator.is_valid(changed(row, place + ("note",), 1)), place


@pytest.mark.parametrize("new", [None, "text", -1, 0, 1.5, True, [], {}, [0.5], ["text"]])
def test_schema_and_reader_agree_on_changed_values(rows, former, validator, tmp_path, new):
    for row in [*rows, former]:
        if row["kind"] == "round":
            row = dict(row, rows=0)  # it closes a round without samples
        for place in places(row):
            broken = changed(row, place, new)
            lines = [*before(rows, dict(row, point=broken.get("point"))), broken]
            assert validator.is_valid(broken) == readers_accept(tmp_path, lines), (place, new)


@pytest.mark.parametrize("place, new", [
    (("lost",), 0), (("threads_worked",), 1), (("work", "flops"), 1.0), (("work", "bytes"), None), (("kind",), "backend"),
])
def test_rows_of_schema_2_have_nothing_of_schema_3(rows, former, validator, tmp_path, place, new):
    assert validator.is_valid(former) and readers_accept(tmp_path, [*before(rows, former), former])
    broken = changed(former, place, new)
    assert not validator.is_valid(broken)
    assert not readers_accept(tmp_path, [*before(rows, former), broken])


def test_backends_are_rows_of_schema_3(rows, validator, tmp_path):
    backend = dict(next(row for row in rows if row["kind"] == "backend"), schema="pairsum.row/2")
    assert not validator.is_valid(backend) and not readers_accept(tmp_path, [*before(rows, backend), backend])


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
def test_samples_with_a_wrong_value_are_rejected(rows, sample, validator, tmp_path, place, new):
    broken = changed(sample, place, new)
    assert not validator.is_valid(broken)
    assert not readers_accept(tmp_path, [*before(rows, sample), broken])


def complaints(path, validator):
    """What is wrong with a rows file, as FILE:LINE: KEY: WHY."""
    for number, line in enumerate(path.read_text().splitlines(), 1):
        for e in validator.iter_errors(json.loads(line)):
            yield f"{path.name}:{number}: {'.'.join(map(str, e.absolute_path))}: {e.message}"


def test_there_are_committed_rows():
    assert len(COMMITTED) >= 8


@pytest.mark.parametrize("path", COMMITTED, ids=lambda path: f"{path.parent.name}/{path.stem}")
def test_committed_rows_are_valid(path, validator):
    assert list(complaints(path, validator)) == []
    assert subprocess.run([PROGRAM, "check", path], capture_output=True, text=True).stderr == ""


def test_a_committed_row_that_was_changed_is_found(tmp_path, validator):
    lines = COMMITTED[-1].read_text().splitlines()
    at = next(k for k, line in enumerate(lines) if '"kind":"sample"' in line)
    broken = json.loads(lines[at])
    broken["phases"]["sum_s"] = -1
    lines[at] = json.dumps(broken)
    path = tmp_path / "changed.jsonl"
    path.write_text("\n".join(lines) + "\n")
    found = list(complaints(path, validator))
    assert len(found) == 1 and found[0].startswith(f"changed.jsonl:{at + 1}: phases: "), found
