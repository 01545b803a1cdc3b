"""The machines and builds that rows come from: what may not be mixed in one comparison."""
import json

import numpy as np
import pandas as pd

#: The share of the machine that other processes may take before a round counts as disturbed.
QUIET = 0.05
_BUILD = ["host", "cpu", "compiler", "flags", "git", "dirty", "binding"]


def builds(rows: pd.DataFrame, samples: pd.DataFrame) -> tuple[pd.DataFrame, pd.DataFrame]:
    """The environments that samples name, each once, and the same for each file; with the number of their build."""
    used = samples[["file", "environment"]].drop_duplicates()
    found = used.merge(rows.drop_duplicates(["file", "environment"], keep="last"), on=["file", "environment"])
    plugins = [json.dumps({k: v for k, v in sorted(one.items()) if k.startswith("plugin ")})
               for one in found["libraries"]]
    found["build"] = found.assign(plugins=plugins).groupby([*_BUILD, "plugins"], sort=False).ngroup()
    found["revision"] = found["git"] + np.where(found["dirty"].astype(bool), " with uncommitted changes", "")
    found["build_name"] = found["compiler"] + ", git " + found["revision"]
    return found.drop_duplicates(["environment", "host", "git"]).reset_index(drop=True), found


def names(table: pd.DataFrame, columns: list[str]) -> pd.Series:
    """Of every line its first column, with as many of the others as tell the lines apart, if they do."""
    name = table[columns[0]]
    for column in columns[1:]:
        several = table[column].nunique(dropna=False) > 1 and name.duplicated(keep=False).any()
        unit = " cores" if column == "cores" else ""
        name = name + (", " + table[column].fillna("").astype(str) + unit if several else "")
    return name


def differences(environments: pd.DataFrame) -> str:
    """What differs between machines and builds, like "host (a, b), git (x, y)"."""
    columns = {"host": "host", "cpu": "cpu", "compiler": "compiler", "flags": "flags", "git": "revision",
               "binding": "binding"}
    values = {name: sorted(set(environments[column])) for name, column in columns.items()}
    return ", ".join(f"{name} ({', '.join(some)})" for name, some in values.items() if len(some) > 1)


def measured_together(samples: pd.DataFrame) -> bool:
    """Are there several builds, and was every one measured in a round with the first?"""
    in_round = samples.groupby(["file", "study", "round"])["build"].agg(set)
    with_first = set().union(*(builds for builds in in_round if 0 in builds))
    return samples["build"].nunique() > 1 and len(with_first) == samples["build"].nunique()


def caveats(closed: pd.DataFrame, environments: pd.DataFrame, differ: str, together: bool) -> list[str]:
    found = []
    for source, shares in closed.groupby("source", sort=False)["others_share"]:
        disturbed = int((shares > QUIET).sum())
        if disturbed:
            found.append(f"{source.split('/')[-1]}: in {disturbed} of {len(shares)} rounds other processes used more "
                         f"than {100 * QUIET:.0f} % of the machine")
    if differ:
        found.append(("the builds differ, which is what is compared: " if together else
                      "rows of different machines or builds in one report: ") + differ)
    if environments["dirty"].any():
        found.append("built from a tree with uncommitted changes")
    loose = environments.loc[environments["binding"].str.startswith("none"), "binding"]
    if len(loose):
        found.append(f"threads were not pinned ({loose.iloc[0]})")
    for limits in environments.get("limits", pd.Series(dtype=object)).dropna().unique():
        if "processors" in limits:
            found.append(f"a control group limits the job to {limits}: threads beyond that are paused in turns")
    if environments["governor"].fillna("unknown").nunique() > 1:
        found.append("rows with different frequency governors")
    return found
