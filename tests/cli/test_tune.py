"""pairsum tune and the profile that it saves."""

import json
import re
import shlex
import signal
import subprocess
import time

import pytest
from conftest import BIN, refused

SMALL = ["--dx", "0.08", "--M", "3", "--threads", "1", "--backend", "naive,symmetric", "--grid", "hashed_grid",
         "--isa", "scalar", "--budget", "10", "--binding", "none"]


@pytest.fixture
def profile(pairsum, tmp_path):
    done = pairsum("tune", *SMALL, "--save", "p.json")
    assert done.returncode == 0, done.stderr
    assert done.stdout.endswith(f"\nprofile: p.json\nto measure it again:\n  {BIN / 'pairsum'} run --profile p.json\n")
    assert not (tmp_path / "tune.profile.json").exists()
    return tmp_path / "p.json"


def test_tune_says_what_to_take_what_it_beat_and_how_to_measure_it_again(pairsum, tmp_path):
    done = pairsum("tune", *SMALL)
    assert (done.returncode, done.stderr) == (0, "")
    winner = re.search(r"^a whole step of \d+ fluid and \d+ boundary particles: take (\w+) M=3 threads=1 double$", done.stdout, re.M)
    assert winner and winner[1] in ("naive", "symmetric"), done.stdout
    assert re.search(r"^\S+ ms a step \[\S+, \S+\], \d+ rounds$", done.stdout, re.M), done.stdout
    other = {"naive": "symmetric", "symmetric": "naive"}[winner[1]]
    assert re.search(rf"^{other} M=3 threads=1 double +\S+  \[\S+, \S+\] +\d+  (slower|faster|not resolved)", done.stdout, re.M)
    assert json.loads((tmp_path / "tune.profile.json").read_text())["words"].startswith(f"backend={winner[1]} ")
    command = re.search(r"^  \S*pairsum (run .*)$", done.stdout, re.M)[1].split()
    assert command == ["run", "--profile", "tune.profile.json"]
    again = pairsum(*command, "--rounds", 1, "--steps", 1, "--out", "again.jsonl")
    assert again.returncode == 0, again.stderr
    assert f"\n{winner[1]} " in again.stdout


def test_a_profile_takes_the_place_of_one_and_of_nothing_else(pairsum, profile, tmp_path):
    first = profile.read_text()
    done = pairsum("tune", *SMALL, "--save", "p.json")
    assert done.returncode == 0 and "profile: p.json (in place of the one that was there)" in done.stdout
    assert profile.read_text() != first
    for name, content in [("p.json", '{"schema": "other"}'), ("p.json", "a,b\n1,2\n"), ("tune.profile.json", "[1]"), ("p.json", "")]:
        (tmp_path / name).write_text(content)
        done = pairsum("tune", *SMALL, *(["--save", name] if name == "p.json" else []))
        assert refused(done, f"does not write over {name}", "no profile", "--save FILE")
        assert (tmp_path / name).read_text() == content


def test_the_command_takes_a_name_as_a_shell_does(pairsum, tmp_path):
    done = pairsum("tune", *SMALL, "--save", "it's mine.json")
    assert done.returncode == 0, done.stderr
    command = re.search(r"^  \S*pairsum (run .*)$", done.stdout, re.M)[1]
    assert shlex.split(command) == ["run", "--profile", "it's mine.json"]


def test_tune_of_the_sum_alone(pairsum):
    done = pairsum("tune", *SMALL, "--phase", "sum", "--state", "perturbed")
    assert done.returncode == 0 and re.match(r"the sum of \d+ fluid", done.stdout), done.stdout
    assert " ms a sum" in done.stdout


def test_all_isas_are_scalar_and_the_vector_units(pairsum):
    built = json.loads(pairsum("list", "--json").stdout)["isas"]
    done = pairsum("tune", "--dx", "0.08", "--M", "3", "--threads", "1", "--backend", "symmetric", "--grid", "hashed_grid",
                   "--budget", "10", "--binding", "none", "--isa", "all")
    assert done.returncode == 0, done.stderr
    found = re.findall(r"(?:take |^)symmetric M=3 threads=1 (?:(\w+) )?double", done.stdout, re.M)
    assert sorted(found) == sorted(["", *built]), done.stdout


def test_every_backend_is_tried_scalar_and_on_the_best_vector_units(pairsum):
    done = pairsum("tune", "--dx", "0.08", "--M", "3", "--threads", "1", "--backend", "symmetric,tiles_omp", "--grid",
                   "hashed_grid", "--budget", "10", "--binding", "none", "--json")
    tried = {(c["backend"], c["isa"] == "scalar") for c in json.loads(done.stdout)["candidates"]}
    assert tried == {("symmetric", True), ("symmetric", False), ("tiles_omp", False)}


def test_run_takes_the_words_of_a_profile_and_options_go_before_them(pairsum, profile, tmp_path):
    words = dict(word.split("=") for word in json.loads(profile.read_text())["words"].split())
    done = pairsum("run", "--profile", profile, "--rounds", 1, "--state", "perturbed", "--out", "rows.jsonl")
    assert done.returncode == 0, done.stderr
    points = [row["point"] for row in map(json.loads, (tmp_path / "rows.jsonl").read_text().splitlines()) if row["kind"] == "sample"]
    assert len({json.dumps(p) for p in points}) == 1
    assert (points[0]["backend"], points[0]["grid"], points[0]["M"]) == (words["backend"], words["grid"], 3)
    assert (points[0]["dx"], points[0]["state"], points[0]["threads"]) == (0.08, "perturbed", 1)


def test_a_profile_of_another_machine_is_said(pairsum, profile):
    data = json.loads(profile.read_text())
    data["machine"].update(cpu="another", host="there", cores=640)
    profile.write_text(json.dumps(data))
    done = pairsum("run", "--profile", profile, "--dry-run")
    assert done.returncode == 0 and "made on there (another, 640 cores)" in done.stdout


@pytest.mark.parametrize("words, says", [
    (["--backend", "nope"], ["nope", "naive"]),
    (["--grid", "nope"], ["nope", "hashed_grid"]),
    (["--block", "nope"], ["slab:N"]),
    (["--M", "1"], ["M must be"]),
    (["--phase", "nope"], ["phase", "total, sum"]),
    (["--budget", "0"], ["budget must be a positive"]),
    (["--budget", "nan"], ["budget must be a positive"]),
    (["--budget", "0.0001"], ["none of the", "candidates was measured", "--budget"]),
    (["--budget", "soon"], ["soon"]),
    (["--dx", "0.08,0.1"], ["tune takes one dx"]),
    (["--state", "rest,perturbed"], ["tune takes one state"]),
    (["--binding", "nope"], ["nope", "cores_first"]),
    (["--save", ""], ["--save"]),
    (["--save", "/proc/nope/p.json"], ["/proc/nope/p.json"]),
    (["--save", "."], ["folder"]),
    (["--nope"], ["--nope"]),
])
def test_tune_refuses(pairsum, words, says):
    given = SMALL.copy()
    if words[0] in given:
        del given[given.index(words[0]):given.index(words[0]) + 2]
    assert refused(pairsum("tune", *given, *words), *says)


def test_a_profile_that_is_none_is_refused(pairsum, profile):
    whole = profile.read_text()
    data = json.loads(whole)
    for content, says in [("[]", "JSON object"),
                          (json.dumps({**data, "schema": "pairsum.profile/9"}), "pairsum.profile/1"),
                          (json.dumps({**data, "words": "backend=naive"}), "a profile lacks threads"),
                          (json.dumps({**data, "words": "backend=naive threads=1 x=2"}), 'key of a profile "x"'),
                          (json.dumps({**data, "more": 1}), '"more"'),
                          (json.dumps({key: data[key] for key in data if key != "case"}), '"case" is missing')]:
        profile.write_text(content)
        assert refused(pairsum("run", "--profile", profile), "p.json", "no profile", says)
    for content, says in [(whole[:100], "this is no JSON"), ("", "p.json: is empty"), ('{"schema": 1, "schema": 1}', "p.json:1:15: key")]:
        profile.write_text(content)
        assert refused(pairsum("run", "--profile", profile), says)
    assert refused(pairsum("run", "--profile", "missing.json"), "missing.json")
    assert refused(pairsum("run", "--profile", ""), "--profile")
    profile.write_text(json.dumps({**data, "words": "backend=nope threads=1"}))
    assert refused(pairsum("run", "--profile", profile), "nope", "naive")
    assert refused(pairsum("run", "quick", "--profile", profile), "--profile", "quick")


def test_an_interrupt_ends_it_and_writes_nothing(tmp_path):
    words = [BIN / "pairsum", "tune", "--dx", "0.04", "--M", "3", "--threads", "1", "--backend", "naive,symmetric", "--budget", "60",
             "--save", "p.json"]
    with subprocess.Popen(words, cwd=tmp_path, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as running:
        time.sleep(1.5)
        running.send_signal(signal.SIGINT)
        out, err = running.communicate(timeout=30)
    assert (running.returncode, err) == (130, "")
    assert out.splitlines()[-1] == "interrupted; no profile was written"
    assert not (tmp_path / "p.json").exists()
