"""Plans, and what is said about them before and while they run."""

import json
import re

import pytest
from conftest import BIN, PLAN, SMALL, refused


@pytest.fixture
def plan(tmp_path):
    """Writes a plan file: PLAN with some keys changed, or any text."""

    def write(text=None, **changes):
        path = tmp_path / "plan.json"
        path.write_text(json.dumps({**PLAN, **changes}) if text is None else text)
        return path

    return write


@pytest.fixture
def files(tmp_path):
    """The files in the folder that tests run in, without plan files."""
    return lambda: sorted(p.name for p in tmp_path.rglob("*") if p.suffix != ".json" or p.is_dir())


# ---------------------------------------------------------------------------------------------- before it is measured


def test_dry_run_prints_the_design_and_writes_nothing(pairsum, plan, files):
    done = pairsum("run", plan(), "--dry-run")
    assert done.returncode == 0, done.stderr
    assert "mine: a plan of a test" in done.stdout and "because: to have two" in done.stdout
    assert re.search(r"^part both: 2 points, 6 rounds", done.stdout, re.M)
    assert re.search(r"^part alone: 1 point, 6 to 8 rounds", done.stdout, re.M)
    assert re.search(r"^  backend +naive, symmetric$", done.stdout, re.M)
    assert re.search(r"about \d+ (s|min|h)", done.stdout.splitlines()[-1])
    assert files() == []


def test_a_dry_run_says_what_is_made_before_and_that_more_pairs_take_longer(pairsum, tmp_path, monkeypatch):
    words = ["run", "--dx", "0.06", "--backend", "naive", "--M", "7", "--steps", "4000", "--dry-run"]
    monkeypatch.setenv("PAIRSUM_CACHE", str(tmp_path / "kept"))
    evolved = pairsum(*words, "--state", "rest,evolved:0.5")
    assert f"made before, which takes minutes, unless kept in {tmp_path}/kept: evolved:0.5\n" in evolved.stdout
    assert "made before" not in pairsum(*words).stdout
    takes = [re.search(r"a round takes about (\d+) (s|min)", pairsum(*words, "--H", H).stdout) for H in ("0.12", "0.24")]
    seconds = [float(found[1]) * (60 if found[2] == "min" else 1) for found in takes]
    assert seconds[1] > 3 * seconds[0]
    assert not (tmp_path / "kept").exists()


@pytest.mark.parametrize("name", ["quick", "talk", "size", "m_sweep", "granularity", "compilers", "self_test", "vector",
                                  "lanes", "field", "density"])
def test_plans_that_come_with_the_program(pairsum, files, tmp_path, name):
    shown = pairsum("run", name, "--show-plan")
    assert shown.returncode == 0, shown.stderr
    plan = json.loads(shown.stdout)
    assert plan["schema"] == "pairsum.plan/1" and plan["study"] == name
    if name not in ("quick", "self_test"):
        return  # a dry run of these makes the points of large worlds
    (tmp_path / "shown.json").write_text(shown.stdout)
    done = pairsum("run", "shown.json", "--dry-run")
    assert done.returncode == 0, done.stderr
    for part in plan["parts"]:
        assert f"part {part['name']}: " in done.stdout
    assert json.loads(pairsum("run", "shown.json", "--show-plan").stdout) == plan
    assert files() == []


def test_options_show_themselves_as_a_plan(pairsum, tmp_path, files):
    shown = pairsum("run", *SMALL, "--backend", "naive", "--show-plan")
    assert shown.returncode == 0, shown.stderr
    (tmp_path / "shown.json").write_text(shown.stdout)
    done = pairsum("run", "shown.json", "--dry-run")
    assert done.returncode == 0 and "1 point, 1 round;" in done.stdout
    assert files() == []


def test_options_that_a_plan_may_have_beside_it(pairsum, plan):
    shown = pairsum("run", plan(), "--rounds", "7", "--half-width", "0.25", "--budget", "33", "--seed", "9", "--show-plan")
    assert shown.returncode == 0, shown.stderr
    said = json.loads(shown.stdout)
    assert said["budget_s"] == 33
    assert [(p["rounds"], p["half_width"], p["seed"]) for p in said["parts"]] == 2 * [([6, 7], 0.25, 9)]  # 6 give an interval


@pytest.mark.parametrize("option, value", [("--dx", "0.1"), ("--backend", "naive"), ("--M", "6"), ("--threads", "1"), ("--state", "rest"),
                                           ("--steps", "3"), ("--repetitions", "2"), ("--dt", "1e-4"), ("--granularity", "default"),
                                           ("--study", "other")])
def test_factors_beside_a_plan_are_refused(pairsum, plan, files, option, value):
    assert refused(pairsum("run", plan(), option, value, "--out", "rows.jsonl"), option, "plan")
    assert files() == []


# ---------------------------------------------------------------------------------------------------- plans that are wrong


def test_unknown_plan_lists_the_plans(pairsum, files):
    assert refused(pairsum("run", "nope"), "nope", "quick", "talk", "self_test", "granularity")
    assert files() == []


TEXT = json.dumps(PLAN)
FIRST = PLAN["parts"][0]


@pytest.mark.parametrize("text, says", [
    ("", ["plan.json"]),
    (TEXT[:-1], ["plan.json"]),
    (TEXT[: len(TEXT) // 2], ["plan.json"]),
    ("no JSON at all", ["plan.json"]),
    ("\0\1\2", ["plan.json"]),
    (TEXT + "}", ["plan.json"]),
    ("[1,2]", ["object"]),
    ("null", ["object"]),
    ("{}", ["schema", "pairsum.plan/1"]),
])
def test_files_that_are_no_plans(pairsum, plan, files, text, says):
    assert refused(pairsum("run", plan(text), "--out", "rows.jsonl"), *says)
    assert files() == []


@pytest.mark.parametrize("changes, says", [
    ({"schema": "pairsum.plan/9"}, ["schema", "pairsum.plan/1", "pairsum.plan/9"]),
    ({"schema": 1}, ["schema", "pairsum.plan/1"]),
    ({"colour": "red"}, ["colour", "not known"]),
    ({"study": "a/b"}, ["study", "a/b"]),
    ({"study": ""}, ["study"]),
    ({"study": 3}, ["study", "3"]),
    ({"budget_s": -1}, ["budget_s", "-1"]),
    ({"budget_s": "long"}, ["budget_s", "long"]),
    ({"parts": []}, ["parts"]),
    ({"parts": {}}, ["parts"]),
    ({"parts": [1]}, ["parts"]),
    ({"parts": [FIRST, FIRST]}, ["both"]),
    ({"parts": [{"backend": "naive"}]}, ["name"]),
    ({"parts": [{**FIRST, "colour": "red"}]}, ["colour", "not known", "backend"]),
    ({"parts": [{**FIRST, "backend": "nope"}]}, ["nope", "naive_omp"]),
    ({"parts": [{**FIRST, "backend": 3}]}, ["backend", "3"]),
    ({"parts": [{**FIRST, "backend": []}]}, ["backend"]),
    ({"parts": [{**FIRST, "M": 1}]}, ["M must be between 2 and 10"]),
    ({"parts": [{**FIRST, "M": "9..5"}]}, ["M"]),
    ({"parts": [{**FIRST, "threads": 0}]}, ["threads"]),
    ({"parts": [{**FIRST, "dx": -0.1}]}, ["dx must be a positive"]),
    ({"parts": [{**FIRST, "rounds": 0}]}, ["rounds", "0"]),
    ({"parts": [{**FIRST, "rounds": [8, 6]}]}, ["rounds", "8"]),
    ({"parts": [{**FIRST, "rounds": "many"}]}, ["rounds", "many"]),
    ({"parts": [{**FIRST, "share": 0}]}, ["share"]),
    ({"parts": [{**FIRST, "half_width": -1}]}, ["half_width"]),
    ({"parts": [{**FIRST, "steps": 2.5}]}, ["steps", "2.5"]),
    ({"defaults": []}, ["defaults"]),
    ({"defaults": {"colour": "red"}}, ["colour", "not known"]),
    ({"self_test": "yes"}, ["self_test"]),
    ({"builds": 0}, ["builds"]),
    ({"builds": 2}, ["--program"]),
    ({"seed": -1}, ["seed"]),
], ids=lambda v: json.dumps(v)[:60] if isinstance(v, dict) else "")
def test_plans_that_say_something_wrong(pairsum, plan, files, changes, says):
    assert refused(pairsum("run", plan(**changes), "--out", "rows.jsonl"), *says)
    assert files() == []


def test_a_plan_that_is_a_folder_or_missing(pairsum, tmp_path, files):
    (tmp_path / "folder.json").mkdir()
    assert refused(pairsum("run", "folder.json", "--out", "rows.jsonl"), "folder.json", "folder")
    assert refused(pairsum("run", "./", "--out", "rows.jsonl"), "folder")
    assert refused(pairsum("run", "missing.json", "--out", "rows.jsonl"), "missing.json")
    assert refused(pairsum("run", "no/folder", "--out", "rows.jsonl"), "no/folder")
    assert files() == ["folder.json"]


def test_list_has_the_plans_and_their_titles(pairsum):
    plans = json.loads(pairsum("list", "--json").stdout)["plans"]
    assert {"quick", "talk", "m_sweep", "size", "granularity", "compilers", "self_test", "vector"} <= {p["name"] for p in plans}
    for plan in plans:
        assert json.loads(pairsum("run", plan["name"], "--show-plan").stdout)["title"] == plan["title"]


@pytest.mark.parametrize("words", [["worker", "99"], ["worker", "-1"], ["worker", "0"], ["worker"], ["worker", "x"]])
def test_the_command_of_the_processes_is_not_for_people(pairsum, files, words):
    assert refused(pairsum(*words))
    assert files() == []


# ---------------------------------------------------------------------------------------------- while it is measured


def rows_of(path, kind):
    return [row for row in map(json.loads, path.read_text().splitlines()) if row["kind"] == kind]


def test_narrow_intervals_end_a_run(pairsum, tmp_path):
    done = pairsum("run", *SMALL[:-2], "--backend", "naive", "--rounds", "30", "--half-width", "1000", "--out", "rows.jsonl")
    assert done.returncode == 0, done.stderr
    assert len(rows_of(tmp_path / "rows.jsonl", "round")) == 6


def test_two_builds_in_the_same_rounds(pairsum, plan, tmp_path):
    done = pairsum("run", plan(builds=2), "--program", BIN / "pairsum", "--out", "rows.jsonl")  # both are this one
    assert done.returncode == 0, done.stderr
    assert {row["rows"] for row in rows_of(tmp_path / "rows.jsonl", "round")} == {2 * 2 * 2, 2 * 1 * 2}


@pytest.mark.parametrize("program", ["/bin/true", "/bin/false"])
def test_another_program_is_no_build(pairsum, plan, tmp_path, program):
    done = pairsum("run", plan(builds=2), "--program", program, "--out", "rows.jsonl")
    assert done.returncode == 2 and "are all programs pairsum, of this version?" in done.stdout, (done.stdout, done.stderr)
    assert rows_of(tmp_path / "rows.jsonl", "round") == [] and rows_of(tmp_path / "rows.jsonl", "end") == []


@pytest.mark.parametrize("words", [["--program", "missing"], ["--program", "/"], ["--program", "plan.json"]])
def test_what_cannot_be_run_is_no_build(pairsum, plan, files, words):
    assert refused(pairsum("run", plan(builds=2), *words, "--out", "rows.jsonl"), words[1], "no program that can be run")
    assert files() == []


# ---------------------------------------------------------------------------------------------- the harness on itself


def test_a_corrupt_backend_has_only_errors(pairsum, plan, tmp_path):
    backends = ["symmetric_omp", "again_symmetric_omp", "slowed_20_symmetric_omp", "corrupt_symmetric_omp"]
    words = {"name": "known", "state": "perturbed", "backend": ",".join(backends), "rounds": 6}
    path = plan(self_test=True, parts=[words])
    done = pairsum("run", path, "--out", "rows.jsonl")
    assert done.returncode == 0, (done.stdout, done.stderr)  # here they are right if they are refused
    assert "FAILED its verification" in done.stdout
    rows = [json.loads(line) for line in (tmp_path / "rows.jsonl").read_text().splitlines()]
    samples = [row for row in rows if row["kind"] == "sample"]
    assert {row["point"]["backend"] for row in samples} == set(backends)
    for row in samples:
        corrupt = row["point"]["backend"].startswith("corrupt")
        assert ("error" in row) == corrupt and (row["phases"] is None) == corrupt
    assert rows[-1]["kind"] == "end"
    report = pairsum("report", "--tables", "rows.jsonl", "--out", "s")
    summary = json.loads((tmp_path / "s" / "summary.json").read_text())
    assert report.returncode in (0, 1) and "corrupt_symmetric_omp" in report.stdout
    assert "corrupt_symmetric_omp" not in [p["backend"] for p in summary["points"]]


def test_backends_of_the_self_test_are_for_the_self_test(pairsum, plan):
    assert refused(pairsum("run", plan(parts=[{"name": "known", "backend": "corrupt_symmetric_omp"}])), "corrupt_symmetric_omp")
    assert refused(pairsum("run", "--backend", "corrupt_symmetric_omp"), "corrupt_symmetric_omp")


# ----------------------------------------------------------------------------------------------------------- progress


def test_progress_is_quiet_where_nobody_looks(pairsum, plan):
    done = pairsum("run", plan(), "--rounds", "2", "--out", "rows.jsonl")
    assert done.returncode == 0 and done.stderr == ""
    assert "\r" not in done.stdout and "\x1b" not in done.stdout and "ETA" not in done.stdout
