"""The history in words, as a page with a line per point, and as files."""
import pathlib
from typing import Any, Iterator

import jinja2
import numpy as np
import pandas as pd

from .compare import first_few
from .history import History
from .summary import write_file
from .words import bounded, hoisted, ms, text_table, threads_words, wrapped

_WORDS = 5  #: columns of both tables that hold words, at their left
_FEW = 10  #: lines of a table in the text; the page has all
#: The drawing of a panel, in pixels: inside its frame, and the frame's left and top.
WIDTH, HEIGHT, LEFT, TOP = 190, 90, 40, 8
_MANY = 5  #: points that move together are suspicious
_LEAST_SPAN = np.log(1.05)
_APART = 11  #: pixels between words beside a panel


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
    return wrapped(f"{'; '.join(said)} ({h.phase.removesuffix('_s')}, 95 % confidence over all).")


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


def _tracks(h: History) -> pd.DataFrame:
    """A line per line and revision: log of the time over that of its first revision, machine's pace taken out, with the
    step that led there; ordered by line and revision."""
    steps = _named(h, h.steps)
    change = -np.log(steps["ratio"])
    steps["log"] = change.groupby(steps["line"]).cumsum()
    before = steps["log"] - change
    steps["log_low"], steps["log_high"] = before - np.log(steps["high"]), before - np.log(steps["low"])
    first = steps.drop_duplicates("line")
    first = first.assign(revision=first["base_revision"], git=first["base_git"], time_s=first["base_time_s"], log=0.0,
                         log_low=np.nan, log_high=np.nan, verdict="first", newest=False)
    return pd.concat([first, steps]).sort_values(["line", "revision"], kind="stable")


def sections(h: History) -> list[dict[str, Any]]:
    """What the page draws: sections of panels, those that changed first. A panel has the lines of one backend on one
    machine and problem that differ in threads."""
    tracks = _tracks(h)
    if tracks.empty:
        return []
    tracks["name"] = tracks["label"].str.replace(r" threads=\d+$", "", regex=True)
    panels = [_panel(own) for _, own in tracks.groupby(["machine", "world", "name"], sort=False)]
    titles = {"slower": "Slower in the newest revision", "changed": "Changed", "same": "No change resolved"}
    found = [{"kind": kind, "title": title, "panels": sorted((p for p in panels if p["kind"] == kind),
                                                            key=lambda p: -p["change"])}
             for kind, title in titles.items()]
    return [section for section in found if section["panels"]]


def _panel(tracks: pd.DataFrame) -> dict[str, Any]:
    gits = tracks.sort_values("revision")["git"].unique()
    x = pd.Series(LEFT + WIDTH * (np.arange(len(gits)) + 0.5) / len(gits), gits)
    most, ends = tracks["log"].abs().max(), tracks[["log_low", "log_high"]].abs().max().max()
    span = np.nanmax([_LEAST_SPAN, 1.1 * most, min(1.05 * ends, 2 * most)])
    tracks = tracks.assign(x=tracks["git"].map(x), **{f"y{end}": TOP + HEIGHT / 2 * (1 - tracks[f"log{end}"].clip(
        -span, span) / span) for end in ("", "_low", "_high")})
    lines = [_line(own) for _, own in tracks.groupby("line")]
    reached = -np.inf
    for line in sorted(lines, key=lambda line: line["end"]):
        line["words_y"] = reached = max(line["end"], reached + _APART)
    first, resolved = tracks.iloc[0], tracks["verdict"].isin(["slower", "faster"])
    kind = ("slower" if (tracks["newest"] & (tracks["verdict"] == "slower")).any() else
            "changed" if resolved.any() else "same")
    change = np.log(tracks["ratio"]).abs()
    return {"title": first["name"], "world": first["world"], "machine": first["machine_name"], "kind": kind,
            "change": (change[resolved] if resolved.any() else change).max(), "lines": lines,
            "gits": [(x[git], git[:7]) for git in gits], "most": f"{np.exp(span):.2f}", "least": f"{np.exp(-span):.2f}"}


def _line(own: pd.DataFrame) -> dict[str, Any]:
    dots = [{"x": e.x, "y": e.y, "low": e.y_low, "high": e.y_high, "verdict": e.verdict,
             "words": f"{e.label}, {e.git}: {ms(e.time_s)} ms" + ("" if e.verdict == "first" else
                      f", ratio to {e.base_git} {bounded(e.ratio, e.low, e.high, 3)}, {e.verdict}")}
            for e in own.itertuples()]
    resolved = own.loc[own["verdict"].isin(["slower", "faster"]), "verdict"]
    return {"path": " ".join(f"{dot['x']:.1f},{dot['y']:.1f}" for dot in dots), "dots": dots, "end": dots[-1]["y"],
            "verdict": resolved.iloc[-1] if len(resolved) else "same", "threads": own["threads"].iloc[0]}


def page(h: History) -> str:
    """One HTML file that needs no other."""
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(pathlib.Path(__file__).parent), autoescape=True,
                                     trim_blocks=True, lstrip_blocks=True, undefined=jinja2.StrictUndefined)
    changed = h.steps[h.steps["verdict"] != "not resolved"].sort_values(["newest", "ratio"], ascending=[False, True])
    rows = [[*row, verdict] for row, verdict in zip(_cells(h, changed), changed["verdict"])]
    tables = [hoisted("Time before over time now: above 1 is faster, the machine's pace taken out; pace: how much "
                       "more the machine itself did", [*_HEADER, "now"], rows, _WORDS)[:3],
              hoisted("Time on the first machine over time on the second; flops and bandwidth: peaks of the second "
                       "over those of the first on as many threads", _MACHINE_HEADER, list(_machine_cells(h)), _WORDS)[:3]]
    return environment.get_template("history.html.j2").render(
        answer=_sentence(h), notes=notes(h), sections=sections(h), changes=tables[0], machines=tables[1], left=LEFT,
        top=TOP, width=WIDTH, height=HEIGHT, phase=h.phase.removesuffix("_s"), revisions=h.revisions)


def write(h: History, folder: pathlib.Path) -> str:
    """Writes history.html, history.csv (a line per step) and machines.csv (two machines side by side); returns the
    text. Each file appears whole or not at all."""
    write_file(folder / "history.html", page(h))
    write_file(folder / "history.csv", _named(h, h.steps).drop(columns=["p", "label"]).to_csv(index=False))
    write_file(folder / "machines.csv", h.elsewhere.join(h.lines, on="line").to_csv(index=False))
    return text(h)
