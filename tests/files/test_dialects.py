"""What the dialects of HDF5 mean: every trait of files that programs write."""

import h5py
import numpy as np
import pytest
from conftest import Particles, columns, dataset, gadget, read


def same(path, tmp_path, p, order=slice(None), **options):
    """Reads a file; its particles must be p's, in that order, to the last bit."""
    result = read(path, out=tmp_path / "out.hdf", **options)
    assert result.code == 0, result.error
    got = columns(tmp_path / "out.hdf")
    for name, expected in [("Coordinates", p.x), ("Velocities", p.v), ("Density", p.rho), ("Masses", p.m)]:
        assert np.array_equal(got[name], np.asarray(expected, "f8")[order]), name
    return result


@pytest.mark.parametrize("packed", [False, True])
@pytest.mark.parametrize("plural", [False, True])
@pytest.mark.parametrize("types", [6, 7])
def test_gadget_and_swift(tmp_path, particles, plural, packed, types):
    path = gadget(tmp_path / "a.hdf5", particles, plural=plural, packed=packed, types=types)
    result = same(path, tmp_path, particles, **({"support": 1.5} if plural else {}))
    assert result.set["H"] == particles.h.max() * (1.5 if plural else 1)
    assert result.set["periodic"] and result.set["low"] == [0, 0, 0] and result.set["high"] == [1, 1, 1]
    assert result.set["time"] == 0.25 and result.set["fluid"] == len(particles)
    assert ("swift" if plural else "gadget") in result.fact["file"]["from"]


def test_floats_become_the_same_doubles(tmp_path, particles):
    for name in ("x", "v", "rho", "m", "h"):
        setattr(particles, name, getattr(particles, name).astype("f4"))
    same(gadget(tmp_path / "a.hdf5", particles, kind="f4"), tmp_path, particles)


def test_many_chunks_are_read_in_their_order(tmp_path):
    p = Particles(150_000)
    same(gadget(tmp_path / "a.hdf5", p, packed=True), tmp_path, p)


def test_behind_a_user_block(tmp_path, particles):
    with h5py.File(gadget(tmp_path / "a.hdf5", particles)) as plain, h5py.File(tmp_path / "b.hdf5", "w", userblock_size=2048) as file:
        for name in plain:
            plain.copy(name, file)
    same(tmp_path / "b.hdf5", tmp_path, particles)


@pytest.mark.parametrize("where", ["HydroScheme", "Parameters"])
def test_the_kernel_gamma_is_the_support(tmp_path, particles, where):
    path = gadget(tmp_path / "a.hdf5", particles, plural=True)
    assert "--support" in read(path).error
    with h5py.File(path, "a") as file:
        file.create_group(where).attrs["Kernel gamma"] = np.array([1.25], "f4")
    result = read(path)
    assert result.set["H"] == 1.25 * particles.h.max()
    assert result.fact["support"]["how"] == "read"
    assert read(path, support=2).set["H"] == 2 * particles.h.max()


@pytest.mark.parametrize("function, gamma", [("Cubic spline (M4)", 1.825742), ("Quintic spline (M6)", 2.195775),
                                             ("Wendland C2", 1.936492)])
def test_the_kernels_name_says_gamma(tmp_path, particles, function, gamma):
    path = gadget(tmp_path / "a.hdf5", particles)
    with h5py.File(path, "a") as file:
        file.create_group("HydroScheme").attrs["Kernel function"] = np.bytes_(function)
    result = read(path)
    assert result.set["H"] == gamma * particles.h.max()
    assert result.fact["support"]["how"] == "derived"


def test_box_of_three_edges_and_axes_that_are_not_periodic(tmp_path, particles):
    path = gadget(tmp_path / "a.hdf5", particles, header={"BoxSize": [1.0, 2.0, 3.0]})
    assert read(path).set["high"] == [1, 2, 3] and read(path).fact["periodic"]["how"] == "assumed"
    with h5py.File(path, "a") as file:
        file.create_group("RuntimePars").attrs["PeriodicBoundariesOn"] = np.array([0], "i4")
    assert not read(path, support=1).set["periodic"] and read(path, support=1).fact["periodic"]["how"] == "read"
    assert read(path, support=1, periodic="all").set["periodic"]


def test_coordinates_outside_of_a_periodic_box_are_wrapped(tmp_path, particles):
    particles.x[3] = [-0.25, 0.5, 1.5]
    path = gadget(tmp_path / "a.hdf5", particles)
    result = read(path, out=tmp_path / "out.hdf")
    assert result.set["wrapped"] == 1
    assert columns(tmp_path / "out.hdf")["Coordinates"][3].tolist() == [0.75, 0.5, 0.5]
    assert result.fact["wrapped"]["value"] == "1"
    widened = read(path, periodic="none")
    assert widened.set["low"] == [-0.25, 0, 0] and widened.set["high"] == [1, 1, 1.5]
    assert "widened along x, z" in widened.fact["box"]["from"]


def test_masses_by_table(tmp_path, particles):
    particles.m = np.full(len(particles), 0.125)
    path = gadget(tmp_path / "a.hdf5", particles, leave=("Masses",), header={"MassTable": [0.125, 0, 0, 0, 0, 0]})
    assert same(path, tmp_path, particles).fact["mass"]["how"] == "read"


def test_without_masses_velocities_and_density(tmp_path, particles):
    path = gadget(tmp_path / "a.hdf5", particles, leave=("Masses", "Velocities", "Density"))
    assert "--rho0" in read(path).error
    result = read(path, rho0=2, out=tmp_path / "out.hdf")
    got = columns(tmp_path / "out.hdf")
    assert (got["Velocities"] == 0).all() and result.fact["velocity"]["how"] == "assumed"
    assert (got["Density"] == 2).all() and result.fact["density"]["how"] == "assumed"
    distance = np.linalg.norm(particles.x[:, None] - particles.x, axis=2) + 9 * np.eye(len(particles))
    assert result.set["dx"] == pytest.approx(np.median(distance.min(axis=1)), rel=0.02)
    assert (got["Masses"] == 2 * result.set["dx"] ** 3).all() and result.fact["mass"]["how"] == "derived"


def test_mass_alone_says_the_density(tmp_path, particles):
    path = gadget(tmp_path / "a.hdf5", particles, leave=("Density",))
    result = read(path)
    assert result.set["rho0"] == pytest.approx(np.median(particles.m) / result.set["dx"] ** 3, rel=0.02)
    assert result.fact["rho0"]["how"] == "derived"


def test_part_type_1_alone_is_fluid(tmp_path, particles):
    same(gadget(tmp_path / "a.hdf5", particles, number=1), tmp_path, particles)


def test_other_types_are_left_out_or_boundary(tmp_path, particles):
    path, wall = gadget(tmp_path / "a.hdf5", particles), Particles(50, seed=2)
    with h5py.File(path, "a") as file:
        group = file.create_group("PartType3")
        for name, values in [("Coordinates", wall.x), ("Velocities", wall.v), ("Density", wall.rho), ("SmoothingLength", wall.h)]:
            dataset(group, name, values)
        file["Header"].attrs["NumPart_ThisFile"] = [len(particles), 0, 0, 50, 0, 0]
        file["Header"].attrs["MassTable"] = [0, 0, 0, 0.5, 0, 0]
    result = same(path, tmp_path, particles)
    assert result.fact["left out"]["value"] == "50 of PartType3"
    result = read(path, boundary_kind="PartType=3", out=tmp_path / "out.hdf")
    assert (result.set["fluid"], result.set["particles"]) == (200, 250)
    got = columns(tmp_path / "out.hdf")
    assert np.array_equal(got["Coordinates"], np.vstack([particles.x, wall.x]))
    assert np.array_equal(got["Masses"], np.append(particles.m, np.full(50, 0.5)))
    assert np.array_equal(got["Kind"], np.repeat([0, 1], [200, 50]))


def test_a_snapshot_of_several_files(tmp_path):
    p = Particles(300)
    for k in range(3):
        part = Particles(300)
        for name in ("x", "v", "rho", "m", "h"):
            setattr(part, name, getattr(p, name)[100 * k:100 * k + 100])
        gadget(tmp_path / f"snap.{k}.hdf5", part, header={"NumFilesPerSnapshot": 3})
    same(tmp_path / "snap.1.hdf5", tmp_path, p)
    parts = [tmp_path / f"snap.{k}.hdf5" for k in range(3)]
    all_parts = read(*parts)
    assert all_parts.set["hash"] == read(parts[1]).set["hash"], "a file that several parts name is read once"
    assert "should both be fluid or both boundary" in read(f"{parts[0]}:fluid", f"{parts[1]}:boundary").error
    with h5py.File(parts[2], "a") as file:
        file["Header"].attrs["NumPart_ThisFile"] = [99, 0, 0, 0, 0, 0]
    assert "snap.2.hdf5: PartType0/Coordinates has 100 rows, but the header counts 99" in read(parts[0]).error
    (tmp_path / "snap.2.hdf5").rename(tmp_path / "away.hdf5")
    assert "snap.2.hdf5 cannot be read" in read(tmp_path / "snap.0.hdf5").error
    assert "its name has no number" in read(tmp_path / "away.hdf5").error


def test_a_file_is_given_once(tmp_path, particles):
    path = gadget(tmp_path / "a.hdf5", particles)
    (tmp_path / "link.hdf5").symlink_to(path)
    for other in (path, tmp_path / "." / "x" / ".." / "a.hdf5", tmp_path / "link.hdf5", f"{path}:fluid"):
        (tmp_path / "x").mkdir(exist_ok=True)
        assert "is given twice" in read(path, other).error, other


def pysph(path, groups, constant_z=None, leave=()):
    """`leave` names columns that groups lack: ("wall", "rho")."""
    with h5py.File(path, "w") as file:
        file.create_group("solver_data").attrs["t"] = 1.5
        for name, p in groups.items():
            arrays = file.create_group(f"particles/{name}/arrays")
            z = p.x[:, 2] if constant_z is None else np.full(len(p), constant_z)
            w = p.v[:, 2] if constant_z is None else np.zeros(len(p))
            data = dict(x=p.x[:, 0], y=p.x[:, 1], z=z, u=p.v[:, 0], v=p.v[:, 1], w=w, rho=p.rho, m=p.m, h=p.h)
            for column, values in data.items():
                if (name, column) in leave:
                    continue
                arrays.create_dataset(column, data=values, compression="gzip")
    return path


def test_pysph_kinds_by_name(tmp_path):
    fluid, wall, block = Particles(100), Particles(60, 2), Particles(40, 3)
    path = pysph(tmp_path / "a.hdf5", {"boundary": wall, "fluid": fluid, "obstacle": block})
    result = read(path, out=tmp_path / "out.hdf")
    assert (result.set["fluid"], result.set["particles"], result.set["time"]) == (100, 200, 1.5)
    assert np.array_equal(columns(tmp_path / "out.hdf")["Coordinates"], np.vstack([fluid.x, wall.x, block.x]))
    assert result.set["H"] == 2 * fluid.h.max() and not result.set["periodic"]
    assert read(path, boundary_kind="none").set["fluid"] == 200
    assert read(path, boundary_kind="name=obstacle").set["fluid"] == 160


def test_kinds_by_name_are_assumed(tmp_path):
    def kinds(*names, **options):
        return read(pysph(tmp_path / "a.hdf5", {name: Particles(20, k) for k, name in enumerate(names)}), **options)

    result = kinds("fluid_box", "wall2", "Boundaries", "sandbox")
    assert result.set["fluid"] == 40
    assert result.fact["boundary"]["how"] == "assumed" and "by the names" in result.fact["boundary"]["from"]
    assert "the group rigid_body is a body that moves" in kinds("fluid", "rigid_body").error
    result = kinds("fluid", "rigid_body", boundary_kind="name=rigid_body")
    assert result.set["fluid"] == 20 and result.fact["boundary"]["how"] == "given"
    path = h5part(tmp_path / "b.h5", {0: Particles(20)})
    assert read(path).fact["fluid"]["how"] == "assumed", "H5Part says nothing of kinds"
    assert read(gadget(tmp_path / "c.hdf5", Particles(20))).fact["fluid"]["how"] == "read"


def test_what_one_group_lacks_is_filled_there_alone(tmp_path):
    fluid, wall = Particles(100), Particles(60, 2)
    path = pysph(tmp_path / "a.hdf5", {"fluid": fluid, "wall": wall}, leave=[("wall", c) for c in ("u", "v", "w", "rho", "m")])
    result = read(path, out=tmp_path / "out.hdf", rho0=1.5)
    got = columns(tmp_path / "out.hdf")
    assert np.array_equal(got["Velocities"], np.vstack([fluid.v, np.zeros((60, 3))]))
    assert np.array_equal(got["Density"], np.append(fluid.rho, np.full(60, 1.5)))
    assert np.array_equal(got["Masses"][:100], fluid.m) and (got["Masses"][100:] > 0).all()
    for what in ("velocity", "density"):
        assert result.fact[what]["how"] == "assumed" and result.fact[what]["from"].startswith(f"{path}, wall has none")
    pysph(path, {"fluid": fluid, "wall": wall}, leave=[("fluid", "rho"), ("fluid", "m")])
    assert "fluid" in read(path, rho0=1.5).fact["density"]["from"]


def test_rho0_is_that_of_the_fluid_that_has_a_density(tmp_path):
    (tmp_path / "fluid.csv").write_text("x,y,rho\n0,0,998\n1,0,1000\n0,1,1002\n1,1,1004\n")
    (tmp_path / "wall.csv").write_text("x,y\n0,-1\n1,-1\n")
    result = read(tmp_path / "fluid.csv", f"{tmp_path / 'wall.csv'}:boundary", H=2)
    assert result.code == 0 and result.set["rho0"] == 1001, result.error
    (tmp_path / "fluid.csv").write_text("x,y,m\n0,0,998\n1,0,1001\n0,1,1001\n1,1,1004\n")
    result = read(tmp_path / "fluid.csv", f"{tmp_path / 'wall.csv'}:boundary", H=2)
    assert result.code == 0 and result.set["rho0"] == 1001, result.error


def test_parts_of_a_snapshot_have_the_same_columns(tmp_path):
    for k in range(2):
        gadget(tmp_path / f"a.{k}.hdf5", Particles(50, k), header={"NumFilesPerSnapshot": 2}, leave=("Density",) if k else ())
    assert "PartType0 has 0 columns of density, but 1 in" in read(tmp_path / "a.0.hdf5").error


def test_2d_in_three_columns_is_found(tmp_path):
    path = pysph(tmp_path / "a.hdf5", {"fluid": Particles(100)}, constant_z=0.5)
    result = read(path)
    assert result.set["dim"] == 2 and "z is constant" in result.fact["dim"]["from"]
    assert read(path, dim=3, H=0.5).set["dim"] == 3


def test_x_and_z_become_x_and_y(tmp_path, particles):
    particles.x[:, 1] = 0.1
    path = gadget(tmp_path / "a.hdf5", particles, header={"BoxSize": [1.0, 5.0, 2.0]})
    result = read(path, out=tmp_path / "out.hdf")
    got = columns(tmp_path / "out.hdf")
    assert result.set["dim"] == 2 and result.set["high"] == [1, 2]
    assert np.array_equal(got["Coordinates"][:, :2], particles.x[:, [0, 2]]) and (got["Coordinates"][:, 2] == 0).all()
    assert np.array_equal(got["Velocities"][:, :2], particles.v[:, [0, 2]])
    assert "y is constant; the columns x, z are x and y" in result.fact["dim"]["from"]


@pytest.mark.parametrize("kind", ["csv", "h5"])
def test_without_y_words_mean_the_files_axes(tmp_path, kind):
    p = Particles(50)
    path = tmp_path / f"xz.{kind}"
    if kind == "csv":
        np.savetxt(path, np.column_stack([p.x[:, [0, 2]], p.v[:, [0, 2]], p.rho]), "%.17g", ",", header="x,z,vx,vz,rho", comments="")
    else:
        with h5py.File(path, "w") as file:
            group = file.create_group("Step#0")
            for name, values in [("x", p.x[:, 0]), ("z", p.x[:, 2]), ("vx", p.v[:, 0]), ("vz", p.v[:, 2]), ("rho", p.rho)]:
                group[name] = values
    result = read(path, H=0.3, box="0,0,0,1,5,2", periodic="z", out=tmp_path / "out.hdf")
    assert result.code == 0, result.error
    assert result.set["dim"] == 2 and result.set["high"] == [1, 2] and result.fact["periodic"]["value"] == "z"
    got = columns(tmp_path / "out.hdf")
    assert np.array_equal(got["Coordinates"][:, :2], p.x[:, [0, 2]]) and np.array_equal(got["Velocities"][:, :2], p.v[:, [0, 2]])
    assert "the columns x, z are x and y" in result.fact["dim"]["from"]
    assert "along which particles lie" in read(path, H=0.3, box="1,1", periodic="y").error


def h5part(path, steps, sph_exa=False):
    with h5py.File(path, "w") as file:
        for number, p in steps.items():
            group = file.create_group(f"Step#{number}")
            group.attrs["time"] = number / 4
            if sph_exa:
                group.attrs["box"] = [-1.0, 2.0, 0.0, 1.0, 0.0, 1.5]
                group.attrs["boundaryType"] = np.array([1, 1, 1], "i1")
            for k, axis in enumerate("xyz"):
                group[axis], group[f"v{axis}"] = p.x[:, k], p.v[:, k]
            group["h"], group["m"], group["rho"] = p.h, p.m, p.rho
    return path


def test_h5part_takes_the_last_step_or_the_one_told(tmp_path):
    steps = {2: Particles(50), 10: Particles(60, 2), 9: Particles(70, 3)}
    path = h5part(tmp_path / "a.h5", steps)
    assert same(path, tmp_path, steps[10]).set["time"] == 2.5
    result = same(path, tmp_path, steps[9], step=9)
    assert not result.set["periodic"] and result.set["H"] == 2 * steps[9].h.max()
    assert "no step 3" in read(path, step=3).error


def test_sph_exa_has_a_box(tmp_path, particles):
    result = same(h5part(tmp_path / "a.h5", {0: particles}, sph_exa=True), tmp_path, particles)
    assert result.set["low"] == [-1, 0, 0] and result.set["high"] == [2, 1, 1.5] and result.set["periodic"]
    assert "sph_exa" in result.fact["file"]["from"]


def test_vtkhdf(tmp_path, particles):
    path = tmp_path / "a.hdf"
    with h5py.File(path, "w") as file:
        file.create_group("VTKHDF").attrs["Type"] = np.bytes_("UnstructuredGrid")
        file["VTKHDF/Points"] = particles.x
        for name, values in [("Velocity", particles.v), ("rho", particles.rho), ("Mass", particles.m)]:
            file[f"VTKHDF/PointData/{name}"] = values
    assert "--H" in read(path).error
    same(path, tmp_path, particles, H=0.3)


def test_columns_by_option(tmp_path, particles):
    path = gadget(tmp_path / "a.hdf5", particles)
    with h5py.File(path, "a") as file:
        file["PartType0/Mine"] = np.column_stack([particles.rho, 3 * particles.rho])
    result = read(path, column="rho=Mine:1", out=tmp_path / "out.hdf")
    assert np.array_equal(columns(tmp_path / "out.hdf")["Density"], 3 * particles.rho), result.error
    assert "has no None for rho" in read(path, column="rho=None").error
    assert "no Mine:2" in read(path, column="rho=Mine:2").error


def test_boundary_by_a_column(tmp_path, particles):
    path = gadget(tmp_path / "a.hdf5", particles)
    with h5py.File(path, "a") as file:
        file["PartType0/Type"] = np.arange(200) % 4
    result = read(path, boundary_kind="Type=0,1", out=tmp_path / "out.hdf")
    assert result.set["fluid"] == 100
    order = np.concatenate([np.flatnonzero(np.arange(200) % 4 > 1), np.flatnonzero(np.arange(200) % 4 < 2)])
    same(path, tmp_path, particles, order, boundary_kind="Type=0,1")
    assert "no column Sort" in read(path, boundary_kind="Sort=1").error


def test_a_boundary_kind_that_nothing_has_is_refused(tmp_path, particles):
    path = gadget(tmp_path / "a.hdf5", particles)
    with h5py.File(path, "a") as file:
        file["PartType0/Type"] = 3 * (np.arange(200) % 2)
    assert "has the groups PartType0" in read(path, boundary_kind="PartType=7").error
    assert "has the values 0, 3" in read(path, boundary_kind="Type=1,2").error
    result = read(path, boundary_kind="Type=0,1")
    assert result.set["fluid"] == 100 and result.fact["kinds not there"]["value"] == "1"
    walls = pysph(tmp_path / "b.hdf5", {"fluid": Particles(50), "boundary": Particles(50, 2)})
    assert "has the groups boundary, fluid" in read(walls, boundary_kind="name=wall").error
    (tmp_path / "c.csv").write_text("x,y,rho,Mk\n0,0,1,1\n1,1,1,10\n0,1,1,10\n")
    assert "has the values 1, 10" in read(tmp_path / "c.csv", boundary_kind="Mk=11", H=1).error


def test_boundary_kind_none_takes_all_groups_as_fluid(tmp_path, particles):
    path = gadget(tmp_path / "a.hdf5", particles)
    with h5py.File(path, "a") as file:
        file.copy("PartType0", "PartType3")
        file["Header"].attrs["NumPart_ThisFile"] = [200, 0, 0, 200, 0, 0]
    result = read(path, boundary_kind="none")
    assert result.set["fluid"] == 400 and "left out" not in result.fact


def test_h_is_that_of_the_fluid(tmp_path):
    fluid, wall = Particles(100), Particles(50, 2)
    wall.h[:] = np.append(np.zeros(49), 9)
    path = pysph(tmp_path / "a.hdf5", {"fluid": fluid, "wall": wall})
    assert read(path).set["H"] == 2 * fluid.h.max()
    fluid.h[3] = 0
    assert "particle 4 has h = 0" in read(pysph(tmp_path / "a.hdf5", {"fluid": fluid, "wall": wall})).error


def test_h_of_the_fluid_counts_where_walls_sort_first(tmp_path):
    fluid, boundary = Particles(100), Particles(50, 2)
    path = pysph(tmp_path / "a.hdf5", {"boundary": boundary, "fluid": fluid}, leave=[("boundary", "h")])
    result = read(path)
    assert result.code == 0, result.error
    assert result.set["H"] == 2 * fluid.h.max()


def test_walls_may_have_zeros(tmp_path, particles):
    """In columns that fluid and walls share."""
    kind = np.repeat([0, 1], 100)
    for name in ("rho", "m", "h"):
        getattr(particles, name)[kind == 1] = 0
    path = gadget(tmp_path / "a.hdf5", particles)
    with h5py.File(path, "a") as file:
        file["PartType0/Kind"] = kind
    result = read(path, out=tmp_path / "out.hdf")
    assert result.code == 0, result.error
    got, wall = columns(tmp_path / "out.hdf"), slice(100, None)
    assert (got["Density"][wall] == result.set["rho0"]).all() and (got["Masses"][wall] > 0).all()
    assert np.array_equal(got["Masses"][:100], particles.m[:100]) and "100 of the walls" in result.fact["density"]["from"]
    assert result.set["rho0"] == pytest.approx(particles.rho[:100].mean()) and result.set["H"] == particles.h.max()
    with h5py.File(path, "a") as file:
        file["PartType0/Masses"][150] = -1
    assert "particle 151 has mass = -1" in read(path).error


def test_each_files_h_has_its_own_support(tmp_path):
    a, b = Particles(100), Particles(80, 2)
    a.h[:], b.h[:] = 0.3, 0.2
    first = gadget(tmp_path / "a.hdf5", a)  # whose h is H
    second = gadget(tmp_path / "b.hdf5", b, plural=True)
    with h5py.File(second, "a") as file:
        file.create_group("HydroScheme").attrs["Kernel gamma"] = 1.75
    result = read(first, second)
    assert result.set["H"] == pytest.approx(0.35) and "each file" in result.fact["H"]["from"], result.error
    assert read(second, first).set["H"] == result.set["H"]
    (tmp_path / "c.csv").write_text("x,y,z,rho,h\n0.5,0.5,0.5,1,0.2\n0.5,0.5,0.25,1,0.2\n")
    assert "c.csv: the smoothing kernel is unknown" in read(first, tmp_path / "c.csv").error


def test_the_header_says_what_h_is(tmp_path, particles):
    def result(word, **options):
        path = gadget(tmp_path / "a.hdf5", particles, header={"SmoothingLengthIs": np.bytes_(word)})
        return read(path, **options)

    largest = particles.h.max()
    assert result("support").set["H"] == largest and result("support").fact["support"]["how"] == "read"
    assert result("h").set["H"] == 2 * largest and result("h").fact["support"]["how"] == "assumed"
    assert result("h", support=3).set["H"] == 3 * largest
    assert 'SmoothingLengthIs is "r", should be' in result("r").error


def test_gravity_is_none_unless_a_file_says_it(tmp_path, particles):
    path = gadget(tmp_path / "a.hdf5", particles)
    assert read(path).set["gravity"] == 0 and read(path).fact["gravity"]["how"] == "assumed"
    gadget(path, particles, header={"Gravity": 1.62})
    assert read(path).set["gravity"] == 1.62 and read(path).fact["gravity"]["how"] == "read"


def test_varying_h(tmp_path, particles):
    h = np.linspace(0.2, 0.29, len(particles))
    path = gadget(tmp_path / "a.hdf5", particles, h=h)
    assert read(path).set["H"] == 0.29
    assert "a factor of 1.45" in read(path).fact["h"]["value"]
    assert read(path, h_quantile=0.5).set["H"] == h[99]
    wide = gadget(tmp_path / "b.hdf5", particles, h=2 * h - 0.2)
    assert "--H" in read(wide).error and "a factor of 1.9" in read(wide).error
    assert read(wide, H=0.3).set["H"] == 0.3


def test_several_files_and_their_kinds(tmp_path):
    fluid, wall = Particles(100), Particles(80, 2)
    a, b = gadget(tmp_path / "a.hdf5", fluid), gadget(tmp_path / "b.hdf5", wall, leave=("Density",))
    result = read(a, f"{b}:boundary", out=tmp_path / "out.hdf")
    assert (result.set["fluid"], result.set["particles"]) == (100, 180)
    got = columns(tmp_path / "out.hdf")
    assert np.array_equal(got["Coordinates"], np.vstack([fluid.x, wall.x]))
    assert np.array_equal(got["Density"], np.append(fluid.rho, np.full(80, result.set["rho0"])))
    assert result.set["hash"] == read(f"{b}:boundary", f"{a}:fluid").set["hash"]
    assert "no particle is fluid" in read(f"{a}:boundary").error


def test_files_of_a_set_have_one_box(tmp_path):
    fluid, wall = Particles(100), Particles(80, 2)
    a = gadget(tmp_path / "a.hdf5", fluid)
    b = gadget(tmp_path / "b.hdf5", wall, header={"BoxSize": 2.0})
    error = read(a, f"{b}:boundary").error
    assert error.startswith(f"{b} has the box [0, 2] x") and f"{a} has [0, 1] x" in error and "--box" in error
    assert read(a, f"{b}:boundary", box="3,3,3").set["high"] == [3, 3, 3]
    b = gadget(tmp_path / "b.hdf5", wall, header={"Periodic": [1, 0, 0]})
    error = read(a, f"{b}:boundary").error
    assert "is periodic along x, but" in error and "--periodic" in error
    assert read(a, f"{b}:boundary", periodic="none").code == 0
    assert read(a, f"{gadget(b, wall, header={'BoxSize': 0.0})}:boundary").set["high"] == [1, 1, 1]


def test_box_by_option(tmp_path, particles):
    path = gadget(tmp_path / "a.hdf5", particles, header={"BoxSize": 0.0})
    result = read(path)
    H = particles.h.max()
    assert result.set["low"] == pytest.approx((particles.x.min(0) - H).tolist()) and not result.set["periodic"]
    assert "--box" in read(path, periodic="all").error
    assert read(path, periodic="all", box="1,2,3").set["high"] == [1, 2, 3]
    assert read(path, box="-1,-1,-1,1,2,3").set["low"] == [-1, -1, -1]
    assert "outside of --box" in read(path, box="1,1,0.5").error
    assert "--box has 4 numbers" in read(path, box="1,1,1,1").error
    assert "--periodic" in read(path, periodic="w", box="1,1,1").error
