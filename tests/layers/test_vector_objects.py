"""What is compiled for one instruction set is linked for no other: the linker takes one copy of a weak symbol for all, so each
must name its set."""

import os
import pathlib
import re
import subprocess

import pytest

BUILD = pathlib.Path(os.environ["PAIRSUM_BUILD"])
SETS = {"avx512": "hwy::N_AVX3", "avx2": "hwy::N_AVX2", "sse4": "hwy::N_S", "neon": "hwy::N_NEON"}
WEAK = re.compile(r"^[0-9a-f]* +([WVu]) (.*)$", re.M)


def shared(symbols, name):
    """The weak symbols that do not name the set."""
    return [symbol for _, symbol in WEAK.findall(symbols) if name not in symbol]


def objects(isa):
    return sorted((BUILD / "kernels/CMakeFiles" / f"pairsum_{isa}.dir").rglob("*.o"))


@pytest.mark.parametrize("isa", SETS)
def test_weak_symbols_name_their_set(isa):
    files = objects(isa)
    if not files:
        pytest.skip(f"{isa} is not in this build")
    found = "".join(subprocess.run(["nm", "-C", *files], text=True, capture_output=True, check=True).stdout)
    assert len(WEAK.findall(found)) > 0
    assert shared(found, SETS[isa]) == []


def test_the_check_rejects():
    assert shared("0000 W f(hwy::N_AVX2::Vec256<double>)\n0000 W std::max(int)\n", "hwy::N_AVX2") == ["std::max(int)"]
