"""Runs read_files, and makes files as other programs write them."""

import json
import os
import pathlib
import subprocess

import h5py
import numpy as np
import pytest

PROGRAM = os.environ["PAIRSUM_READ_FILES"]


class Result:
    """What read_files said: a set as a dict, or the line of its error."""

    def __init__(self, done):
        self.code, self.error = done.returncode, done.stderr.strip()
        self.set = json.loads(done.stdout) if done.returncode == 0 else None
        if self.set:
            self.fact = {f["what"]: f for f in self.set["facts"]}


def read(*words, **options):
    """Reads files as one set; an option `boundary_kind` is --boundary-kind."""
    flags = [f"--{name.replace('_', '-')}={value}" for name, value in options.items()]
    done = subprocess.run([PROGRAM, *flags, *map(str, words)], text=True, capture_output=True, timeout=60)
    assert done.returncode in (0, 2), done
    result = Result(done)
    assert result.code == 0 or (len(result.error.splitlines()) == 1 and result.error), result.error
    return result


def columns(path):
    """The columns of a file that read_files wrote."""
    with h5py.File(path) as file:
        return {name: data[...] for name, data in file["PartType0"].items()}


def dataset(group, name, data, packed=False):
    """`packed` as SWIFT packs."""
    rows = 64 if len(data) < 10_000 else 4096
    options = {"chunks": (rows, *data.shape[1:]), "shuffle": True, "compression": "gzip", "fletcher32": True}
    group.create_dataset(name, data=data, **(options if packed else {}))


class Particles:
    """Some particles at random places of the unit cube."""

    def __init__(self, n=200, seed=1):
        rng = np.random.default_rng(seed)
        self.x, self.v = rng.random((n, 3)), rng.standard_normal((n, 3))
        self.rho, self.m, self.h = 1 + rng.random(n), (1 + rng.random(n)) / n, 0.25 * (1 + 0.1 * rng.random(n))

    def __len__(self):
        return len(self.m)


@pytest.fixture
def particles():
    return Particles()


def gadget(path, p, *, plural=False, packed=False, types=6, number=0, leave=(), kind="f8", header=(), h=None):
    """A file as GADGET or SWIFT writes it; `leave` names columns that it lacks."""
    s = "s" if plural else ""
    data = {"Coordinates": p.x, "Velocities": p.v, "Masses": p.m, ("Densities" if plural else "Density"): p.rho,
            f"SmoothingLength{s}": p.h if h is None else h}
    with h5py.File(path, "w") as file:
        attributes = file.create_group("Header").attrs
        counts = np.zeros(types, "i8")
        counts[number] = len(p)
        attributes.update({"NumPart_ThisFile": counts, "NumFilesPerSnapshot": 1, "MassTable": np.zeros(types),
                           "BoxSize": 1.0, "Time": np.array([0.25])} | dict(header))
        group = file.create_group(f"PartType{number}")
        for name, values in data.items():
            if name not in leave:
                dataset(group, name, values.astype(kind), packed)
        group.create_dataset("ParticleIDs", data=np.arange(len(p)))
    return path
