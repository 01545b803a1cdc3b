"""The history in words, as a page with a line per point, and as files."""
import pathlib
from typing import Iterator

import numpy as np
import pandas as pd

from . import figures
from .compare import first_few
from .figures import revisions
from .figures.inline import inline
from .figures.sheet import sheet
from .history import History
from .page import Markup, filled, html_table
from .summary import write_file
from .tables import Table
from .words import bounded, hoisted, ms, text_table, threads_words, wrapped

_WORDS = 5  #: columns of both tables that hold words, at their left
_FEW = 10  #: lines of a table in the text; the page has all
_LOOK = figures.Look(panel=3.4, columns=1, font=8)
_MANY = 5  #: points that move together are suspicious
_LEAST_SPAN = np.log(1.05)


def _few(caption: str, header: list[str], rows: list[list[str]]) -> str:
    """The first lines of a table."""
    if not rows:
        return ""
    said, *table = hoisted(caption, header, rows[:_FEW], _WORDS)
    return f"\n{wrapped(said)}{text_table(*table)}" + (f"and {len(rows) - _FEW} more\n" if len(rows) > _FEW else "")


def text(h: History) -> str:
    """The answer first: how many points the newest revisions made slower or faster; then the steps that say so."""
    newest = h.steps[h.steps["newest"]]
    found = _sentence(h)
    faster = newest[newest["verdict"] == "faster"].sort_values("ratio", ascending=False)
    for verdict, table in (("slower", h.slower), ("faster", faster)):
        found += _few(f"{verdict} now", _HEADER, list(_cells(h, table)))
    found += _few("the same revision on two machines; ratios above 1: the second is faster", _MACHINE_HEADER,
                  list(_machine_cells(h)))
    return found + "".join("\n" + wrapped(note) for note in notes(h))


def _sentence(h: History) -> str:
    newest, before = h.steps[h.steps["newest"]], h.steps[~h.steps["newest"]]
    if h.steps.empty:
        alike = "" if h.phase == "sum_s" else ", in as many steps"
        return wrapped(f"No point was measured with two revisions on one machine{alike}: {len(h.lines)} points, "
                       f"{len(h.revisions)} revisions, {len(h.machines)} machines.")
    said = []
    for table, when in ((newest, "in the newest revision of their machine"), (before, "in revisions before")):
        count = table["verdict"].value_counts()
        if len(table):
            said.append(f"{count.get('slower', 0)} of {len(table)} points got slower, {count.get('faster', 0)} faster, "
                        f"{count.get('not resolved', 0)} not resolved, {when}")
    return wrapped(f"{'; '.join(said)} ({h.phase.removesuffix('_s')}, 95 % confidence over "
                   f"{'all' if len(said) == 1 else 'each of the two'}).")


def notes(h: History) -> list[str]:
    """What to keep in mind, as texts."""
    found = []
    unpaired, unpaced = (h.steps["rounds"] == 0).sum(), h.steps["machine_ratio"].isna().sum()
    if unpaired:
        found.append("revisions were measured apart: what disturbed one of them, and is not in the machine's pace, is "
                     "in the ratios")
    found += _together(h)
    if unpaced:
        found.append(f"{unpaced} of {len(h.steps)} ratios are of times as they are: rows lack the machine's pace")
    once = (h.lines["revisions"] == 1).sum()
    if once and len(h.steps):
        found.append(f"{once} points were measured with one revision alone")
    if h.dirty:
        found.append(f"{h.dirty} rounds left out: built from a tree with uncommitted changes, which no revision names")
    if len(h.failed):
        backends = ", ".join(sorted(set(h.failed["backend"])))
        found.append(f"{len(h.failed)} points have rows without a passed verification, which are left out: {backends}")
    return found


def _together(h: History) -> list[str]:
    """The note on points measured apart that nearly all moved the same way, as they do when the machine changed."""
    apart = _named(h, h.steps[h.steps["rounds"] == 0])
    logs = np.log(apart["ratio"]).groupby([apart[name] for name in ("git", "machine_name", "world", "threads")])
    moved = logs.agg(["size", "median", lambda values: abs(np.sign(values).sum()) / len(values)]).set_axis(
        ["size", "median", "alike"], axis="columns")
    moved = moved[(moved["size"] >= _MANY) & (moved["alike"] >= 0.8) & (moved["median"].abs() > _LEAST_SPAN)]
    said = [f"{world} on {threads_words(threads)} ({machine}, {git}): {e.size:.0f} points by {np.exp(e.median):.2f}"
            for (git, machine, world, threads), e in zip(moved.index, moved.itertuples(index=False))]
    return ["points moved together, as if the machine had changed in a way that its pace does not show; measuring both "
            f"revisions in the same rounds (plan compilers) would tell: {first_few(said)}"] if said else []


def _named(h: History, steps: pd.DataFrame) -> pd.DataFrame:
    """Steps with what their lines, machines and revisions are called."""
    git, name = h.revisions["git"].str[:12], h.machines["name"]
    table = steps.join(h.lines, on="line")
    return table.assign(machine_name=table["machine"].map(name), git=table["revision"].map(git),
                        base_git=table["base_revision"].map(git))


def _cells(h: History, steps: pd.DataFrame) -> Iterator[list[str]]:
    for e in _named(h, steps).itertuples():
        yield [e.label, e.world, e.machine_name, e.base_git, e.git, ms(e.base_time_s), ms(e.time_s),
               "-" if np.isnan(e.machine_ratio) else f"{e.machine_ratio:.3f}",
               bounded(e.ratio, e.low, e.high, 3, " (too few rounds)")]


_HEADER = ["point", "problem", "machine", "from", "to", "ms", "ms now", "pace", "ratio [low, high]"]


def _machine_cells(h: History) -> Iterator[list[str]]:
    for e in h.elsewhere.itertuples():
        line, base = h.lines.loc[e.line], h.lines.loc[e.base]
        peaks = ["-" if np.isnan(value) else f"{value:.2f}" for value in (e.flops_ratio, e.bandwidth_ratio)]
        yield [line["label"], line["world"], h.machines["name"][base["machine"]], h.machines["name"][line["machine"]],
               h.revisions["git"][e.revision][:12], ms(e.base_time_s), ms(e.time_s),
               bounded(e.ratio, e.low, e.high, 3, " (too few rounds)"), *peaks]


_MACHINE_HEADER = ["point", "problem", "machine", "second", "revision", "ms", "ms on second", "ratio [low, high]",
                   "flops", "bandwidth"]


def tracks(h: History) -> pd.DataFrame:
    """A line per line and revision, ordered by these: `over_first`, its time over that of its first revision, machine's
    pace taken out, with `over_first_low` and `over_first_high` by the step that led there; the columns of the step."""
    steps = _named(h, h.steps)
    over_first = (1 / steps["ratio"]).groupby(steps["line"]).cumprod()
    before = over_first * steps["ratio"]
    steps = steps.assign(over_first=over_first, over_first_low=before / steps["high"],
                         over_first_high=before / steps["low"])
    first = steps.drop_duplicates("line")
    first = first.assign(revision=first["base_revision"], git=first["base_git"], time_s=first["base_time_s"], ratio=1.0,
                         over_first=1.0, over_first_low=np.nan, over_first_high=np.nan, verdict="first", newest=False)
    found = pd.concat([first, steps]).sort_values(["line", "revision"], kind="stable", ignore_index=True)
    return found.assign(name=found["label"].str.replace(r" threads=\d+$", "", regex=True))


def page(h: History) -> str:
    """One HTML file that needs no other."""
    found = revisions.sections(tracks(h)) if len(h.steps) else {}
    panels = [(title, panel) for title, some in found.items() for panel in some]

    def drawn(k: int) -> str:
        panel = panels[k][1]
        with figures.applied(_LOOK):
            return inline(sheet([panel], _LOOK), _LOOK, f"{k}", f"{panel.title}, time over revisions")

    sections: dict[str, list[Markup]] = {}
    for (title, _), svg in zip(panels, figures.on_all_cores(drawn, range(len(panels)))):
        sections.setdefault(title, []).append(Markup(svg))
    changed = h.steps[h.steps["verdict"] != "not resolved"].sort_values(["newest", "ratio"], ascending=[False, True])
    rows = [[*row, verdict] for row, verdict in zip(_cells(h, changed), changed["verdict"])]
    tables = {
        "Changes": Table(*hoisted("Time before over time now: above 1 is faster, the machine's pace taken out; pace: "
                                  "how much more the machine itself did", [*_HEADER, "now"], rows, _WORDS)),
        "Two machines": Table(*hoisted("Time on the first machine over time on the second; flops and bandwidth: peaks "
                                       "of the second over those of the first on as many threads", _MACHINE_HEADER,
                                       list(_machine_cells(h)), _WORDS)),
        "Revisions": Table("In the order in which they were first measured", ["revision", "first measured (UTC)"],
                           h.revisions.to_numpy().tolist(), 2)}
    return filled("history.html.j2", answer=_sentence(h), notes=notes(h), sections=sections,
                  open=revisions.SECTIONS[:2], phase=h.phase.removesuffix("_s"),
                  tables={title: html_table(table) for title, table in tables.items() if table.rows})


def write(h: History, folder: pathlib.Path) -> str:
    """Writes history.html, history.csv (a line per step) and machines.csv (two machines side by side); returns the
    text. Each file appears whole or not at all."""
    write_file(folder / "history.html", page(h))
    write_file(folder / "history.csv", _named(h, h.steps).drop(columns=["p", "label"]).to_csv(index=False))
    write_file(folder / "machines.csv", h.elsewhere.join(h.lines, on="line").to_csv(index=False))
    return text(h)
