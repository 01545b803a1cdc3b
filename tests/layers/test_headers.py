"""Every header compiles alone, with the include folders the build uses."""

import concurrent.futures
import json
import os
import pathlib
import platform
import shlex
import subprocess

import pytest

SOURCE = pathlib.Path(os.environ["PAIRSUM_SOURCE"])
BUILD = pathlib.Path(os.environ["PAIRSUM_BUILD"])


VECTOR_UNITS = ["-msse4.2", "-maes", "-mpclmul"] if platform.machine() == "x86_64" else []  # kernels/vector needs some


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
    return [words[0], "-std=c++20", "-fopenmp", "-fsyntax-only", "-w", "-DEIGEN_DONT_VECTORIZE", *VECTOR_UNITS, *folders, "-x", "c++"]


def complaints(compiler, paths):
    """What the compiler says of those that do not compile alone, two at a time."""

    def one(path):
        done = subprocess.run([*compiler, str(path)], text=True, capture_output=True, cwd=BUILD)
        return "" if done.returncode == 0 else done.stderr or str(path)

    with concurrent.futures.ThreadPoolExecutor(2) as two:
        return "".join(two.map(one, paths))


def test_every_header_compiles_alone(compiler):
    paths = [p for top in ["kernels", "harness"] for p in sorted((SOURCE / top).rglob("*.hpp"))]
    assert len(paths) > 50
    assert complaints(compiler, paths) == ""


def test_the_check_rejects(compiler, tmp_path):
    good, bad = tmp_path / "good.hpp", tmp_path / "bad.hpp"
    bad.write_text("inline std::vector<int> none() { return {}; }\n")
    good.write_text("#include <vector>\n" + bad.read_text())
    assert complaints(compiler, [good]) == ""
    assert "vector" in complaints(compiler, [good, bad])
