"""LAMMPS dumps, extended XYZ, GROMACS, GSD, H5MD and PySPH."""
import numpy as np
import pytest
from conftest import h5py

from pairsum_results.particles.kinds import BOUNDARY, FLUID, named_kind

DUMP = """ITEM: UNITS
si
ITEM: TIME
0.25
ITEM: TIMESTEP
{step}
ITEM: NUMBER OF ATOMS
2
ITEM: BOX BOUNDS {words}
-1 1{xy}
0 2{xz}
0 4{yz}
ITEM: ATOMS {columns}
{rows}
"""


def dump(path, words="pp pp ff", tilt=("", "", ""), columns="id type x y z", rows="5 1 0 1 2\n3 2 .5 1 3", steps=1):
    path.write_text("".join(DUMP.format(step=k, words=words, xy=tilt[0], xz=tilt[1], yz=tilt[2], columns=columns,
                                        rows=rows.replace("STEP", str(k))) for k in range(steps)))
    return path


def test_a_dump_with_more_columns(tmp_path, converted):
    path = dump(tmp_path / "dump.0", columns="id type x y z vx vy vz mass c_rho",
                rows="5 1 0 1 2 1 2 3 .5 1000\n3 2 .5 1 3 4 5 6 .5 1001")
    said, file = converted("--column", "rho=c_rho", "--boundary-kind", "type=2", path)
    data, header = file["PartType0"], file["Header"].attrs
    assert data["Coordinates"][:].tolist() == [[0, 1, 2], [0.5, 1, 3]] and data["Masses"][:].tolist() == [0.5, 0.5]
    assert data["Velocities"][:].tolist() == [[1, 2, 3], [4, 5, 6]] and data["Density"][:].tolist() == [1000, 1001]
    assert data["ParticleIDs"][:].tolist() == [5, 3] and data["Kind"][:].tolist() == [0, 1]
    assert header["BoxLow"].tolist() == [-1, 0, 0] and header["BoxSize"].tolist() == [2, 2, 4]
    assert header["Periodic"].tolist() == [1, 1, 0] and header["Time"] == 0.25 and "LAMMPS' si" in said
    said, file = converted(path)
    assert file["PartType0/Kind"][:].tolist() == [0, 0] and '--boundary-kind "type=..."' in said


@pytest.mark.parametrize("columns", ["xs ys zs", "xsu ysu zsu"])
def test_scaled_positions_are_scaled_back(tmp_path, converted, columns):
    _, file = converted(dump(tmp_path / "dump.0", columns=columns, rows="0.5 0.5 0.5\n1.25 0 0.25"))
    assert file["PartType0/Coordinates"][:].tolist() == [[0, 1, 2], [1.5, 0, 1]]


def test_a_triclinic_box_is_refused_and_one_without_tilt_is_not(tmp_path, converted, refused):
    assert "a triclinic box (tilted by 0.5)" in refused(
        dump(tmp_path / "a.dump", words="xy xz yz pp pp pp", tilt=(" 0", " 0.5", " 0")))
    _, file = converted(dump(tmp_path / "b.dump", words="xy xz yz pp pp ff", tilt=(" 0", " 0", " 0")))
    assert file["Header"].attrs["Periodic"].tolist() == [1, 1, 0]


def test_one_frame_is_taken(tmp_path, converted, refused):
    path = dump(tmp_path / "many.dump", columns="x y z", rows="STEP 0 0\nSTEP 1 1", steps=3)
    said, file = converted(path)
    assert file["PartType0/Coordinates"][:, 0].tolist() == [2, 2] and "frame 2 of 0 to 2" in said
    assert converted("--frame", 1, path)[1]["PartType0/Coordinates"][:, 0].tolist() == [1, 1]
    assert "has 3 frames, so no frame 3" in refused("--frame", 3, path)


@pytest.mark.parametrize("rows, says", [
    ("5 1 0 1 2", "1 rows of 5 columns; the file names 2 and 5"), ("5 1 0 1 2\n3 2 .5 1", "z = [0.5 1.  nan]"),
    ("5 1 0 1 2 6\n3 2 .5 1 3 7", "2 rows of 6 columns"), ("5 1 0 1 2\n3 2 .5 1 nan", "row 1, counted from 0"),
    ("5 1 0 1 x\n3 2 .5 1 3", "holds other things than numbers"), ("5 1 0 1 inf\n3 2 .5 1 3", "row 0, counted from 0")])
def test_damaged_dumps_are_refused(tmp_path, refused, rows, says):
    assert says in refused(dump(tmp_path / "bad.dump", rows=rows))


def test_a_dump_without_positions_names_its_columns(tmp_path, refused):
    assert "no column of positions among id, type" in refused(
        dump(tmp_path / "bad.dump", columns="id type", rows="1 1\n2 1"))


def test_xyz_without_a_box_and_with_one_that_is_tilted(tmp_path, converted, refused):
    path = tmp_path / "a.xyz"
    path.write_text('1\nLattice="1 0 0 0.5 1 0 0 0 1" Properties=pos:R:3\n0 0 0\n')
    assert "triclinic" in refused(path)
    path.write_text('1\nLattice="1 0 0 0 1 0 0 0 1" Properties=pos:R:3:kind:I:1\n0 0 0 0\n')
    said, file = converted(path)
    assert file["Header"].attrs["Periodic"].tolist() == [1, 1, 1] and "usual where a file has a Lattice and no pbc" in said
    path.write_text("2\nProperties=pos:R:3\n0 0 0\n")
    assert "the file names 2 and 3" in refused(path)
    path.write_text("two\n")
    assert 'the number of particles should stand where the file has "two"' in refused(path)


@pytest.mark.parametrize("pbc, periodic", [("True False True", [1, 0, 1]), ("T F T", [1, 0, 1]), ("1 0 1", [1, 0, 1]),
                                           ("true false TRUE", [1, 0, 1]), ("False False False", [0, 0, 0])])
def test_periodic_axes_of_xyz(tmp_path, converted, pbc, periodic):
    path = tmp_path / "a.xyz"
    path.write_text(f'1\nLattice="1 0 0 0 1 0 0 0 1" Properties=pos:R:3 pbc="{pbc}"\n0 0 0\n')
    assert converted(path)[1]["Header"].attrs["Periodic"].tolist() == periodic


@pytest.mark.parametrize("words, says", [('pbc="T F"', 'pbc is "T F", should be three of T and F'),
                                         ('pbc="x y z"', 'pbc is "x y z", should be three of T and F'),
                                         ('Origin="0 0"', "cannot be read as extended XYZ: ")])
def test_a_box_of_xyz_that_is_not_of_three_axes_is_refused(tmp_path, refused, words, says):
    path = tmp_path / "a.xyz"
    path.write_text(f'1\nLattice="1 0 0 0 1 0 0 0 1" Properties=pos:R:3 {words}\n0 0 0\n')
    assert says in refused(path)


GRO = "made\n2\n    1SOL     OW    1   0.100   0.200   0.300  0.1000  0.2000  0.3000\n" \
      "    1SOL     OW    2   1.100   1.200   1.300  0.4000  0.5000  0.6000\n{box}\n"


def test_gro_stays_in_nm(tmp_path, converted, refused):
    pytest.importorskip("MDAnalysis", reason="python3-mdanalysis is not installed")
    path = tmp_path / "a.gro"
    path.write_text(GRO.format(box="   2.00000   3.00000   4.00000"))
    said, file = converted(path)
    assert file["PartType0/Coordinates"][:].tolist() == np.float32([[0.1, 0.2, 0.3], [1.1, 1.2, 1.3]]).tolist()
    assert file["PartType0/Velocities"][:].tolist() == np.float32([[0.1, 0.2, 0.3], [0.4, 0.5, 0.6]]).tolist()
    assert file["Header"].attrs["BoxSize"].tolist() == [2, 3, 4] and "nm and nm/ps" in said
    assert "Masses" not in file["PartType0"] and file["Header"].attrs["Periodic"].tolist() == [1, 1, 1]
    path.write_text(GRO.format(box="   2.0   3.0   4.0   0.0   0.0   1.0   0.0   0.0   0.0"))
    assert "triclinic box" in refused(path)
    path.write_text("made\n2\nnothing\n")
    assert "a.gro cannot be read as gro: " in refused(path)


def test_one_frame_of_a_gro_is_taken(tmp_path, converted, refused):
    pytest.importorskip("MDAnalysis", reason="python3-mdanalysis is not installed")
    path = tmp_path / "many.gro"
    first = GRO.format(box="   2.00000   3.00000   4.00000")
    last = "made t= 2\n1\n    1SOL     OW    1   0.500   0.200   0.300\n   5.00000   3.00000   4.00000\n\n"
    path.write_text(first + first.replace("0.100   0.200", "0.400   0.200") + last)
    said, file = converted(path)
    assert file["PartType0/Coordinates"][:].tolist() == np.float32([[0.5, 0.2, 0.3]]).tolist()
    assert "frame 2 of 0 to 2" in said and file["Header"].attrs["BoxSize"].tolist() == [5, 3, 4]
    for number, x in ((0, 0.1), (1, 0.4), (-2, 0.4)):
        assert converted("--frame", number, path)[1]["PartType0/Coordinates"][0, 0] == np.float32(x)
    assert "has 3 frames, so no frame 7" in refused("--frame", 7, path)
    path.write_text(first + first[:-40])
    assert "many.gro cannot be read as gro: frame 1 ends before its 2 particles and its box" in refused(path)
    path.write_text(first + "made\ntwo\n")
    assert 'the number of particles should stand where the file has "two"' in refused(path)
    path.write_text("\n\n")
    assert "many.gro is empty" in refused(path)


def test_gsd_is_centred_at_0_and_names_types(tmp_path, converted, refused):
    hoomd = pytest.importorskip("gsd.hoomd", reason="python3-gsd is not installed")
    path = tmp_path / "a.gsd"
    shot = hoomd.Snapshot()
    shot.particles.N, shot.particles.types, shot.particles.typeid = 2, ["fluid", "wall"], [0, 1]
    shot.configuration.box, shot.configuration.dimensions = [4, 6, 1, 0, 0, 0], 2
    shot.particles.velocity = [[1, 2, 0], [3, 4, 0]]
    with hoomd.open(str(path), "wb") as file:
        for k in range(2):
            shot.particles.position = [[k, 0, 0], [k, 1, 0]]
            file.append(shot)
    _, file = converted(path)
    data, header = file["PartType0"], file["Header"].attrs
    assert set(data) == {"Coordinates", "Velocities", "Kind"}  # the schema's mass of 1 was not written
    assert data["Coordinates"][:].tolist() == [[1, 0, 0], [1, 1, 0]] and data["Kind"][:].tolist() == [0, 1]
    assert header["BoxLow"].tolist() == [-2, -3, -0.5] and header["Periodic"].tolist() == [1, 1, 0]
    assert converted("--frame", 0, path)[1]["PartType0/Coordinates"][0].tolist() == [0, 0, 0]
    shot.configuration.box = [4, 6, 1, 0.5, 0, 0]
    with hoomd.open(str(path), "wb") as file:
        file.append(shot)
    assert "triclinic" in refused(path)
    path.write_bytes(path.read_bytes()[:300])
    assert "a.gsd cannot be read as GSD: " in refused(path)


def h5md(path):
    with h5py.File(path, "w") as file:
        file.create_group("h5md")
        for name, shift in (("fluid", 0.0), ("wall", 10.0)):
            group = file.create_group(f"particles/{name}")
            group["position/value"] = np.array([[[k + shift, 1.0], [k + shift, 2.0]] for k in range(3)])
            group["position/value"].attrs["unit"] = "m"
            group["position/time"] = np.array([0.0, 0.5, 1.0])
            group["mass"] = np.array([1.0, 2.0])
            group["box/edges"] = np.array([5.0, 6.0])
            group["box"].attrs["boundary"] = np.array([b"periodic", b"none"])
    return path


def test_groups_of_h5md_are_kinds(tmp_path, converted):
    path = h5md(tmp_path / "a.h5")
    said, file = converted(path)
    data, header = file["PartType0"], file["Header"].attrs
    assert data["Coordinates"][:].tolist() == [[2, 1, 0], [2, 2, 0], [12, 1, 0], [12, 2, 0]]
    assert data["Masses"][:].tolist() == [1, 2, 1, 2] and data["Kind"][:].tolist() == [0, 0, 1, 1]
    assert header["BoxSize"].tolist() == [5, 6, 0] and header["Periodic"].tolist() == [1, 0, 0] and header["Time"] == 1
    assert "frame 2 of 0 to 2" in said and header["Dimension"] == 2
    assert converted("--frame", 0, "--boundary-kind", "name=fluid", path)[1]["PartType0/Kind"][:].tolist() == [1, 1, 0, 0]


@pytest.mark.parametrize("name, kind", [
    ("wall_2", BOUNDARY), ("Tank Walls", BOUNDARY), ("boundaries", BOUNDARY), ("fluid_box", FLUID), ("WATER", FLUID),
    ("TankWall", BOUNDARY), ("WaterBody", FLUID), ("rigid_body", "body"), ("sandbox", None), ("firewall", None),
    ("seabed2", None), ("particles", None), ("", None)])
def test_kinds_by_name_are_by_whole_words(name, kind):
    assert named_kind(name) == kind


def test_groups_with_different_boxes_are_refused(tmp_path, refused):
    path = h5md(tmp_path / "a.h5")
    with h5py.File(path, "r+") as file:
        file["particles/wall/box/edges"][0] = 7
    assert "a.h5:fluid and a.h5:wall have different boxes" in refused(path)


def pysph(path):
    particles = {name: {"arrays": {"x": np.array([x, x + 1]), "y": np.array([1.0, 2.0]), "u": np.ones(2), "v": np.zeros(2),
                                   "w": np.zeros(2), "m": np.full(2, 0.5), "h": np.full(2, 0.1), "A": np.zeros(6)}}
                 for name, x in (("fluid", 0.0), ("tank", 10.0))}
    np.savez(path, version=2, particles=particles, solver_data={"t": 0.125})
    return path


def test_pickles_are_read_if_they_are_trusted(tmp_path, converted, refused):
    path = pysph(tmp_path / "a.npz")
    assert "holds pickles, which may run any program" in refused(path)
    _, file = converted("--trust-pickles", path)
    data = file["PartType0"]
    assert data["Kind"][:].tolist() == [0, 0, 1, 1] and file["Header"].attrs["Time"] == 0.125
    assert data["Coordinates"][:].tolist() == [[0, 1, 0], [1, 2, 0], [10, 1, 0], [11, 2, 0]]
    assert data["Velocities"][:, 0].tolist() == [1] * 4 and data["SmoothingLength"][:].tolist() == [0.1] * 4
    np.savez(path, x=np.zeros(3))
    assert "is no .npz of PySPH" in refused("--trust-pickles", path)
