"""A format of one's own is one file and one line of formats.def."""

import os
import pathlib
import shlex
import subprocess

import pytest

SOURCE = pathlib.Path(os.environ.get("PAIRSUM_SOURCE", pathlib.Path(__file__).parents[2]))
BUILD = os.environ.get("PAIRSUM_BUILD")

POINTS = """
#include <fstream>
#include <pairsum/files/formats.hpp>

namespace pairsum::files::formats_of {
file_format points();
file_format points() {
  return {"points", "three numbers a line", [](std::span<const std::byte>, std::string_view path) { return ends_in(path, ".POINTS"); },
          [](const std::string& path, const hints&) {
            file_content c;
            std::ifstream file(path);
            for (double x, y, z; file >> x >> y >> z;) {
              c.x[0].push_back(x);
              c.x[1].push_back(y);
              c.x[2].push_back(z);
            }
            return c;
          }};
}
}  // namespace pairsum::files::formats_of
"""


@pytest.mark.skipif(BUILD is None, reason="PAIRSUM_BUILD names no build")
def test_one_file_and_one_line_add_a_format(tmp_path):
    own = tmp_path / "include/pairsum/files"
    own.mkdir(parents=True)
    lines = (SOURCE / "kernels/files/formats.def").read_text()
    (own / "formats.def").write_text(lines + "FORMAT(points)\n")
    (tmp_path / "points.cpp").write_text(POINTS)
    build = pathlib.Path(BUILD)
    libraries = [build / "kernels/libpairsum_files.a", build / "kernels/libpairsum.a"]
    pkg = subprocess.run(["pkg-config", "--libs", "hdf5"], text=True, capture_output=True, check=True)
    flags = shlex.split(os.environ.get("PAIRSUM_SANITIZERS", ""))
    program = tmp_path / "read_files"
    done = subprocess.run(
        [os.environ.get("PAIRSUM_CXX", "g++"), "-std=c++20", *flags, f"-I{tmp_path}/include", f"-I{build}/kernels/include",
         f"-I{build}/kernels/generated", "-isystem", "/usr/include/eigen3", SOURCE / "kernels/files/formats.cpp", tmp_path / "points.cpp",
         SOURCE / "tests/files/read_files.cpp", *libraries, *shlex.split(pkg.stdout), "-ltbb", "-fopenmp", "-o", program],
        text=True, capture_output=True)
    assert done.returncode == 0, done.stderr
    (tmp_path / "a.points").write_text("0 0 0\n1 0 0\n0 1 0\n0 0 1\n")
    done = subprocess.run([program, "--rho0=1000", "--H=2", tmp_path / "a.points"], text=True, capture_output=True)
    assert done.returncode == 0 and '"particles":4' in done.stdout, done.stderr
    done = subprocess.run([program, "--H=2", tmp_path / "points.cpp"], text=True, capture_output=True)
    assert done.returncode == 2 and done.stderr.strip().endswith("points"), "a file of no format: all are named"
