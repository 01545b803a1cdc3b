"""Roofline: the flops per second of each point under the measured bandwidth and peak."""
import axes_ticks
import choice
import labels
import layout
import panels
import style
from summary import NoData

NAME = "roofline"


def draw(summary):
    """Return the figure, or raise NoData. Per state (case, dx, ...) one panel per thread count.

    Every point is a small marker, each backend at its best M is a large one with its name.
    """
    groups = []
    for panel in panels.of_points(summary, _known, without=("grid",)):
        columns = []
        for threads, rows in panels.split(panel.rows, "threads"):
            columns.append((f"{threads} thread{'s' * (threads != 1)}", rows,
                            _peaks(summary, panel, threads)))
        groups.append((panel, columns))
    if not groups:
        raise NoData('no entry of "points" has a "model" with its flops and bytes')
    common, own = panels.titles([panel for panel, _ in groups])
    places = layout.arrange(summary, [columns for _, columns in groups])
    titles = {place: panels.joined(text, column[0]) for (_, columns), text, group
              in zip(groups, own, places) for column, place in zip(columns, group)}
    everything = [column for _, columns in groups for column in columns]
    names = [_name(row) for _, rows, _ in everything for row in choice.best_m(rows)]
    most = max(len(choice.best_m(rows)) for _, rows, _ in everything)
    page = layout.Sheet(summary, "Roofline of the summation: achieved flops against the measured "
                        "limits", common, titles, 2.9, max(2.9, most * labels.STEP + 0.1), (0.72, labels.room(names)))
    limits = _limits(everything)
    for (_, columns), group in zip(groups, places):
        for (_, rows, peaks), place in zip(columns, group):
            _panel(page.axes[place], rows, peaks, limits)
    return page.figure


def _known(entry):
    model = entry.get("model")
    return model is not None and model["intensity"] is not None \
        and model["achieved_flops_per_s"] is not None


def _peaks(summary, panel, threads):
    """Return the measured peaks at the threads, precision and environment of a panel."""
    series = {row["series"] for row in panel.rows}
    wanted = {summary["series"][one].get("environment") for one in series
              if isinstance(one, int) and one < len(summary.get("series") or [])}
    return [row for row in summary["peaks"] if row["threads"] == threads
            and row["precision"] in panel.facts["precision"]
            and (not wanted or row["environment"] in wanted)
            and row["flops_per_s"] and row["bandwidth_bytes_per_s"]]


def _limits(everything):
    """Return (x low, x high), (y low, y high) that show all points and the corners of the roofs."""
    models = [row["model"] for _, rows, _ in everything for row in rows]
    peaks = [row for *_, some in everything for row in some]
    x = [model["intensity"] for model in models]
    x += [row["flops_per_s"] / row["bandwidth_bytes_per_s"] for row in peaks]
    y = [model["achieved_flops_per_s"] / 1e9 for model in models]
    y += [row["flops_per_s"] / 1e9 for row in peaks]
    return (min(x) / 2, max(x) * 2.2), (min(y) / 2, max(y) * 1.6)


def _name(row):
    return f"{row['backend']} {panels.cells(row)}"


def _panel(axes, rows, peaks, limits):
    axes.set_xscale("log")
    axes_ticks.logarithmic(axes.yaxis, limits[1], counted=False)
    axes_ticks.logarithmic(axes.xaxis, limits[0], counted=False)
    axes.set_xlim(*limits[0])
    axes.set_ylim(*limits[1])
    axes.set_xlabel("flops per byte (model)")
    axes.set_ylabel("Gflop/s")
    for row in peaks:
        flops, rate = row["flops_per_s"] / 1e9, row["bandwidth_bytes_per_s"] / 1e9
        corner = flops / rate
        axes.plot([limits[1][0] / rate / 10, corner, limits[0][1]], [limits[1][0] / 10, flops, flops],
                  color=style.RULE, linewidth=2, zorder=1, label="roof")
        axes.annotate(f"{flops:.3g} Gflop/s, {rate:.3g} GB/s", (limits[0][1], flops), xytext=(-2, 4),
                      textcoords="offset points", ha="right", fontsize=style.SMALL, color=style.MUTED)
    best, ends = choice.best_m(rows), []
    for row in rows:
        at = row["model"]["intensity"], row["model"]["achieved_flops_per_s"] / 1e9
        large = row in best
        axes.plot(*at, linestyle="", color=style.colour(row["backend"]), marker=style.marker(row["M"]),
                  markersize=7 if large else 3.5, markeredgecolor=style.INK, label=_name(row),
                  markeredgewidth=0.6 if large else 0.3, zorder=4 if large else 3)
        if large:
            ends.append((*at, _name(row), style.colour(row["backend"])))
    labels.at_ends(axes, ends)
