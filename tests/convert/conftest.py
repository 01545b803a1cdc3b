"""What the tests of `pairsum convert` share: the package's path, a run of the program, and files of other programs."""
import os
import pathlib
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
REAL = pathlib.Path(os.environ.get("PAIRSUM_PARTICLE_FILES", ROOT.parent / "shared/data/particles"))
sys.dont_write_bytecode = True
sys.path[:0] = [str(ROOT / "plots"), str(pathlib.Path(__file__).resolve().parent)]

h5py = pytest.importorskip("h5py", reason="python3-h5py is not installed, without which nothing is converted")


@pytest.fixture
def converted(tmp_path, capfd):
    """Converts; returns what was printed and the file, open for reading."""
    from pairsum_results import __main__ as program

    opened = []

    def run(*words):
        out = tmp_path / "out.hdf"
        code = program.main(["convert", *map(str, words), str(out)])
        said = capfd.readouterr()
        assert (code, said.err) == (0, ""), said.err
        opened.append(h5py.File(out, "r"))
        return said.out, opened[-1]
    yield run
    for file in opened:
        file.close()


@pytest.fixture
def refused(tmp_path, capfd):
    """Converts what cannot be; returns the line, after a look that no file was left."""
    from pairsum_results import __main__ as program

    def run(*words, out="refused.hdf"):
        before = sorted(tmp_path.iterdir())
        code = program.main(["convert", *map(str, words), str(tmp_path / out)])
        said = capfd.readouterr()
        assert (code, said.out) == (2, "") and said.err.startswith("pairsum: ") and said.err.count("\n") == 1, said.err
        assert sorted(tmp_path.iterdir()) == before
        return said.err
    return run


@pytest.fixture
def real():
    """The path of a file that another program wrote; the test is skipped where it is not beside the checkout."""
    def path(name):
        if not (REAL / name).exists():
            pytest.skip(f"{name} does not lie in {REAL}")
        return REAL / name
    return path
