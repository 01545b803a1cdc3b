"""docs/validation: the tables are what the script makes of the series beside them, and it makes those of snapshots."""
import importlib.util

import pandas as pd
import pytest
from conftest import ROOT

FOLDER = ROOT / "docs/validation"
SPEC = importlib.util.spec_from_file_location("dam_break", FOLDER / "dam_break.py")
dam_break = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(dam_break)


def test_the_tables_are_those_of_the_series():
    text = (FOLDER / "dam_break.md").read_text()
    assert dam_break.document(text) == text
    assert dam_break.document(text.replace("| 2D, dx = 6 mm |", "| 2D, dx = 7 mm |")) == text


def test_deviation_and_delay():
    measured = pd.DataFrame({"T": [0.0, 1.0, 2.0, 9.0], "value": [1.0, 2.0, 3.0, 9.0]})
    ahead = pd.DataFrame({"T": [0.0, 2.0], "value": [1.5, 3.5]})
    assert dam_break.deviation(measured, ahead) == (0.5, 0.5)  # without what the simulation does not reach
    assert dam_break.delay(measured, ahead) == 0.5
    assert dam_break.deviation(measured, measured) == (0, 0)


def test_every_experiment_names_its_source():
    for name in {*dam_break.FRONTS.values(), *dam_break.HEIGHTS.values()}:
        assert "doi:" in (FOLDER / name).read_text().splitlines()[0], name
        assert dam_break.experiment(name)["T"].is_monotonic_increasing, name


def test_a_series_says_front_and_height(tmp_path):
    h5py = pytest.importorskip("h5py", reason="python3-h5py is not installed")
    with h5py.File(tmp_path / "snapshot_0000.hdf", "w") as file:
        header, particles = file.create_group("Header"), file.create_group("PartType0")
        header.attrs.update({"Time": 0.5, "Step": 3, "Lost": 2, "Rho0": 1000.0, "Dimension": 2})
        particles["Coordinates"] = [[0.1, 0.3, 0], [0.5, 0.2, 0], [0.1, 0.2, 0], [9, 9, 0]]
        particles["Kind"], particles["Masses"] = [0, 0, 0, 1], [10.0] * 4  # dx = 0.1 m
    (tmp_path / "log.csv").write_text("step,kinetic_J,potential_J,internal_J,momentum_x_kg_m_s\n3,1,2,3,4\n")
    (line,) = dam_break.series(tmp_path).to_dict("records")
    assert line == {"t_s": 0.5, "front_m": pytest.approx(0.55), "height_m": pytest.approx(0.35), "kinetic_J": 1,
                    "potential_J": 2, "internal_J": 3, "momentum_x_kg_m_s": 4, "lost": 2}
