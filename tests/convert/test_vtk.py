"""VTK XML and legacy files with the traits of SPHinXsys, TrixiParticles and DualSPHysics."""
import numpy as np
import pytest

pytest.importorskip("vtkmodules.vtkIOXML", reason="python3-vtk9 is not installed")
from vtkmodules.util.numpy_support import numpy_to_vtk  # noqa: E402
from vtkmodules.vtkCommonCore import vtkPoints  # noqa: E402
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData, vtkUnstructuredGrid  # noqa: E402
from vtkmodules.vtkIOLegacy import vtkPolyDataWriter  # noqa: E402
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter, vtkXMLUnstructuredGridWriter  # noqa: E402

PLACES = np.array([[0.0, 0.1, 0.2], [0.3, 0.1, 0.25], [0.6, 0.2, 0.2]])


def point_set(kind, places, field=(), **columns):
    made = kind()
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.asarray(places), deep=True))
    made.SetPoints(points)
    for name, values in columns.items():
        add(made.GetPointData(), name, values)
    for name, value in field:
        add(made.GetFieldData(), name, [value])
    return made


def add(to, name, values):
    array = numpy_to_vtk(np.asarray(values), deep=True)
    array.SetName(name)
    to.AddArray(array)


def written(path, data, writer):
    writer.SetInputData(data)
    writer.SetFileName(str(path))
    assert writer.Write()
    return path


def trixi(path, places, **columns):
    """UnstructuredGrid, appended raw, zlib, UInt64 headers, no cells."""
    data = point_set(vtkUnstructuredGrid, places, [("time", 0.4), ("ndims", 2)], **columns)
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetHeaderTypeToUInt64()
    writer.SetDataModeToAppended()
    writer.EncodeAppendedDataOff()
    writer.SetCompressorTypeToZLib()
    written(path, data, writer)
    text = path.read_bytes()
    assert b'header_type="UInt64"' in text and b"ZLib" in text and b'encoding="raw"' in text and b'OfCells="0"' in text
    return path


SPHINXSYS = """<?xml version="1.0"?>
<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian">
 <PolyData>
  <Piece Name ="{name}" NumberOfPoints="2" NumberOfVerts="2">
   <Points>
    <DataArray Name="Position" type="Float32"  NumberOfComponents="3" Format="ascii">
    {places}
    </DataArray>
   </Points>
   <PointData  Vectors="vector">
    <DataArray Name="OriginalID" type="Int32" Format="ascii">
    {ids}
    </DataArray>
    {more}
   </PointData>
   <Verts>
    <DataArray type="Int32"  Name="connectivity"  Format="ascii">
    0 1
    </DataArray>
    <DataArray type="Int32"  Name="offsets"  Format="ascii">
    1 2
    </DataArray>
   </Verts>
  </Piece>
 </PolyData>
</VTKFile>
"""


def sphinxsys(path, places, ids, more=""):
    path.write_text(SPHINXSYS.format(name=path.stem, places=places, ids=ids, more=more))
    return path


def test_format_with_a_capital_and_a_wall_without_velocity(tmp_path, converted):
    velocity = ('<DataArray Name="Velocity" type="Float32" NumberOfComponents="3" Format="ascii">\n1 2 0 3 4 0\n'
                '</DataArray><DataArray Name="Density" type="Float32" Format="ascii">\n1000 1001\n</DataArray>')
    water = sphinxsys(tmp_path / "water.vtp", "0.5 0 0 0.5 1 0", "0 1", velocity)
    wall = sphinxsys(tmp_path / "wall.vtp", "-0.5 0 0 -0.5 1 0", "5 6")
    said, file = converted("--fluid", water, "--boundary", wall)
    data = file["PartType0"]
    assert set(data) == {"Coordinates", "Velocities", "ParticleIDs", "Kind"}  # no density of the wall is made up
    assert data["Coordinates"].dtype == float and data["Coordinates"][:, 0].tolist() == [0.5, 0.5, -0.5, -0.5]
    assert data["Velocities"][:].tolist() == [[1, 2, 0], [3, 4, 0], [0, 0, 0], [0, 0, 0]]
    assert data["ParticleIDs"][:].tolist() == [0, 1, 5, 6] and data["Kind"][:].tolist() == [0, 0, 1, 1]
    assert file["Header"].attrs["Dimension"] == 2
    lines = {line.split("  ")[0]: " ".join(line.split()) for line in said.splitlines()}
    assert lines["particles"] == "particles 2 fluid, 2 boundary"
    assert lines["Velocities"] == "Velocities Velocity; 0 in wall.vtp assumed walls at rest"
    assert lines["Density"] == "Density Density left out not in wall.vtp"


def test_compressed_data_two_components_and_no_cells(tmp_path, converted):
    flat = PLACES * [1, 1, 0]
    fluid = trixi(tmp_path / "fluid.vtu", flat, velocity=np.array([[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]]), density=[7.0, 8.0, 9.0])
    wall = trixi(tmp_path / "wall.vtu", flat + [0, 1, 0], hydrodynamic_density=[1.0, 2.0, 3.0])
    said, file = converted("--fluid", fluid, "--boundary", wall)
    assert file["PartType0/Velocities"][:3].tolist() == [[1, 2, 0], [3, 4, 0], [5, 6, 0]]
    assert file["PartType0/Density"][:].tolist() == [7, 8, 9, 1, 2, 3]
    assert file["Header"].attrs["Time"] == 0.4 and file["Header"].attrs["Dimension"] == 2
    assert (file["PartType0/Coordinates"][:] == np.concatenate([flat, flat + [0, 1, 0]])).all()


def legacy(path, **columns):
    return written(path, point_set(vtkPolyData, PLACES, **columns), vtkPolyDataWriter())


@pytest.mark.parametrize("velocity", ["Vel", "Velocity", "velocities"])
def test_legacy_files_of_dualsphysics_say_kinds(tmp_path, converted, velocity):
    path = legacy(tmp_path / "part.vtk", Rhop=[1000.0, 1001.0, 1002.0], Type=np.array([0, 3, 1], np.uint8),
                  Idp=np.array([4, 7, 9], np.uint32), **{velocity: PLACES})
    said, file = converted(path)
    assert file["PartType0/Kind"][:].tolist() == [1, 0, 1] and "Type of DualSPHysics: 3 fluid, 0 and 1" in said
    assert file["PartType0/Density"][:].tolist() == [1000, 1001, 1002]
    assert (file["PartType0/Velocities"][:] == PLACES).all() and file["PartType0/ParticleIDs"][:].tolist() == [4, 7, 9]
    assert file["Header"].attrs["Dimension"] == 3


def test_a_plane_of_x_and_z_stays_as_it_is(tmp_path, converted):
    path = written(tmp_path / "part.vtk", point_set(vtkPolyData, PLACES * [1, 0, 1]), vtkPolyDataWriter())
    said, file = converted(path)
    assert file["Header"].attrs["Dimension"] == 2 and "y is the same everywhere" in said
    assert (file["PartType0/Coordinates"][:] == PLACES * [1, 0, 1]).all()
    assert file["PartType0/Kind"][:].tolist() == [0, 0, 0] and "nothing says otherwise" in said


def test_kinds_can_be_said(tmp_path, converted, refused):
    path = legacy(tmp_path / "part.vtk", Mk=[1, 5, 7], Type=np.array([4, 3, 3], np.uint8))
    assert converted("--boundary-kind", "Mk=1,7", path)[1]["PartType0/Kind"][:].tolist() == [1, 0, 1]
    assert converted("--boundary-kind", "none", path)[1]["PartType0/Kind"][:].tolist() == [0, 0, 0]
    assert 'Type has the values 3, 4, should have 0 or 1 (wall) and 3 (fluid)' in refused(path)
    assert 'unknown column "Mkk"; did you mean Mk?' in refused("--boundary-kind", "Mkk=1", path)
    assert "should be none, or a column" in refused("--boundary-kind", "Mk", path)


def test_floating_bodies_and_sets_without_fluid_are_refused(tmp_path, refused):
    assert "floating bodies (Type = 2" in refused(legacy(tmp_path / "a.vtk", Type=[0, 2, 3]))
    assert "no particle is fluid; --boundary-kind none" in refused(legacy(tmp_path / "b.vtk", Type=[0, 1, 1]))


def test_columns_can_be_named(tmp_path, converted, refused):
    path = legacy(tmp_path / "part.vtk", U=PLACES * 2, field_7=[1.0, 2.0, 3.0])
    said, file = converted("--column", "vx=U:0", "--column", "vy=U:1", "--column", "vz=U:2", "--column", "rho=field_7", path)
    assert (file["PartType0/Velocities"][:] == 2 * PLACES).all() and file["PartType0/Density"][:].tolist() == [1, 2, 3]
    assert 'unknown column "U:3"' in refused("--column", "vx=U:3", path)
    assert 'unknown quantity "speed"' in refused("--column", "speed=U:0", path)


def test_what_is_no_set_of_points_is_refused(tmp_path, refused):
    image = vtkImageData()
    image.SetDimensions(2, 2, 2)
    path = written(tmp_path / "image.vti", image, vtkXMLImageDataWriter())
    assert "holds no particles but vtkImageData" in refused(path)
    assert "none.vtk: no particles" in refused(written(tmp_path / "none.vtk", vtkPolyData(), vtkPolyDataWriter()))


def test_a_file_that_was_cut_is_refused_with_a_line_of_vtk(tmp_path, refused):
    whole = trixi(tmp_path / "whole.vtu", PLACES, density=[7.0, 8.0, 9.0]).read_bytes()
    cut = tmp_path / "cut.vtu"
    for bytes_left in (150, len(whole) // 2, whole.index(b"AppendedData") + 40):
        cut.write_bytes(whole[:bytes_left])
        assert "cut.vtu cannot be read as VTK: " in refused(cut)
