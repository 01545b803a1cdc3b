"""What is compiled for one instruction set is linked for no other: the linker takes one copy of a weak symbol for all, so each
must name its set."""

import os
import pathlib
import platform
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


def prefetches(disassembly):
    """How many instructions that ask for memory each sum over cells has."""
    sums = re.split(r"^[0-9a-f]+ <void pairsum::tile_kernel<.*>::sum<(?:true|false)>.*:$", disassembly, flags=re.M)[1:]
    return [len(re.findall(r"\bprefetch", body.split("\n\n")[0])) for body in sums]


@pytest.mark.skipif(platform.machine() not in ("x86_64", "AMD64"), reason="the names of other instructions")
@pytest.mark.parametrize("isa", SETS)
def test_sums_ask_for_memory_ahead(isa):
    """Compilers may leave out what has no effect but on time: two for later cells, then rows and places near the next."""
    files = objects(isa)
    if not files:
        pytest.skip(f"{isa} is not in this build")
    if "CMAKE_BUILD_TYPE:STRING=Release" not in (BUILD / "CMakeCache.txt").read_text():
        pytest.skip("only optimised sums are one function")
    command = ["objdump", "-dC", "--no-show-raw-insn", *files]
    counts = prefetches(subprocess.run(command, text=True, capture_output=True, check=True).stdout)
    assert counts and min(counts) > 3


def test_the_count_of_prefetches():
    name = "0010 <void pairsum::tile_kernel<F, V>::sum<true>(int)>:"
    assert prefetches(f"{name}\n 1: prefetcht0 (%rax)\n 2: ret\n\n0020 <f()>:\n 3: prefetcht0 (%rax)\n\n{name}\n 4: ret\n") == [1, 0]


def test_the_check_rejects():
    assert shared("0000 W f(hwy::N_AVX2::Vec256<double>)\n0000 W std::max(int)\n", "hwy::N_AVX2") == ["std::max(int)"]
