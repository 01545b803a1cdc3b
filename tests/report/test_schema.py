"""The JSON Schema of a summary against summaries of the program: it accepts them, and rejects broken ones. What it
accepts, the plots can read. CTest names the folder of the programs in PAIRSUM_BIN."""

import copy
import json
import os
import pathlib
import subprocess
import sys

import jsonschema
import pytest

ROOT = pathlib.Path(__file__).parents[2]
BIN = os.environ.get("PAIRSUM_BIN")
SCHEMA = json.loads((ROOT / "harness" / "report" / "summary.schema.json").read_text())
ROW_SCHEMA = json.loads((ROOT / "harness" / "rows" / "row.schema.json").read_text())
SHARED = ("point", "counters", "environment", "hex", "utc", "schema", "from_one", "from_one_or_null", "count", "count_or_null")
FREE = ("caches", "libraries")  # their keys are the machine's
PLAN = {
    "schema": "pairsum.plan/1", "study": "small", "title": "everything that a report has a table for", "budget_s": 0,
    "peaks": True, "self_test": True,
    "defaults": {"case": "dam_break", "dx": 0.06, "state": "rest", "steps": 2, "rounds": [3, 3]},
    "parts": [{"name": "all", "reason": "small", "M": "3,7", "threads": "all",
               "backend": "naive_omp,naive_tbb,sphysics_sweep,symmetric_omp,symmetric_tbb,again_symmetric_omp,corrupt_symmetric_omp"},
              {"name": "sparse", "reason": "few neighbours", "H": 0.07, "M": 7, "threads": "all",
               "backend": "naive_omp,sphysics_sweep,symmetric_omp"}],
}

sys.path.insert(0, str(ROOT / "plots"))
import summary as plots_summary  # noqa: E402

pytestmark = pytest.mark.skipif(not BIN, reason="PAIRSUM_BIN names no folder with pairsum")


def pairsum(folder, *words):
    done = subprocess.run([pathlib.Path(BIN) / "pairsum", *words], cwd=folder, text=True, capture_output=True, timeout=200)
    assert done.returncode == 0, done.stderr


def report_of(folder, *words):
    pairsum(folder, "run", *words, "--out", "rows.jsonl")
    pairsum(folder, "report", "rows.jsonl", "--out", "out")
    return json.loads((folder / "out" / "summary.json").read_text())


def measured_work(folder):
    """Flops and bytes of each point, as its rows say."""
    rows = [json.loads(line) for line in (folder / "rows.jsonl").read_text().splitlines()]
    return {json.dumps(row["point"], sort_keys=True): (row["work"]["flops"], row["work"]["bytes"])
            for row in rows if row["kind"] == "sample" and row["work"]}


@pytest.fixture(scope="module")
def validator():
    jsonschema.Draft7Validator.check_schema(SCHEMA)
    return jsonschema.Draft7Validator(SCHEMA)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("study")


@pytest.fixture(scope="module")
def summary(folder):
    """Of two algorithms, runtimes and M, with peaks, a copy and a corrupt backend."""
    (folder / "plan.json").write_text(json.dumps(PLAN))
    return report_of(folder, "plan.json")


def places(value, at=()):
    """The paths of all keys, of the first entry of each list."""
    if isinstance(value, list) and value:
        yield from places(value[0], at + (0,))
    if isinstance(value, dict):
        for key, inner in value.items():
            yield at + (key,)
            yield from places(inner, at + (key,))


def inner(data, place):
    for key in place:
        data = data[key]
    return data


def changed(data, place, new):
    """A copy with one value replaced, or removed if `new` is Ellipsis."""
    data = copy.deepcopy(data)
    if new is ...:
        del inner(data, place[:-1])[place[-1]]
    else:
        inner(data, place[:-1])[place[-1]] = new
    return data


def test_definitions_of_rows_are_those_of_the_rows():
    for name in SHARED:
        assert SCHEMA["definitions"][name] == ROW_SCHEMA["definitions"][name], name
    work = copy.deepcopy(ROW_SCHEMA["definitions"]["work"])
    for in_model in ("flops", "bytes"):
        del work["properties"][in_model]
    assert SCHEMA["definitions"]["work"] == work


def test_a_real_summary_is_valid_and_has_what_was_measured(summary, validator):
    validator.validate(summary)
    for table in ("series", "points", "speedup", "algorithm_speedup", "runtime_comparison", "m_comparison", "self_test",
                  "strategies", "strategy_ladder", "strategy_threads", "strategy_shifts", "peaks", "questions", "failed", "caveats"):
        assert summary[table], table
    assert {row["what"] for row in summary["strategy_shifts"]} == {"sparsity"}
    assert summary["answer"] and summary["points"][0]["model"] and summary["points"][0]["passes"]
    assert summary["rounds"]["finished"] == 6


def test_models_have_the_flops_and_bytes_of_the_rows(summary, folder):
    measured = measured_work(folder)
    models = {json.dumps(p["point"], sort_keys=True): (p["model"]["flops"], p["model"]["bytes"])
              for p in summary["points"] if p["model"]}
    assert len(models) > 10
    assert {point: measured[point] for point in models} == models


def test_the_plots_accept_a_real_summary(summary):
    plots_summary.check(summary)


def test_the_plots_reject_a_broken_one(summary):
    with pytest.raises(plots_summary.SummaryError):
        plots_summary.check(changed(summary, ("points", 0, "point", "threads"), None))


def test_a_small_study_of_one_backend_is_valid(tmp_path, validator):
    small = report_of(tmp_path, "--dx", "0.06", "--rounds", "1", "--backend", "symmetric", "--M", "7", "--threads", "1")
    validator.validate(small)
    plots_summary.check(small)
    assert small["questions"] == [] and small["speedup"] == [] and small["points"][0]["model"] is None


def test_a_missing_key_is_rejected(summary, validator):
    for place in places(summary):
        free = len(place) > 1 and (place[-2] in FREE or place[-2:] == ("point", "block"))
        assert validator.is_valid(changed(summary, place, ...)) == free, place


def test_an_unknown_key_is_rejected(summary, validator):
    objects = [place for place in [(), *places(summary)]
               if isinstance(inner(summary, place), dict) and place[-1:] not in [(free,) for free in FREE]]
    objects += [(table, 0) for table in summary if isinstance(summary[table], list) and summary[table]
                and isinstance(summary[table][0], dict)]
    assert len(objects) > 25
    for place in objects:
        assert not validator.is_valid(changed(summary, place + ("note",), 1)), place


def test_a_value_of_another_type_is_rejected(summary, validator):
    for place in places(summary):
        wrong = "text" if isinstance(inner(summary, place), (dict, list)) else [["text"]]
        assert not validator.is_valid(changed(summary, place, wrong)), place


@pytest.mark.parametrize("place, wrong", [
    (("schema",), "pairsum.summary/1"),
    (("sources",), []),
    (("points", 0, "rounds"), 0),
    (("points", 0, "round_s", 0), None),
    (("points", 0, "phases", "sum_s", "confidence"), 95),
    (("points", 0, "passes", "wait_share"), 1.5),
    (("points", 0, "passes", "busy_s"), []),
    (("points", 0, "model", "limited_by"), "luck"),
    (("points", 0, "fingerprint"), "abc"),
    (("speedup", 0, "speedup"), None),
    (("speedup", 0, "base_threads"), 2),
    (("algorithm_speedup", 0, "verdict"), "equal"),
    (("algorithm_speedup", 0, "base_time_s"), None),
    (("m_comparison", 0, "collision_share"), -0.5),
    (("self_test", 0, "holds"), None),
    (("strategies", 0, "conflicts"), "luck"),
    (("strategy_ladder", 0, "at"), "some_threads"),
    (("strategy_ladder", 0, "rank"), 0),
    (("strategy_ladder", 0, "extra_bytes"), -1),
    (("strategy_threads", 0, "ratio"), None),
    (("strategy_shifts", 0, "what"), "weather"),
    (("strategy_shifts", 0, "base_rank"), None),
    (("peaks", 0, "flops_per_s"), 0),
    (("failed", 0, "rows"), 0),
    (("rounds", "finished"), -1),
])
def test_a_wrong_value_is_rejected(summary, validator, place, wrong):
    assert not validator.is_valid(changed(summary, place, wrong))


@pytest.mark.parametrize("place", [("answer",), ("points", 0, "model"), ("points", 0, "passes"), ("points", 0, "work"),
                                   ("rounds", "others_share"), ("speedup", 0, "machine_flops_scaling"),
                                   ("points", 0, "workspace_bytes"), ("strategies", 0, "breaks_down"),
                                   ("strategy_ladder", 0, "over_serial"), ("strategy_ladder", 0, "efficiency")])
def test_what_may_be_unknown_may_be_null(summary, validator, place):
    assert validator.is_valid(changed(summary, place, None))
