"""clang-format has nothing to change."""

import os
import pathlib
import shutil
import subprocess

import pytest

SOURCE = pathlib.Path(os.environ["PAIRSUM_SOURCE"])
TOOL = shutil.which("clang-format-14") or shutil.which("clang-format")


def complaints(*paths):
    done = subprocess.run([TOOL, "--dry-run", "-Werror", *map(str, paths)], cwd=SOURCE, text=True, capture_output=True)
    return done.stderr


@pytest.mark.skipif(TOOL is None, reason="clang-format-14 is not installed")
def test_sources_are_formatted():
    paths = [p for top in ["kernels", "harness", "tests", "examples"] for p in sorted((SOURCE / top).rglob("*.?pp"))]
    assert complaints(*paths) == ""


@pytest.mark.skipif(TOOL is None, reason="clang-format-14 is not installed")
def test_the_check_rejects(tmp_path):
    bad = tmp_path / "bad.cpp"
    bad.write_text("int   main( ){return 0 ;}\n")
    (tmp_path / ".clang-format").write_text((SOURCE / ".clang-format").read_text())
    assert complaints(bad) != ""
