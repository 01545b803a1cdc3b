"""Sums over the ranks of an MPI job, as a user meets them."""

import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import time

import jsonschema
import pytest
from conftest import BIN, refused

SOURCE = pathlib.Path(os.environ["PAIRSUM_SOURCE"])
SCHEMA = jsonschema.Draft7Validator(json.loads((SOURCE / "harness/rows/row.schema.json").read_text()))
ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
SMALL = ["--dx", "0.08", "--M", "3", "--threads", "1", "--steps", "2", "--rounds", "1", "--oversubscribe"]


def built():
    done = subprocess.run([BIN / "pairsum", "run", "--ranks", "2", "--dx", "0.08", "--launcher", "/no/launcher", "--out",
                           "/dev/null"], text=True, capture_output=True, timeout=60)
    return "PAIRSUM_RANKS" not in done.stderr


BUILT = built()
with_ranks = pytest.mark.skipif(not BUILT or not shutil.which("mpirun"),
                                reason="needs a build with PAIRSUM_RANKS=ON, and mpirun")


@pytest.fixture
def call(tmp_path):
    """Calls pairsum, or a launcher with it, in an empty folder."""

    def run(*words, before=()):
        return subprocess.run([*before, BIN / "pairsum", *map(str, words)], cwd=tmp_path, text=True, capture_output=True,
                              timeout=120, env=ENVIRONMENT)

    return run


def rows_of(path, kind="sample"):
    rows = [json.loads(line) for line in path.read_text().splitlines()]
    for row in rows:
        assert [e.message for e in SCHEMA.iter_errors(row)] == []
    return [row for row in rows if row["kind"] == kind]


@pytest.mark.skipif(BUILT, reason="is about builds without ranks")
def test_a_build_without_ranks_names_the_option(call):
    assert refused(call("run", "--ranks", 2, "--dx", 0.08), "PAIRSUM_RANKS=ON")
    assert refused(call("verify", "--ranks", 2), "PAIRSUM_RANKS=ON")
    assert refused(call("simulate", "--ranks", 2, "--threads", 1, "--oversubscribe"), "PAIRSUM_RANKS=ON")


@with_ranks
def test_ranks_are_measured_in_the_rounds_of_one_rank(call, tmp_path):
    done = call("run", *SMALL, "--ranks", "1,2", "--cut", "twice,once", "--out", "rows.jsonl")
    assert done.returncode == 0, done.stderr
    samples, (closing,) = rows_of(tmp_path / "rows.jsonl"), rows_of(tmp_path / "rows.jsonl", "round")
    assert closing["rows"] == len(samples)
    points = {(s["point"]["backend"], s["point"]["ranks"], s["point"].get("cut")) for s in samples}
    assert points == {("naive_omp", 1, None), ("naive_omp", 2, "twice"), ("symmetric_omp", 1, None),
                      ("symmetric_omp", 2, "twice"), ("symmetric_omp", 2, "once")}
    counted = {s["work"]["pairs_interacting"] for s in samples if s["work"]}
    assert len(counted) == 1
    for s in samples:
        if s["point"]["ranks"] == 1:
            assert "ranks" not in s
            continue
        ranks, (pairs,) = s["ranks"], counted
        assert len(ranks) == 2 and sum(r["own"] for r in ranks) == s["point"]["n_fluid"]
        cut = {r["cut"] for r in ranks} if s["point"]["cut"] == "twice" else {sum(r["cut"] for r in ranks)}
        assert len(cut) == 1 and cut != {0}
        summed = sum(r["pairs"] for r in ranks) - (cut.pop() if s["point"]["cut"] == "twice" else 0)
        assert summed == pairs
        assert all(r["ghosts"] > 0 and r["halo"]["messages"] == 1 for r in ranks)
        sends = s["point"]["cut"] == "once"
        assert all((r["send_back"]["messages"] > 0) == sends for r in ranks)
        assert "error" not in s and s["verify"]["max_rel_err"] <= s["verify"]["bound"]
        if s["phases"]:
            assert max(r["busy_s"] for r in ranks) == s["phases"]["sum_s"]
            assert {r["cores"] for r in ranks} == {"0", "1"} or len({r["cores"] for r in ranks}) == 2


@with_ranks
def test_ranks_on_too_few_cores_are_counted_and_not_timed(call, tmp_path):
    ranks = len(os.sched_getaffinity(0)) + 1
    words = ["run", *SMALL, "--backend", "symmetric_omp", "--ranks", f"1,{ranks}", "--out", "rows.jsonl"]
    assert refused(call(*[w for w in words if w != "--oversubscribe"]), f"{ranks} threads", "--oversubscribe")
    assert not (tmp_path / "rows.jsonl").exists()
    done = call(*words)
    assert done.returncode == 0, done.stderr
    assert "gets no times" in done.stdout
    samples = rows_of(tmp_path / "rows.jsonl")
    for s in samples:
        assert (s["phases"] is None) == (s["point"]["ranks"] == ranks) == ("untimed" in s)
        assert s["verify"]["fingerprint"]
    assert f"{ranks} ranks with 1 thread each" in next(s["untimed"] for s in samples if "untimed" in s)
    assert len({s["work"]["pairs_interacting"] for s in samples if s["work"]}) == 1
    report = call("report", "--tables", "rows.jsonl", "--out", "report")
    assert report.returncode == 0, report.stderr
    assert f"ranks={ranks} twice has no times" in (tmp_path / "report" / "tables.txt").read_text()


@with_ranks
def test_a_report_tells_ranks_apart(call, tmp_path):
    if len(os.sched_getaffinity(0)) < 2:
        pytest.skip("times of two ranks need two cores")
    assert call("run", *SMALL, "--backend", "naive", "--ranks", "1,2", "--out", "rows.jsonl").returncode == 0
    report = call("report", "--tables", "rows.jsonl", "--out", "report")
    assert report.returncode == 0, report.stderr
    text = (tmp_path / "report" / "tables.txt").read_text()
    assert len(re.findall(r"^== dam_break.*2 ranks, pairs across them twice", text, re.M)) == 1
    assert len(re.findall("^== dam_break", text, re.M)) == 2
    header, *lines = (tmp_path / "report" / "rounds.csv").read_text().splitlines()
    columns = header.split(",")
    assert [(line.split(",")[columns.index("ranks")], line.split(",")[columns.index("cut")]) for line in lines] == [
        ("1", "none"), ("2", "twice")]


@with_ranks
def test_verify_sums_over_ranks(call):
    done = call("verify", "--ranks", 3, "--dx", 0.1, "--M", 3, "--grid", "hashed_grid", "--threads", "1,2", "--backend",
                "symmetric_omp,naive", "--interaction", "ferrari09,count", "--dim", 3, "--precision", "double",
                "--smoothing", "wendland_c2", "--isa", "scalar", "--cut", "twice,once", "--json")
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    jsonschema.Draft7Validator(json.loads((SOURCE / "harness/cli/verify.schema.json").read_text())).validate(found)
    sums = found["worlds"][0]["sums"]
    assert {s["ranks"] for s in sums} == {3} and {s["cut"] for s in sums} == {"twice", "once"}
    assert found["failed"] == 0 and len(sums) == 10


@with_ranks
def test_simulate_steps_as_on_one_rank(call):
    words = ["simulate", "--dx", 0.1, "--until", 0.02, "--threads", 1, "--oversubscribe"]
    one, two = call(*words), call(*words, "--ranks", 2, "--cut", "once")
    assert one.returncode == two.returncode == 0, two.stderr
    moments = [[line for line in done.stdout.splitlines() if line.startswith("    ")] for done in (one, two)]
    assert len(moments[0]) > 10 and moments[0] == moments[1]
    assert refused(call("simulate", "--ranks", "1,2"), "--ranks names 2")


@with_ranks
def test_a_job_that_somebody_else_started(call, tmp_path):
    outer = ["mpirun", "--oversubscribe", "-n", "2"]
    done = call("run", *SMALL, "--backend", "naive", "--out", "rows.jsonl", before=outer)
    assert done.returncode == 0, done.stderr
    samples = rows_of(tmp_path / "rows.jsonl")
    assert {s["point"]["ranks"] for s in samples} == {2} and len(samples) == 2
    assert done.stdout.count("rows: rows.jsonl") == 1
    assert "  mpirun -n 2 " in done.stdout


@with_ranks
def test_what_starts_no_job_is_named(call, tmp_path):
    words = ["run", *SMALL, "--ranks", 2, "--out", "rows.jsonl", "--launcher"]
    assert refused(call(*words, "no_such_launcher"), "no_such_launcher is no program", "--launcher")
    assert refused(call(*words, "false"), "false started no rank of 2")
    assert refused(call(*words, ""), "--launcher takes the words")


@with_ranks
def test_an_error_of_one_rank_ends_all_with_one_line():
    """Only the second knows no such command; the first waits for its order."""
    pairsum = BIN / "pairsum"
    begin = time.monotonic()
    done = subprocess.run(["mpirun", "--oversubscribe", "-n", "1", pairsum, "job", "worker", "--", "-1", ":", "-n", "1",
                           pairsum, "job", "nonsense"], text=True, capture_output=True, stdin=subprocess.DEVNULL,
                          timeout=60, env=ENVIRONMENT)
    assert done.returncode == 2 and time.monotonic() - begin < 30
    lines = [line for line in done.stderr.splitlines() if line.startswith("pairsum: ")]
    assert len(lines) == 1 and lines[0].startswith('pairsum: rank 1: unknown command "nonsense"'), done.stderr


def children(parent):
    """Ids of the processes below one."""
    below = {}
    for entry in pathlib.Path("/proc").iterdir():
        try:
            if entry.name.isdigit():
                below.setdefault(int((entry / "stat").read_text().rsplit(")", 1)[1].split()[1]), []).append(int(entry.name))
        except OSError:
            pass  # it has ended meanwhile
    found, todo = [], [parent]
    while todo:
        found += below.get(todo[0], [])
        todo += below.get(todo.pop(0), [])
    return found


def is_rank(pid):
    try:
        return (pathlib.Path("/proc") / str(pid) / "cmdline").read_bytes().split(b"\0")[1:2] == [b"job"]
    except OSError:
        return False


@with_ranks
def test_a_killed_rank_voids_its_round_and_what_is_finished_is_kept(tmp_path):
    out = tmp_path / "rows.jsonl"
    words = [BIN / "pairsum", "run", "--dx", "0.06", "--M", "3", "--threads", "1", "--steps", "10", "--rounds", "3",
             "--oversubscribe", "--backend", "naive", "--ranks", "2", "--out", out]

    def rows():
        return [json.loads(line) for line in out.read_text().split("\n")[:-1]] if out.exists() else []

    study = subprocess.Popen([*map(str, words)], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, env=ENVIRONMENT)
    while study.poll() is None:
        ranks = [pid for pid in children(study.pid) if is_rank(pid)]
        if len(ranks) == 2 and any(row["kind"] == "round" for row in rows()):
            os.kill(ranks[-1], signal.SIGKILL)
            begin = time.monotonic()
            while any(map(is_rank, ranks)) and time.monotonic() < begin + 20:
                time.sleep(0.01)
            assert time.monotonic() - begin < 10, "the other rank outlives it"
        time.sleep(0.002)
    said = study.communicate()[0]
    assert study.returncode == 2 and "given up: it was killed 3 times in a row" in said, said
    assert said.count("is voided and measured again: its process was ended by signal 9") == 3, said
    assert [row["round"] for row in rows() if row["kind"] == "round"] == [1]
    again = subprocess.run([*map(str, words)], text=True, capture_output=True, env=ENVIRONMENT, timeout=120)
    assert again.returncode == 0 and "rounds there: 1 of 3 run" in again.stdout, again.stdout + again.stderr
    closed = rows_of(out, "round")
    assert [row["replicate"] for row in closed] == [1, 2, 3] and len(rows_of(out, "void")) <= 3
    assert len(rows_of(out, "end")) == 1
