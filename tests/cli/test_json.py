"""--json of verify and tune: one document on stdout, which obeys its schema; the lines for people on stderr. Colours."""

import copy
import json
import os
import pathlib
import pty
import subprocess

import jsonschema
import pytest
from conftest import BIN

SOURCE = pathlib.Path(os.environ["PAIRSUM_SOURCE"])
VERIFY = ["verify", "--dim", "3", "--precision", "double", "--smoothing", "wendland_c2", "--dx", "0.1", "--M", "3", "--threads", "1,2",
          "--isa", "scalar", "--backend", "naive,symmetric_omp"]
TUNE = ["tune", "--dx", "0.08", "--M", "3", "--threads", "1", "--backend", "naive,symmetric", "--grid", "hashed_grid,compact_grid",
        "--isa", "scalar", "--budget", "10", "--binding", "none"]


def schema_of(path):
    return jsonschema.Draft7Validator(json.loads((SOURCE / path).read_text()))


def changed(document, path, value):
    other = copy.deepcopy(document)
    *way, last = path
    at = other
    for key in way:
        at = at[key]
    at[last] = value
    return other


def test_verify(pairsum):
    said = pairsum(*VERIFY)
    done = pairsum(*VERIFY, "--json")
    assert done.returncode == 0
    document = json.loads(done.stdout)
    schema = schema_of("harness/cli/verify.schema.json")
    assert not list(schema.iter_errors(document))
    world, = document["worlds"]
    assert done.stderr == said.stdout and said.stderr == ""
    assert f"{document['sums']} of {document['sums']} sums agree" in done.stderr and document["failed"] == 0
    assert len(world["sums"]) == document["sums"] and (world["case"], world["dx"], world["state"]) == ("dam_break", 0.1, "perturbed")
    formulas = {(s["precision"], s["interaction"], s["smoothing"]) for s in world["sums"]}
    assert ("double", "ferrari09", "wendland_c2") in formulas and ("double", "count", None) in formulas
    one = [s for s in world["sums"] if s["interaction"] == "ferrari09" and s["grid"] == "hashed_grid"]
    assert sorted((s["backend"], s["threads"], s["M"]) for s in one) == [("naive", 1, 3), ("symmetric_omp", 1, 3), ("symmetric_omp", 2, 3)]
    assert all(0 < s["error_over_bound"] < 1 and s["failure"] is None for s in one)
    assert all(s["M"] is None for s in world["sums"] if s["grid"] == "compact_grid")
    for path, wrong in [(["schema"], "pairsum.verify/2"), (["worlds", 0, "sums", 0, "threads"], 0), (["more"], 1),
                        (["worlds", 0, "sums", 0, "failure"], False)]:
        assert list(schema.iter_errors(changed(document, path, wrong))), path


def test_verify_takes_the_other_grids_where_a_box_is_too_narrow_for_the_hashed_one(pairsum):
    words = ["--case", "periodic_lattice", "--dx", "0.15", "--state", "perturbed", "--grid", "all"]  # 3 cells along each axis
    done = pairsum("verify", "--dim", "3", "--precision", "double", "--smoothing", "wendland_c2", "--threads", "1,2", "--isa", "scalar",
                   "--backend", "naive,symmetric_omp", *words, "--json")
    assert done.returncode == 0, done.stderr
    document = json.loads(done.stdout)
    assert document["failed"] == 0
    assert {s["grid"] for world in document["worlds"] for s in world["sums"]} == {"dense_grid", "compact_grid"}


def test_verify_refuses_with_nothing_on_stdout(pairsum):
    done = pairsum("verify", "--backend", "nope", "--json")
    assert (done.returncode, done.stdout) == (2, "") and "nope" in done.stderr


def test_tune(pairsum, tmp_path):
    done = pairsum(*TUNE, "--json")
    assert done.returncode == 0
    document = json.loads(done.stdout)
    schema = schema_of("harness/tune/tune.schema.json")
    assert not list(schema.iter_errors(document))
    assert document["profile"] == "tune.profile.json" and (tmp_path / "tune.profile.json").is_file()
    assert "profile: tune.profile.json" in done.stderr and ": take " in done.stderr
    winner, candidates = document["winner"], document["candidates"]
    assert candidates[winner["candidate"]]["words"] == winner["words"] == json.loads((tmp_path / "tune.profile.json").read_text())["words"]
    assert winner["low"] <= winner["time_s"] <= winner["high"] and winner["rounds"] >= 6
    assert len(candidates) == len({c["words"] for c in candidates}) == 4
    for k, c in enumerate(candidates):
        assert (c["verdict"] is None) == (k == winner["candidate"] or c["look_s"] is None), c
        assert (c["look_s"] is None) == (c["fate"] in ("not_seen", "passed_by", "wrong")), c
        assert c["low"] is None or c["low"] <= c["ratio"] <= c["high"]
        assert (c["low"] is None) == (c["rounds"] < 3 or k == winner["candidate"])
        assert (c["grid"] == "compact_grid") == (c["M"] is None)
    for path, wrong in [(["schema"], "pairsum.tune/2"), (["candidates", 0, "fate"], "lost"), (["winner", "time_s"], -1), (["more"], 1)]:
        assert list(schema.iter_errors(changed(document, path, wrong))), path


def on_a_terminal(tmp_path, *words, **environment):
    """What the program writes to stdout where that is a terminal."""
    main, end = pty.openpty()
    kept = {key: value for key, value in os.environ.items() if key not in ("NO_COLOR", "TERM")}
    with subprocess.Popen([BIN / "pairsum", *words], cwd=tmp_path, stdout=end, stderr=subprocess.PIPE,
                          env={**kept, "TERM": "xterm", **environment}) as running:
        os.close(end)
        text = b""
        try:
            while part := os.read(main, 4096):
                text += part
        except OSError:
            pass  # how the end of a pseudo-terminal is told
        running.communicate()
    os.close(main)
    assert running.returncode == 0
    return text.decode()


@pytest.mark.parametrize("words, says", [(VERIFY, "\x1b[32m"), (TUNE, "take \x1b[1m")], ids=["verify", "tune"])
def test_verdicts_are_coloured_on_a_terminal_alone_and_never_with_no_color(tmp_path, pairsum, words, says):
    assert says in on_a_terminal(tmp_path, *words)
    assert "\x1b" not in on_a_terminal(tmp_path, *words, NO_COLOR="1")
    assert "\x1b" not in on_a_terminal(tmp_path, *words, TERM="dumb")
    assert "\x1b" not in pairsum(*words).stdout
