"""The numbers that another program, in C++, gave for the committed rows, to 1e-9, and what it said of them: golden.json.

What differs, and why: rows of schema 2 do not state the backends' traits, nor the flops and bytes of the model. So
whether symmetric sums scale as well as gathers, and how near a sum is to what the machine can do, are not answered from
them. The answer is now set against the gather and the symmetric sum instead of the fastest naive backend; what is the
fastest and what cannot be told from it is as it was, but in `vector`, where it is now the fastest of all parts instead of
that of the largest part. Of the questions it has the details alone. What is fastest is now chosen by geometric means, as
the ratios are; by medians before: ladders, shifts, best M and answers that depend on the choice were written anew.
"""
import functools
import json
import math
import pathlib

import jsonschema
import pytest
from committed import committed
from conftest import ROOT

import pairsum_results as pr
from pairsum_results import summary

UNKNOWN = ("Does it scale as well, within 5 %?", "Does a sum reach half of what the machine can do?")
GOLDEN = json.loads((pathlib.Path(__file__).parent / "golden.json").read_text())
SCHEMA = json.loads((ROOT / "plots/pairsum_results/summary.schema.json").read_text())


def rows(table, *columns):
    return table[list(columns)].values.tolist()


def condensed(report):
    """What golden.json has of a report."""
    r, points, bounds = report.results, report.points, ("ratio", "low", "high")
    backend = points["backend"]
    ladder = report.ladder.assign(base=report.ladder["base"].map(backend))
    timed = [f"{name}{end}" for name in ("sum_s", "total_s") for end in ("", "_low", "_high")]
    answer = report.answer
    return {
        "points": rows(points, *timed, "confidence", "rounds", "between", "within", "wait_share", "ns_per_pair"),
        "speedup": rows(report.speedup, "point", "base", *bounds, "rounds", "verdict", "machine_flops_scaling",
                        *(f"{name}{end}" for name in ("machine_speedup", "of_machine") for end in ("", "_low", "_high"))),
        **{name: rows(report.tables[name], "point", "base", *bounds, "rounds", "verdict")
           for name in ("algorithm_speedup", "runtime_comparison")},
        "m_comparison": rows(report.m_comparison, "point", "best_M", "over_best", "verdict", "collision_share",
                             "useful_pair_ratio"),
        "ladder": rows(ladder, "point", "base", "at", "rank", "of", "time_s", *bounds, "verdict",
                       *(f"{name}{end}" for name in ("over_serial", "efficiency") for end in ("", "_low", "_high")),
                       "extra_bytes", "world") if len(ladder) else [],
        "shifts": rows(report.shifts, "series", "backend", "base_series", "what", "rank", "base_rank", *bounds, "verdict"),
        "breaks_down": rows(report.strategies, "backend", "breaks_down"),
        "self_test": sorted(rows(report.self_test, "backend", "threads", "expected", *bounds, "confidence", "holds")),
        "answer": [[answer.point, answer.ties]],
        "questions": [[q["question"], q["answer"]] for q in report.questions],
        "failed": rows(r.failed, "backend", "threads", "rows", "error"),
        "caveats": [[c] for c in report.caveats],
        "peaks": rows(r.peaks, "threads", "precision", "bandwidth_bytes_per_s", "flops_per_s"),
        "rounds": [[len(r.closed), r.void_rounds, r.closed["others_share"].max()]]}


def same(found, expected):
    if expected is None:
        return found is None or found != found
    if isinstance(expected, float) or isinstance(found, float):
        return isinstance(found, (int, float)) and math.isclose(found, expected, rel_tol=1e-9, abs_tol=1e-12)
    if isinstance(expected, list):
        return len(found) == len(expected) and all(map(same, found, expected))
    if isinstance(expected, dict):
        return found.keys() == expected.keys() and all(same(found[key], expected[key]) for key in expected)
    return found == expected


@functools.cache
def report_of(name):
    """That of a committed rows file, like "talk/FILE.jsonl"."""
    return pr.report(pr.load(ROOT / "results" / name))


@pytest.fixture(scope="module", params=GOLDEN)
def compared(request):
    return condensed(report_of(request.param)), GOLDEN[request.param]


def test_every_number_is_as_it_was(compared):
    found, golden = compared
    assert found.keys() == golden.keys()
    for name, expected in golden.items():
        if name == "questions":
            expected = [row for row in expected if row[0] not in UNKNOWN]
        assert len(found[name]) == len(expected), name
        wrong = [(a, b) for a, b in zip(found[name], expected) if not same(a, b)]
        assert not wrong, f"{name}: {len(wrong)} of {len(expected)} differ, the first: {wrong[0]}"


def test_a_number_that_is_off_is_found(compared):
    found, golden = compared
    value = golden["points"][0][0]
    assert same(found["points"][0][0], value) and not same(value * (1 + 2e-9), value) and not same(None, value)
    assert not same([*found["points"][0][:-1], 7.0], golden["points"][0]) and not same(float("nan"), value)


@pytest.mark.parametrize("path", committed("results/*/*/summary.json"), ids=lambda path: path.parts[-3])
def test_every_committed_summary_is_that_of_its_rows(path):
    """If not: pairsum report --tables FILE.jsonl, and commit it."""
    kept = json.loads(path.read_text())
    jsonschema.validate(kept, SCHEMA)
    made_again = json.loads(summary._printed(summary.summary(report_of(str(path.parent.relative_to(ROOT / "results")
                                                                       .with_suffix(".jsonl"))))))
    assert [key for key in kept if not same(made_again.get(key), kept[key])] == [] and kept.keys() == made_again.keys()
    made_again["points"][-1]["sum_s"] *= 1 + 1e-8
    assert not same(made_again, kept)


def test_there_are_committed_summaries():
    assert len(committed("results/*/*/summary.json")) > 5
