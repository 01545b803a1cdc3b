"""Files that other programs wrote, where they lie beside the checkout."""

import os
import pathlib

import pytest
from conftest import read

SOURCE = pathlib.Path(os.environ.get("PAIRSUM_SOURCE", pathlib.Path(__file__).parents[2]))
FOLDER = SOURCE.parent / "shared/data/particles"
pytestmark = pytest.mark.skipif(not FOLDER.is_dir(), reason=f"there is no {FOLDER}")


def test_a_swift_snapshot():
    result = read(FOLDER / "swift_snapshot_g32.hdf5")
    assert (result.set["particles"], result.set["fluid"]) == (32768, 32768)
    assert result.set["H"] == pytest.approx(2.195775 * 0.2690356, rel=1e-6)
    assert result.set["periodic"] and result.set["high"] == pytest.approx([6.2831853] * 3)
    assert result.fact["support"]["from"] == "Kernel gamma"


def test_an_older_swift_snapshot():
    result = read(FOLDER / "swift_glassCube_8.hdf5")
    assert result.set["particles"] == 512 and result.set["wrapped"] == 5
    assert result.set["H"] == pytest.approx(1.825742 * 0.1548059, rel=1e-6)
