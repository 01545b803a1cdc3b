#!/usr/bin/python3
"""The dam break of `pairsum simulate` against experiments: front and height of the column over time.

dam_break.py series DIR OUT.csv   what a folder of snapshots says: t_s, front_m, height_m, kinetic_J, ... lost
dam_break.py figure               front.png and the table of dam_break.md, from the series and experiments beside this file

Dimensionless: T = t sqrt(g/a), Z = front/a, height/a, with the width and height a = 0.6 m of the column. A particle is
half a spacing wide: the front is the largest x and half a spacing, the height the largest y of particles less than two
spacings from the back wall, and half a spacing.
"""
import pathlib
import sys

import numpy as np
import pandas as pd

HERE = pathlib.Path(__file__).parent
GRAVITY, COLUMN = 9.81, 0.6
SCALE = np.sqrt(GRAVITY / COLUMN)  #: 1/s
SERIES = {"2D, dx = 12 mm": "pairsum_2d_12mm.csv", "2D, dx = 6 mm": "pairsum_2d_6mm.csv",
          "3D, dx = 20 mm": "pairsum_3d_20mm.csv"}
FRONTS = {"Martin & Moyce 1952": "mm1952_n2_1_a2p25in_front.csv", "Lobovsky et al. 2014": "lobovsky2014_H600_front.csv"}
HEIGHTS = {"Martin & Moyce 1952": "mm1952_n2_1_a2p25in_height.csv"}


def series(folder: pathlib.Path) -> pd.DataFrame:
    """A line per snapshot."""
    import h5py

    log = pd.read_csv(folder / "log.csv").set_index("step")
    lines = []
    for path in sorted(folder.glob("snapshot_*.hdf")):
        with h5py.File(path) as file:
            header, particles = file["Header"].attrs, file["PartType0"]
            x, y = particles["Coordinates"][:, :2][particles["Kind"][:] == 0].T
            mass, rho = particles["Masses"][0], header["Rho0"]
            dx = (mass / rho) ** (1 / header["Dimension"])
            of = log.loc[header["Step"]]
            lines.append({"t_s": header["Time"], "front_m": x.max() + dx / 2, "height_m": y[x < 2 * dx].max() + dx / 2,
                          **of[["kinetic_J", "potential_J", "internal_J", "momentum_x_kg_m_s"]], "lost": header["Lost"]})
    return pd.DataFrame(lines)


def experiment(name: str) -> pd.DataFrame:
    """Columns T and value, without what lies on the far wall."""
    found = pd.read_csv(HERE / name, comment="#")
    found = found.set_axis(["T", "value", *found.columns[2:]], axis=1)[["T", "value"]]
    return found[found["value"] < 2.68] if name.startswith("lobovsky") else found


def simulated(name: str, column: str) -> pd.DataFrame:
    found = pd.read_csv(HERE / name)
    return pd.DataFrame({"T": SCALE * found["t_s"], "value": found[column] / COLUMN})


def deviation(measured: pd.DataFrame, found: pd.DataFrame) -> tuple[float, float]:
    """Mean and largest deviation of a simulation from the points of an experiment that it reaches, in units of a."""
    reached = measured[measured["T"].between(found["T"].min(), found["T"].max())]
    differ = np.interp(reached["T"], found["T"], found["value"]) - reached["value"]
    return float(differ.mean()), float(differ[differ.abs().idxmax()])


def delay(measured: pd.DataFrame, found: pd.DataFrame) -> float:
    """By how much time the experiment's front is later at the same place, the median, in units of T."""
    beyond = measured[measured["value"].between(1.2, found["value"].max())]
    return float((beyond["T"] - np.interp(beyond["value"], found["value"], found["T"])).median())


def table() -> str:
    """Markdown: a line per simulation and experiment."""
    lines = ["| simulation | experiment | front: mean | largest | later by | height: mean | largest |",
             "| --- | --- | ---: | ---: | ---: | ---: | ---: |"]
    for who, name in SERIES.items():
        front, height = simulated(name, "front_m"), simulated(name, "height_m")
        for experimenter, file in FRONTS.items():
            measured = experiment(file)
            mean, largest = deviation(measured, front)
            cells = [f"{mean:+.2f}", f"{largest:+.2f}", f"{delay(measured, front):.2f}"]
            cells += [f"{d:+.2f}" for d in deviation(experiment(HEIGHTS[experimenter]), height)] \
                if experimenter in HEIGHTS else ["", ""]
            lines.append(f"| {who} | {experimenter} | {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"


def balance() -> str:
    """Markdown: a line per simulation, what happens to energy and particles."""
    lines = ["| simulation | energy lost by t = 0.5 s | momentum along x at 0.5 s | particles lost by 0.5 s | by the end |",
             "| --- | ---: | ---: | ---: | ---: |"]
    for who, name in SERIES.items():
        found = pd.read_csv(HERE / name)
        energy = found[["kinetic_J", "potential_J", "internal_J"]].sum(axis=1)
        half = (found["t_s"] - 0.5).abs().idxmin()
        lines.append(f"| {who} | {100 * (1 - energy[half] / energy[0]):.1f} % | {found['momentum_x_kg_m_s'][half]:.0f} kg m/s "
                     f"| {found['lost'][half]:.0f} | {found['lost'].iloc[-1]:.0f} at {found['t_s'].iloc[-1]:g} s |")
    return "\n".join(lines) + "\n"


def figure(path: pathlib.Path) -> None:
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    plots, axes = plt.subplots(1, 2, figsize=(11, 4.2), layout="constrained")
    for axis, column, measured, said in ((axes[0], "front_m", FRONTS, "front  Z = x / a"),
                                         (axes[1], "height_m", HEIGHTS, "height at the back wall / a")):
        for (who, name), style in zip(SERIES.items(), ("--", "-", ":")):
            found = simulated(name, column)
            axis.plot(found["T"], found["value"], style, color="#0b5394", label=f"pairsum, {who}")
        for (who, name), mark in zip(measured.items(), ("o", ".")):
            found = experiment(name)
            axis.plot(found["T"], found["value"], mark, color="#b45f06", fillstyle="none", label=who)
        axis.set(xlabel="T = t sqrt(g/a)", ylabel=said, xlim=(0, 3.6))
        axis.spines[["top", "right"]].set_visible(False)
        axis.legend(frameon=False, fontsize=9)
    axes[0].set_ylim(0.9, 5.6)
    plots.savefig(path, dpi=120)


def document(text: str) -> str:
    """The document with its tables made anew."""
    for name, made in (("deviation", table()), ("balance", balance())):
        begin, end = f"<!-- table {name} -->\n", "<!-- end -->"
        before, rest = text.split(begin)
        text = before + begin + made + rest[rest.index(end):]
    return text


if __name__ == "__main__":
    if sys.argv[1:2] == ["series"] and len(sys.argv) == 4:
        series(pathlib.Path(sys.argv[2])).to_csv(sys.argv[3], index=False, float_format="%.6g")
    elif sys.argv[1:] == ["figure"]:
        figure(HERE / "front.png")
        (HERE / "dam_break.md").write_text(document((HERE / "dam_break.md").read_text()))
    else:
        sys.exit(__doc__)
