"""The statistics that the program needs while it runs (the stop rule, tune) are scipy's."""
import json
import os
import pathlib
import subprocess

import numpy as np
import pytest
import scipy.stats

BIN = pathlib.Path(os.environ["PAIRSUM_BIN"])
RANDOM = np.random.default_rng(2009)


def said(**question):
    """What the program says."""
    done = subprocess.run([BIN / "stats_of"], input=json.dumps(question), capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


@pytest.mark.parametrize("n", [1, 2, 5, 6, 7, 10, 20, 21, 101, 1000])
def test_median_and_its_interval(n):
    values = np.exp(RANDOM.normal(size=n))
    found = said(what="median", of=list(values))
    assert found["value"] == pytest.approx(np.median(values), rel=1e-15)
    rank = int(scipy.stats.binom(n, 0.5).ppf(0.025))  # the most that the two tails leave below 5 %
    if rank == 0:
        assert found["ends"] is None and n < 6
    else:
        ordered = np.sort(values)
        confidence = 1 - 2 * scipy.stats.binom.cdf(rank - 1, n, 0.5)
        assert found["ends"] == pytest.approx([ordered[rank - 1], ordered[n - rank], confidence], rel=1e-12)
        assert confidence >= 0.95 > 1 - 2 * scipy.stats.binom.cdf(rank, n, 0.5)


@pytest.mark.parametrize("n", [3, 4, 9, 50])
@pytest.mark.parametrize("level", [0.8, 0.95, 0.9999])
def test_paired_ratio(n, level):
    base, other = np.exp(RANDOM.normal(0.2, 0.3, n)), np.exp(RANDOM.normal(0, 0.1, n))
    test = scipy.stats.ttest_rel(np.log(base), np.log(other))
    low, high = test.confidence_interval(level)
    found = said(what="ratio", base=list(base), other=list(other), level=level)
    assert found["value"] == pytest.approx(np.exp(np.mean(np.log(base / other))), rel=1e-12)
    assert found["ends"] == pytest.approx([np.exp(low), np.exp(high), level], rel=1e-8)
    assert (found["p"], found["pairs"]) == (pytest.approx(test.pvalue, rel=1e-8), n)


def test_ratios_without_scatter_and_of_few_rounds():
    assert said(what="ratio", base=[2, 2, 2], other=[1, 1, 1]) == {"value": 2, "ends": [2, 2, 0.95], "pairs": 3, "p": 0}
    assert said(what="ratio", base=[3, 3, 3], other=[3, 3, 3])["p"] == 1
    assert said(what="ratio", base=[2, 3], other=[1, 1])["ends"] is None
    assert said(what="verdict", base=[2, 4, 6], other=[1, 2, 3]) == "faster"
    assert said(what="verdict", base=[1, 2, 3], other=[2, 4, 6]) == "slower"
    assert said(what="verdict", base=[1, 2, 3], other=[2, 1, 3]) == "not resolved"


@pytest.mark.parametrize("freedom", [1, 2, 2.5, 9, 300])
def test_student_t(freedom):
    for p in (1e-9, 0.025, 0.3, 0.5, 0.9, 0.999999):
        assert said(what="quantile", of=p, freedom=freedom) == pytest.approx(scipy.stats.t.ppf(p, freedom), rel=1e-8, abs=1e-12)
    for t in (0, 1e-8, 0.5, 3, 40, 1e6):
        assert said(what="tails", of=t, freedom=freedom) == pytest.approx(2 * scipy.stats.t.sf(t, freedom), rel=1e-9)


def test_holm():
    assert said(what="holm", of=[0.01, 0.04, 0.03, 0.005]) == pytest.approx([0.03, 0.06, 0.06, 0.02])  # Holm 1979
    p = RANDOM.uniform(size=30) ** 3
    ordered = np.argsort(p)
    steps = np.minimum(1, np.maximum.accumulate(p[ordered] * np.arange(30, 0, -1)))
    assert said(what="holm", of=list(p)) == pytest.approx(steps[np.argsort(ordered)], rel=1e-12)


@pytest.mark.parametrize("question, names", [
    ({"what": "median", "of": []}, "at least one"), ({"what": "median", "of": [1, 2], "level": 1}, "between 0 and 1"),
    ({"what": "ratio", "base": [1, 2], "other": [1]}, "as many"), ({"what": "ratio", "base": [1, 0, 1], "other": [1, 1, 1]}, "positive"),
    ({"what": "holm", "of": [1.1]}, "p-value"), ({"what": "quantile", "of": 1, "freedom": 3}, "between 0 and 1"),
    ({"what": "tails", "of": 1, "freedom": 0}, "freedom")])
def test_what_is_no_sample_is_refused(question, names):
    assert names in said(**question)["error"]
