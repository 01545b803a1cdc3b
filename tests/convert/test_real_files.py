"""Files that other programs wrote, where they lie beside the checkout."""
import numpy as np
import pytest


def pairs(file, support):
    """Pairs with r < support of what was written, each once."""
    spatial = pytest.importorskip("scipy.spatial")
    return len(spatial.cKDTree(file["PartType0/Coordinates"][:]).query_pairs(np.nextafter(support, 0), output_type="ndarray"))


def test_a_dam_break_of_sphinxsys(real, converted):
    pytest.importorskip("vtkmodules.vtkIOXML", reason="python3-vtk9 is not installed")
    said, file = converted("--fluid", real("sphinxsys_WaterBlock_0006009202.vtp"),
                           "--boundary", real("sphinxsys_WallBoundary_0000000000.vtp"))
    assert np.bincount(file["PartType0/Kind"][:]).tolist() == [2236, 2012]
    assert file["Header"].attrs["Dimension"] == 2 and pairs(file, 0.052) == 36232
    assert "SmoothingLength" not in file["PartType0"] and "Masses" not in file["PartType0"]


def test_a_tank_of_trixiparticles(real, converted):
    pytest.importorskip("vtkmodules.vtkIOXML", reason="python3-vtk9 is not installed")
    said, file = converted("--fluid", real("trixi_fluid_1_20.vtu"), "--boundary", real("trixi_boundary_1_20.vtu"))
    assert np.bincount(file["PartType0/Kind"][:]).tolist() == [360, 276]
    assert file["Header"].attrs["Dimension"] == 2 and file["Header"].attrs["Time"] == 0.4
    assert file["PartType0/Density"][:].min() > 900 and (file["PartType0/Velocities"][:, 2] == 0).all()
    assert "not in trixi_fluid_1_20.vtu; elsewhere it is 0.06" in said


def test_a_triclinic_dump(real, refused):
    assert "albite_triclinic.dump has a triclinic box" in refused(real("albite_triclinic.dump"))


def test_files_that_pairsum_reads_itself(real, refused):
    assert "pairsum reads bi4 itself" in refused(real("Part_0001.bi4"))
    assert "not H5MD" in refused(real("swift_glassCube_8.hdf5"))
