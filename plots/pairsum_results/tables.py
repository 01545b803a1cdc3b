"""The report as text and as Markdown: answers, tables, failed points, caveats."""
import dataclasses
from typing import Any, Callable, Iterator

import pandas as pd

from .load import PLACE, Results, place_words
from .reports import Report
from .rows import PHASES
from .scaling import TRAFFIC
from .words import (bounded, count, fixed, hoisted, markdown_table, names, percent, short, text_table, time, whole,
                    wrapped)


@dataclasses.dataclass
class Table:
    """A table for people; empty ones are not shown."""
    caption: str
    header: list[str]
    rows: list[list[str]]
    left: int  #: columns aligned to the left


def _table(caption: str, frame: pd.DataFrame, left: int, **columns: Callable[[Any], str]) -> Table:
    """A line per line of the frame; each column is its header (_ for a space) with what it says of the line. Columns
    that say the same of all stand in the caption; nothing is left where all are such."""
    rows = [[say(e) for say in columns.values()] for e in frame.itertuples()]
    table = Table(*hoisted(caption, [name.replace("_", " ") for name in columns], rows, left))
    return table if len(rows) < 2 or len(table.header) > 1 else dataclasses.replace(table, rows=[])


def ms(seconds: float) -> str:
    return short(1e3 * seconds)


def _ratio(e: Any, name: str = "", digits: int = 3) -> str:
    value, end = getattr(e, name or "ratio"), f"{name}_" if name else ""
    return bounded(value, getattr(e, f"{end}low"), getattr(e, f"{end}high"), digits, " (no interval)")


def said(value: Any, yes: str = "yes", no: str = "no") -> str:
    """A word or a flag; "-" if it is null."""
    return "-" if pd.isna(value) else value if isinstance(value, str) else yes if value else no


def series_tables(report: Report, series: int) -> Iterator[Table]:
    """The tables of one series."""
    named = names(report.points, False)
    own = {name: table[table["series"] == series].assign(
        name=lambda t: named.reindex(t["point"] if "point" in t else t.index).to_numpy(),
        base_name=lambda t: named.reindex(t["base"]).to_numpy() if "base" in t else "")
        for name, table in report.tables.items() if "series" in table}
    place = {"backend": lambda e: e.name, "grid": lambda e: e.grid, "M": lambda e: whole(e.M),
             "threads": lambda e: whole(e.threads)}
    speedups = own["speedup"].set_index("point")[["ratio", "efficiency"]]
    points = own["points"].join(speedups)
    yield _table("Summation time per step, median over rounds; speedup and efficiency over the same backend on 1 "
                 "thread", points, 2, **place, sum_ms=lambda e: ms(e.sum_s),
                 interval=lambda e: "-" if pd.isna(e.sum_s_low) else f"[{ms(e.sum_s_low)}, {ms(e.sum_s_high)}]",
                 speedup=lambda e: fixed(e.ratio, 2), efficiency=lambda e: percent(e.efficiency),
                 **({"lost": lambda e: whole(e.lost)} if (points["lost"] > 0).any() else {}),
                 ns_per_pair=lambda e: fixed(e.ns_per_pair, 3), rounds=lambda e: whole(e.rounds))
    yield _table("Algorithm speedup: summation time of the base over that of the backend, on as many threads",
                 own["algorithm_speedup"], 3, runtime=lambda e: e.runtime, **place, ms=lambda e: ms(e.time_s),
                 base=lambda e: e.base_name + ("" if pd.isna(e.base_M) else f" M={e.base_M:.0f}"),
                 base_ms=lambda e: ms(e.base_time_s), speedup=_ratio)
    scaled = own["speedup"]
    yield _table("Speedup over 1 thread; how many times as many multiply-adds the machine made in the same rounds, and "
                 "what part of\nthat the sum reaches (medians over rounds)",
                 scaled[(scaled["threads"] > 1) & scaled["machine_speedup"].notna()], 2, **place, speedup=_ratio,
                 machine=lambda e: _ratio(e, "machine_speedup"), of_machine=lambda e: _ratio(e, "of_machine"))
    faster = {"faster": "TBB", "slower": "OpenMP", "not resolved": "not resolved"}
    yield _table("OpenMP against TBB: summation time, and OpenMP's over TBB's; not resolved: no difference at 95 % "
                 "confidence over the\nwhole table", own["runtime_comparison"], 2, algorithm=lambda e: e.algorithm,
                 grid=place["grid"], M=place["M"], threads=place["threads"], OpenMP_ms=lambda e: ms(e.base_time_s),
                 TBB_ms=lambda e: ms(e.time_s), ratio=_ratio, faster=lambda e: faster[e.verdict])
    over_m = own["m_comparison"].join(report.points[["cells", "cells_nonempty", "pairs_tested"]], on="point")
    yield _table("Comparison over M: median times per step, cells, distance tests, those due to folded cells, and "
                 "pairs found per test", over_m, 2, **place, sum_ms=lambda e: ms(e.sum_s),
                 total_ms=lambda e: ms(e.time_s), cells=lambda e: count(e.cells),
                 non_empty=lambda e: count(e.cells_nonempty), tested=lambda e: count(e.pairs_tested),
                 folded=lambda e: percent(e.collision_share), useful=lambda e: fixed(e.useful_pair_ratio, 4))
    known = points[points["bound_s"].notna() | points["wait_share"].notna()]
    yield _table("Against the least time that arithmetic or memory bandwidth allows, and threads' time spent waiting "
                 "at barriers", known, 2, **place, sum_ms=lambda e: ms(e.sum_s), bound_ms=lambda e: ms(e.bound_s),
                 of_bound=lambda e: percent(e.share_of_bound), set_by=lambda e: said(e.limited_by),
                 flop_per_byte=lambda e: fixed(e.intensity, 1),
                 Gflops=lambda e: fixed(1e-9 * e.achieved_flops_per_s, 2), waiting=lambda e: percent(e.wait_share))
    yield _table("Phases per step: median ms and share of the total (pair lists: prepare makes the list, sum sweeps "
                 "it)", points, 2, **place, **{phase.removesuffix("_s"): _phase(phase) for phase in PHASES})
    yield _strategy_table(own["ladder"])
    builds = own["compiler_comparison"]
    for (build, base), table in builds.groupby(["build", "base_build"]):
        yield _table(f"Builds: summation time of this one, {build}\nand of the base, {base}", table, 2, **place,
                     base_ms=lambda e: ms(e.base_time_s), ms=lambda e: ms(e.time_s), ratio=_ratio,
                     this_is=lambda e: e.verdict)


def _phase(phase: str) -> Callable[[Any], str]:
    def cell(e: Any) -> str:
        time = getattr(e, phase)
        share = phase != "total_s" and pd.notna(time) and e.total_s > 0
        return ms(time) + (f" {100 * time / e.total_s:>3.0f}%" if share else "")
    return cell


def _strategy_table(ladder: pd.DataFrame) -> Table:
    one = ladder[ladder["at"] == "one_thread"].drop_duplicates("backend").set_index("backend")
    highest = ladder[ladder["at"] == "most_threads"] if (ladder["at"] == "most_threads").any() else ladder
    serial = ["over_serial", "over_serial_low", "over_serial_high"]
    highest = highest.drop(columns=serial).join(one[serial], on="backend")
    base = highest.iloc[0] if len(highest) else None
    caption = "" if base is None else (
        "Strategies: prepare, zero, sum and reduce together, each backend at its most threads; base "
        f"{base['base_backend']} on {base['base_threads']} threads, {time(base['base_time_s'])};\n"
        "memory beyond that of the leanest")
    return _table(caption, highest, 1, backend=lambda e: e.backend, M=lambda e: whole(e.M),
                  threads=lambda e: whole(e.threads), ms=lambda e: ms(e.time_s), ratio=lambda e: _ratio(e, digits=2),
                  **{"1_thread_over_serial_sweep": lambda e: _ratio(e, "over_serial", 2)},
                  efficiency=lambda e: _ratio(e, "efficiency", 2), waiting=lambda e: percent(e.wait_share),
                  extra_MiB=lambda e: fixed(e.extra_bytes / 2**20, 1), rank=lambda e: f"{e.rank} of {e.of}")


def all_tables(report: Report) -> Iterator[Table]:
    """The tables over all series."""
    yield _table("Strategies: how each backend keeps threads apart, whether its bits are the same for every number of "
                 "threads", report.strategies, 6, backend=lambda e: e.backend, runtime=lambda e: said(e.runtime),
                 conflicts=lambda e: said(e.conflicts), pairs=lambda e: said(e.symmetric, "once", "twice"),
                 same_bits=lambda e: said(e.deterministic), also=lambda e: said(e.aliases))
    yield _table("Strategies from one world to another: time over that of the base there, over the same here (below 1 "
                 "it fares worse here)", report.shifts, 3, here=lambda e: e.world, there=lambda e: e.base_world,
                 backend=lambda e: e.backend, threads=lambda e: whole(e.threads), ratio=lambda e: _ratio(e, digits=2),
                 here_it_is=lambda e: e.verdict, rank=lambda e: f"{e.rank} of {e.of}",
                 rank_there=lambda e: f"{e.base_rank} of {e.base_of}")
    worth = report.density[report.density["fastest_symmetric"]]
    yield _table("Pairs per particle: the fastest backend that computes each pair once against the fastest gather; ns "
                 "per pair of prepare,\nzero, sum and reduce together", worth, 4, particles=lambda e: e.world,
                 units=lambda e: e.units, backend=lambda e: e.backend, gather=lambda e: e.base_backend,
                 threads=lambda e: whole(e.threads), pairs=lambda e: fixed(e.pairs_per_particle, 1),
                 ns_per_pair=lambda e: fixed(e.ns_per_pair, 2), symmetric_is_faster_by=lambda e: _ratio(e, digits=2))
    yield from _rank_tables(report.scaling)
    yield _table("Self-test: summation time over that of the base against what is known (95 % over the whole table)",
                 report.self_test, 3, what=lambda e: e.what, backend=lambda e: e.backend, state=lambda e: e.state,
                 dx=lambda e: f"{e.dx:.10g}", M=lambda e: whole(e.M), threads=lambda e: whole(e.threads),
                 expected=lambda e: fixed(e.expected, 2), ratio=lambda e: _ratio(e, digits=4),
                 holds=lambda e: "yes" if e.holds else "NO")


def _rank_tables(scaling: pd.DataFrame) -> Iterator[Table]:
    """What ranks gain, how well they are used, and what they exchange."""
    table = scaling.assign(name=names(scaling, False))
    place = {"particles": lambda e: e.world, "backend": lambda e: e.name, "grid": lambda e: e.grid,
             "pairs_across": lambda e: "-" if e.ranks == 1 else e.cut, "M": lambda e: whole(e.M),
             "ranks": lambda e: whole(e.ranks), "threads": lambda e: whole(e.threads)}
    for kind, of in (("strong", "the same particles"), ("weak", "as many particles as a rank has")):
        yield _table(f"Ranks: {kind} scaling; a step from index to reduce with messages and waits, and the sum alone. "
                     f"Speedup and efficiency\nover 1 rank with 1 thread on {of}; then the time of 1 rank with as many "
                     "threads\nover that of the ranks", table[table["scaling"] == kind], 4, **place,
                     step_ms=lambda e: ms(e.step_s) if e.timed else "not timed", sum_ms=lambda e: ms(e.sum_s),
                     speedup=lambda e: _ratio(e, "speedup", 2), efficiency=lambda e: _ratio(e, "efficiency", 2),
                     sum_efficiency=lambda e: _ratio(e, "sum_efficiency", 2),
                     threads_over_ranks=lambda e: _ratio(e, "over_threads", 2),
                     sum_threads_over_ranks=lambda e: _ratio(e, "sum_over_threads", 2),
                     ranks_are=lambda e: said(e.verdict))
    several = table[table["ranks"] > 1]
    metrics = several[several["load_balance"].notna()]
    yield _table("Ranks: POP metrics of the sum; load balance is mean over greatest useful time, communication "
                 "efficiency the greatest over the\ntime until the last rank is through, parallel efficiency their "
                 "product (0.8 counts as good); computation scaling is\nthe useful time of 1 rank with 1 thread over that "
                 "of all", metrics, 5, scaling=lambda e: e.scaling, **place,
                 load_balance=lambda e: fixed(e.load_balance, 3),
                 communication_efficiency=lambda e: fixed(e.communication_efficiency, 3),
                 parallel_efficiency=lambda e: fixed(e.parallel_efficiency, 3),
                 computation_scaling=lambda e: _ratio(e, "computation_scaling", 2))
    counted = several[several["cut_pairs"].notna()].drop_duplicates(["problem", *PLACE, "ranks", "cut"])
    yield _table("Ranks: what they hold, and what all of them send in a step; cut pairs each once, imbalance: the "
                 "greatest number of pairs\nof a rank over the mean", counted, 4, **place,
                 cut_pairs=lambda e: count(e.cut_pairs), of_all=lambda e: percent(e.cut_share),
                 ghosts_a_particle=lambda e: fixed(e.ghosts_per_particle, 3),
                 imbalance=lambda e: fixed(e.imbalance, 3),
                 **{f"{phase}{what}": _traffic(phase, what) for phase in TRAFFIC for what in ("", "_bytes")})


def _traffic(phase: str, what: str) -> Callable[[Any], str]:
    """A cell: messages or bytes of a phase."""
    return lambda e: count(getattr(e, f"{phase}_bytes")) if what else short(getattr(e, f"{phase}_messages"))


def heading(results: Results, series: int) -> tuple[str, str]:
    """A series in a few words, and in all."""
    s = results.series.loc[series]
    e = results.environments[results.environments["environment"] == s["environment"]].iloc[0]
    ranks = f", {s['ranks']} ranks, pairs across them {s['cut']}" if s["ranks"] > 1 else ""
    return (f"{s['case']}, {s['state']}, dx {s['dx']:.10g}{ranks}",
            f"{s['n_fluid']} fluid and {s['n_boundary']} boundary particles; study {s['study']}, order {s['order']}, "
            f"{s['dim']}D, {s['precision']}, {s['interaction']}, {s['smoothing']}, {s['integrator']}, dt "
            f"{s['dt']:.10g}; host {e['host']}, {e['cores']} cores, {e['compiler']}, git {e['git']}"
            f"{' (dirty)' if e['dirty'] else ''}")


def _answers(report: Report) -> Iterator[str]:
    if report.answer:
        yield wrapped(f"{report.answer.text} {report.answer.details}")
    yield from (wrapped(f"{q['question']} {q['verdict']}: {q['number']}. {q['answer']}") for q in report.questions)


def _rest(report: Report) -> Iterator[str]:
    """Lists behind the tables."""
    broken = report.strategies.dropna(subset=["breaks_down"])
    if len(broken):
        yield "Where strategies break down, of what was measured\n" + "".join(
            wrapped(f"- {e.backend}: {e.breaks_down}") for e in broken.itertuples())
    if len(report.results.failed):
        yield "Failed points: these rows have no passed verification and are in no table\n" + "".join(
            wrapped(f"- {place_words(f)} ({f.case}, {f.state}, dx {f.dx:.10g}, study {f.study}): {f.rows} rows: "
                    f"{f.error}")
            for f in report.results.failed.itertuples())
    if report.caveats:
        yield "Caveats: what to keep in mind with these numbers\n" + "".join(wrapped(f"- {c}") for c in report.caveats)


def text(report: Report) -> str:
    """The report for a terminal."""
    parts = list(_answers(report))
    for series in report.results.series.index:
        parts.append(wrapped("== " + ": ".join(heading(report.results, series))))
        parts += [_as_text(table) for table in series_tables(report, series) if table.rows]
    parts += [_as_text(table) for table in all_tables(report) if table.rows]
    return "\n".join([*parts, *_rest(report)])


def _as_text(table: Table) -> str:
    return table.caption + "\n" + text_table(table.header, table.rows, table.left)


def markdown(report: Report) -> str:
    """The same in Markdown."""
    def printed(table: Table) -> str:
        return table.caption.replace("\n", " ") + "\n\n" + markdown_table(table.header, table.rows, table.left)

    parts = [f"# {report.title}\n", *_answers(report)]
    for series in report.results.series.index:
        title, details = heading(report.results, series)
        parts += [f"## {title}\n", wrapped(details)]
        parts += [printed(table) for table in series_tables(report, series) if table.rows]
    parts += [printed(table) for table in all_tables(report) if table.rows]
    rest = "\n".join(_rest(report))
    return "\n".join([*parts, f"```text\n{rest}```\n"] if rest else parts)
