"""run_all.sh with stubs of cmake, pairsum and Python: the order of its steps, its time, its ends."""
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


def budgets(sandbox):
    return [int(value(call, "--budget")) for call in sandbox.calls("pairsum run")]


def test_the_full_run(sandbox):
    done = sandbox.run("./run_all.sh", "--no-install", "--jobs", "3", OMP_NUM_THREADS="1")
    assert done.returncode == 0, done.stderr
    calls = sandbox.calls("cmake") + sandbox.calls("pairsum")
    assert calls[0] == "cmake --preset study"
    assert calls[1] == "cmake --build --preset study --target pairsum --parallel 3"
    assert calls[2].startswith("pairsum verify ")
    runs = calls[3:5]
    assert [run.split(" --")[0] for run in runs] == ["pairsum run talk", "pairsum run m_sweep"]
    outs = [value(run, "--out") for run in runs]
    assert [os.path.dirname(out) for out in outs] == ["results/talk", "results/m_sweep"]
    stem = os.path.basename(outs[0])[:-len(".jsonl")]
    assert re.fullmatch(r"\S+-\d{8}T\d{6}Z-(nogit|[0-9a-f]+)(-dirty)?", stem)
    folders = [f"results/{study}/{stem}" for study in ("talk", "m_sweep")]  # one report per rows file
    assert calls[5:] == [f"pairsum report {folder}.jsonl" for folder in folders]
    assert done.stdout.splitlines()[-5:] == [
        f"the answer of results/talk/{stem}.jsonl", "Run it:  build/study/bin/pairsum run --backend tiles_omp", "",
        *(f"look at it: results/{study}/{stem}/report.html" for study in ("talk", "m_sweep"))]
    assert len(done.stdout.splitlines()) <= 40 and "verify: all passed" in done.stdout
    assert (sandbox.tree / "build/log/verify.txt").read_text() == "a sum\nall passed\n"
    assert "\033" not in done.stdout + done.stderr


def test_budgets_fit_into_the_limit(sandbox):
    """talk may take four fifths of what is left; what the stub leaves unused goes to m_sweep."""
    assert sandbox.run("./run_all.sh", "--no-install").returncode == 0
    left = 900 - 50
    talk, m_sweep = budgets(sandbox)
    assert talk in range(left * 4 // 5 - 5, left * 4 // 5 + 1)
    assert m_sweep in range(left * 19 // 20 - 5, left + 1)


def test_the_budget_shrinks_with_the_time_that_passed(sandbox):
    assert sandbox.run("./run_all.sh", "--no-install").returncode == 0
    unhurried = budgets(sandbox)
    sandbox.log.write_text("")
    done = sandbox.run("./run_all.sh", "--no-install", STUB_SLOW="run talk", STUB_SECONDS="5")
    assert done.returncode == 0
    slow = budgets(sandbox)
    assert slow[1] <= unhurried[1] - 3


def test_quick_carries_out_one_small_study(sandbox):
    done = sandbox.run("./run_all.sh", "--quick", "--no-install")
    assert done.returncode == 0, done.stderr
    run, = sandbox.calls("pairsum run")
    assert run.startswith("pairsum run quick ")
    assert os.path.dirname(value(run, "--out")) == "results/quick"
    assert 75 <= budgets(sandbox)[0] <= 90
    assert done.stdout.splitlines()[-1].endswith("/report.html")


def test_works_from_anywhere_and_with_another_results_folder(sandbox, tmp_path):
    done = sandbox.run("env", "-C", str(tmp_path), "tree/run_all.sh", "--quick", "--no-install",
                       "--results", "my results")
    assert done.returncode == 0, done.stderr
    assert len(list((tmp_path / "my results/quick").glob("*.jsonl"))) == 1
    assert not (sandbox.tree / "results").exists()
    assert re.search(r"^look at it: my results/quick/\S+/report.html$", done.stdout, re.MULTILINE)


def test_a_second_run_keeps_the_files_of_the_first(sandbox):
    sandbox.run("./run_all.sh", "--quick", "--no-install")
    time.sleep(1.1)
    sandbox.run("./run_all.sh", "--quick", "--no-install")
    files = list((sandbox.tree / "results/quick").glob("*.jsonl"))
    assert len(files) == 2 and all(len(file.read_text().splitlines()) == 1 for file in files)


def test_a_failed_verification_stops_before_measuring(sandbox):
    done = sandbox.run("./run_all.sh", "--no-install", STUB_FAILS="verify", STUB_STATUS="1")
    assert done.returncode == 1
    assert done.stderr.splitlines() == [
        "a sum", "all passed", "run_all.sh: the verification failed (exit 1); all of its output: build/log/verify.txt"]
    assert sandbox.calls("pairsum run") == []


@pytest.mark.parametrize("what, status", [("run m_sweep", 2), ("report", 5)])
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


def test_with_too_little_time_only_the_first_study_is_measured(sandbox):
    done = sandbox.run("./run_all.sh", "--no-install", "--limit", "60")
    assert done.returncode == 0, done.stderr
    run, = sandbox.calls("pairsum run")
    assert run.startswith("pairsum run talk ") and budgets(sandbox) == [192]  # one round in any case
    assert done.stdout.count("left out") == 1
    assert len(sandbox.calls("pairsum report")) == 1


def test_nothing_measured_is_no_success(sandbox):
    done = sandbox.run("./run_all.sh", "--no-install", "--quick", STUB_ROW="")
    assert done.returncode == 4
    assert done.stderr.splitlines()[-1].startswith("run_all.sh: nothing was measured within 120 s")
    assert sandbox.calls("pairsum report") == []


def test_a_hanging_study_is_cut_short(sandbox):
    done = sandbox.run("./run_all.sh", "--no-install", "--quick", "--limit", "5",
                       STUB_SLOW="run quick", STUB_SECONDS="50")
    assert done.returncode == 0, done.stderr
    assert "the study quick was cut short by the time limit" in done.stderr
    assert len(sandbox.calls("pairsum report")) == 1


@pytest.mark.parametrize("sent, status", [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_an_interrupt_ends_at_once_and_says_what_is_kept(sandbox, sent, status):
    running = sandbox.start("./run_all.sh", "--no-install", "--quick", STUB_SLOW="run quick",
                            STUB_SECONDS="50")
    began = time.monotonic()
    while not sandbox.calls("pairsum run") and time.monotonic() - began < 20:
        time.sleep(0.05)
    out = value(sandbox.calls("pairsum run")[0], "--out")
    while not (sandbox.tree / out).exists() and time.monotonic() - began < 20:  # the rows it will speak of
        time.sleep(0.05)
    time.sleep(0.3)
    os.kill(running.pid, sent)
    _, errors = running.communicate(timeout=10)
    assert running.returncode == status
    assert errors.splitlines()[-1] == (
        f"run_all.sh: interrupted; finished rounds are kept in {out}; "
        f"to go on: build/study/bin/pairsum run quick --out {out}")
    assert sandbox.calls("pairsum report") == []


def test_the_limit_counts_from_the_end_of_the_build(sandbox):
    sandbox.stub("cmake", '#!/bin/bash\nif [[ $1 == --build ]]; then sleep 4; mkdir -p build/study/bin; '
                          'cp "$STUBS/pairsum" build/study/bin/; fi\n')
    assert sandbox.run("./run_all.sh", "--quick", "--no-install").returncode == 0
    assert budgets(sandbox)[0] >= (120 - 30) * 19 // 20 - 1
