"""What the programs print and write when all is well."""

import json
import os
import pathlib
import signal
import subprocess
import time

import jsonschema
from conftest import BIN, SMALL

SOURCE = pathlib.Path(os.environ["PAIRSUM_SOURCE"])
BACKENDS = ["naive", "naive_omp", "naive_tbb", "pair_list", "sphysics_sweep", "ppm_stencil", "symmetric", "symmetric_omp",
            "symmetric_tbb"]


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
    for command in ["run", "verify", "report", "list"]:
        done = pairsum(command, "--help")
        assert done.returncode == 0 and len(done.stdout) > 200


def test_list_and_its_json_agree(pairsum):
    listed = json.loads(pairsum("list", "--json").stdout)
    assert [b["name"] for b in listed["backends"]] == BACKENDS
    text = pairsum("list").stdout
    for kind in ["backends", "cases", "integrators"]:
        for entry in listed[kind]:
            assert entry["name"] in text and entry["description"] in text
    assert set(listed["states"]) == {"rest", "perturbed"}


def test_rows_of_all_backends_obey_the_schema(pairsum, tmp_path):
    out = tmp_path / "deep" / "rows.jsonl"
    done = pairsum("run", *SMALL[:6], "--backend", ",".join(BACKENDS), "--state", "rest,perturbed", "--steps", 2, "--repetitions", 2,
                   "--out", out)
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines()[-1] == f"rows: {out}"
    assert done.stderr == ""  # no progress line where nobody looks
    assert schema_errors(out) == []
    samples = [json.loads(line) for line in out.read_text().splitlines() if '"sample"' in line]
    assert {s["point"]["backend"] for s in samples} == set(BACKENDS)
    assert len(samples) == len(BACKENDS) * 2 * 2 * 2
    for s in samples:
        assert s["verify"]["fingerprint"] and s["phases"]["total_s"] > 0


def test_default_rows_path_names_study_host_time_and_revision(pairsum, tmp_path):
    done = pairsum("run", *SMALL, "--study", "mine", "--results", tmp_path / "results")
    (path,) = (tmp_path / "results" / "mine").iterdir()
    assert done.stdout.splitlines()[-1] == f"rows: {path}"
    assert path.name.startswith(os.uname().nodename + "-2") and path.suffix == ".jsonl"


def test_outside_drop_is_said(pairsum, tmp_path):
    done = pairsum("run", *SMALL, "--outside", "drop", "--out", tmp_path / "r.jsonl")
    assert done.returncode == 0


def test_report_writes_summary_and_tables(pairsum, rows, tmp_path):
    done = pairsum("report", rows, "--summary", tmp_path / "s" / "summary.json")
    assert done.returncode == 0, done.stderr
    summary = json.loads((tmp_path / "s" / "summary.json").read_text())
    assert summary["schema"] == "pairsum.summary/1" and summary["points"]
    assert "Algorithm speedup" in done.stdout and max(map(len, done.stdout.splitlines()[:-1])) <= 120


def test_verify_says_how_many_agree(pairsum):
    done = pairsum("verify", "--dx", "0.08", "--M", "2,6", "--threads", "1,3")
    assert done.returncode == 0, done.stdout
    assert done.stdout.splitlines()[-1] == "52 of 52 sums agree with the reference"


def test_interrupt_leaves_valid_rows(pairsum, tmp_path):
    out = tmp_path / "rows.jsonl"
    process = subprocess.Popen([BIN / "pairsum", "run", *SMALL[:6], "--steps", "2", "--repetitions", "100000", "--out", out],
                               stdout=subprocess.PIPE, text=True)
    while not out.exists() or out.read_text().count('"sample"') < 10:
        time.sleep(0.02)
    process.send_signal(signal.SIGINT)
    printed, _ = process.communicate(timeout=30)
    assert process.returncode == 130
    assert "ns/pair" in printed
    assert schema_errors(out) == []
    assert pairsum("report", out).returncode == 0


def test_bench_speaks_google_benchmark(pairsum):
    done = pairsum("--dx", "0.08", "--M", "3", "--threads", "1,2", "--benchmark_filter=symmetric|smoothing|hashing/M:6|counting_sort/bits:12",
                   "--benchmark_min_time=0.01", "--benchmark_format=json", program="pairsum_bench")
    assert done.returncode == 0, done.stderr
    names = [b["name"] for b in json.loads(done.stdout)["benchmarks"]]
    assert "symmetric_omp/dam_break/M:3/threads:2/manual_time" in names
    assert "smoothing/wendland_c2" in names and "hashing/M:6" in names and "counting_sort/bits:12" in names
    assert sum("symmetric/" in n for n in names) == 1
