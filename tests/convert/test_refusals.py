"""What is refused, each with one line and exit code 2, and a library that is not there or crashes."""
import os
import signal
import subprocess
import sys

import numpy as np
import pytest
from conftest import ROOT, h5py
from pairsum_results.particles import formats

FILES = {"vtkmodules.vtkCommonCore": ("a.vtk", b"# vtk DataFile Version 3.0\n", "python3-vtk9"),
         "MDAnalysis": ("a.gro", b"a\n", "python3-mdanalysis"), "h5py": ("a.h5", b"\x89HDF\r\n\x1a\n", "python3-h5py"),
         "gsd.hoomd": ("a.gsd", bytes.fromhex("df65df65df65df65"), "python3-gsd")}


@pytest.mark.parametrize("module", FILES)
def test_a_library_that_is_not_there_is_named_with_its_package(module, tmp_path, refused, monkeypatch):
    name, content, package = FILES[module]
    (tmp_path / name).write_bytes(content)
    monkeypatch.setitem(sys.modules, module, None)  # as Python has it for a module that cannot be imported
    assert f"{name} needs Python's {module.split('.')[0]} (Debian: {package})" in refused(tmp_path / name)


def test_what_is_read_without_a_library_does_not_load_one(tmp_path):
    (tmp_path / "a.xyz").write_text("1\n\nAr 0 0 0\n")
    look = ("import sys; from pairsum_results.particles import formats; import pathlib; "
            "formats.read(pathlib.Path(sys.argv[1])); "
            "print([m for m in ('vtkmodules', 'MDAnalysis', 'gsd', 'h5py') if m in sys.modules])")
    done = subprocess.run([sys.executable, "-B", "-c", look, tmp_path / "a.xyz"], cwd=ROOT / "plots", text=True,
                          capture_output=True)
    assert (done.stdout, done.stderr) == ("[]\n", "")


def test_words_that_cannot_be(tmp_path, refused):
    path = tmp_path / "a.xyz"
    path.write_text("1\n\nAr 0 0 0\n")
    assert "should end in .hdf, by which ParaView knows it" in refused(path, out="out.vtk")
    assert "wants the files to read and, last, the .hdf to write" in refused()
    assert "nothing.vtp: No such file or directory" in refused(tmp_path / "nothing.vtp")
    os.link(path, tmp_path / "same.hdf")
    assert "is to be read and to be written" in refused(path, out="same.hdf")
    assert "cannot write" in refused(path, out="nowhere/out.hdf")


def test_files_that_need_no_conversion_and_unknown_ones(tmp_path, refused):
    for name, content, says in (("a.csv", b"x,y\n", "pairsum reads CSV itself"), ("a.bi4", b"#File ", "reads bi4 itself"),
                                ("a.txt", b"hello", "is no particle file that is known here: VTK"),
                                ("b.vtu", b"", "is no particle file that is known here")):
        (tmp_path / name).write_bytes(content)
        assert says in refused(tmp_path / name)
    with h5py.File(tmp_path / "g.hdf5", "w") as file:
        file["PartType0/Coordinates"] = np.zeros((3, 3))
    assert "is HDF5 but not H5MD; pairsum reads the other kinds of HDF5 itself" in refused(tmp_path / "g.hdf5")


def test_no_particles_are_refused(tmp_path, refused):
    (tmp_path / "a.xyz").write_text("0\n\n")
    assert "a.xyz: no particles" in refused(tmp_path / "a.xyz")


def test_a_library_that_crashes_is_one_line(tmp_path, refused, monkeypatch):
    (tmp_path / "a.xyz").write_text("1\n\nAr 0 0 0\n")

    def crash(*_):
        os.write(2, b"terminate called\n")
        os.kill(os.getpid(), signal.SIGKILL)
    monkeypatch.setattr(formats.xyz, "read", crash)
    assert refused(tmp_path / "a.xyz").startswith("pairsum: SIGKILL ended a library while it read the files")


def test_a_fault_of_the_program_is_heard(tmp_path, capfd, monkeypatch):
    from pairsum_results import __main__ as program

    (tmp_path / "a.xyz").write_text("1\n\nAr 0 0 0\n")
    monkeypatch.setattr(formats.xyz, "read", lambda *_: 1 // 0)
    assert program.main(["convert", str(tmp_path / "a.xyz"), str(tmp_path / "out.hdf")]) == 1
    assert "ZeroDivisionError" in capfd.readouterr().err
