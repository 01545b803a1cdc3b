"""Runs the programs that were just built."""

import os
import pathlib
import shutil
import subprocess

import pytest

BIN = pathlib.Path(os.environ["PAIRSUM_BIN"])
SMALL = ["--dx", "0.08", "--M", "3", "--threads", "1", "--steps", "2", "--rounds", "1"]
# Two parts, 3 points, 6 rounds each.
PLAN = {
    "schema": "pairsum.plan/1",
    "study": "mine",
    "title": "a plan of a test",
    "defaults": {"case": "dam_break", "dx": 0.08, "M": 3, "threads": 1, "steps": 2, "rounds": 6},
    "parts": [
        {"name": "both", "reason": "to have two", "backend": "naive,symmetric"},
        {"name": "alone", "backend": "naive", "state": "perturbed", "rounds": [6, 8]},
    ],
}


@pytest.fixture
def pairsum(tmp_path):
    """Calls pairsum in an empty folder; returns the finished process."""

    def call(*words, program="pairsum"):
        return subprocess.run([BIN / program, *map(str, words)], cwd=tmp_path, text=True, capture_output=True, timeout=300)

    return call


@pytest.fixture(scope="session")
def small_run(tmp_path_factory):
    path = tmp_path_factory.mktemp("small_run") / "rows.jsonl"
    done = subprocess.run([BIN / "pairsum", "run", *SMALL, "--out", path], text=True, capture_output=True, timeout=300)
    assert done.returncode == 0, done.stderr
    return path


@pytest.fixture
def rows(small_run, tmp_path):
    """A small valid rows file."""
    return pathlib.Path(shutil.copy(small_run, tmp_path))


def refused(done, *says):
    """One line on stderr that says all of `says`, exit code 2, no table on stdout."""
    assert done.returncode == 2, (done.returncode, done.stdout, done.stderr)
    lines = done.stderr.strip().splitlines()
    assert len(lines) == 1, done.stderr
    assert lines[0].startswith("pairsum: ") or lines[0].startswith("pairsum_bench: "), lines[0]
    for word in says:
        assert word in lines[0], lines[0]
    return True
