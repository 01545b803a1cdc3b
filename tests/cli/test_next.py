"""What a run says comes next, what it leaves of a plan, and where it goes on."""

import json
import re
import shlex
import signal
import subprocess
import time

import pytest
from conftest import BIN, PLAN, SMALL, refused


def rows_of(path, kind):
    return [row for row in map(json.loads, path.read_text().splitlines()) if row["kind"] == kind]


@pytest.fixture
def resumes(pairsum):
    """Builds with uncommitted changes cannot be told apart, so they resume nothing."""
    if ", modified" in pairsum("--version").stdout:
        pytest.skip("built from a tree with uncommitted changes")


def next_command(done):
    """The command of the last line, as the shell reads it."""
    return shlex.split(done.stdout.splitlines()[-1])


def test_too_few_rounds_lead_to_more_and_then_to_the_report(pairsum, tmp_path):
    done = pairsum("run", *SMALL[:-1], 3, "--out", "a b.jsonl")
    assert "more rounds, since 6 give an interval:" in done.stdout
    again = next_command(done)
    assert again[:2] == [str(BIN / "pairsum"), "run"] and again[-2:] == ["--out", "a b.jsonl"]
    assert sorted(again[2:-2]) == sorted([*SMALL[:-1], "3"])
    more = subprocess.run(again, cwd=tmp_path, text=True, capture_output=True)
    assert more.returncode == 0 and "rounds 6;" in more.stdout, more.stdout  # the table takes all
    report = next_command(more)
    assert report == [str(BIN / "pairsum"), "report", "a b.jsonl"]
    assert subprocess.run([*report, "--tables"], cwd=tmp_path, capture_output=True).returncode == 0


def test_the_table_ends_with_a_verdict(pairsum):
    done = pairsum("run", *SMALL[:-1], 6, "--backend", "naive,symmetric,pair_list")
    assert done.returncode == 0, done.stderr
    number = r"\d+\.?\d*"
    assert re.search(rf"^\w+ ran {number} \[{number}, {number}\] times as fast as \w+|^nothing is decided: ", done.stdout, re.M)
    first = re.search(rf"^(\w+) +{number}  \[{number}, {number}\] +1.000 +fastest", done.stdout, re.M)
    assert first, done.stdout
    assert len(re.findall(r"^(?:naive|symmetric|pair_list) ", done.stdout, re.M)) >= 3


# ------------------------------------------------------------------------------------------------------------ narrowed


def shown(done):
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.mark.parametrize("only, parts", [
    (["backend=naive"], {"both": ["naive"], "alone": ["naive"]}),
    (["backend=symmetric"], {"both": ["symmetric"]}),
    (["state=perturbed"], {"alone": ["naive"]}),
    (["backend=symmetric", "backend=naive"], {"both": ["naive", "symmetric"], "alone": ["naive"]}),
])
def test_only_narrows_a_plan(pairsum, tmp_path, only, parts):
    (tmp_path / "plan.json").write_text(json.dumps(PLAN))
    words = [word for o in only for word in ("--only", o)]
    plan = shown(pairsum("run", "plan.json", *words, "--show-plan"))
    assert {p["name"]: p["backend"] for p in plan["parts"]} == parts


@pytest.mark.parametrize("only, says", [
    ("backend=naive_omp", ["no backend naive_omp", "naive, symmetric"]),
    ("colour=red", ["colour", "backend", "threads"]),
    ("backend", ["backend=naive"]),
    ("M=3..5", ["no M 4", "it has 3"]),
])
def test_only_refuses_what_the_plan_has_not(pairsum, tmp_path, only, says):
    (tmp_path / "plan.json").write_text(json.dumps(PLAN))
    assert refused(pairsum("run", "plan.json", "--only", only, "--out", "rows.jsonl"), *says)
    assert not (tmp_path / "rows.jsonl").exists()


def test_a_narrowed_plan_is_measured(pairsum, tmp_path):
    (tmp_path / "plan.json").write_text(json.dumps(PLAN))
    done = pairsum("run", "plan.json", "--only", "backend=symmetric", "--rounds", 2, "--out", "rows.jsonl")
    assert done.returncode == 0, done.stderr
    assert {row["point"]["backend"] for row in rows_of(tmp_path / "rows.jsonl", "sample")} == {"symmetric"}
    assert "--only backend=symmetric --rounds 2 --out rows.jsonl" in done.stdout


# ------------------------------------------------------------------------------------------------------------- resumed


def interrupted_run(folder, *words):
    """A run of options that was interrupted after a finished round; its file."""
    process = subprocess.Popen([BIN / "pairsum", "run", *words], cwd=folder, stdout=subprocess.PIPE, text=True)
    (rows,) = wait_for(lambda: [p for p in folder.rglob("*.jsonl") if rows_of_whole_lines(p, "round")], process)
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=30)
    assert process.returncode == 130
    return rows


def rows_of_whole_lines(path, kind):
    return [line for line in path.read_text().split("\n")[:-1] if f'"kind":"{kind}"' in line]


def wait_for(found, process):
    until = time.monotonic() + 60
    while time.monotonic() < until and process.poll() is None:
        if found():
            return found()
        time.sleep(0.01)
    raise AssertionError("it ended before")


def test_options_resume_the_newest_unfinished_file(pairsum, resumes, tmp_path):
    words = [*SMALL[:-1], "400"]
    first = interrupted_run(tmp_path, *words)
    closed = len(rows_of(first, "round"))
    assert "resuming" not in pairsum("run", *SMALL[:-1], "2").stdout  # other options
    assert "resuming" not in pairsum("run", *words, "--budget", "0.1", "--fresh").stdout
    done = pairsum("run", *words, "--budget", "1")
    assert f"resuming {first.relative_to(tmp_path)}" in done.stdout and len(rows_of(first, "round")) > closed, done.stdout
    assert rows_of(first, "end")
    assert "resuming" not in pairsum("run", *words, "--budget", "0.1").stdout  # it came to its end
    assert len(list(tmp_path.rglob("*.jsonl"))) >= 3


# ---------------------------------------------------------------------------------------------------------------- help


def test_help_has_groups_and_fits_on_a_screen(pairsum):
    lines = pairsum("run", "--help").stdout.splitlines()
    assert max(map(len, lines)) <= 100, max(lines, key=len)
    assert len(lines) <= 70
    for group in ["The plan", "What is compared", "The case", "How often", "Files", "Machine and build"]:
        assert any(line.startswith(group) for line in lines), group
