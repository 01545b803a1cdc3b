"""The file that is written: names of GADGET, VTKHDF with links to the same data, and that it appears whole or not at all."""
import numpy as np
import pytest
from conftest import h5py
from pairsum_results import ResultsError
from pairsum_results.particles import Asked, convert, joined, source

XYZ = ('3\nLattice="2 0 0 0 3 0 0 0 4" Origin="-1 0 0" pbc="T F T" Time=0.5 '
       'Properties=species:S:1:pos:R:3:velo:R:3:mass:R:1:h:R:1:id:I:1\n'
       'Fluid 0 1 2 1 2 3 0.5 0.1 7\nWall 0.25 1 2 0 0 0 0.5 0.125 8\nFluid 0.5 1 2.5 4 5 6 0.25 0.1 9\n')


@pytest.fixture
def xyz(tmp_path):
    path = tmp_path / "set.xyz"
    path.write_text(XYZ)
    return path


def test_names_shapes_and_types_are_those_of_gadget(xyz, converted):
    said, file = converted(xyz)
    header = dict(file["Header"].attrs)
    assert header["NumPart_ThisFile"].tolist() == header["NumPart_Total"].tolist() == [3, 0, 0, 0, 0, 0]
    assert header["MassTable"].tolist() == [0] * 6 and header["NumFilesPerSnapshot"] == 1
    assert header["BoxSize"].tolist() == [2, 3, 4] and header["BoxLow"].tolist() == [-1, 0, 0]
    assert header["BoxHigh"].tolist() == [1, 3, 4] and header["Periodic"].tolist() == [1, 0, 1]
    assert header["Dimension"] == 3 and header["Time"] == 0.5
    assert header["KindNames"] == b"fluid,boundary" and header["SmoothingLengthIs"] == b"h"
    data = file["PartType0"]
    assert {name: (values.shape, str(values.dtype)) for name, values in data.items()} == {
        "Coordinates": ((3, 3), "float64"), "Velocities": ((3, 3), "float64"), "Masses": ((3,), "float64"),
        "SmoothingLength": ((3,), "float64"), "ParticleIDs": ((3,), "uint64"), "Kind": ((3,), "uint8")}
    assert data["Coordinates"][:].tolist() == [[0, 1, 2], [0.25, 1, 2], [0.5, 1, 2.5]]
    assert data["SmoothingLength"][:].tolist() == [0.1, 0.125, 0.1] and data["Kind"][:].tolist() == [0, 1, 0]
    assert "no pbc" not in said and "box              -1 to 1, 0 to 3, 0 to 4" in said


def test_nothing_is_made_up(tmp_path, converted):
    path = tmp_path / "bare.xyz"
    path.write_text("2\n\nAr 0 0 0\nAr 1 1 1\n")
    said, file = converted(path)
    assert set(file["PartType0"]) == {"Coordinates", "Kind"}
    assert set(file["Header"].attrs) == {"NumPart_ThisFile", "NumPart_Total", "MassTable", "NumFilesPerSnapshot",
                                         "Dimension", "Periodic", "KindNames"}
    assert "assumed  open: no file names one" in said


def test_vtkhdf_is_the_same_data(xyz, converted):
    _, file = converted(xyz)
    assert file["VTKHDF/Points"] == file["PartType0/Coordinates"]  # one dataset with two names
    for name in ("Velocities", "Masses", "SmoothingLength", "ParticleIDs", "Kind"):
        assert file[f"VTKHDF/PointData/{name}"] == file[f"PartType0/{name}"]


def test_vtk_opens_it(xyz, converted):
    io = pytest.importorskip("vtkmodules.vtkIOHDF", reason="python3-vtk9 is not installed")
    from vtkmodules.util.numpy_support import vtk_to_numpy

    _, file = converted(xyz)
    name = file.filename
    file.close()
    reader = io.vtkHDFReader()
    assert reader.CanReadFile(name)
    reader.SetFileName(name)
    reader.Update()
    grid = reader.GetOutput()
    assert (grid.GetNumberOfPoints(), grid.GetNumberOfCells(), grid.GetCellType(2)) == (3, 3, 1)
    assert [grid.GetCell(k).GetPointId(0) for k in range(3)] == [0, 1, 2]
    assert vtk_to_numpy(grid.GetPoints().GetData()).tolist() == [[0, 1, 2], [0.25, 1, 2], [0.5, 1, 2.5]]
    data = grid.GetPointData()
    assert vtk_to_numpy(data.GetArray("Velocities")).tolist() == [[1, 2, 3], [0, 0, 0], [4, 5, 6]]
    assert vtk_to_numpy(data.GetArray("Kind")).tolist() == [0, 1, 0]


@pytest.mark.parametrize("name, means", [("h", b"h"), ("hsml", b"h"), ("Hvar", b"h"), ("smoothing_length", b"h"),
                                         ("support_radius", b"support")])
def test_what_h_means_is_said(tmp_path, converted, name, means):
    path = tmp_path / "a.xyz"
    path.write_text(f"1\nProperties=pos:R:3:{name}:R:1\n0 0 0 0.3\n")
    _, file = converted(path)
    assert file["Header"].attrs["SmoothingLengthIs"] == means
    assert file["PartType0/SmoothingLength"][:].tolist() == [0.3]


def test_ids_that_occur_twice_are_left_out(xyz, tmp_path, converted):
    said, file = converted("--fluid", xyz, "--fluid", xyz)
    assert "ParticleIDs" not in file["PartType0"] and "3 occur more than once" in said
    assert file["Header"].attrs["NumPart_ThisFile"][0] == 6


def test_files_may_stand_on_both_sides_of_an_option(xyz, converted):
    said, file = converted(xyz, "--boundary", xyz)
    assert file["PartType0/Kind"][:].tolist() == [1, 1, 1, 0, 1, 0]


def test_a_file_is_whole_or_as_it_was(xyz, tmp_path, monkeypatch):
    out = tmp_path / "out.hdf"
    out.write_text("before")

    def full(*_, **__):
        raise OSError(28, "No space left on device")
    with monkeypatch.context() as patch:
        patch.setattr(h5py.Group, "create_dataset", full)
        with pytest.raises(ResultsError, match="cannot write .*out.hdf: No space left on device"):
            convert(Asked(str(out), [str(xyz)]))
    assert out.read_text() == "before" and sorted(tmp_path.iterdir()) == [out, xyz]
    convert(Asked(str(out), [str(xyz)]))
    assert h5py.is_hdf5(out) and sorted(tmp_path.iterdir()) == [out, xyz]


def test_more_particles_than_pairsum_numbers_are_refused(tmp_path):
    many = np.broadcast_to(np.zeros(1, np.uint8), (2**32 - 1024, 3))  # which takes one byte
    with pytest.raises(ResultsError, match="4294966272 particles are more than pairsum takes, 4294966271"):
        joined.joined([(source.Source(tmp_path, "test", {"pos": many}), "fluid")], {}, "")
    joined.check_count(2**32 - 1025)
