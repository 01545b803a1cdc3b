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
NEVER_CALLED = "pairsum::compile_types<"  # it lets the compiler instantiate the sums


def shared(symbols, isa):
    """The weak symbols that do not name the set."""
    names = (SETS[isa], f"pairsum::isas::{isa} ", NEVER_CALLED)
    return [symbol for _, symbol in WEAK.findall(symbols) if not any(name in symbol for name in names)]


def objects(isa):
    """Those of the formulas, and of the lister."""
    folders = [*(BUILD / "kernels/CMakeFiles").glob(f"pairsum_{isa}_*.dir"), BUILD / "kernels/CMakeFiles" / f"pairsum_lister_{isa}.dir"]
    return sorted(file for folder in folders for file in folder.rglob("*.o"))


@pytest.mark.parametrize("isa", SETS)
def test_weak_symbols_name_their_set(isa):
    files = objects(isa)
    if not files:
        pytest.skip(f"{isa} is not in this build")
    found = "".join(subprocess.run(["nm", "-C", *files], text=True, capture_output=True, check=True).stdout)
    assert len(WEAK.findall(found)) > 0
    assert shared(found, isa) == []


def prefetches(disassembly):
    """How many instructions that ask for memory each sum over cells has."""
    sums = re.split(r"^[0-9a-f]+ <pairsum::lane_rows_sum<.*>::(?:half|full)_stencils\(.*:$", disassembly, flags=re.M)[1:]
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
    name = "0010 <pairsum::lane_rows_sum<F, V>::half_stencils(int)>:"
    assert prefetches(f"{name}\n 1: prefetcht0 (%rax)\n 2: ret\n\n0020 <f()>:\n 3: prefetcht0 (%rax)\n\n{name}\n 4: ret\n") == [1, 0]


def test_the_check_rejects():
    good = "0000 W f(hwy::N_AVX2::Vec256<double>)\n0000 W g(pairsum::isas::avx2 const*)\n"
    bad = ["std::max(int)", "f(hwy::N_AVX3::Vec512<double>)", "g(pairsum::isas::avx512 const*)"]
    assert shared(good + "".join(f"0000 W {symbol}\n" for symbol in bad), "avx2") == bad
