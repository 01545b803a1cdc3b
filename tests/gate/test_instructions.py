"""Instructions of a small sum by backend, within 3 % of figures.json; `PAIRSUM_WRITE=1` writes the file anew."""
import json
import os
import pathlib
import re
import subprocess

import pytest

HERE = pathlib.Path(__file__).parent
FIGURES = HERE / "figures.json"
SOURCE = pathlib.Path(os.environ["PAIRSUM_SOURCE"])
FOLDER = pathlib.Path(os.environ["PAIRSUM_FOLDER"])
SHARE = 0.03


def compiler():
    """The words that figures hold for: another compiler makes other instructions."""
    return subprocess.run(["g++", "-dumpfullversion"], capture_output=True, text=True, check=True).stdout.strip()


def differences(counted, expected):
    """What is not within the share of what is expected, in words."""
    found = [f"{name} is new: {counted[name]}" for name in counted.keys() - expected.keys()]
    found += [f"{name} was not counted" for name in expected.keys() - counted.keys()]
    for name in counted.keys() & expected.keys():
        ratio = counted[name] / expected[name]
        if abs(ratio - 1) > SHARE:
            found.append(f"{name}: {counted[name]} instructions, {ratio:.3f} of {expected[name]}")
    return sorted(found)


@pytest.fixture(scope="module")
def counted():
    options = ["-DCMAKE_BUILD_TYPE=Release", "-DPAIRSUM_GATE=ON", "-DPAIRSUM_NATIVE=OFF", "-DCMAKE_CXX_FLAGS=-march=haswell",
               "-DPAIRSUM_DIMS=3", "-DPAIRSUM_PRECISIONS=double", "-DPAIRSUM_INTERACTIONS=ferrari09",
               "-DPAIRSUM_SMOOTHINGS=wendland_c2", "-DPAIRSUM_ISAS=avx2", "-DPAIRSUM_HARNESS=OFF", "-DPAIRSUM_RANKS=OFF",
               "-DPAIRSUM_TESTS=OFF"]
    subprocess.run(["cmake", "-G", "Ninja", "-S", SOURCE, "-B", FOLDER, "-DCMAKE_CXX_COMPILER=g++", *options], check=True,
                   stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", FOLDER, "--parallel", "2", "--target", "instructions"], check=True,
                   stdout=subprocess.DEVNULL)
    for old in FOLDER.glob("counts*"):
        old.unlink()
    subprocess.run(["valgrind", "-q", "--tool=callgrind", "--collect-atstart=no", f"--callgrind-out-file={FOLDER}/counts",
                    FOLDER / "bin/instructions"], check=True, env={**os.environ, "OMP_NUM_THREADS": "1"})
    counts = {}
    for dump in FOLDER.glob("counts*"):
        text = dump.read_text(encoding="utf-8", errors="replace")
        name = re.search(r"^desc: Trigger: Client Request: (.+)$", text, re.M)
        total = re.search(r"^(?:summary|totals): (\d+)", text, re.M)
        if name and total:
            counts[name[1]] = int(total[1])
    return counts


def test_a_small_sum_takes_as_many_instructions_as_it_did(counted):
    if os.environ.get("PAIRSUM_WRITE"):
        FIGURES.write_text(json.dumps({"compiler": compiler(), "instructions": dict(sorted(counted.items()))}, indent=1) + "\n",
                           encoding="utf-8")
    figures = json.loads(FIGURES.read_text(encoding="utf-8"))
    if figures["compiler"] != compiler():
        pytest.skip(f"figures are of g++ {figures['compiler']}, this is {compiler()}")
    assert differences(counted, figures["instructions"]) == []


def test_more_instructions_are_found():
    expected = {"a scalar": 1000, "b avx2": 1000}
    assert differences({"a scalar": 1029, "b avx2": 971}, expected) == []
    assert len(differences({"a scalar": 1031, "b avx2": 1000}, expected)) == 1
    assert len(differences({"a scalar": 1000, "c scalar": 5}, expected)) == 2
