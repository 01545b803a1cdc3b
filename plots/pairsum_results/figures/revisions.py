"""Points over revisions: the time over that of the first, a panel for each backend on a machine and problem."""
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from ..words import bounded, ms, threads_words
from .marks import ends, few, intervals, reference, told
from .sheet import Panel
from .style import EDGE, MUTED

SECTIONS = ("Slower in the newest revision", "Changed", "No change resolved")
#: What a revision did to a point: colour and marker.
_CHANGES = {"slower": ("#D55E00", "^"), "faster": ("#0072B2", "v")}
_SAME = (MUTED, "s")


def sections(tracks: pd.DataFrame) -> dict[str, list[Panel]]:
    """Title -> panels, those that changed most first; of a table as history_report.tracks gives it."""
    found: list[tuple[int, float, Panel]] = []
    for (name, world, machine), own in tracks.groupby(["name", "world", "machine_name"], sort=False):
        slower = (own["newest"] & (own["verdict"] == "slower")).any()
        kind = 0 if slower else 1 if own["verdict"].isin(_CHANGES).any() else 2
        found.append((kind, -np.log(own["ratio"]).abs().max(), Panel(
            f"{name}, {world}, {machine}", lambda axes, own=own: _paint(axes, own), rows=6)))
    found.sort(key=lambda one: one[:2])
    return {title: panels for k, title in enumerate(SECTIONS) if (panels := [one[2] for one in found if one[0] == k])}


def _words(e) -> str:
    """What is said of a point that is pointed at."""
    ratio = "" if e.verdict == "first" else (
        f", ratio to {e.base_git} {bounded(e.ratio, e.low, e.high, 3)}, {e.verdict}")
    return f"{e.label}, {e.git}: {ms(e.time_s)} ms{ratio}"


def _paint(axes: Axes, own: pd.DataFrame) -> None:
    gits, labels = own.sort_values("revision")["git"].unique(), []
    own = own.assign(at=own["git"].map(pd.Series(range(len(gits)), gits)))
    reference(axes, y=1)
    for (_, threads), line in own.groupby(["line", "threads"]):
        resolved = line["verdict"][line["verdict"].isin(_CHANGES)]
        colour, _ = _CHANGES[resolved.iloc[-1]] if len(resolved) else _SAME
        axes.plot(line["at"], line["over_first"], color=colour, label=threads_words(threads), zorder=2)
        labels.append((line["at"].iloc[-1], line["over_first"].iloc[-1], threads_words(threads), colour))
        for verdict, some in line.groupby("verdict"):
            colour, marker = _CHANGES.get(verdict, _SAME)
            intervals(axes, some["at"], some["over_first"], some["over_first_low"],
                      some["over_first_high"], colour)
            drawn, = axes.plot(some["at"], some["over_first"], marker, color=colour, zorder=3, **EDGE)
            told(drawn, "use", map(_words, some.itertuples()))
    values = own[["over_first", "over_first_low", "over_first_high"]].stack()
    low, high = min(values.min(), 0.96), max(values.max(), 1.04)
    axes.set(xlim=(-0.3, len(gits) - 0.7), ylim=(low - 0.1 * (high - low), high + 0.1 * (high - low)),
             ylabel="time / first")
    shown = range(len(gits)) if len(gits) < 5 else (0, len(gits) - 1)
    axes.set_xticks(shown, [gits[k][:7] for k in shown])
    few(axes.yaxis)
    ends(axes, labels)
