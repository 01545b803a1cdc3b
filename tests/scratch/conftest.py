"""A scratch copy of the project, to which the code of docs/adding-a-backend.md is added as the document says."""

import json
import os
import pathlib
import platform
import re
import shutil
import subprocess
from typing import NamedTuple

import pytest

SOURCE = pathlib.Path(os.environ["PAIRSUM_SOURCE"])
REGISTRY = "kernels/registry.def"


class Addition(NamedTuple):
    """A file of one word, its text, and what it is called in the registry."""

    path: str
    word: str
    text: str
    line: str

    def put(self, tree):
        (tree / self.path).write_text(self.text)
        self.list(tree)

    def list(self, tree):
        with (tree / REGISTRY).open("a") as file:
            file.write(self.line + "\n")


# A file's name, the next block of C++, and then its word in the registry.
ADDITION = re.compile(r"Write `(kernels/\w+/(\w+)\.cpp)`.*?:\n\n```cpp\n(.*?)```\n.*?word\s+`([A-Z]+\(\2[^`]*\))`\s+to\s+`kernels/registry.def`", re.S)


def documented():
    """The additions of the document, by word."""
    text = (SOURCE / "docs/adding-a-backend.md").read_text()
    return {m[2]: Addition(*m.groups()) for m in ADDITION.finditer(text)}


def wrong_sum():
    """The document's backend, but the pairs of the last cell are dropped."""
    good = documented()["my_sum"]
    text = good.text.replace("my_", "wrong_").replace("fluid_cells; }", "fluid_cells - 1; }")
    assert text.count("fluid_cells - 1") == 1
    return Addition("kernels/backends/wrong_sum.cpp", "wrong_sum", text, good.line.replace("my_", "wrong_"))


def files(tree):
    """Every file of a copy, and its text."""
    return {str(p.relative_to(tree)): p.read_bytes() for p in sorted(tree.rglob("*")) if p.is_file()}


def copy(folder):
    """The files that git tracks or would; results are left out."""
    done = subprocess.run(["git", "-c", f"safe.directory={SOURCE}", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
                          cwd=SOURCE, capture_output=True, text=True)
    if done.returncode == 0:
        names = [n for n in done.stdout.split("\0") if n]
    else:  # no clone: an unpacked archive
        tops = ["CMakeLists.txt", "kernels", "harness", "tests"]
        names = [str(p.relative_to(SOURCE)) for top in tops for p in [SOURCE / top, *(SOURCE / top).rglob("*")]]
    for name in names:
        if (SOURCE / name).is_file() and not name.startswith("results/"):
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(SOURCE / name, folder / name)
    return folder


def configure(tree, *options):
    """Little more than what is added; the compiler does not optimise."""
    restricted = ["-DPAIRSUM_DIMS=2", "-DPAIRSUM_PRECISIONS=double", "-DPAIRSUM_INTERACTIONS=my_pairs;ferrari09",
                  "-DPAIRSUM_SMOOTHINGS=wendland_c2", f"-DPAIRSUM_ISAS={'sse4' if platform.machine() == 'x86_64' else 'all'}",
                  "-DPAIRSUM_GBENCH=OFF", "-DPAIRSUM_RANKS=OFF", "-DPAIRSUM_NATIVE=OFF", "-DCMAKE_BUILD_TYPE=Debug", "-DCMAKE_CXX_FLAGS_DEBUG=-O0",
                  f"-DCMAKE_CXX_COMPILER={os.environ['PAIRSUM_CXX']}"]
    return subprocess.run(["cmake", "-G", os.environ["PAIRSUM_GENERATOR"], "-S", tree, "-B", tree / "build", *restricted, *options],
                          text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


@pytest.fixture(scope="session")
def additions():
    return [*documented().values(), wrong_sum()]


@pytest.fixture(scope="session")
def tree(tmp_path_factory, additions):
    """The copy with everything added, and the program built once."""
    folder = copy(tmp_path_factory.mktemp("tree"))
    before = files(folder)
    for addition in additions:
        addition.put(folder)
    after = files(folder)
    done = configure(folder)
    assert done.returncode == 0, done.stdout
    jobs = os.environ.get("PAIRSUM_JOBS", "2")
    done = subprocess.run(["cmake", "--build", folder / "build", "--target", "pairsum", "--parallel", jobs],
                          text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    assert done.returncode == 0, done.stdout[-8000:]
    return folder, before, after


@pytest.fixture
def pairsum(tree, tmp_path):
    """Calls the program that knows the additions."""

    def call(*words):
        return subprocess.run([tree[0] / "build/bin/pairsum", *map(str, words)], cwd=tmp_path, text=True, capture_output=True,
                              timeout=300)

    return call


@pytest.fixture
def listed(pairsum):
    done = pairsum("list", "--json")
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)
