"""Damaged and hostile HDF5 files: one line and exit code 2, or a set; no crash, no hang, no memory for what is not there."""

import subprocess
import sys

import h5py
import numpy as np
import pytest
from conftest import PROGRAM, Particles, gadget, read

WRONG = {
    "a scalar": lambda g: replace(g, "Coordinates", np.float64(1)),
    "three dimensions": lambda g: replace(g, "Coordinates", np.zeros((200, 3, 1))),
    "four columns": lambda g: replace(g, "Coordinates", np.zeros((200, 4))),
    "texts": lambda g: replace(g, "Coordinates", np.full(200, b"x")),
    "a group": lambda g: (g.pop("Coordinates"), g.create_group("Coordinates")),
    "fewer rows": lambda g: replace(g, "Masses", np.ones(199)),
    "two columns of masses": lambda g: replace(g, "Masses", np.ones((200, 2))),
    "a NaN": lambda g: g["Coordinates"].__setitem__((7, 1), np.nan),
    "an infinite velocity": lambda g: g["Velocities"].__setitem__((7, 1), np.inf),
    "a negative mass": lambda g: g["Masses"].__setitem__(7, -1),
    "no density": lambda g: g["Density"].__setitem__(7, 0),
    "a kind that is none": lambda g: replace(g, "Kind", np.full(200, 5)),
    "a negative box": lambda g: g.parent["Header"].attrs.__setitem__("BoxSize", [1.0, -1.0, 1.0]),
    "a box that is not finite": lambda g: g.parent["Header"].attrs.__setitem__("BoxSize", np.nan),
    "seven dimensions": lambda g: g.parent["Header"].attrs.__setitem__("Dimension", 7),
    "another count": lambda g: g.parent["Header"].attrs.__setitem__("NumPart_ThisFile", [100] + [0] * 5),
    "a billion files": lambda g: g.parent["Header"].attrs.__setitem__("NumFilesPerSnapshot", 10**9),
    "no particles": lambda g: g.pop("Coordinates"),
    "no groups": lambda g: g.parent.pop("PartType0"),
    "a dangling link": lambda g: (g.pop("Coordinates"), g.__setitem__("Coordinates", h5py.SoftLink("/nowhere"))),
    "a circle of links": lambda g: (g.pop("Coordinates"), g.__setitem__("Coordinates", h5py.SoftLink("/PartType0/Coordinates"))),
    "2^60 rows": lambda g: claim(g, 2**60),
    "3 billion rows": lambda g: claim(g, 3 * 10**9),
}
FINE = {
    "a box in text": lambda g: g.parent["Header"].attrs.__setitem__("BoxSize", "one"),
    "no header": lambda g: g.parent.pop("Header"),
    "a huge attribute": lambda g: g.parent["Header"].attrs.__setitem__("Time", np.zeros(5000)),
    "masses of zero": lambda g: g["Masses"].__setitem__(slice(None), 0),
}


def replace(group, name, data):
    group.pop(name, None)
    group[name] = data


def claim(group, rows):
    """Coordinates of many rows, of which none is stored."""
    group.pop("Coordinates")
    group.create_dataset("Coordinates", (rows, 3), "f8", chunks=(1024, 3))


@pytest.fixture
def path(tmp_path, particles):
    return gadget(tmp_path / "a.hdf5", particles, packed=False)


@pytest.mark.parametrize("what", WRONG)
def test_what_is_wrong_is_one_line(path, what):
    with h5py.File(path, "a") as file:
        WRONG[what](file["PartType0"])
    result = read(path)
    assert result.code == 2 and result.error.startswith((str(path), f"cannot read {path}")), result.error
    if what in ("a NaN", "an infinite velocity", "a negative mass", "no density"):
        assert "particle 8 " in result.error


@pytest.mark.parametrize("what", FINE)
def test_what_is_odd_is_read(path, what):
    with h5py.File(path, "a") as file:
        FINE[what](file["PartType0"])
    assert read(path).code == 0


def test_a_file_cut_short_is_one_line(path, tmp_path):
    whole = path.read_bytes()
    cut = tmp_path / "cut.hdf5"
    for size in [1, 8, 100, 600, *range(1000, len(whole), len(whole) // 12), len(whole) - 1]:
        cut.write_bytes(whole[:size])
        assert read(cut).code == 2, size


def test_a_changed_column_that_has_a_checksum_is_one_line(tmp_path, particles):
    path = gadget(tmp_path / "a.hdf5", particles, packed=True)
    with h5py.File(path) as file:
        at = file["PartType0/Velocities"].id.get_chunk_info(1)
    whole = bytearray(path.read_bytes())
    whole[at.byte_offset + at.size // 2] ^= 1
    path.write_bytes(whole)
    result = read(path)
    assert result.code == 2 and "PartType0/Velocities: cannot be read" in result.error


@pytest.mark.parametrize("packed", [False, True])
def test_no_changed_byte_crashes_or_hangs(tmp_path, particles, packed):
    """Changes lie in what is no column: there they may change what HDF5 does."""
    whole = bytearray(gadget(tmp_path / "a.hdf5", particles, packed=packed).read_bytes())
    rng, codes = np.random.default_rng(7), set()
    changed = tmp_path / "changed.hdf5"
    places = rng.permutation([k for k in range(len(whole)) if whole[k] != 0 or k < 4096])
    for place in places[:60]:
        other = bytearray(whole)
        other[place] = rng.integers(256)
        changed.write_bytes(other)
        codes.add(read(changed).code)
    assert codes <= {0, 2}


def test_it_takes_at_most_200_bytes_a_particle(tmp_path):
    """The larger of the two processes takes half of that at most, beyond what it takes for a few particles."""
    def peak(n):
        path = gadget(tmp_path / f"{n}.hdf5", Particles(n), packed=True)
        measure = ("import resource,subprocess,sys;subprocess.run(sys.argv[1:],check=True,stdout=subprocess.DEVNULL);"
                   "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)")
        done = subprocess.run([sys.executable, "-c", measure, PROGRAM, path], capture_output=True, text=True, check=True)
        return 1024 * int(done.stdout)

    n = 400_000
    assert (peak(n) - peak(100)) / n < 100
