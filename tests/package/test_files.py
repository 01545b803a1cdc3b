"""What is installed, and what its CMake files say."""

import os
import re

import pytest

from conftest import BUILD, SOURCE, call, must


def traces(folder):
    """Files that name the source or the build folder."""
    names = [str(path).encode() + end for path in (SOURCE, BUILD) for end in (b"/", b'"', b";", b"\0", b"\n", b" ")]
    return [p for p in sorted(folder.rglob("*")) if p.is_file() and any(name in p.read_bytes() for name in names)]


def test_no_file_names_the_trees(prefix, tmp_path):
    assert traces(prefix) == []
    (tmp_path / "a.cmake").write_text(f"include({SOURCE}/kernels/registry.def)\n")
    assert traces(tmp_path) == [tmp_path / "a.cmake"]


def test_every_header_is_there(prefix):
    kernels = SOURCE / "kernels"
    wanted = {p.relative_to(kernels) for p in kernels.rglob("*.hpp")}
    folder = prefix / "include/pairsum"
    installed = {p.relative_to(folder) for p in folder.rglob("*") if p.is_file()}
    assert {str(p) for p in installed - wanted} == {"build_word.hpp", "core/places.hpp", "smoothing/all_smoothings.hpp"}  # generated
    assert wanted <= installed
    assert [p.name for p in (prefix / "include").iterdir()] == ["pairsum"]


@pytest.mark.parametrize("program", ["pairsum", "pairsum_bench"])
def test_programs_are_there_if_they_are_built(prefix, program):
    assert (prefix / "bin" / program).exists() == (BUILD / "bin" / program).exists()


def test_the_installed_program_reports_with_the_installed_package(prefix, tmp_path):
    talk = sorted((SOURCE / "results/talk").glob("vm-*.jsonl"))[0]
    must(prefix / "bin/pairsum", "report", "--tables", talk, "--out", tmp_path / "report")
    assert (tmp_path / "report/tables.txt").read_text().startswith("On vm ")
    broken = tmp_path / "elsewhere/bin/pairsum"
    broken.parent.mkdir(parents=True)
    broken.write_bytes((prefix / "bin/pairsum").read_bytes())
    broken.chmod(0o755)
    done = call(broken, "report", talk)
    assert done.returncode == 2 and "has no package pairsum_results" in done.stdout


PROJECT = """cmake_minimum_required(VERSION 3.25)
project(finds LANGUAGES CXX)
find_package(pairsum {version} REQUIRED)
get_target_property(options pairsum::options INTERFACE_COMPILE_OPTIONS)
message(STATUS "options: ${{options}}")
get_target_property(folders pairsum::pairsum INTERFACE_INCLUDE_DIRECTORIES)
message(STATUS "folders: ${{folders}}")
message(STATUS "dims: ${{pairsum_DIMS}}")
"""


def finds(project, tmp_path, version):
    (tmp_path / "CMakeLists.txt").write_text(PROJECT.format(version=version))
    return project(tmp_path)[1]


def test_options_and_one_include_folder_come_along_but_no_warnings(project, built, prefix, tmp_path):
    done = finds(project, tmp_path, "0.1")
    assert done.returncode == 0, done.stdout
    assert "-fno-math-errno;-fno-trapping-math" in done.stdout
    assert ("-march=native" in done.stdout) == (built("NATIVE") == ["ON"])
    assert "-Wall" not in done.stdout
    folders = re.search(r"folders: (.*)", done.stdout)[1].split(";")
    assert {os.path.realpath(folder) for folder in folders} == {str(prefix / "include")}
    assert f"dims: {';'.join(built('DIMS'))}\n" in done.stdout


@pytest.mark.parametrize("version", ["0.0.1", "0.2", "1.0"])
def test_another_version_is_refused(project, tmp_path, version):
    done = finds(project, tmp_path, version)
    assert done.returncode != 0
    assert "compatible" in done.stdout and "pairsum" in done.stdout
