"""What the programs print and write when all is well."""

import csv
import json
import os
import pathlib
import re
import signal
import subprocess
import time

import jsonschema
import pytest
from conftest import BIN, SMALL

SOURCE = pathlib.Path(os.environ["PAIRSUM_SOURCE"])


@pytest.fixture
def listed(pairsum):
    """What `pairsum list --json` says was built."""
    return json.loads(pairsum("list", "--json").stdout)


@pytest.fixture
def backends(listed):
    names = [b["name"] for b in listed["backends"] if b["unavailable"] is None]
    assert {"naive", "naive_omp", "symmetric", "symmetric_omp"} <= set(names)
    return names


def number_of_sums(listed, M, threads):
    """How many sums `verify` makes: serial backends once, the others with each number of threads; grids that take no M
    once, every backend in the precisions that it has; each scalar and on the best vector units, where it has both."""
    def ways(b, f):
        both = listed["isas"] and f["smoothing"] and f["precision"] != "mixed" and b["conflicts"] != "atomics"
        return (f["precision"] in b["precisions"]) * (2 if both else 1)

    runs = sum((1 if b["runtime"] == "serial" else threads) * sum(ways(b, f) for f in listed["formulas"])
               for b in listed["backends"] if b["unavailable"] is None)
    return (len(listed["grids"]) + (M - 1) * len(listed["grids_with_M"])) * runs


def schema_errors(path):
    validator = jsonschema.Draft7Validator(json.loads((SOURCE / "harness/rows/row.schema.json").read_text()))
    return [e.message for line in path.read_text().splitlines() for e in validator.iter_errors(json.loads(line))]


def test_version_names_revision_compiler_and_flags(pairsum):
    done = pairsum("--version")
    assert done.returncode == 0
    for word in ["pairsum 0.", "git ", "compiler ", "flags -O"]:
        assert word in done.stdout


def test_help_teaches(pairsum):
    assert "pairsum run" in pairsum("--help").stdout
    assert "worker" not in pairsum("--help").stdout
    for command in ["run", "tune", "verify", "report", "compare", "history", "convert", "list"]:
        done = pairsum(command, "--help")
        assert done.returncode == 0 and len(done.stdout) > 200


def test_number_of_sums():
    backends = [{"runtime": t, "unavailable": u, "conflicts": c, "precisions": ["double", "mixed"][:1 + (c != "atomics")]}
                for t, u, c in [("serial", None, "serial"), ("omp", None, "atomics"), ("tbb", "no TBB", "gather")]]
    built = {"backends": backends, "grids": ["a", "b"], "grids_with_M": ["a"], "isas": ["x", "y"],
             "formulas": [{"precision": p, "smoothing": s} for p, s in [("double", "s"), ("double", None), ("float", "s"), ("mixed", "s")]]}
    assert number_of_sums(built, 2, 3) == (2 + 1) * ((2 + 1 + 1) + 3 * (1 + 1))
    assert number_of_sums({**built, "isas": []}, 2, 3) == (2 + 1) * ((1 + 1 + 1) + 3 * (1 + 1))


def test_what_is_listed_is_what_the_folders_hold(listed):
    names = [b["name"] for b in listed["backends"]]
    in_tree = {p.stem for p in (SOURCE / "kernels/backends").glob("*.cpp")}
    assert len(names) == len(set(names)) and set(names) == in_tree
    known = set(listed["smoothings"]) | {m["word"] for m in listed["unavailable"] if m["kind"] == "smoothing kernel"}
    assert known == {p.stem for p in (SOURCE / "kernels/smoothing").glob("*.hpp")}
    assert set(listed["states"]) == {"rest", "perturbed", "evolved:T"}


def test_rows_of_all_backends_obey_the_schema(pairsum, backends, tmp_path):
    out = tmp_path / "deep" / "rows.jsonl"
    done = pairsum("run", *SMALL[:6], "--backend", ",".join(backends), "--state", "rest,perturbed", "--steps", 2, "--rounds", 2,
                   "--repetitions", 2, "--out", out)
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines()[-3] == f"rows: {out}"
    assert done.stderr == ""  # no progress line where nobody looks
    assert schema_errors(out) == []
    samples = [json.loads(line) for line in out.read_text().splitlines() if '"sample"' in line]
    assert {s["point"]["backend"] for s in samples} == set(backends)
    assert len(samples) == len(backends) * 2 * 2 * 2 * 2
    for s in samples:
        assert s["verify"]["fingerprint"] and s["phases"]["total_s"] > 0


def test_default_rows_path_names_study_host_time_and_revision(pairsum, tmp_path):
    done = pairsum("run", *SMALL, "--study", "mine", "--results", tmp_path / "results")
    (path,) = (tmp_path / "results" / "mine").iterdir()
    assert done.stdout.splitlines()[-3] == f"rows: {path}"
    assert path.name.startswith(os.uname().nodename + "-2") and path.suffix == ".jsonl"


def test_report_writes_summary_tables_figures_and_page(pairsum, tmp_path):
    rows, folder = tmp_path / "rows.jsonl", tmp_path / "deep" / "s"
    made = pairsum("run", *SMALL[:2], "--M", "6", *SMALL[4:], "--out", rows)  # the table compares with M = 6
    assert made.returncode == 0, made.stderr
    done = pairsum("report", rows, "--out", folder)
    assert done.returncode == 0, done.stderr
    summary = json.loads((folder / "summary.json").read_text())
    assert summary["schema"] == "pairsum.summary/3" and summary["points"]
    lines = done.stdout.splitlines()
    assert lines[0].startswith("On ") and lines[-1] == f"page:    {folder / 'report.html'}"
    assert lines[-3] == f"tables:  {folder}/tables.txt, tables.md, csv/, rounds.csv, summary.json"
    assert (folder / "report.html").read_text().startswith("<!") and list(folder.glob("*.png"))
    tables = (folder / "tables.txt").read_text()
    assert "Algorithm speedup" in tables
    assert pairsum("report", "--tables", rows, "--out", folder).stdout.count(tables) == 1
    assert "Algorithm speedup" in (folder / "tables.md").read_text()
    for table in (folder / "csv").iterdir():
        lines = list(csv.reader(table.read_text().splitlines()))
        assert lines and {len(line) for line in lines} == {len(lines[0])}, table
    assert (folder / "csv" / "points.csv").exists()


def test_report_goes_beside_the_rows_by_default(pairsum, rows):
    done = pairsum("report", "--tables", rows)
    assert done.returncode == 0, done.stderr
    assert (rows.parent / "rows" / "summary.json").exists()
    assert pairsum("report", "--tables", rows.parent).returncode == 0  # a folder of rows: beside them
    assert (rows.parent / "summary.json").exists()


def test_verify_says_how_many_agree(pairsum, listed):
    done = pairsum("verify", "--dx", "0.08", "--M", "2", "--threads", "2")
    assert done.returncode == 0, done.stdout
    n = number_of_sums(listed, M=1, threads=1)
    assert done.stdout.splitlines()[-1] == f"{n} of {n} sums agree with the reference"
    for f in listed["formulas"]:
        assert re.search(rf"^{f['dim']}D +{f['precision']} +{f['interaction']} +{f['smoothing'] or 'none'} +\d+ sums ", done.stdout, re.M), f


def test_verify_takes_each_smoothing_kernel_where_it_is_built(pairsum, listed):
    for smoothing in listed["smoothings"]:
        done = pairsum("verify", "--smoothing", smoothing, "--backend", "symmetric,tiles_omp", "--dx", "0.1", "--M", "3", "--threads", "1")
        assert done.returncode == 0, done.stderr
        lines = re.findall(r"^(\d)D +(\w+) +(\w+) +(\w+) +\d+ sums ", done.stdout, re.M)
        assert sorted(line for line in lines if line[3] != "none") == sorted(
            (str(f["dim"]), f["precision"], f["interaction"], smoothing) for f in listed["formulas"] if f["smoothing"] == smoothing)


def test_verify_can_say_each_sum(pairsum):
    done = pairsum("verify", "--dim", "3", "--precision", "double", "--interaction", "ferrari09", "--smoothing", "wendland_c2",
                   "--backend", "naive,symmetric_omp", "--grid", "hashed_grid", "--dx", "0.08", "--M", "2,6", "--threads", "1,3",
                   "--isa", "scalar", "--each")
    lines = [line for line in done.stdout.splitlines() if "threads=" in line]
    assert done.returncode == 0 and len(lines) == 2 * (1 + 2)
    assert all(re.search(r"M=[26] +threads=[13] +\d", line) for line in lines)


def test_grids_without_m_are_measured_once_and_have_no_m(pairsum, listed, tmp_path):
    without = sorted(set(listed["grids"]) - set(listed["grids_with_M"]))
    done = pairsum("run", *SMALL[:2], "--M", "3,4", "--threads", 1, "--rounds", 1, "--steps", 1, "--backend", "symmetric_omp",
                   "--grid", ",".join(listed["grids"]), "--out", "rows.jsonl")
    assert done.returncode == 0, done.stderr
    assert schema_errors(tmp_path / "rows.jsonl") == []
    points = [row["point"] for row in map(json.loads, (tmp_path / "rows.jsonl").read_text().splitlines()) if row["kind"] == "sample"]
    assert sorted((p["grid"], p["M"] or 0) for p in points) == sorted(
        [(grid, m) for grid in listed["grids_with_M"] for m in (3, 4)] + [(grid, 0) for grid in without])
    assert all((p["M"] is None) == (p["grid"] in without) and p["block"] == "none" for p in points)
    for grid in without:
        assert re.search(rf"^symmetric_omp +{grid} +- +\d", done.stdout, re.M), done.stdout


def test_vector_units_are_a_factor_of_every_backend(pairsum, listed, tmp_path):
    if not listed["isas"]:
        pytest.skip("no instruction set is in this build and of this machine")
    done = pairsum("run", *SMALL, "--backend", "naive,tiles_omp", "--isa", "default,scalar,best", "--out", "rows.jsonl")
    assert done.returncode == 0, done.stderr
    points = [row["point"] for row in map(json.loads, (tmp_path / "rows.jsonl").read_text().splitlines()) if row["kind"] == "sample"]
    assert {(p["backend"], p["isa"]) for p in points} == {(b, isa) for b in ("naive", "tiles_omp") for isa in ("scalar", listed["isas"][0])}


def test_verify_leaves_out_what_nobody_asked_for_by_name(pairsum, listed):
    """Of all precisions those that the backend takes; of all interactions those that the precision takes."""
    done = pairsum("verify", "--dim", "3", "--dx", "0.1", "--M", "3", "--smoothing", listed["smoothings"][0], "--backend", "atomic_add")
    assert done.returncode == 0, done.stderr
    assert "3D  double" in done.stdout and "3D  mixed" not in done.stdout
    if "mixed" in listed["precisions"]:
        words = ["--dim", "3", "--dx", "0.1", "--M", "3", "--smoothing", listed["smoothings"][0], "--precision", "mixed"]
        done = pairsum("verify", *words)
        assert done.returncode == 0, done.stderr
        assert "3D  mixed" in done.stdout and "count" not in done.stdout
        refused = pairsum("verify", *words, "--backend", "atomic_add")
        assert refused.returncode == 2 and "precision mixed needs vector units" in refused.stderr


def test_lists_of_words_are_factors(pairsum, listed, tmp_path):
    out = tmp_path / "rows.jsonl"
    kernels = sorted({f["smoothing"] for f in listed["formulas"] if f["dim"] == 3 and f["smoothing"]})
    precisions = next(b["precisions"] for b in listed["backends"] if b["name"] == "naive")
    factors = {"precision": precisions, "interaction": listed["interactions"], "smoothing": kernels,
               "order": ["lattice", "shuffled", "morton"], "integrator": ["euler", "rk4"]}
    options = [text for name, words in factors.items() for text in (f"--{name}", ",".join(words))]
    done = pairsum("run", "--case", "random_clustered", "--dx", "0.2", "--M", "4", "--threads", "1", "--backend", "naive,symmetric",
                   "--steps", "1", "--rounds", "1", *options, "--out", out)
    assert done.returncode == 0, done.stderr
    points = [row["point"] for row in map(json.loads, out.read_text().splitlines()) if row["kind"] == "sample"]
    formulas = [f for f in listed["formulas"] if f["dim"] == 3 and f["precision"] in precisions]
    assert len(points) == len({json.dumps(p, sort_keys=True) for p in points}) == 2 * 3 * 2 * len(formulas)
    assert {p["smoothing"] for p in points if p["interaction"] == "count"} == {"none"}
    assert schema_errors(out) == []
    headings = re.findall(r"^random_clustered 3D, dx 0.2, rest, H = 2 dx, (\w+), \w+, \w+, order \w+: \d+ fluid", done.stdout, re.M)
    assert 1 < len(headings) <= 15 and re.search(r"^\d+ more in the report$", done.stdout, re.M)
    assert pairsum("report", "--tables", out).returncode == 0


@pytest.mark.parametrize("case, dim", [("dam_break", 2), ("lattice", 1), ("random_uniform", 1), ("random_uniform", 2),
                                       ("random_clustered", 2), ("random_uniform", 3)])
def test_cases_run_in_their_dimensions(pairsum, listed, tmp_path, case, dim):
    if dim not in listed["dims"]:
        pytest.skip(f"{dim}D is not built")
    done = pairsum("run", "--case", case, "--dim", str(dim), "--dx", "0.1" if dim == 3 else "0.05", "--state", "perturbed", "--M", "5", "--threads", "1",
                   "--integrator", "predictor_corrector", "--steps", "3", "--rounds", "1", "--out", tmp_path / "rows.jsonl")
    assert done.returncode == 0, done.stderr
    assert "FAILED" not in done.stdout


def test_interrupt_leaves_valid_rows(pairsum, tmp_path):
    out = tmp_path / "rows.jsonl"
    process = subprocess.Popen([BIN / "pairsum", "run", *SMALL[:6], "--steps", "2", "--rounds", "100000", "--out", out],
                               stdout=subprocess.PIPE, text=True)
    while not out.exists() or out.read_text().count('"sample"') < 10:
        time.sleep(0.02)
    process.send_signal(signal.SIGINT)
    printed, _ = process.communicate(timeout=30)
    assert process.returncode == 130
    assert "ns/pair" in printed and "to go on:" in printed
    assert schema_errors(out) == []
    assert pairsum("report", "--tables", out).returncode == 0


def test_bench_speaks_google_benchmark(pairsum):
    done = pairsum("--dx", "0.08", "--M", "3", "--threads", "1,2", "--oversubscribe", "--benchmark_filter=symmetric|smoothing|hashing/M:6|counting_sort/bits:12",
                   "--benchmark_min_time=0.01", "--benchmark_format=json", program="pairsum_bench")
    assert done.returncode == 0, done.stderr
    made = json.loads(done.stdout)["benchmarks"]
    names = [b["name"] for b in made]
    for b in made:
        if "/dam_break/" in b["name"]:
            assert b["index_s"] > 0 and b["prepare_s"] >= 0 and b["pairs_interacting"] > 0
            assert 1e3 * (b["index_s"] + b["prepare_s"]) < 100 * b["real_time"], "in seconds, the time in ms"
    assert "symmetric_omp/dam_break/M:3/threads:2/manual_time" in names
    assert "smoothing/wendland_c2" in names and "hashing/M:6" in names and "counting_sort/bits:12" in names
    assert sum("symmetric/" in n for n in names) == 1
    assert not any("isa:" in n for n in names)  # each on what its backend takes by default
