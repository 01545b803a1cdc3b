"""What the numbers say: medians with intervals, ratios, verdicts, components of variance (docs/statistics.md).

The value of a round is the unit: a median, an interval or a ratio is over rounds.
"""
import numpy as np
import pandas as pd
import scipy.stats

LEVEL = 0.95
#: Fewest rounds from which the interval of a ratio is made.
FEWEST_FOR_RATIO = 3
#: Fewest rounds from which the interval of a median is made (median_rank).
FEWEST_FOR_MEDIAN = 6


def median_rank(n: int, level: float = LEVEL) -> tuple[int, float]:
    """The rank k for which the k-th smallest and the k-th largest of n values enclose the median of their distribution
    with the least confidence from `level` up, whatever the distribution, and that confidence (David & Nagaraja, Order
    Statistics, 3rd ed., sec. 7.1). (0, nan) if n is too small: below 6 at 95 %."""
    half = scipy.stats.binom(n, 0.5)
    rank = int(half.ppf((1 - level) / 2))
    return (rank, 1 - 2 * half.cdf(rank - 1)) if rank > 0 else (0, np.nan)


def medians(values: pd.DataFrame, by: str) -> pd.DataFrame:
    """The median of every column in each group, and its interval as COLUMN_low and COLUMN_high; "confidence" and
    "rounds" belong to the group. Nothing of a column that has a null in the group."""
    parts = []
    sizes = values.groupby(by).size()
    for n, groups in sizes.groupby(sizes):
        own = values[values[by].isin(groups.index)].sort_values(by, kind="stable")
        columns = own.columns.drop(by)
        ordered = np.sort(own[columns].to_numpy(float).reshape(len(groups), n, len(columns)), axis=1)
        middle = pd.DataFrame(np.median(ordered, axis=1), groups.index, columns)
        rank, confidence = median_rank(n)
        ends = [pd.DataFrame(ordered[:, at] if rank else np.nan, groups.index, columns).where(middle.notna())
                .add_suffix(end) for at, end in ((rank - 1, "_low"), (n - rank if rank else 0, "_high"))]
        parts.append(pd.concat([middle, *ends], axis=1).assign(confidence=confidence, rounds=n))
    if not parts:
        names = [f"{name}{end}" for name in values.columns.drop(by) for end in ("", "_low", "_high")]
        return pd.DataFrame(columns=[*names, "confidence", "rounds"], index=pd.Index([], name=by), dtype=float)
    return pd.concat(parts).sort_index()


def ratios(logs: pd.DataFrame, base, other, level: float = LEVEL, paired: bool = True) -> pd.DataFrame:
    """The ratios base/other of times, of which `logs` has the logarithms: a line per round, a column per point. `base`
    and `other` list columns, pair by pair.

    "ratio" is exp(mean(log ratio)) over the rounds that both have, a geometric mean (Fleming & Wallace, Comm. ACM 29
    (1986) 218); "low", "high" and "p" (of a ratio of 1) are Student's t on the log ratios; "rounds" counts them. Of two
    that share no round, or with `paired` false, it is the ratio of geometric means with Welch's t (Biometrika 34 (1947)
    28), and "rounds" is 0. Below 3 rounds (on either side) there is no interval."""
    a, b = logs[list(base)].to_numpy(), logs[list(other)].to_numpy()
    both = a - b
    n = np.sum(~np.isnan(both), axis=0) if paired else np.zeros(both.shape[1], int)
    mean, variance = _moments(both)
    (mean_a, variance_a), (mean_b, variance_b) = _moments(a), _moments(b)
    n_a, n_b = np.sum(~np.isnan(a), axis=0), np.sum(~np.isnan(b), axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        of_a, of_b = variance_a / n_a, variance_b / n_b
        welch = (of_a + of_b) ** 2 / (of_a**2 / (n_a - 1) + of_b**2 / (n_b - 1))  # Welch-Satterthwaite
        estimate = np.where(n > 0, mean, mean_a - mean_b)
        error = np.sqrt(np.where(n > 0, variance / n, of_a + of_b))
        freedom = np.where(n > 0, n - 1, welch)
        enough = np.where(n > 0, n, np.minimum(n_a, n_b)) >= FEWEST_FOR_RATIO
        reach = np.where(error > 0, scipy.stats.t.ppf((1 + level) / 2, freedom) * error, 0)
        p = np.where(error > 0, 2 * scipy.stats.t.sf(np.abs(estimate / error), freedom), estimate == 0)
    found = pd.DataFrame({"ratio": np.exp(estimate), "low": np.exp(estimate - reach), "high": np.exp(estimate + reach),
                          "p": p, "rounds": n})
    found.loc[~enough, ["low", "high", "p"]] = np.nan
    return found


def _moments(values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Mean and unbiased variance of every column, without its nulls."""
    frame = pd.DataFrame(values)
    return frame.mean().to_numpy(), frame.var().to_numpy()


def holm(p: pd.Series) -> pd.Series:
    """Step-down adjusted p-values of the comparisons of one table (Holm, Scand. J. Stat. 6 (1979) 65): with those at
    most alpha resolved, even one false verdict is no likelier than alpha. Nulls were not tested and not counted."""
    tested = p.dropna().sort_values(kind="stable")
    steps = (tested * np.arange(len(tested), 0, -1)).clip(upper=1).cummax()
    return steps.reindex(p.index)


def verdicts(table: pd.DataFrame, alpha: float = 1 - LEVEL) -> pd.Series:
    """What each "ratio" with its "p" says of the other against its base: "faster", "slower" or "not resolved"."""
    resolved = holm(table["p"]) <= alpha
    words = np.select([resolved & (table["ratio"] > 1), resolved & (table["ratio"] < 1)], ["faster", "slower"],
                      "not resolved")
    return pd.Series(words, table.index, dtype=object)


def components_of_variance(values: pd.DataFrame, by: str, process: str, value: str) -> pd.DataFrame:
    """Relative standard deviations "between" processes and "within" them for each group: the method of moments for
    unbalanced one-way data (Searle, Casella, McCulloch, Variance Components, 1992, sec. 3.6); a negative estimate is 0,
    the mean is that of the processes' means. Without a process that has two values, "within" is null and "between"
    holds both; with one process "between" is null."""
    groups = values.groupby([by, process])[value].agg(["mean", "var", "count"])
    groups["inside"] = (groups["var"] * (groups["count"] - 1)).fillna(0)
    groups["sum"] = groups["mean"] * groups["count"]
    groups["square"] = groups["count"] ** 2.0
    total = groups.groupby(by).agg(centre=("mean", "mean"), inside=("inside", "sum"), n=("count", "sum"),
                                   square=("square", "sum"), sum=("sum", "sum"), k=("mean", "size"))
    spare = total["n"] - total["k"]
    within = (total["inside"] / spare).where(spare > 0)
    off = groups["mean"] - (total["sum"] / total["n"]).reindex(groups.index, level=by)
    outside = (groups["count"] * off**2).groupby(by).sum() / (total["k"] - 1)
    size = (total["n"] - total["square"] / total["n"]) / (total["k"] - 1)
    between = ((outside - within.fillna(0)) / size).clip(lower=0).where(total["k"] > 1)
    return pd.DataFrame({"between": between**0.5 / total["centre"], "within": within**0.5 / total["centre"]})
