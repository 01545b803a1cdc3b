"""Installs the library that was just built under a folder of the tests."""

import os
import pathlib
import re
import subprocess

import pytest

SOURCE = pathlib.Path(os.environ["PAIRSUM_SOURCE"])
BUILD = pathlib.Path(os.environ["PAIRSUM_BUILD"])
OPTIONS = [f"-DCMAKE_CXX_COMPILER={os.environ['PAIRSUM_CXX']}", "-DCMAKE_BUILD_TYPE=Release",
           "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG"]  # a third of the time


def call(*words):
    return subprocess.run([*map(str, words)], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


def must(*words):
    done = call(*words)
    assert done.returncode == 0, done.stdout
    return done.stdout


@pytest.fixture(scope="session")
def prefix(tmp_path_factory):
    folder = tmp_path_factory.mktemp("prefix")
    must("cmake", "--install", BUILD, "--prefix", folder)
    return folder


@pytest.fixture(scope="session")
def package(prefix):
    """The folder of the package's CMake files."""
    return next(prefix.glob("lib*/**/pairsumConfig.cmake")).parent


@pytest.fixture(scope="session")
def built(package):
    """The words the package says it was built with: built("BACKENDS")."""
    text = (package / "pairsumConfig.cmake").read_text()
    return lambda kind: re.search(rf'^set\(pairsum_{kind} "(.*?)"\)', text, re.M)[1].split(";")


@pytest.fixture
def project(prefix, tmp_path):
    """Configures a folder as a project that is given the prefix; returns its build folder and the finished process."""

    def configure(folder, *options):
        build = tmp_path / "build"
        return build, call("cmake", "-S", folder, "-B", build, f"-DCMAKE_PREFIX_PATH={prefix}", *OPTIONS, *options)

    return configure
