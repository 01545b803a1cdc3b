"""clang-tidy has nothing to say, with the checks of .clang-tidy. PAIRSUM_TIDY=all looks at every source: ten minutes."""

import os
import pathlib
import shutil
import subprocess

import pytest

SOURCE = pathlib.Path(os.environ["PAIRSUM_SOURCE"])
TOOL = shutil.which("clang-tidy-14")
QUICK = ["kernels/core/team.cpp", "kernels/sum/check.cpp", "harness/rows/whole_file.cpp"]
BUILD = pathlib.Path(os.environ.get("PAIRSUM_BUILD", SOURCE / "build/test"))
FLAGS = [f"-I{BUILD}/harness/environment/include", f"-I{BUILD}/kernels/include", f"-I{BUILD}/kernels/generated", "-std=c++20", f"-I{SOURCE}", "-isystem", "/usr/include/eigen3", "-isystem", "/usr/include/hdf5/serial", "-fopenmp", "-DFMT_SHARED",
         '-DPAIRSUM_FLAGS=""', '-DPAIRSUM_VERSION=""']


def complaints(path):
    done = subprocess.run([TOOL, "--quiet", f"--config-file={SOURCE}/.clang-tidy", str(path), "--", *FLAGS],
                          cwd=SOURCE, text=True, capture_output=True)
    found = [line for line in done.stdout.splitlines() if "error:" in line]
    return found if found or done.returncode == 0 else [done.stderr]


def sources():
    if os.environ.get("PAIRSUM_TIDY") != "all":
        return QUICK
    return sorted(str(p.relative_to(SOURCE)) for top in ["kernels", "harness"] for p in (SOURCE / top).rglob("*.cpp"))


@pytest.mark.skipif(TOOL is None, reason="clang-tidy-14 is not installed")
@pytest.mark.parametrize("path", sources())
def test_sources_are_tidy(path):
    assert complaints(path) == []


@pytest.mark.skipif(TOOL is None, reason="clang-tidy-14 is not installed")
def test_the_check_rejects(tmp_path):
    bad = tmp_path / "bad.cpp"
    bad.write_text("#include <string>\nint f(std::string s) { if (s.size() == 0) return 1; return s.size() / 2.0 > 1; }\n")
    assert any("readability-container-size-empty" in line for line in complaints(bad))
