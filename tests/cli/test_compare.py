"""Comparing what was measured: backends, files, revisions."""

import json
import re
import subprocess

import pytest
from conftest import BIN, PLAN, refused


@pytest.fixture(scope="module")
def measured(tmp_path_factory):
    """Two rows files of one plan, six rounds each."""
    folder = tmp_path_factory.mktemp("measured")
    (folder / "plan.json").write_text(json.dumps(PLAN))
    for name in ["one.jsonl", "two.jsonl"]:
        done = subprocess.run([BIN / "pairsum", "run", folder / "plan.json", "--out", folder / name], cwd=folder, text=True,
                              capture_output=True, timeout=120)
        assert done.returncode == 0, done.stderr
    return folder


def test_compare_backends(pairsum, measured):
    done = pairsum("compare", "naive", "symmetric", "--in", measured / "one.jsonl", "--allow-mixed")
    assert done.returncode == 0, done.stderr
    assert "dam_break rest dx=0.08 M=3 threads=1" in done.stdout and "Of 1 comparison B is faster in " in done.stdout
    ratio, low, high = map(float, re.search(r"([0-9.]+) +\[([0-9.]+), ([0-9.]+)\]", done.stdout).groups())
    assert low <= ratio <= high
    total = pairsum("compare", "naive", "symmetric", "--in", measured / "one.jsonl", "--phase", "total", "--allow-mixed")
    assert total.returncode == 0 and total.stdout != done.stdout


def test_compare_files_and_folders(pairsum, measured, tmp_path):
    done = pairsum("compare", measured / "one.jsonl", measured / "two.jsonl", "--allow-mixed")
    assert done.returncode == 0, done.stderr
    assert "Of 3 comparisons B is faster in " in done.stdout
    for name in ["one", "two"]:
        (tmp_path / name).mkdir()
        (tmp_path / name / "rows.jsonl").write_bytes((measured / f"{name}.jsonl").read_bytes())
    folders = pairsum("compare", "one", "two", "--allow-mixed")
    assert folders.returncode == 0 and "Of 3 comparisons" in folders.stdout


def test_compare_revisions(pairsum, measured, tmp_path):
    one = (measured / "one.jsonl").read_text()
    environment = next(row for row in map(json.loads, one.splitlines()) if row["kind"] == "environment")
    old = "0123456789ab"
    for name, text in [("new", one), ("old", (measured / "two.jsonl").read_text().replace(environment["git"], old)
                                      .replace(environment["environment"], "0123456789abcdef"))]:
        (tmp_path / f"{name}.jsonl").write_text(text)
    done = pairsum("compare", old[:6], environment["git"][:6], "--in", "old.jsonl", "new.jsonl", "--allow-mixed")
    assert done.returncode == 0, done.stderr
    assert "Of 3 comparisons B is faster in " in done.stdout
    assert refused(pairsum("compare", old, old[:6], "--in", "old.jsonl", "new.jsonl", "--allow-mixed"), "both", old)


def test_compare_refuses(pairsum, measured, tmp_path):
    one = measured / "one.jsonl"
    assert refused(pairsum("compare", "naive", "nope", "--in", one), '"nope"', "naive", "symmetric")
    assert refused(pairsum("compare", "nope", "naive", "--in", one), '"nope"')
    assert refused(pairsum("compare", "naive", "symmetric", "--in", one, "--phase", "nope"), "nope", "total", "sum")
    assert refused(pairsum("compare", "naive", "symmetric", "--in", "missing.jsonl"), "missing.jsonl")
    assert refused(pairsum("compare", one, "missing.jsonl"), "missing.jsonl")
    assert refused(pairsum("compare", "naive"), "B")
    (tmp_path / "foreign.jsonl").write_text("a,b\n1,2\n")
    assert refused(pairsum("compare", one, "foreign.jsonl"), "foreign.jsonl")
    (tmp_path / "empty").mkdir()
    assert refused(pairsum("compare", "naive", "symmetric", "--in", "empty"), "empty")
