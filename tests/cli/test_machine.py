"""The machine as a job sees it, threads that are not given, particles that leave."""

import json
import os
import re
import resource
import subprocess

import pytest

from conftest import BIN, refused

CORES = len(os.sched_getaffinity(0))
SMALL = ["--dx", "0.08", "--M", "3", "--steps", "2", "--rounds", "1"]
EVERY = [*SMALL, "--threads", "all", "--backend", "naive_omp"]
TWO = ["--dx", "0.1", "--M", "2", "--threads", "2"]
LIMITED = [  # every way to a parallel sum
    ("pairsum", ["run", *TWO, "--backend", "naive_omp", "--rounds", "1"]),
    ("pairsum", ["run", *TWO, "--backend", "naive_tbb", "--rounds", "1"]),
    ("pairsum", ["verify", *TWO, "--dim", "3", "--backend", "naive_omp"]),
    ("pairsum", ["tune", *TWO, "--backend", "naive_omp", "--grid", "hashed_grid"]),
    ("pairsum_bench", [*TWO, "--benchmark_filter=^naive_omp"]),
]
two_cores = pytest.mark.skipif(CORES < 2, reason="one core")


def environment(path):
    return next(row for row in map(json.loads, path.read_text().splitlines()) if row["kind"] == "environment")


def samples(path):
    return [row for row in map(json.loads, path.read_text().splitlines()) if row["kind"] == "sample"]


@two_cores
@pytest.mark.parametrize("name, value", [("OMP_PROC_BIND", "true"), ("OMP_PLACES", "cores"), ("OMP_PLACES", "{0}"), ("GOMP_CPU_AFFINITY", "0")])
def test_what_pins_the_first_thread_hides_no_core(pairsum, tmp_path, monkeypatch, name, value):
    monkeypatch.setenv(name, value)
    done = pairsum("run", *EVERY, "--out", "rows.jsonl")
    assert done.returncode == 0, done.stderr
    seen = environment(tmp_path / "rows.jsonl")
    assert seen["cores"] == CORES
    assert sorted(map(int, seen["binding"].removeprefix("cores_first ").split(","))) == sorted(os.sched_getaffinity(0))
    assert {s["point"]["threads"] for s in samples(tmp_path / "rows.jsonl")} >= {1, CORES}


@two_cores
def test_rows_say_who_pins_threads(pairsum, tmp_path, monkeypatch):
    said = []
    for name, value in (("OMP_PROC_BIND", "false"), ("OMP_PROC_BIND", "true"), ("GOMP_CPU_AFFINITY", "0")):
        monkeypatch.setenv(name, value)
        assert pairsum("run", *EVERY, "--binding", "none", "--out", f"{name}={value}.jsonl").returncode == 0
        said.append(environment(tmp_path / f"{name}={value}.jsonl")["binding"])
        monkeypatch.delenv(name)
    assert said == ["none", "none: left to OMP_PROC_BIND", "none: left to GOMP_CPU_AFFINITY"]


@two_cores
@pytest.mark.parametrize("name, value", [("OMP_PROC_BIND", "false"), ("GOMP_CPU_AFFINITY", "0")])
def test_bench_pins_threads_as_run_does_and_says_so(pairsum, monkeypatch, name, value):
    monkeypatch.setenv(name, value)
    words = [*TWO, "--benchmark_filter=^naive_omp", "--benchmark_min_time=0.01", "--benchmark_format=json"]
    said = json.loads(pairsum(*words, program="pairsum_bench").stdout)["context"]["binding"]
    assert sorted(map(int, said.removeprefix("cores_first ").split(","))) == sorted(os.sched_getaffinity(0))
    said = json.loads(pairsum(*words, "--binding", "none", program="pairsum_bench").stdout)["context"]["binding"]
    assert said == ("none" if name == "OMP_PROC_BIND" else "none: left to GOMP_CPU_AFFINITY")


@two_cores
@pytest.mark.parametrize("pinned", [{}, {"OMP_PROC_BIND": "true"}])
def test_taskset_holds(tmp_path, pinned):
    last = max(os.sched_getaffinity(0))
    words = ["taskset", "-c", str(last), BIN / "pairsum", "run", *EVERY, "--out", "rows.jsonl"]
    done = subprocess.run(words, cwd=tmp_path, text=True, capture_output=True, timeout=300, env=os.environ | pinned)
    assert done.returncode == 0, done.stderr
    seen = environment(tmp_path / "rows.jsonl")
    assert (seen["cores"], seen["binding"]) == (1, f"cores_first {last}")


@pytest.mark.parametrize("program, words", [("pairsum", ["run", *SMALL]), ("pairsum", ["tune", "--dx", "0.08"]), ("pairsum_bench", ["--dx", "0.08"])])
def test_more_threads_than_the_machine_has_are_refused(pairsum, program, words):
    done = pairsum(*words, "--threads", CORES + 1, program=program)
    assert refused(done, f"{CORES + 1} threads on {CORES} core", "--oversubscribe")


def test_a_dry_run_says_that_they_would_be_refused(pairsum):
    words = ["run", *SMALL, "--threads", CORES + 1, "--dry-run"]
    assert f"it would be refused: {CORES + 1} threads on" in pairsum(*words).stdout
    assert "refused" not in pairsum(*words, "--oversubscribe").stdout


def test_more_threads_than_the_machine_has_are_measured_if_that_is_wanted(pairsum, tmp_path):
    done = pairsum("run", *SMALL, "--threads", CORES + 1, "--backend", "naive_omp,naive_tbb", "--oversubscribe", "--out", "rows.jsonl")
    assert done.returncode == 0, done.stderr
    assert f"note: {CORES + 1} threads on {CORES} core" in done.stdout and " --oversubscribe" in done.stdout
    serial = pairsum("run", *SMALL, "--threads", CORES + 1, "--backend", "naive")
    assert serial.returncode == 0, "a serial backend has one thread, whatever is asked for"


@two_cores
@pytest.mark.parametrize("words", [["run", "--rounds", "1", "--steps", "1", "--out", "rows.jsonl"], ["tune", "--budget", "5"]], ids=lambda w: w[0])
def test_one_thread_is_given_where_openmp_gives_one(pairsum, monkeypatch, words):
    """The reference takes no more, either."""
    monkeypatch.setenv("OMP_THREAD_LIMIT", "1")
    done = pairsum(*words, "--dx", "0.08", "--M", "5", "--backend", "naive,naive_omp", "--threads", "1")
    assert done.returncode == 0, done.stderr


@two_cores
@pytest.mark.parametrize("program, words", [w for w in LIMITED if "naive_tbb" not in w[1]])
@pytest.mark.parametrize("name, value", [("OMP_THREAD_LIMIT", "1"), ("OMP_MAX_ACTIVE_LEVELS", "0")])
def test_threads_that_openmp_does_not_give_are_an_error(pairsum, monkeypatch, program, words, name, value):
    monkeypatch.setenv(name, value)
    done = pairsum(*words, program=program)
    assert done.returncode == 2, done.stdout
    assert "OpenMP gave 1 of 2 threads" in done.stderr and name in done.stderr


LIMITED_TO_1_GIB = """
group=/sys/fs/cgroup/memory
[[ -d $group ]] || group=/sys/fs/cgroup
mount -t tmpfs none "$group" || exit 77
echo 1073741824 | tee "$group/memory.max" >"$group/memory.limit_in_bytes"
exec "$@"
"""


@pytest.mark.skipif(os.getuid() != 0, reason="mounts, which only root may")
@pytest.mark.parametrize("words", [["run", "--steps", "1"], ["run", "--dry-run"], ["verify", "--dim", "3"], ["tune"]], ids=" ".join)
def test_what_takes_more_memory_than_the_job_has_is_refused(tmp_path, words):
    start = {"cwd": tmp_path, "text": True, "capture_output": True, "timeout": 300}
    words = [BIN / "pairsum", *words, "--dx", "0.004", "--M", "6", "--threads", "1", "--backend", "naive"]
    done = subprocess.run(["unshare", "-m", "bash", "-c", LIMITED_TO_1_GIB, "-", *words], **start)
    if done.returncode == 77 or "unshare" in done.stderr:
        pytest.skip("no mount of one's own here")
    assert refused(done, "dam_break with dx = 0.004 would take about 2 GiB of memory, this machine has 1 GiB for this job; a larger dx takes less")
    assert not list(tmp_path.iterdir())


@two_cores
@pytest.mark.skipif(os.getuid() != 0, reason="becomes a user of its own, who has no other processes")
@pytest.mark.parametrize("program, words", LIMITED)
def test_threads_that_the_system_does_not_give_are_an_error(tmp_path, program, words):
    user = 54321
    os.chmod(tmp_path, 0o777)

    def few_processes():
        most = 2 if words[0] == "run" else 1  # a study has a process of its own for each step
        resource.setrlimit(resource.RLIMIT_NPROC, (most, most))
        os.setuid(user)

    start = {"cwd": tmp_path, "text": True, "capture_output": True, "timeout": 300}
    try:
        subprocess.run([BIN / program, "--help"], **start, preexec_fn=lambda: os.setuid(user))
    except PermissionError:
        pytest.skip("the program lies where other users cannot read")
    done = subprocess.run([BIN / program, *words], **start, preexec_fn=few_processes)
    assert done.returncode == 2, (done.stdout, done.stderr)
    assert "the system gives 1 of 2 threads" in done.stderr and "ulimit -u" in done.stderr


FLYING = ["run", "--dx", "0.08", "--backend", "naive_omp,symmetric_omp", "--M", "5", "--threads", "1", "--rounds", "1", "--dt", "0.05",
          "--steps", "12", "--out", "rows.jsonl"]


def test_a_point_whose_particles_leave_gets_no_time(pairsum, tmp_path):
    done = pairsum(*FLYING)
    assert done.returncode == 1
    assert "gets no time: step 4: particle 0 and 67 more left Omega: dt is too large (0.05 s)" in done.stdout
    assert "--outside drop" in done.stdout and "fastest" not in done.stdout
    rows = samples(tmp_path / "rows.jsonl")
    assert len(rows) == 2 and all(row["phases"] is None and "left Omega" in row["error"] for row in rows)


def test_particles_that_may_leave_are_counted_wherever_times_stand(pairsum, tmp_path):
    done = pairsum(*FLYING, "--outside", "drop")
    assert done.returncode == 0, done.stderr
    steps = [row for row in samples(tmp_path / "rows.jsonl") if row["point"]["backend"] == "naive_omp"]
    assert [row["lost"] for row in steps[:4]] == [0, 0, 0, 68] and sum(row["lost"] for row in steps) == 216
    assert "naive_omp lost 216 of 216 fluid particles" in done.stdout
    line = next(line for line in done.stdout.splitlines() if line.startswith("naive_omp ") and "lost" not in line and "(" not in line)
    assert line.split()[-1] == "-", "no time per pair: the steps have different pairs"
    assert pairsum("report", "--tables", "rows.jsonl", "--out", "report").returncode == 0
    assert "naive_omp M=5 threads=1 (216 of 216 fluid particles)" in (tmp_path / "report" / "tables.txt").read_text()


@pytest.mark.parametrize("dt, step", [("0.01", 10), ("1e308", 2)])
def test_a_state_that_is_no_longer_finite_is_named(pairsum, dt, step):
    done = pairsum("run", "--case", "periodic_lattice", "--dx", "0.1", "--state", "perturbed", "--dt", dt, "--steps", 12, "--M", 2,
                   "--threads", 1, "--rounds", 1, "--backend", "naive")
    assert done.returncode == 1
    assert f"gets no time: step {step}: " in done.stdout and " of particle " in done.stdout
    assert "is not finite" in done.stdout and "dt is too large" in done.stdout
    assert "nan" not in done.stdout and "FAILED its verification" not in done.stdout


@pytest.mark.parametrize("dim", [1, 2])
@pytest.mark.parametrize("dt", ["0.01", "1e308"])
def test_states_of_fewer_dimensions_are_named_too(pairsum, dim, dt):
    if dim not in json.loads(pairsum("list", "--json").stdout)["dims"]:
        pytest.skip(f"{dim}D is not built")
    done = pairsum("run", "--case", "periodic_lattice", "--dim", dim, "--dx", "0.02", "--state", "perturbed", "--dt", dt, "--steps", 50, "--M", 4,
                   "--threads", 1, "--rounds", 1, "--backend", "naive")
    assert done.returncode == 1
    assert re.search(r"gets no time: step \d+: .* of particle \d+.* is not finite.*: dt is too large", done.stdout), done.stdout
    assert "nan" not in done.stdout and "FAILED its verification" not in done.stdout
