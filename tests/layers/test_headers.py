"""Every header compiles alone, with the include folders the build uses.

Most of the time would go into reading Eigen again and again, so it is precompiled for the headers that include it, be it by
way of others. That hides nothing: what they use comes after their includes, and so after Eigen, in any case; and each of the
headers on the way is looked at, too."""

import concurrent.futures
import functools
import json
import os
import pathlib
import platform
import re
import shlex
import subprocess

import pytest

SOURCE = pathlib.Path(os.environ["PAIRSUM_SOURCE"])
BUILD = pathlib.Path(os.environ["PAIRSUM_BUILD"])


HEAVY = "Eigen/Core"
INCLUDE = re.compile(r'^\s*#\s*include\s+[<"]([^>"]+)[>"]', re.M)
VECTOR_UNITS = ["-msse4.2", "-maes", "-mpclmul"] if platform.machine() == "x86_64" else []  # kernels/vector needs some
CHOSEN = ["-DPAIRSUM_ISA_LIST=", "-DPAIRSUM_SMOOTHING_LIST="]  # what a build chooses: here nothing


@pytest.fixture(scope="module")
def compiler():
    """The compiler with the include folders of the library and the program. Warnings are not asked for; nor are vector
    instructions of Eigen, which take the most time."""
    folders = []
    for entry in json.loads((BUILD / "compile_commands.json").read_text()):
        words = shlex.split(entry["command"])
        made = pathlib.Path(entry["directory"], words[words.index("-o") + 1]).relative_to(BUILD)
        if made.parts[0] not in ("kernels", "harness"):
            continue  # a test's
        for at, word in enumerate(words):
            if word == "-isystem":
                folders.append(("-isystem", words[at + 1]))
            elif word.startswith("-I"):
                folders.append((word,))
    folders = [word for pair in dict.fromkeys(folders) for word in pair]
    assert folders, "compile_commands.json names no include folder"
    return [words[0], "-std=c++20", "-fopenmp", "-fsyntax-only", "-w", "-DEIGEN_DONT_VECTORIZE", *VECTOR_UNITS, *CHOSEN, *folders, "-x", "c++"]


@functools.cache
def reaches_heavy(path):
    """Does the header include what is precompiled, itself or by way of others of the project?"""
    names = INCLUDE.findall(path.read_text())
    files = [file for name in names for file in (path.parent / name, SOURCE / name, SOURCE / "kernels" / name.removeprefix("pairsum/"))]
    return HEAVY in names or any(reaches_heavy(file) for file in files if file.is_file())


@pytest.fixture(scope="module")
def precompiled(compiler, tmp_path_factory):
    """The words that bring it."""
    header = tmp_path_factory.mktemp("precompiled") / "heavy.hpp"
    header.write_text(f"#include <{HEAVY}>\n")
    kind = ".pch" if "clang" in pathlib.Path(compiler[0]).name else ".gch"
    words = [word for word in compiler[:-2] if word != "-fsyntax-only"]
    subprocess.run([*words, "-x", "c++-header", header, "-o", f"{header}{kind}"], check=True)
    return ["-include", str(header), "-Winvalid-pch"]


@pytest.fixture(scope="module")
def complaints(compiler, precompiled):
    """What the compiler says of those that do not compile alone, two at a time."""

    def one(path):
        brought = precompiled if reaches_heavy(path) else []
        done = subprocess.run([*compiler[:-2], *brought, *compiler[-2:], str(path)], text=True, capture_output=True, cwd=BUILD)
        return "" if done.returncode == 0 else done.stderr or str(path)

    def all_of(paths):
        with concurrent.futures.ThreadPoolExecutor(2) as two:
            return "".join(two.map(one, paths))

    return all_of


def test_every_header_compiles_alone(complaints):
    paths = [p for top in ["kernels", "harness"] for p in sorted((SOURCE / top).rglob("*.hpp"))]
    assert len(paths) > 50
    assert sum(map(reaches_heavy, paths)) > 50
    assert complaints(paths) == ""


def test_the_check_rejects(complaints, tmp_path):
    good, bad = tmp_path / "good.hpp", tmp_path / "bad.hpp"
    bad.write_text("inline std::vector<int> none() { return {}; }\n")
    good.write_text("#include <vector>\n" + bad.read_text())
    assert complaints([good]) == ""
    assert "vector" in complaints([good, bad])


def test_what_is_precompiled_helps_those_alone_that_include_it(complaints, tmp_path):
    near, far, without = (tmp_path / f"{name}.hpp" for name in ("near", "far", "without"))
    use = "inline double first(const Eigen::Vector3d& x) { return x[0]; }\n"
    near.write_text(f"#pragma once\n#include <{HEAVY}>\n" + use)
    far.write_text('#include "near.hpp"\n' + use.replace("first", "second"))
    without.write_text(use)
    assert complaints([near, far]) == ""
    assert "Eigen" in complaints([near, without])
