"""The soak's own checks must reject; and a short soak."""
import json
import os
import pathlib
import subprocess
import sys

import pytest
from soak import ACTIONS, Faults, finished_rounds, nothing_lost

SOAK = pathlib.Path(__file__).with_name("soak.py")


def text(*rows):
    return "".join(json.dumps(row) + "\n" for row in rows)


def sample(k):
    return {"kind": "sample", "round": k}


def closed(k, rows=1, utc="now"):
    return {"kind": "round", "round": k, "rows": rows, "utc": utc}


def test_finished_rounds_are_found():
    whole = text({"kind": "environment"}, sample(1), closed(1), sample(2), {"kind": "void", "round": 2}, sample(3), closed(3))
    assert finished_rounds(whole) == {1: "now", 3: "now"} == finished_rounds(whole + '{"kind": "sam', cut=True)


@pytest.mark.parametrize("rows, says", [
    (text(sample(1), closed(1)) + "{", "the last line is cut"),
    (text(sample(1)) + "{\n" + text(closed(1)), "line 2 is no JSON"),
    (text(sample(1), closed(1), closed(1)), "round 1 is closed twice"),
    (text(sample(1), closed(1, rows=2)), "round 1 has 1 rows of 2"),
    (text(sample(1), closed(1), {"kind": "void", "round": 1}), "round 1 was finished and is void")])
def test_a_file_that_is_not_valid_is_rejected(rows, says):
    with pytest.raises(Faults, match=says):
        finished_rounds(rows)


@pytest.mark.parametrize("after, says", [({2: "b"}, "round 1, finished at a, is gone"), ({1: "c"}, "is another")])
def test_a_round_that_is_lost_is_found(after, says):
    nothing_lost({1: "a"}, {1: "a", 2: "b"})
    with pytest.raises(Faults, match=says):
        nothing_lost({1: "a"}, after)


def test_a_short_soak_loses_nothing():
    words = ["--dx", "0.08", "--backend", "naive_omp,symmetric_omp", "--M", "6", "--threads", "2", "--steps", "20", "--rounds", "60",
             "--binding", "none"]
    done = subprocess.run([sys.executable, SOAK, "--program", os.environ["PAIRSUM_BIN"] + "/pairsum", "--seconds", "12", "--wait", "1", "--",
                           *words], capture_output=True, text=True, timeout=240, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    counts = json.loads(done.stdout)
    assert counts["fault"] is None and counts["starts"] >= 5 and counts["rounds"] >= 60
    assert sum(counts.get(action, 0) for action in ACTIONS) >= 2
