"""A study that is cut, by whatever, goes on where it was, and ends with the rows of one that was not."""

import collections
import json
import os
import pathlib
import random
import signal
import subprocess
import time
import uuid

import jsonschema
import pytest
from conftest import BIN, refused

SOURCE = pathlib.Path(os.environ["PAIRSUM_SOURCE"])
SCHEMA = jsonschema.Draft7Validator(json.loads((SOURCE / "harness/rows/row.schema.json").read_text()))
ROUNDS = 7
PLAN = {
    "schema": "pairsum.plan/1",
    "study": "cut",
    "title": "for tests",
    "defaults": {"case": "dam_break", "dx": 0.07, "M": "4,5", "threads": 1, "steps": 2, "repetitions": 2, "rounds": ROUNDS},
    "parts": [
        {"name": "rest", "backend": "naive,symmetric,symmetric_omp", "state": "rest"},
        {"name": "perturbed", "backend": "naive,symmetric", "state": "perturbed"},
    ],
}
POINTS = {"rest": 6, "perturbed": 4}


class study:
    """Conductors of one plan that write to one file, and the processes they start."""

    def __init__(self, folder):
        self.folder, self.out = folder, folder / "rows.jsonl"
        self.plan = folder / "plan.json"
        self.plan.write_text(json.dumps(PLAN))
        self.mark = f"PAIRSUM_TEST_MARK={uuid.uuid4()}"  # their processes inherit it

    def words(self, *more):
        return [BIN / "pairsum", "run", self.plan, "--out", self.out, *more]

    def start(self):
        name, value = self.mark.split("=")
        return subprocess.Popen(self.words(), cwd=self.folder, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                start_new_session=True, env={**os.environ, name: value})

    def run(self):
        process = self.start()
        said, _ = process.communicate(timeout=120)
        return process.returncode, said

    def processes(self):
        """Ids of living processes of these studies."""
        found = []
        for entry in pathlib.Path("/proc").iterdir():
            try:
                marked = entry.name.isdigit() and self.mark.encode() in (entry / "environ").read_bytes()
                if marked and (entry / "stat").read_text().rsplit(")", 1)[1].split()[0] not in "ZX":
                    found.append(int(entry.name))
            except OSError:
                pass  # it has ended meanwhile
        return found

    def rows(self):
        """Whole lines, also while somebody writes."""
        if not self.out.exists():
            return []
        return [json.loads(line) for line in self.out.read_text().split("\n")[:-1]]

    def wait_until(self, fulfilled, process):
        """Until a round is under way that fulfils; the rows then."""
        while process.poll() is None:
            rows = self.rows()
            if rows and rows[-1]["kind"] == "sample" and fulfilled(rows):
                return rows
            time.sleep(0.002)
        raise AssertionError("it ended before: " + process.stdout.read())

    def left_behind(self, within_s=2):
        until = time.monotonic() + within_s
        while self.processes() and time.monotonic() < until:
            time.sleep(0.01)
        return self.processes()


@pytest.fixture
def cut_study(tmp_path):
    s = study(tmp_path)
    yield s
    for pid in s.processes():  # only of a test that failed
        os.kill(pid, signal.SIGKILL)


def of_kind(rows, kind):
    return [row for row in rows if row["kind"] == kind]


def check(rows, replicates=ROUNDS, ends=1):
    """Every row is valid, every replicate there once and whole; returns the design: what was measured in each replicate."""
    for row in rows:
        assert [e.message for e in SCHEMA.iter_errors(row)] == []
    voided = [row["round"] for row in of_kind(rows, "void")]
    rounds = {row["round"]: row for row in of_kind(rows, "round")}
    assert len(rounds) == len(of_kind(rows, "round")) and len(voided) == len(set(voided))
    assert not rounds.keys() & set(voided)
    assert len(of_kind(rows, "end")) == ends
    measured = collections.defaultdict(list)
    for row in of_kind(rows, "sample"):
        assert row["round"] in rounds or row["round"] in voided
        measured[row["round"]].append(row)
    for number in voided:
        assert measured[number], f"round {number} is voided, but has no rows"
    times = collections.Counter((row["part"], row["replicate"]) for row in rounds.values())
    assert times == {(part, k): 1 for part in POINTS for k in range(1, replicates + 1)}
    environments = {row["environment"] for row in of_kind(rows, "environment")}
    design = {}
    for number, row in rounds.items():
        samples = measured[number]
        assert row["rows"] == len(samples) and row["environment"] in environments
        assert {s["part"] for s in samples} == {row["part"]}
        points = {json.dumps(s["point"], sort_keys=True) for s in samples}
        n = POINTS[row["part"]]
        assert len(points) == n
        seen = collections.Counter((json.dumps(s["point"], sort_keys=True), s["repetition"], s["step"]) for s in samples)
        assert seen == {(p, r, t): 1 for p in points for r in (1, 2) for t in (1, 2)}
        slots = collections.Counter((s["repetition"], s["slot"], s["step"]) for s in samples)
        assert slots == {(r, k, t): 1 for r in (1, 2) for k in range(1, n + 1) for t in (1, 2)}
        assert all("error" not in s and s["verify"]["fingerprint"] and s["environment"] in environments for s in samples)
        design[row["part"], row["replicate"]] = frozenset(points), frozenset(slots), row["plan"], row["seed"]
    return design


@pytest.fixture(scope="module")
def uninterrupted(tmp_path_factory):
    """How long it takes until the first round is measured and then for a round, and the design."""
    s = study(tmp_path_factory.mktemp("whole"))
    before = time.monotonic()
    process = s.start()
    s.wait_until(lambda rows: True, process)
    started = time.monotonic() - before
    said, _ = process.communicate(timeout=120)
    assert process.returncode == 0, said
    round_s = (time.monotonic() - before - started) / (ROUNDS * len(POINTS))
    assert not of_kind(s.rows(), "void")
    return started, round_s, check(s.rows())


@pytest.mark.parametrize("seed", [1])
def test_many_kills(cut_study, uninterrupted, seed):
    started, round_s, design = uninterrupted
    draw = random.Random(seed)
    longest = started + 1.5 * round_s  # at most a round or two get through
    kills, ended = 0, False
    while kills < 20 and not ended:
        finished = len(of_kind(cut_study.rows(), "round"))
        process = cut_study.start()
        try:
            process.wait(draw.uniform(0, longest))
            ended = True
        except subprocess.TimeoutExpired:
            process.kill()
            kills += 1
        process.wait()
        assert cut_study.left_behind() == []
        if len(of_kind(cut_study.rows(), "round")) > finished + 2:  # others had slowed the uninterrupted one
            longest /= 2
    assert kills >= 10, "it ended before: " + process.stdout.read()
    if ended:
        assert process.returncode == 0, process.stdout.read()
    else:
        code, said = cut_study.run()
        assert code == 0, said
    rows = cut_study.rows()
    assert check(rows) == design
    assert of_kind(rows, "void"), "no kill hit a round"
    assert rows[-1]["kind"] == "end"


def test_kill_within_a_round(cut_study, uninterrupted):
    process = cut_study.start()
    rows = cut_study.wait_until(lambda rows: len(of_kind(rows, "round")) == 3, process)
    process.kill()
    process.wait()
    assert cut_study.left_behind() == []
    code, said = cut_study.run()
    assert code == 0, said
    assert "resuming" in said and f"3 of {ROUNDS} rest, 0 of {ROUNDS} perturbed" in said
    assert [row["round"] for row in of_kind(cut_study.rows(), "void")] == [rows[-1]["round"]]
    assert check(cut_study.rows()) == uninterrupted[-1]


def test_a_killed_worker_voids_its_round_only(cut_study, uninterrupted):
    process = cut_study.start()
    rows = cut_study.wait_until(lambda rows: len(of_kind(rows, "round")) == 2, process)
    for pid in set(cut_study.processes()) - {process.pid}:
        os.kill(pid, signal.SIGKILL)
    said, _ = process.communicate(timeout=120)
    assert process.returncode == 0, said
    assert f"round {rows[-1]['round']} is voided and measured again" in said and "signal 9" in said
    (void,) = of_kind(cut_study.rows(), "void")
    assert void["round"] == rows[-1]["round"] and "signal 9" in void["reason"]
    assert check(cut_study.rows()) == uninterrupted[-1]


def test_workers_that_always_die_end_the_study(cut_study, uninterrupted):
    process = cut_study.start()
    killed = set()
    while process.poll() is None:
        rows = cut_study.rows()
        if rows and rows[-1]["kind"] == "sample" and rows[-1]["round"] not in killed:
            killed.add(rows[-1]["round"])
            for pid in set(cut_study.processes()) - {process.pid}:
                os.kill(pid, signal.SIGKILL)
        time.sleep(0.002)
    said = process.stdout.read()
    assert process.returncode == 2, said
    assert "given up" in said and not of_kind(cut_study.rows(), "end")
    code, said = cut_study.run()
    assert code == 0, said
    assert check(cut_study.rows()) == uninterrupted[-1]


@pytest.mark.parametrize("whom, number", [("group", signal.SIGINT), ("conductor", signal.SIGINT), ("conductor", signal.SIGTERM)])
def test_interrupt_and_terminate(cut_study, uninterrupted, whom, number):
    process = cut_study.start()
    cut_study.wait_until(lambda rows: len(of_kind(rows, "round")) == 2, process)
    if whom == "group":
        os.killpg(process.pid, number)
    else:
        process.send_signal(number)
    said, _ = process.communicate(timeout=30)
    assert process.returncode == 130, said
    assert "ns/pair" in said  # the table of what is there
    assert "interrupted; 2 finished rounds are kept\n" in said
    assert said.endswith(f"to go on:\n  {BIN / 'pairsum'} run {cut_study.plan} --out {cut_study.out}\n")
    assert cut_study.left_behind() == []
    rows = cut_study.rows()
    assert not of_kind(rows, "end") and len(of_kind(rows, "round")) < 2 * ROUNDS
    for row in rows:
        assert [e.message for e in SCHEMA.iter_errors(row)] == []
    rounds = {row["round"] for kind in ("round", "void") for row in of_kind(rows, kind)}
    assert {row["round"] for row in of_kind(rows, "sample")} == rounds  # what was cut is voided already
    code, said = cut_study.run()
    assert code == 0, said
    assert "resuming" in said
    assert check(cut_study.rows()) == uninterrupted[-1]


def test_an_ended_study_is_measured_once_more(cut_study, uninterrupted):
    for _ in range(2):
        code, said = cut_study.run()
        assert code == 0, said
        assert "resuming" not in said
    twice = check(cut_study.rows(), replicates=2 * ROUNDS, ends=2)
    assert {key: twice[key] for key in uninterrupted[-1]} == uninterrupted[-1]


def test_fresh_refuses_a_file_that_is_there(pairsum, cut_study):
    cut_study.out.write_text("mine")
    assert refused(pairsum(*cut_study.words("--fresh")[1:]), "--fresh", "rows.jsonl")
    assert cut_study.out.read_text() == "mine"


def test_two_runs_do_not_write_one_file(pairsum, cut_study, uninterrupted):
    process = cut_study.start()
    cut_study.wait_until(lambda rows: True, process)
    assert refused(pairsum(*cut_study.words()[1:]), "being written", "rows.jsonl")
    assert refused(pairsum("run", "--dx", "0.08", "--M", "3", "--rounds", "1", "--out", cut_study.out), "being written")
    assert process.poll() is None, "it ended too early for this test"
    said, _ = process.communicate(timeout=120)
    assert process.returncode == 0, said
    assert check(cut_study.rows()) == uninterrupted[-1]


def test_another_plan_in_the_same_file_counts_for_itself(cut_study):
    code, said = cut_study.run()
    assert code == 0, said
    before = len(cut_study.rows())
    cut_study.plan.write_text(json.dumps({**PLAN, "seed": 7}))
    code, said = cut_study.run()
    assert code == 0, said
    rounds = of_kind(cut_study.rows()[before:], "round")
    assert len(rounds) == 2 * ROUNDS and {row["seed"] for row in rounds} == {7}
    everything = [row["round"] for row in of_kind(cut_study.rows(), "round")]
    assert len(everything) == len(set(everything))
