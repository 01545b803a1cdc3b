"""pairsum info: what is in a file of particles, and how many pairs."""

import json
import os
import pathlib

import numpy as np
import pytest

from conftest import refused

h5py = pytest.importorskip("h5py", reason="python3-h5py is not installed")
SOURCE = pathlib.Path(os.environ.get("PAIRSUM_SOURCE", pathlib.Path(__file__).parents[2]))
REAL = SOURCE.parent / "shared/data/particles"


@pytest.fixture
def tank(tmp_path):
    """Random fluid, and a wall, as PySPH writes them; returns path, fluid, wall."""
    rng = np.random.default_rng(3)
    fluid, wall = rng.random((300, 3)), rng.random((100, 3)) * [1, 0.2, 1]
    with h5py.File(tmp_path / "tank.hdf5", "w") as file:
        for name, x in [("fluid", fluid), ("wall", wall)]:
            arrays = file.create_group(f"particles/{name}/arrays")
            for k, axis in enumerate("xyz"):
                arrays[axis], arrays["uvw"[k]] = x[:, k], np.zeros(len(x))
            arrays["m"], arrays["rho"], arrays["h"] = np.full(len(x), 1e-3), np.full(len(x), 1e3), np.full(len(x), 0.1)
    return tmp_path / "tank.hdf5", fluid, wall


def pairs(a, b, H):
    return int((np.linalg.norm(a[:, None] - b[None], axis=2) < H).sum())


@pytest.mark.parametrize("kind, walls", [(None, True), ("none", False)])
def test_pairs_are_those_of_brute_force(pairsum, tank, kind, walls):
    path, fluid, wall = tank
    done = pairsum("info", path, "--H", "0.21", "--json", *(["--boundary-kind", kind] if kind else []))
    assert done.returncode == 0, done.stderr
    got = json.loads(done.stdout)
    every = fluid if walls else np.vstack([fluid, wall])
    assert got["pairs_fluid_fluid"] == (pairs(every, every, 0.21) - len(every)) // 2
    assert got["pairs_fluid_boundary"] == (pairs(fluid, wall, 0.21) if walls else 0)
    assert got["pairs"] == got["pairs_fluid_fluid"] + got["pairs_fluid_boundary"]
    assert (got["particles"], got["fluid"], got["boundary"]) == (400, 300, 100) if walls else (400, 400, 0)
    assert got["H"] == 0.21 and got["periodic"] == "none" and len(got["hash"]) == 16
    assert {"what": "H", "value": "0.21", "how": "given", "from": "--H"} in got["facts"]


def test_the_text_says_what_was_assumed(pairsum, tank):
    done = pairsum("info", tank[0])
    assert done.returncode == 0, done.stderr
    lines = {line.strip().split("  ")[0]: line for line in done.stdout.splitlines()}
    assert "assumed" in lines["support"] and "derived" in lines["H"] and "fluid-boundary" in lines["pairs"]
    assert "% of the distance tests hit" in lines["useful pairs"]


def test_without_a_support_radius_two_spacings_are_assumed(pairsum, tmp_path):
    (tmp_path / "lattice.csv").write_text("x,y,z\n" + "".join(f"{x},{y},{z}\n" for x in range(4) for y in range(4)
                                                               for z in range(4)))
    words = ["lattice.csv", "--mass", "1000", "--rho0", "1000"]
    done = pairsum("info", *words, "--json")
    assert done.returncode == 0, done.stderr
    got = json.loads(done.stdout)
    assert {"what": "H", "value": "2", "how": "assumed", "from": "2 spacings; nothing says it, --H does"} in got["facts"]
    assert got["H"] == 2 and got["pairs"] == json.loads(
        pairsum("info", *words, "--H", "2", "--json").stdout)["pairs"]
    for command in (["run", "--particles"], ["info", "--support", "3"]):
        refused(pairsum(*command, *words), "nothing says the support radius; --H does")


def test_what_is_wrong_is_one_line(pairsum, tank, tmp_path):
    path = tank[0]
    (tmp_path / "text").write_text("none")
    refused(pairsum("info", tmp_path / "none"), "No such file")
    refused(pairsum("info", tmp_path / "text"), "no format")
    refused(pairsum("info", path, "--H", "x"), "--H")
    refused(pairsum("info", path, "--H", "1,2"), "takes one number")
    refused(pairsum("info", path, "--column", "u=x"), "--column", "vx")
    refused(pairsum("info", path, "--dim", "4"), "dimension")
    refused(pairsum("info", path, "--periodic", "all"), "--box")
    refused(pairsum("info", path, "--support", "-1"), "--support")
    path.write_bytes(path.read_bytes()[:5000])
    refused(pairsum("info", path), "tank.hdf5")


@pytest.mark.skipif(not REAL.is_dir(), reason=f"there is no {REAL}")
def test_pairs_of_a_swift_snapshot(pairsum):
    done = pairsum("info", REAL / "swift_snapshot_g32.hdf5", "--H", "0.5890558", "--json")
    assert json.loads(done.stdout)["pairs"] == 1897609, done.stderr
