"""What a reader sees first, as values for the page: warnings, the answer, ladders of all backends, case by case."""
from typing import Any

import pandas as pd

from . import words
from .builds import QUIET
from .compare import first_few
from .figures import cases, ladder
from .figures.style import FAMILIES
from .ladders import families, worlds
from .load import PLACE
from .reports import Report
from .self_tests import self_tests

_USUAL = ("", "scalar", "none", "auto")  # what is not said of a point


def warnings(report: Report) -> list[str]:
    """What to know before any number: disturbed rounds, points that failed their verification."""
    shares, failed = report.results.closed["others_share"], report.results.failed
    failed = failed[~failed["backend"].isin(self_tests(report.results).index)]  # of those it is what was expected
    found = []
    if disturbed := int((shares > QUIET).sum()):
        found.append(f"{disturbed} of {len(shares)} rounds {'was' if disturbed == 1 else 'were'} disturbed: other "
                     f"processes took up to {100 * shares.max():.2g} % of the machine. Small differences may come from that.")
    if len(failed):
        found.append(f"{len(failed)} point{'s' * (len(failed) > 1)} failed the verification: "
                     f"{first_few(failed['backend'].drop_duplicates())}. Their times do not count.")
    return found


def card(report: Report) -> dict[str, Any] | None:
    """The answer in numbers with intervals, none if it is open, and what it is the answer to."""
    answer = report.answer
    if answer is None:
        return None
    p, e = report.points.loc[answer.point], report.results.environments.drop_duplicates("build").iloc[0]
    numbers = []
    for over, than in ((answer.over_gather, "the gather"), (answer.over_symmetric, "the symmetric sum")):
        if over and pd.notna(over["low"]):
            numbers.append((f"{over['ratio']:.2f} times", f"as fast as {than}, {over['name']}",
                            words.between(over["low"], over["high"], "{:.2f}".format)))
    if pd.notna(p["total_s_low"]):
        numbers.append((words.time(p["total_s"]), "a step",
                        words.between(p["total_s_low"], p["total_s_high"], words.time)))
    tied = dict.fromkeys(report.points["backend"][answer.ties])
    tied.pop(p["backend"], None)  # with another grid or M
    fastest = "Fastest" if answer.decided else "Fastest so far"
    facts = {fastest: f"{p['backend']} with {words.threads_words(p['threads'])}, {_place(p)}",
             "Ties with": first_few(list(tied)),
             "Case": f"{p['case']}, {p['dim']}D, {p['state']}, spacing {p['dx']:g}",
             "Particles": f"{words.count(p['n_fluid'])} fluid"
             + (f", {words.count(p['n_boundary'])} boundary" if p["n_boundary"] else ""),
             "Precision": p["precision"], "Machine": f"{e['host']}: {e['cpu']}, {e['cores']} cores",
             "Rounds": f"{p['rounds']} of this point, {len(report.results.closed)} in all"}
    return {"text": answer.text, "decided": answer.decided, "numbers": numbers if answer.decided else [],
            "facts": {name: said for name, said in facts.items() if said}, "command": answer.command}


def _place(p: Any) -> str:
    """Where a point was measured, in a few words."""
    cells = f"{p['grid']}" + ("" if pd.isna(p["M"]) else f" M = {p['M']:.0f}")
    return ", ".join([cells, *(p[name] for name in ("isa", "block") if p[name] not in _USUAL)])


def start(report: Report) -> tuple[str, int]:
    """Case and number of threads that are shown first: those of the answer."""
    names = worlds(report.results)
    if report.answer is None:
        return str(names.iloc[0]) if len(names) else "", 1
    p = report.points.loc[report.answer.point]
    return names[p["series"]], int(p["threads"])


def ladders(report: Report) -> dict[tuple[str, int], dict[str, Any]]:
    """By case and number of threads: all backends against the base. Positions are in % of the width."""
    kinds, found = families(report.results), {}
    for (_, threads), own in report.standings.groupby(["series", "threads"]):
        end, tied = ladder.reach(own) / 100, own["tied"] & (own["tied"].sum() > 1)
        apart = [name for name in PLACE if own[name].nunique(dropna=False) > 1 and name not in ("backend", "threads",
                                                                                                  "granularity")]
        rungs = [{"name": e.backend, "detail": _detail(e, apart), "family": kinds[e.backend],
                  "at": min(e.ratio / end, 100), "low": e.low / end, "high": min(e.high / end, 100),
                  "interval": pd.notna(e.low) and e.point != e.base, "ratio": f"{e.ratio:.2f}",
                  "time": words.time(e.time_s), "tied": tied[e.Index], "title": _title(e)} for e in own.itertuples()]
        found[own["world"].iloc[0], threads] = {
            "headline": ladder.headline(own), "one": 1 / end, "rungs": rungs,
            "families": {kind: text for kind, (_, text) in FAMILIES.items() if kind in set(kinds[own["backend"]])}}
    return found


def _detail(e: Any, apart: list[str]) -> str:
    """What tells this point's grid and block from those of the other backends on the ladder."""
    values = {name: getattr(e, name) for name in apart}
    if pd.notna(values.get("M")):
        values |= {"M": f"M = {e.M:.0f}", "grid": "" if e.grid == "hashed_grid" else e.grid}
    return ", ".join(value for value in values.values() if isinstance(value, str) and value not in _USUAL)


def _title(e: Any) -> str:
    return (f"{e.backend} on {_place(e._asdict())}, {words.threads_words(e.threads)}: {words.time(e.time_s)} a step, "
            f"{words.bounded(e.ratio, e.low, e.high, missing=' (no interval)')} times as fast as {e.base_backend}; "
            f"rank {e.rank} of {e.of}" + (", not to be told from the fastest" if e.tied and e.rank > 1 else ""))


def by_case(report: Report) -> dict[str, Any] | None:
    """Backends (rows) by cases (columns): time over that of the fastest of the case, and how pale that is."""
    lines, table = cases.grid(report), report.standings
    if lines.empty:
        return None
    first = table.drop_duplicates("series").set_index("series")
    rows = [(backend, [_behind(None if pd.isna(k) else table.loc[int(k)]) for k in row])
            for backend, row in zip(lines.index, lines.to_numpy())]
    return {"columns": [first["world"][series].replace("_", "_\u200b") for series in lines.columns], "rows": rows}


def _behind(e: pd.Series | None) -> dict[str, Any]:
    if e is None:
        return {"text": "-", "shade": len(cases.STEPS), "title": "not measured"}
    return {"text": f"{e['behind']:.2f}", "shade": cases.shade(e["behind"]),
            "title": f"{e['backend']}, {e['world']}, {words.threads_words(e['threads'])}: {words.time(e['time_s'])} a "
            f"step, {words.bounded(e['behind'], e['behind_low'], e['behind_high'])} times the fastest; rank {e['rank']} of "
            f"{e['of']}"}
