"""run_all.sh with stubs of cmake, pairsum and Python: the order of its parts, its time, its ends."""
import os
import re
import signal
import time

import pytest


def value(call, option):
    return re.search(rf"{option} (\S+)", call).group(1)


def test_help(sandbox):
    done = sandbox.run("./run_all.sh", "--help")
    assert done.returncode == 0 and done.stdout.startswith("usage: ./run_all.sh")
    for option in ("--quick", "--no-install", "--results", "--jobs", "--limit"):
        assert option in done.stdout
    assert sandbox.calls() == []


@pytest.mark.parametrize("arguments", [["--fast"], ["--jobs"], ["--jobs", "0"], ["--limit", "x"]])
def test_bad_input(sandbox, arguments):
    done = sandbox.run("./run_all.sh", *arguments)
    assert done.returncode == 2
    assert len(done.stderr.splitlines()) == 1 and done.stderr.startswith("run_all.sh: ")


def test_the_full_run(sandbox):
    done = sandbox.run("./run_all.sh", "--no-install", "--jobs", "3", OMP_NUM_THREADS="1")
    assert done.returncode == 0, done.stderr
    calls = [call for call in sandbox.calls() if not call.startswith("python -c")]
    assert calls[0] == "cmake --preset study"
    assert calls[1] == "cmake --build --preset study --target pairsum --parallel 3"
    assert calls[2].startswith("pairsum verify ")
    runs = calls[3:8]
    assert all(run.startswith("pairsum run ") for run in runs)
    assert [value(run, "--study") for run in runs] == ["talk"] * 3 + ["m_sweep"] * 2
    assert [value(run, "--state") for run in runs] == ["rest", "perturbed"] + ["rest"] * 3
    assert [value(run, "--dx") for run in runs] == ["0.00594"] * 4 + ["0.02"]
    assert [value(run, "--threads") for run in runs[:3]] == ["all", "all", "1"]
    assert value(runs[3], "--threads") == value(runs[4], "--threads") == str(
        len(os.sched_getaffinity(0)))
    assert value(runs[0], "--backend") == "naive_omp,symmetric_omp,naive_tbb,symmetric_tbb"
    assert value(runs[2], "--backend") == "naive,pair_list,sphysics_sweep,ppm_stencil,symmetric"
    assert value(runs[3], "--M") == "5,6,7,8,9"
    assert value(runs[4], "--M") == "2,3,4,5,6,7,8,9"
    outs = sorted({value(run, "--out") for run in runs})
    assert [os.path.dirname(out) for out in outs] == ["results/m_sweep", "results/talk"]
    stem = os.path.basename(outs[1])[:-len(".jsonl")]
    assert re.fullmatch(r"\S+-\d{8}T\d{6}Z-(nogit|[0-9a-f]+)(-dirty)?", stem)
    folders = [f"results/{study}/{stem}" for study in ("talk", "m_sweep")]  # one report per rows file
    assert calls[8:] == (
        [f"pairsum report {folder}.jsonl --summary {folder}/summary.json" for folder in folders]
        + [f"python plots/plot.py {folder}/summary.json --out {folder}" for folder in folders])
    for folder in folders:
        assert (sandbox.tree / folder / "tables.txt").read_text() == "a table\n"
    for text in ("a table", f"results/talk/{stem}/tables.txt", f"results/talk/{stem}/summary.json",
                 f"results/talk/{stem}/*.svg", f"results/m_sweep/{stem}.jsonl"):
        assert text in done.stdout
    assert "\033" not in done.stdout + done.stderr


def test_budgets_fit_into_the_limit(sandbox):
    """A part may take its share of what is left; what the stub leaves unused goes to the later ones."""
    assert sandbox.run("./run_all.sh", "--no-install").returncode == 0
    budgets = [int(value(call, "--budget")) for call in sandbox.calls("pairsum run")]
    left = 900 - 45
    assert budgets[0] in range(left * 11 // 23 - 5, left * 11 // 23 + 1)
    assert budgets[1] in range(left * 6 // 12 - 5, left * 6 // 12 + 1)
    assert max(budgets) <= left


def test_budgets_shrink_with_the_time_that_passed(sandbox):
    def budgets():
        found = [int(value(call, "--budget")) for call in sandbox.calls("pairsum run")]
        sandbox.log.write_text("")
        return found

    assert sandbox.run("./run_all.sh", "--no-install", "--quick").returncode == 0
    unhurried = budgets()
    done = sandbox.run("./run_all.sh", "--no-install", "--quick", STUB_SLOW="rest --backend naive_omp,symmetric_omp,naive", STUB_SECONDS="5")
    assert done.returncode == 0
    slow = budgets()
    assert all(late < early for late, early in zip(slow[1:], unhurried[1:], strict=True))


def test_quick_runs_a_small_case_into_its_own_folder(sandbox):
    done = sandbox.run("./run_all.sh", "--quick", "--no-install")
    assert done.returncode == 0, done.stderr
    runs = sandbox.calls("pairsum run")
    assert {value(run, "--dx") for run in runs} == {"0.02", "0.03"}
    assert {value(run, "--study") for run in runs} == {"quick"}
    assert {os.path.dirname(value(run, "--out")) for run in runs} == {"results/quick"}
    assert all(int(value(run, "--budget")) <= 120 for run in runs)


def test_works_from_anywhere_and_with_another_results_folder(sandbox, tmp_path):
    done = sandbox.run("env", "-C", str(tmp_path), "tree/run_all.sh", "--quick", "--no-install",
                       "--results", "my results")
    assert done.returncode == 0, done.stderr
    assert len(list((tmp_path / "my results/quick").glob("*.jsonl"))) == 1
    assert not (sandbox.tree / "results").exists()
    assert re.search(r"^tables:  my results/quick/\S+/tables.txt$", done.stdout, re.MULTILINE)


def test_a_second_run_keeps_the_files_of_the_first(sandbox):
    sandbox.run("./run_all.sh", "--quick", "--no-install")
    time.sleep(1.1)
    sandbox.run("./run_all.sh", "--quick", "--no-install")
    files = list((sandbox.tree / "results/quick").glob("*.jsonl"))
    assert len(files) == 2 and all(len(file.read_text().splitlines()) == 4 for file in files)


def test_a_failed_verification_stops_before_measuring(sandbox):
    done = sandbox.run("./run_all.sh", "--no-install", STUB_FAILS="verify", STUB_STATUS="1")
    assert done.returncode == 1
    assert done.stderr.splitlines()[-1] == "run_all.sh: the verification failed (exit 1)"
    assert sandbox.calls("pairsum run") == []


@pytest.mark.parametrize("what, status", [("0.00594 --state perturbed", 2), ("report", 5)])
def test_a_failing_step_stops_with_its_exit_code(sandbox, what, status):
    done = sandbox.run("./run_all.sh", "--no-install", STUB_FAILS=what, STUB_STATUS=str(status))
    assert done.returncode == status
    last = done.stderr.splitlines()[-1]
    assert f"failed (exit {status})" in last and "kept in results/talk/" in last
    assert sandbox.calls("python plots") == []


def test_a_failing_build_stops(sandbox):
    done = sandbox.run("./run_all.sh", "--no-install", STUB_CMAKE_STATUS="9")
    assert done.returncode == 9
    assert sandbox.calls("pairsum") == []
    done = sandbox.run("./run_all.sh", "--no-install", STUB_NO_PROGRAM="1")
    assert done.returncode == 4


def test_with_too_little_time_only_the_first_part_is_measured(sandbox):
    done = sandbox.run("./run_all.sh", "--no-install", "--quick", "--limit", "5")
    assert done.returncode == 0, done.stderr
    assert len(sandbox.calls("pairsum run")) == 1
    assert done.stdout.count("left out") == 3
    assert len(sandbox.calls("pairsum report")) == 1


def test_nothing_measured_is_no_success(sandbox):
    done = sandbox.run("./run_all.sh", "--no-install", "--quick", STUB_ROW="")
    assert done.returncode == 4
    assert done.stderr.splitlines()[-1].startswith("run_all.sh: nothing was measured within 120 s")
    assert sandbox.calls("pairsum report") == []


def test_a_hanging_part_is_cut_short(sandbox):
    done = sandbox.run("./run_all.sh", "--no-install", "--quick", "--limit", "22",
                       STUB_SLOW="perturbed --backend", STUB_SECONDS="50")
    assert done.returncode == 0, done.stderr
    assert "'parallel algorithms, perturbed' was cut short by the time limit" in done.stderr
    assert len(sandbox.calls("pairsum run")) == 2
    assert done.stdout.count("left out") == 2
    assert len(sandbox.calls("pairsum report")) == 1


@pytest.mark.parametrize("sent, status", [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_an_interrupt_ends_at_once_and_says_what_is_kept(sandbox, sent, status):
    running = sandbox.start("./run_all.sh", "--no-install", "--quick", STUB_SLOW="run",
                            STUB_SECONDS="50")
    began = time.monotonic()
    while not sandbox.calls("pairsum run") and time.monotonic() - began < 20:
        time.sleep(0.05)
    time.sleep(0.3)
    os.kill(running.pid, sent)
    _, errors = running.communicate(timeout=10)
    assert running.returncode == status
    assert "interrupted" in errors and "kept in results/quick" in errors
    assert sandbox.calls("pairsum report") == []
