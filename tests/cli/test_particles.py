"""Particles of files go wherever a case goes."""

import json
import shlex

import pytest
from conftest import BIN, refused

h5py = pytest.importorskip("h5py", reason="python3-h5py is not installed")
SMALL = ["--M", "3", "--threads", "1", "--steps", "1"]


@pytest.fixture
def file(pairsum, tmp_path):
    """A snapshot of water that flows."""
    done = pairsum("simulate", "--dx", "0.08", "--until", "0.02", "--every", "0.02", "--threads", "1", "--snapshots", "made")
    assert done.returncode == 0, done.stderr
    return (tmp_path / "made/snapshot_0001.hdf").rename(tmp_path / "own water.hdf")


def rows_of(path):
    return [json.loads(line) for line in path.read_text().splitlines()]


def test_run_measures_them_and_says_where_they_are_from(pairsum, file, tmp_path):
    words = ["run", "--particles", file, *SMALL, "--rounds", "1", "--out", "rows.jsonl"]
    done = pairsum(*words)
    assert done.returncode == 0, done.stderr
    assert "own water.hdf  read  hdf5, gadget" in done.stdout
    rows = rows_of(tmp_path / "rows.jsonl")
    (particles,) = [r for r in rows if r["kind"] == "particles"]
    samples = [r for r in rows if r["kind"] == "sample"]
    assert particles["files"] == [str(file)]
    assert {s["point"]["particles"] for s in samples} == {particles["particles"]}
    assert {(s["point"]["case"], s["point"]["state"]) for s in samples} == {("file", "read")}
    with h5py.File(file) as made:
        kinds = made["PartType0/Kind"][()]
    assert {s["point"]["n_fluid"] for s in samples} == {(kinds == 0).sum()}
    report = pairsum("report", "rows.jsonl")
    assert report.returncode == 0, report.stderr
    (command,) = [line for line in report.stdout.splitlines() if "pairsum run" in line]
    given = shlex.split(command)
    assert given[given.index("--particles") + 1] == str(file)


def test_hints_change_what_is_measured_and_stand_in_the_command(pairsum, file, tmp_path):
    done = pairsum("run", "--particles", file, "--H", "0.2", "--boundary-kind", "none", *SMALL, "--rounds", "1", "--out", "r.jsonl")
    assert done.returncode == 0, done.stderr
    point = [r for r in rows_of(tmp_path / "r.jsonl") if r["kind"] == "sample"][0]["point"]
    assert (point["H"], point["n_boundary"]) == (0.2, 0)
    report = pairsum("report", "r.jsonl")
    assert "--H 0.2" in report.stdout and "--boundary-kind none" in report.stdout


def test_plans_name_them(pairsum, file, tmp_path):
    plan = {"schema": "pairsum.plan/1", "study": "own", "title": "particles of a file",
            "defaults": {"particles": str(file), "M": 3, "threads": 1, "steps": 1, "rounds": 1, "backend": "naive,symmetric"},
            "parts": [{"name": "as_read"}, {"name": "wider", "H": 0.25}]}
    (tmp_path / "plan.json").write_text(json.dumps(plan))
    done = pairsum("run", "./plan.json", "--out", "rows.jsonl")
    assert done.returncode == 0, done.stderr
    points = [r["point"] for r in rows_of(tmp_path / "rows.jsonl") if r["kind"] == "sample"]
    assert len({p["particles"] for p in points}) == 2 and {p["H"] for p in points} == {0.16, 0.25}


def test_verify_and_tune_take_them(pairsum, file, tmp_path):
    done = pairsum("verify", "--particles", file, "--backend", "symmetric,naive", "--M", "3", "--threads", "1", "--interaction",
                   "count,ferrari09", "--isa", "scalar")
    assert done.returncode == 0 and "file 3D" in done.stdout, done.stdout + done.stderr
    done = pairsum("tune", "--particles", file, "--backend", "naive,symmetric", "--grid", "compact_grid", "--threads", "1",
                   "--budget", "3")
    assert done.returncode == 0, done.stderr
    assert json.loads((tmp_path / "tune.profile.json").read_text())["case"]["particles"] == [str(file)]
    done = pairsum("run", "--profile", "tune.profile.json", "--rounds", "1", "--out", "again.jsonl")
    assert done.returncode == 0, done.stderr


def test_numbers_of_a_box_may_be_the_same(pairsum, tmp_path):
    (tmp_path / "two.csv").write_text("x,y,z,rho,m\n0.1,0.5,0.5,1,1\n0.9,0.5,0.5,1,1\n0.5,0.1,0.9,1,1\n")
    for box in ("1,1,1", "0,0,0,1,1,1"):
        done = pairsum("info", "two.csv", "--H", "0.25", "--periodic", "all", "--box", box, "--json")
        assert done.returncode == 0, done.stderr
        told = json.loads(done.stdout)
        assert told["box"] == {"low": [0, 0, 0], "high": [1, 1, 1]} and told["pairs"] == 1


def test_a_profile_takes_other_words(pairsum, file, tmp_path):
    done = pairsum("tune", "--particles", file, "--backend", "naive", "--grid", "compact_grid", "--threads", "1", "--budget", "2")
    assert done.returncode == 0, done.stderr
    done = pairsum("run", "--profile", "tune.profile.json", "--H", "0.2", "--rounds", "1", "--out", "wider.jsonl")
    assert done.returncode == 0, done.stderr
    assert {r["point"]["H"] for r in rows_of(tmp_path / "wider.jsonl") if r["kind"] == "sample"} == {0.2}


def test_states_of_files(pairsum, file, tmp_path):
    done = pairsum("run", "--particles", file, "--state", "read,perturbed", *SMALL, "--rounds", "1", "--out", "states.jsonl")
    assert done.returncode == 0, done.stderr
    assert {r["point"]["state"] for r in rows_of(tmp_path / "states.jsonl") if r["kind"] == "sample"} == {"read", "perturbed"}
    assert refused(pairsum("run", "--particles", file, "--state", "evolved:1", *SMALL), "read, perturbed")


def test_bench_takes_them(pairsum, file):
    if not (BIN / "pairsum_bench").exists():
        pytest.skip("no pairsum_bench in this build")
    done = pairsum("--particles", file, "--threads", "1", "--grid", "compact_grid", "--benchmark_filter=^symmetric/",
                   "--benchmark_min_time=0.001", program="pairsum_bench")
    assert done.returncode == 0 and "symmetric/file/compact_grid/threads:1" in done.stdout, done.stderr


def test_simulate_takes_them(pairsum, file, tmp_path):
    done = pairsum("simulate", "--particles", file, "--until", "0.01", "--every", "0.01", "--threads", "1", "--snapshots", "more")
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "more/snapshot_0001.hdf").exists()


def test_a_file_that_changes_is_noticed(pairsum, file, tmp_path):
    shown = pairsum("run", "--particles", file, *SMALL, "--show-plan")
    plan = json.loads(shown.stdout[shown.stdout.index("{"):])
    (tmp_path / "plan.json").write_text(json.dumps(plan))
    assert plan["parts"][0]["particles_hash"]
    with h5py.File(file, "a") as made:
        made["PartType0/Density"][0] += 1
    assert refused(pairsum("run", "./plan.json"), "own water.hdf", "other particles")


@pytest.mark.parametrize("words, says", [
    (["--particles", "none.hdf"], ["none.hdf"]),
    (["--particles", "FILE", "--dx", "0.1"], ["--dx", "--particles"]),
    (["--particles", "FILE", "--case", "lattice"], ["--case", "--particles"]),
    (["--particles", "FILE", "--periodic", "x,q"], ["--periodic", "x,q"]),
    (["--particles", "FILE", "--support", "wide"], ["--support", "wide"]),
    (["--particles", "FILE", "--column", "x"], ["--column", "x=Points:0"]),
    (["--periodic", "x"], ["--periodic", "--particles"]),
])
def test_refusals(pairsum, file, words, says):
    assert refused(pairsum("run", *[file if w == "FILE" else w for w in words], *SMALL), *says)


@pytest.mark.parametrize("words", [["run", "--rounds", "1", "--steps", "1", "--out", "rows.jsonl"],
                                   ["verify", "--interaction", "count", "--isa", "scalar", "--grid", "compact_grid"]],
                         ids=["run", "verify"])
def test_all_backends_leave_out_those_whose_skin_a_narrow_box_has_no_room_for(pairsum, words):
    words = [*words, "--case", "periodic_lattice", "--dim", "3", "--dx", "0.1", "--threads", "1"]
    if words[0] == "run":
        words += ["--grid", "compact_grid"]
    done = pairsum(*words, "--backend", "all", "--H", "0.32")
    assert done.returncode == 0, done.stderr
    assert "left out: verlet_list, verlet_list_tbb; the periodic box has no three cells of H and their skin" in done.stdout
    wide = pairsum(*words, "--backend", "all", "--H", "0.3", *(["--dry-run"] if words[0] == "run" else []))
    assert wide.returncode == 0 and "left out: verlet" not in wide.stdout
    assert refused(pairsum(*words, "--backend", "naive,verlet_list", "--H", "0.32"), "skin")


@pytest.mark.parametrize("program, words", [
    ("pairsum", ["run", "--rounds", "1", "--steps", "1", "--out", "rows.jsonl", "--isa", "best", "--backend", "all"]),
    ("pairsum", ["run", "--dry-run", "--backend", "all"]),
    ("pairsum", ["tune", "--budget", "2", "--isa", "scalar"]),
    ("pairsum_bench", ["--benchmark_filter=symmetric_omp", "--benchmark_min_time=0.001"])],
    ids=["run", "dry run", "tune", "bench"])
def test_what_takes_all_backends_takes_them_in_a_narrow_box(pairsum, program, words):
    done = pairsum(*words, "--case", "periodic_lattice", "--dx", "0.1", "--threads", "1", "--grid", "compact_grid", "--H", "0.32",
                   program=program)
    assert done.returncode == 0, done.stderr
    assert "verlet_list " not in done.stdout.replace("left out: verlet_list", "")
