"""--sbatch prints a job script that is whole, carries every option and quotes what it is told; it runs nothing."""

import json
import re
import shlex
import shutil
import subprocess

import pytest
from conftest import BIN, PLAN, refused

HOSTILE = ["two words", "it's", 'a"b', "$(touch pwned)", "`touch pwned`", "a;touch pwned", "a\ntouch pwned", "a&b|c>d", "~", "*", "é\\"]


@pytest.fixture
def with_ranks(pairsum):
    if "PAIRSUM_RANKS" in pairsum("run", "--dx", 0.08, "--ranks", 2, "--dry-run").stderr:
        pytest.skip("this build has no ranks")


def script_of(done):
    assert (done.returncode, done.stderr) == (0, "")
    return done.stdout


def directives(script):
    return dict(re.findall(r"^#SBATCH --([a-z-]+)=(.*)$", script, re.MULTILINE))


def called(script, folder):
    """What the script calls when it is run by bash, word for word, with a program that only tells its words."""
    teller = folder / "teller"
    teller.write_text('#!/bin/bash\nprintf "%s\\0" "$PWD" "$@"\n')
    teller.chmod(0o755)
    program = re.search(r"^exec (\S+) ", script, re.MULTILINE).group(1)
    copy = folder / "job.sh"
    copy.write_text(script.replace(f"exec {program} ", f"exec {shlex.quote(str(teller))} "))
    assert subprocess.run(["bash", "-n", copy], capture_output=True, text=True).stderr == ""
    done = subprocess.run(["bash", copy], capture_output=True, text=True, cwd="/", timeout=30)
    assert (done.returncode, done.stderr) == (0, "")
    return done.stdout.split("\0")[:-1]


def test_a_script_for_one_rank(pairsum, tmp_path):
    script = script_of(pairsum("run", "--dx", 0.08, "--threads", 1, "--rounds", 2, "--budget", 30, "--out", "r.jsonl", "--sbatch"))
    assert script.startswith("#!/bin/bash\n")
    given = directives(script)
    assert (given["nodes"], given["ntasks"], given["cpus-per-task"], given["job-name"]) == ("1", "1", "1", "pairsum-run")
    assert given["time"] == "00:06:00"  # 30 s and a tenth, and five minutes, to whole minutes
    assert "\n#SBATCH --exclusive\n" in script
    assert "launcher" not in script
    assert called(script, tmp_path) == [str(tmp_path), "run", "--threads", "1", "--dx", "0.08", "--rounds", "2",
                                        "--budget", "30", "--out", "r.jsonl"]
    assert sorted(path.name for path in tmp_path.iterdir()) == ["job.sh", "teller"]  # nothing was run


def test_directives_come_before_commands(pairsum):
    lines = script_of(pairsum("run", "--dx", 0.08, "--threads", 1, "--sbatch")).splitlines()
    first = next(k for k, line in enumerate(lines) if line and not line.startswith("#"))
    assert not [line for line in lines[first:] if line.startswith("#SBATCH")]
    assert all(len(line) <= 100 for line in lines if line.startswith("#") and "made by" not in line)


def test_tasks_are_those_of_the_largest_number_of_ranks(pairsum, with_ranks, tmp_path):
    script = script_of(pairsum("run", "--dx", 0.08, "--ranks", "1,2", "--threads", "2/ranks", "--sbatch", "--out", "x"))
    given = directives(script)
    assert (given["ntasks"], given["cpus-per-task"]) == ("2", "1")
    words = called(script, tmp_path)
    launcher = words[words.index("--launcher") + 1]
    assert launcher.startswith(("srun", "mpirun"))
    assert words[-2:] == ["--out", "x"] and "--sbatch" not in words
    assert [words[words.index(o) + 1] for o in ("--ranks", "--threads")] == ["1,2", "2/ranks"]


def test_nodes_hold_all_ranks(pairsum, with_ranks):
    given = directives(script_of(pairsum("run", "--dx", 0.08, "--ranks", 4096, "--threads", 1, "--sbatch")))
    cores = int(re.search(r"Enough nodes of (\d+) core", pairsum("run", "--dx", 0.08, "--threads", 1, "--sbatch").stdout).group(1))
    assert int(given["nodes"]) == -(-4096 // cores)
    assert (given["ntasks"], given["cpus-per-task"]) == ("4096", "1")


def test_a_rank_with_many_threads_has_its_cores(pairsum, with_ranks, tmp_path):
    plan = {**PLAN, "parts": [{"name": "a", "backend": "naive_omp", "ranks": 2, "threads": 1},
                              {"name": "b", "backend": "naive_omp", "ranks": 1, "threads": 64}]}
    (tmp_path / "plan.json").write_text(json.dumps(plan))
    script = script_of(pairsum("run", "plan.json", "--sbatch"))
    given = directives(script)
    assert (given["ntasks"], given["cpus-per-task"], given["job-name"]) == ("2", "32", "pairsum-mine")


def test_time_is_that_of_the_plan_without_a_budget(pairsum):
    script = script_of(pairsum("run", "--dx", 0.08, "--threads", 1, "--rounds", 1, "--sbatch"))
    assert re.fullmatch(r"\d\d:\d\d:00", directives(script)["time"])
    assert "twice the estimate" in script


def test_rows_go_to_one_file_without_out(pairsum, tmp_path):
    words = called(script_of(pairsum("run", "quick", "--sbatch", "--results", "a b")), tmp_path)
    assert words[1:] == ["run", "quick", "--out", "a b/quick/sbatch.jsonl"]


@pytest.mark.parametrize("name", HOSTILE)
def test_names_are_quoted(pairsum, tmp_path, name):
    for folder in (tmp_path / name, tmp_path / "bin"):
        folder.mkdir()
    (tmp_path / name / "p.json").write_text(json.dumps(PLAN))
    done = subprocess.run([BIN / "pairsum", "run", "./p.json", "--only", "backend=naive", "--launcher", name, "--out", f"./{name}", "--sbatch"],
                          cwd=tmp_path / name, capture_output=True, text=True, timeout=60)
    assert called(script_of(done), tmp_path / "bin") == [
        str(tmp_path / name), "run", "./p.json", "--only", "backend=naive", "--launcher", name, "--out", f"./{name}"]
    assert not list(tmp_path.rglob("pwned"))


def test_the_test_sees_a_word_without_quotes(tmp_path):
    with pytest.raises(AssertionError):
        called("exec pairsum run it's\n", tmp_path)
    assert called("exec pairsum run $(echo a b)\n", tmp_path)[1:] == ["run", "a", "b"]


def test_a_title_stays_a_comment(pairsum, tmp_path):
    (tmp_path / "plan.json").write_text(json.dumps({**PLAN, "study": "$(a)'b\"", "title": "a {} $(touch pwned) é"}))
    script = script_of(pairsum("run", "plan.json", "--sbatch"))
    assert directives(script)["job-name"] == "pairsum-__a__b_"
    called(script, tmp_path)
    assert not (tmp_path / "pwned").exists()


def test_what_makes_no_sense_is_refused(pairsum, tmp_path):
    small = ["run", "--dx", 0.08, "--threads", 1, "--sbatch"]
    assert refused(pairsum(*small, "--dry-run"), "--sbatch", "--dry-run", "leave one")
    assert refused(pairsum(*small, "--show-plan"), "--sbatch", "--show-plan")
    assert refused(pairsum(*small, "--fresh"), "--fresh", "--out")
    assert refused(pairsum(*small, "--launcher", ""), "--launcher", "mpirun")
    assert refused(pairsum(*small, "--out", ""), "--out")
    assert refused(pairsum(*small, "--backend", "no_such"), "no_such")
    assert refused(pairsum("run", "no_such_plan", "--sbatch"), "no_such_plan")
    assert refused(pairsum("run", "quick", "--dx", 0.1, "--sbatch"), "--dx")
    assert refused(pairsum("run", "compilers", "--sbatch"), "--program")
    assert list(tmp_path.iterdir()) == []


def test_inside_of_a_job_it_is_refused(tmp_path):
    done = subprocess.run(["env", "SLURM_STEP_NUM_TASKS=4", "SLURM_PROCID=0", BIN / "pairsum", "run", "quick", "--sbatch"],
                          cwd=tmp_path, capture_output=True, text=True, timeout=60)
    assert refused(done, "outside", "--ranks")


def slurm_answers():
    if not shutil.which("sbatch"):
        return False
    return subprocess.run(["sinfo"], capture_output=True, timeout=60).returncode == 0


@pytest.mark.skipif(not slurm_answers(), reason="no Slurm answers here")
def test_slurm_takes_the_script(pairsum, tmp_path):
    job = tmp_path / "job.sh"
    job.write_text(script_of(pairsum("run", "quick", "--only", "threads=1", "--sbatch")))
    tested = subprocess.run(["sbatch", "--test-only", job], capture_output=True, text=True, timeout=60)
    assert tested.returncode == 0, tested.stderr
    assert "to start at" in tested.stderr
    job.write_text(re.sub("--nodes=.*", "--nodes=none", job.read_text()))
    assert subprocess.run(["sbatch", "--test-only", job], capture_output=True, timeout=60).returncode != 0
