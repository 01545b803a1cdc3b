"""What holds for every script: it parses, may be run, names no host, asks nothing."""
import os
import re
import subprocess

import pytest

from conftest import ROOT, SCRIPTS


@pytest.mark.parametrize("name", SCRIPTS)
def test_it_parses(name):
    done = subprocess.run(["bash", "-n", ROOT / name], capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")


def places_in(text):
    """Hosts, and folders that not every Debian has."""
    folders = re.findall(r"(?<![\w.$}~<*/-])/[a-z]+/[\w.]*", text)
    return re.findall("https?://", text) + [f for f in folders if f.split("/")[1] not in ("usr", "dev", "proc", "sys", "etc", "tmp")]


@pytest.mark.parametrize("name", SCRIPTS)
def test_it_names_no_host_and_no_folder_of_a_user(name):
    assert places_in((ROOT / name).read_text()) == []


def test_places_are_found():
    assert places_in('cd "/home/me/pairsum" >/dev/null; run /opt/tool/run; get https://a.b; "$dir/a/b" a/b/c') == [
        "https://", "/home/me", "/opt/tool"]


@pytest.mark.parametrize("name", [name for name in SCRIPTS if "harness" not in name])
def test_it_may_be_run(name):
    assert os.access(ROOT / name, os.X_OK)
    text = (ROOT / name).read_text()
    assert text.startswith("#!/usr/bin/env bash\n") and "\nset -euo pipefail\n" in text


def test_run_tests_ends_with_ctest(sandbox):
    done = sandbox.run("./run_tests.sh", "--no-install", "--jobs", "2")
    assert done.returncode == 0, done.stderr
    calls = [call for call in sandbox.calls() if not call.startswith("python -c")]
    python = sandbox.environment["PYTHON"]
    assert calls[0].startswith(f"cmake --preset test -DPython3_EXECUTABLE={python}")
    assert calls[1] == "cmake --build --preset test --parallel 2"
    assert calls[2].startswith("ctest --preset test ") and len(calls) == 3


def test_run_tests_fast_leaves_out_what_builds_anew(sandbox):
    done = sandbox.run("./run_tests.sh", "--no-install", "--fast")
    assert done.returncode == 0, done.stderr
    assert "--label-exclude leg|full" in sandbox.calls("ctest")[0]


def test_run_tests_returns_the_status_of_ctest(sandbox):
    sandbox.stub("ctest", "#!/bin/bash\necho summary of ctest\nexit 8\n")
    done = sandbox.run("./run_tests.sh", "--no-install")
    assert done.returncode == 8
    assert done.stdout.splitlines()[-1] == "summary of ctest"


def test_continuous_integration_runs_the_study_first_and_the_tests_last(sandbox):
    sandbox.stub("ctest", "#!/bin/bash\necho ctest >>\"$LOG\"\necho summary of ctest\n")
    done = sandbox.run(".ci/run", "--no-install", CI="true")
    assert done.returncode == 0, done.stderr
    assert sandbox.calls("pairsum run")[0].startswith("pairsum run quick ")
    assert sandbox.calls()[-1] == "ctest"
    assert done.stdout.splitlines()[-1] == "summary of ctest"


def test_continuous_integration_stops_at_a_failing_study(sandbox):
    done = sandbox.run(".ci/run", "--no-install", STUB_FAILS="verify", STUB_STATUS="1")
    assert done.returncode == 1
    assert sandbox.calls("ctest") == []


GROUPS = {
    "none": ({"proc/self/cgroup": "0::/\n"}, None, None),
    "version 2, a group above": ({
        "proc/self/cgroup": "0::/batch/job\n", "sys/fs/cgroup/batch/job/cpu.max": "max 100000\n", "sys/fs/cgroup/batch/cpu.max": "150000 100000\n",
        "sys/fs/cgroup/batch/job/memory.max": "max\n", "sys/fs/cgroup/batch/job/memory.current": "1048576\n",
        "sys/fs/cgroup/batch/memory.max": "104857600\n", "sys/fs/cgroup/batch/memory.current": "4194304\n"}, 1, 96),
    "version 1, beside 2": ({
        "proc/self/cgroup": "4:memory:/job\n2:cpu,cpuacct:/job/step\n0::/\n", "sys/fs/cgroup/unified/cgroup.procs": "",
        "sys/fs/cgroup/cpu,cpuacct/job/cpu.cfs_quota_us": "50000\n", "sys/fs/cgroup/cpu,cpuacct/job/cpu.cfs_period_us": "100000\n",
        "sys/fs/cgroup/cpu,cpuacct/cpu.cfs_quota_us": "-1\n", "sys/fs/cgroup/cpu,cpuacct/cpu.cfs_period_us": "100000\n",
        "sys/fs/cgroup/memory/job/memory.limit_in_bytes": "52428800\n", "sys/fs/cgroup/memory/job/memory.usage_in_bytes": "0\n",
        "sys/fs/cgroup/memory/memory.limit_in_bytes": "9223372036854771712\n", "sys/fs/cgroup/memory/memory.usage_in_bytes": "0\n"}, 1, 50),
    "in a container, which sees its own group": ({
        "proc/self/cgroup": "0::/docker/1a2b\n", "sys/fs/cgroup/cpu.max": "100000 100000\n", "sys/fs/cgroup/memory.max": "20971520\n",
        "sys/fs/cgroup/memory.current": "41943040\n"}, 1, 0),
}


@pytest.mark.parametrize("which", GROUPS)
def test_cores_and_memory_are_those_of_the_job(tmp_path, which):
    files, cores, memory = GROUPS[which]
    for name, text in files.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    words = 'set -euo pipefail; script=test; system_root=$1; . "$2"; cores; free_memory_mb; jobs_for 40'
    done = subprocess.run(["bash", "-c", words, "-", tmp_path, ROOT / "harness/scripts/steps.sh"], capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")
    found = list(map(int, done.stdout.split()))
    machine = len(os.sched_getaffinity(0))
    assert found[0] == (cores or machine) and found[2] == (1 if cores == 1 else min(machine, max(1, found[1] // 40)))
    assert found[1] == memory if memory is not None else found[1] > 100
