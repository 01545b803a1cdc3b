"""What write_hdf writes is what VTK 9.1 reads; what write_xmf names is there."""

import xml.etree.ElementTree

import h5py
import numpy as np
import pytest
from conftest import Particles, columns, gadget, read

vtk = pytest.importorskip("vtkmodules.all", reason="python3-vtk9 is not installed")
from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402


@pytest.fixture
def written(tmp_path):
    p = Particles(100)
    assert read(gadget(tmp_path / "a.hdf5", p), out=tmp_path / "out.hdf", xmf=tmp_path / "out.xmf").code == 0
    return tmp_path / "out.hdf", p


def test_vtk_reads_it(written):
    path, p = written
    reader = vtk.vtkHDFReader()
    assert reader.CanReadFile(str(path))
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    assert grid.GetNumberOfPoints() == grid.GetNumberOfCells() == 100
    assert grid.GetCellType(99) == vtk.VTK_VERTEX and grid.GetCell(99).GetPointId(0) == 99
    assert np.array_equal(vtk_to_numpy(grid.GetPoints().GetData()), p.x)
    data = grid.GetPointData()
    assert np.array_equal(vtk_to_numpy(data.GetArray("Velocities")), p.v)
    assert np.array_equal(vtk_to_numpy(data.GetArray("Density")), p.rho)
    assert np.array_equal(vtk_to_numpy(data.GetArray("Kind")), np.zeros(100))


def test_the_data_are_there_once(written):
    path, _ = written
    with h5py.File(path) as file:
        for name in ["Velocities", "Density", "Masses", "Kind", "ParticleIDs"]:
            assert file[f"VTKHDF/PointData/{name}"] == file[f"PartType0/{name}"]
        assert file["VTKHDF/Points"] == file["PartType0/Coordinates"]
        header = dict(file["Header"].attrs)
        assert header["NumPart_ThisFile"].tolist() == [100, 0, 0, 0, 0, 0] and header["Step"] == 7
        assert b"H = " in header["Facts"] and header["Periodic"].tolist() == [1, 1, 1]


def test_a_series_names_data_that_are_there(written):
    """Debian's VTK has no reader of XDMF."""
    path, _ = written
    root = xml.etree.ElementTree.parse(path.with_suffix(".xmf")).getroot()
    assert [t.get("Value") for t in root.iter("Time")] == ["0", "1"]
    items = list(root.iter("DataItem"))
    assert len(items) == 2 * 6
    for item in items:
        file, name = item.text.split(":")
        assert file == path.name
        with h5py.File(path) as opened:
            data = opened[name]
            assert data.shape == tuple(map(int, item.get("Dimensions").split()))
            kinds = {"Float": "f", "UChar": "u", "UInt": "u"}
            assert (data.dtype.kind, data.dtype.itemsize) == (kinds[item.get("NumberType")], int(item.get("Precision")))


def test_the_headers_H_is_no_h(written):
    path, p = written
    H = read(path).set["H"]
    assert read(path).fact["H"]["how"] == "read" and H == p.h.max()
    assert read(path, support=3).set["H"] == H
    assert read(path, h=0.125).set["H"] == 0.25 and "assumed" in read(path, h=0.125).fact["H"]["from"]
    assert read(path, h=0.125, support=3).set["H"] == 0.375


def test_read_again_it_is_the_same(written, tmp_path):
    path, _ = written
    first = read(path, out=tmp_path / "again.hdf")
    assert first.set["hash"] == read(tmp_path / "again.hdf").set["hash"]
    a, b = columns(path), columns(tmp_path / "again.hdf")
    assert all(np.array_equal(a[name], b[name]) for name in a)
