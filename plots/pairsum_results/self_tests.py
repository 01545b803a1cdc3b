"""Backends whose behaviour is known: do the numbers say so?"""
import numpy as np
import pandas as pd

from . import stats
from .load import PLACE, Results


def self_tests(results: Results) -> pd.DataFrame:
    """The backends that test the harness: `what`, `base_backend`, `expected` (time over the base's; null where
    verification must refuse it)."""
    found = results.backends.dropna(subset=["self_test.what"])
    return found.filter(like="self_test.").rename(columns=lambda name: name.removeprefix("self_test."))


def self_test(results: Results) -> pd.DataFrame:
    """What the harness says of backends whose behaviour is known: `expected` and found `ratio` of their time over that
    of the base, with an interval at 95 % over the whole table (Bonferroni); `holds`, and why in `text`. A copy should
    lie within its interval, a calibrated delay too, and a corrupt backend should have no time."""
    tests, place = self_tests(results), ["case", "state", "dx", *PLACE]
    points = results.points.reset_index()
    own = points[points["backend"].isin(tests.index)].join(tests, on="backend")
    level = 1 - (1 - stats.LEVEL) / max(len(own), 1)
    same = ["series", *(name for name in PLACE if name != "backend")]
    pairs = own.merge(points[[*same, "backend", "point"]].rename(columns={"backend": "base_backend", "point": "base"}),
                      on=[*same, "base_backend"], how="left")
    timed = pairs["base"].notna() & pairs["point"].map(results.times().notna())
    found = stats.ratios(results.logs(), pairs.loc[timed, "point"], pairs.loc[timed, "base"].astype(int), level)
    pairs = pairs.join(found.set_axis(pairs.index[timed]).rename(columns={"rounds": "pairs"}))
    failed = results.failed[results.failed["backend"].isin(tests.index)].join(tests, on="backend")
    table = pd.concat([pairs.assign(error=None), failed], ignore_index=True)
    table[["pairs", "ratio", "low", "high"]] = table.reindex(columns=["pairs", "ratio", "low", "high"]).where(
        table.reindex(columns=["pairs"])["pairs"].fillna(0) > 0)
    verdicts = [_self_test_verdict(e) for e in table.itertuples()]
    table["holds"], table["text"] = [v[0] for v in verdicts], [v[1] for v in verdicts]
    table["confidence"] = np.where(table["low"].notna(), level, np.nan)
    return table[["what", "base_backend", *place, "expected", "ratio", "low", "high", "confidence", "holds", "text"]]


def _self_test_verdict(e) -> tuple[bool, str]:
    wrong = pd.isna(e.expected)
    if isinstance(e.error, str):
        return wrong, ("refused, as it must be: " if wrong else "failed its verification: ") + e.error
    if wrong:
        return False, "it got a time, although it is wrong"
    if pd.isna(e.base):
        return False, "its base was not measured"
    if pd.isna(e.pairs):
        return False, "its base was not measured in the same rounds"
    if pd.isna(e.low):
        return False, "too few rounds for an interval"
    inside, told = e.low <= e.expected <= e.high, e.low > 1
    return inside, (f"{e.ratio:.4f} [{e.low:.4f}, {e.high:.4f}], {e.expected:g} expected: "
                    f"{'inside' if inside else 'OUTSIDE'} the interval"
                    + ("" if e.expected == 1 else ", told from its base" if told else ", not told from its base"))
