"""Everything that is said of results, made once: what summary.json, tables, figures and page are written from."""
import dataclasses

import numpy as np
import pandas as pd

from . import compare, ladders
from .answers import Answer, answer
from .densities import density
from .load import Results, place_words
from .model import models, shares
from .questions import questions
from .scaling import scaling, unlike
from .self_tests import self_test
from .stats import FEWEST_FOR_MEDIAN


@dataclasses.dataclass
class Report:
    """`points` are those of the results with what models and shares say; the other tables are what the functions of
    their names give: compare.py, densities.py, scaling.py, and ladders.py for `standings`, `ladder`, `shifts`,
    `strategies`."""
    results: Results
    title: str
    points: pd.DataFrame
    speedup: pd.DataFrame
    algorithm_speedup: pd.DataFrame
    runtime_comparison: pd.DataFrame
    compiler_comparison: pd.DataFrame
    m_comparison: pd.DataFrame
    density: pd.DataFrame
    scaling: pd.DataFrame
    standings: pd.DataFrame
    ladder: pd.DataFrame
    shifts: pd.DataFrame
    strategies: pd.DataFrame
    self_test: pd.DataFrame
    answer: Answer | None
    questions: list[dict[str, str]]
    caveats: list[str]

    @property
    def tables(self) -> dict[str, pd.DataFrame]:
        """The tables by name."""
        return {name: value for name, value in vars(self).items() if isinstance(value, pd.DataFrame)}


def report(results: Results) -> Report:
    """What can be said of the results."""
    points = results.points.join(models(results)).join(shares(results))
    of_points = {name: getattr(compare, name)(results) for name in
                 ("speedup", "algorithm_speedup", "runtime_comparison", "compiler_comparison", "m_comparison")}
    found = ladders.ladder(results)
    shifted = ladders.shifts(results, found)
    tested, said = self_test(results), answer(results)
    asked = questions(results, points["series"][said.point], {**of_points, "points": points}) if said else []
    studies, hosts = results.series["study"].unique(), results.environments["host"].unique()
    return Report(results, f"{', '.join(studies)} on {', '.join(hosts)}", points, **of_points, density=density(results),
                  scaling=scaling(results), standings=ladders.standings(results), ladder=found,
                  shifts=shifted, strategies=ladders.strategies(results, found, shifted), self_test=tested, answer=said,
                  questions=asked, caveats=_caveats(results, of_points, tested))


def _caveats(results: Results, tables: dict[str, pd.DataFrame], tested: pd.DataFrame) -> list[str]:
    points, labels = results.points, compare.labels(results)
    found = list(results.caveats)
    for what, which in (("more threads than cores", points["threads"] > points["cores"]),
                        (f"fewer than {FEWEST_FOR_MEDIAN} rounds, so no interval of the median",
                         points["rounds"] < FEWEST_FOR_MEDIAN)):
        if which.any():
            found.append(f"{what}: {compare.first_few(list(labels[which]))}")
    steps = results.samples[results.samples["counts"]]
    few = (steps["threads_worked"] < steps["threads"]).groupby(steps["point"]).agg(["sum", "size"])
    if (few := few[few["sum"] > 0]).size:
        found.append("fewer threads worked in a step than were asked for: " + compare.first_few(
            [f"{labels[e.Index]} ({e.sum} of {e.size} steps)" for e in few.itertuples()]))
    if (losing := points[points["lost"] > 0]).size:
        found.append("particles left Omega, and later steps summed the others alone: " + compare.first_few(
            [f"{labels[e.Index]} ({e.lost:.0f} of {e.n_fluid} fluid particles)" for e in losing.itertuples()]))
    found += compare.without_base(results)
    for table in tables.values():
        apart = table[(table["rounds"] == 0) & (table["point"] != table["base"])]
        found += [f"{labels[e.base]} and {labels[e.point]} were measured in different rounds: their ratio is not paired"
                  for e in apart.itertuples()]
    for e in tested[~tested["holds"].astype(bool)].itertuples():
        cells = "" if np.isnan(e.M) else f" M={e.M:.0f}"
        found.append(f"self-test {e.backend}{cells} threads={e.threads} does not hold: {e.text}")
    found += unlike(results)
    found += [f"{place_words(f)}: {f.rows} row{'' if f.rows == 1 else 's'} without a passed verification left out"
              for f in results.failed.itertuples()]
    return list(dict.fromkeys(found))
