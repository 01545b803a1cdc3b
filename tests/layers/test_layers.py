"""Greps the includes: each folder may include what docs/design.md allows, and nothing else."""

import fnmatch
import json
import os
import pathlib
import re

SOURCE = pathlib.Path(os.environ["PAIRSUM_SOURCE"])
UMBRELLA = "kernels/pairsum.hpp"  # for users; it may include all of the library, and no file of this project includes it
ALLOWED = {  # folder: folders it may include, besides itself
    UMBRELLA: ["core", "cases", "interactions", "smoothing", "sum", "integrators"],
    "core": [],
    "pattern": ["core"],
    "particles": ["core"],
    "eos": ["core"],
    "smoothing": ["core"],
    "interactions": ["core", "smoothing", "eos"],
    "cases": ["core", "particles", "eos"],
    "grid": ["core", "pattern", "particles"],
    "sum": ["core", "pattern", "particles", "eos", "smoothing", "interactions", "grid", "cases"],
    "vector": ["core", "pattern", "particles", "grid", "interactions", "sum"],
    "backends": ["core", "pattern", "particles", "grid", "interactions", "sum", "vector"],
    "integrators": ["core", "particles", "sum"],
    "harness/rows": ["core"],
    "harness/stats": ["core"],
    "harness/measure": ["core"],
    "harness/environment": ["core", "harness/rows"],
    "harness/model": ["core", "sum", "harness/measure"],
    "harness/plan": ["core", "cases", "integrators", "sum", "harness/rows", "harness/environment"],
    "harness/verify": ["core", "particles", "cases", "sum", "harness/measure"],
    "harness/self_test": ["core", "particles", "sum", "harness/measure"],
    "harness/run": ["core", "cases", "integrators", "sum", "harness/rows", "harness/plan", "harness/measure", "harness/verify",
                    "harness/stats", "harness/environment", "harness/model", "harness/self_test"],
    "harness/tune": ["core", "cases", "sum", "harness/rows", "harness/plan", "harness/measure", "harness/verify", "harness/stats",
                     "harness/environment", "harness/run"],
    "harness/report": ["core", "sum", "harness/rows", "harness/stats", "harness/model", "harness/self_test"],
    "harness/cli": ["core", "cases", "integrators", "sum", "harness/*"],
    "harness/gbench": ["core", "cases", "integrators", "sum", "harness/*", "grid", "smoothing", "particles"],
}
NO_BACKEND_INCLUDES_ANOTHER = "backends"
DOOR = {"sum/registry.hpp", "sum/setup.hpp", "sum/summation.hpp", "sum/reference.hpp", "sum/setup_of.hpp", "sum/rate_table.hpp", "sum/grids.hpp",
        "sum/check.hpp", "sum/block_shape.hpp", "sum/probe.hpp", "sum/backend.hpp", "sum/costs.hpp", "sum/profile.hpp"}
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.M)
FORBIDDEN_IN_LIBRARY = re.compile(r"#\s*include\s+<(chrono|iostream|fstream|cstdio|filesystem)>|\bgetenv\b|\bprintf\s*\(")


def folder_of(include):
    return "/".join(include.split("/")[:2]) if include.startswith("harness/") else include.split("/")[0]


def allowed(folder, target):
    return target == folder or any(fnmatch.fnmatchcase(target, a) for a in ALLOWED[folder])


def complaints(path, text):
    """What is wrong with the includes of file `path` (relative to the root) with this text."""
    folder = path if path == UMBRELLA else folder_of(path) if path.startswith("harness/") else path.split("/")[1]
    found = []
    if folder not in ALLOWED:
        return [f"{path} is in a folder that no rule names"]
    for include in INCLUDE.findall(text):
        if include in ("pairsum.hpp", "pairsum/pairsum.hpp"):
            found.append(f"{path} includes everything: {include}")
        if "/" not in include:
            continue  # beside it, or generated
        target = folder_of(include)
        if not allowed(folder, target):
            found.append(f"{path} includes {include}")
        if folder == target == NO_BACKEND_INCLUDES_ANOTHER:
            found.append(f"{path} includes another backend: {include}")
        if folder.startswith("harness/") and include.startswith("sum/") and include not in DOOR:
            found.append(f"{path} goes around the registry: {include}")
    if path.startswith("kernels/") and FORBIDDEN_IN_LIBRARY.search(text):
        found.append(f"{path} uses a clock, a file or stdout")
    return found


def sources():
    for top in ["kernels", "harness"]:
        for path in sorted((SOURCE / top).rglob("*.?pp")):
            yield path


def test_every_include_is_allowed():
    found = [c for path in sources() for c in complaints(str(path.relative_to(SOURCE)), path.read_text())]
    assert found == []


def test_every_folder_is_known():
    folders = {p.relative_to(SOURCE / "kernels").parts[0] for p in (SOURCE / "kernels").rglob("*/*.?pp")}
    folders |= {"/".join(p.relative_to(SOURCE).parts[:2]) for p in (SOURCE / "harness").rglob("*.?pp")}
    assert folders | {UMBRELLA} == set(ALLOWED)
    assert [p.name for p in (SOURCE / "kernels").glob("*.?pp")] == ["pairsum.hpp"]


def test_the_checker_rejects():
    assert complaints("kernels/core/a.hpp", '#include "grid/cells.hpp"\n')
    assert complaints("kernels/backends/a.hpp", '#include "backends/naive.hpp"\n')
    assert complaints("kernels/sum/a.hpp", '#include <chrono>\n')
    assert complaints("harness/run/a.cpp", '#include "sum/block.hpp"\n')
    assert complaints("harness/report/a.cpp", '#include "harness/run/world.hpp"\n')
    assert complaints("harness/report/a.cpp", '#include "sum/block.hpp"\n')
    assert not complaints("harness/report/a.cpp", '#include "sum/registry.hpp"\n#include "harness/model/cost.hpp"\n')
    assert complaints("harness/cli/a.cpp", '#include "grid/hashed_grid.hpp"\n')
    assert complaints("harness/cli/a.cpp", '#include "backends/naive.hpp"\n')
    assert complaints("harness/gbench/a.cpp", '#include "backends/naive.hpp"\n')
    assert complaints("harness/self_test/a.cpp", '#include "harness/verify/verifier.hpp"\n')
    assert complaints("harness/gbench/a.cpp", '#include "sum/block.hpp"\n')
    assert complaints("harness/new_folder/a.cpp", "")
    assert complaints("kernels/new_folder/a.hpp", "")
    assert complaints("kernels/another.hpp", "")
    assert complaints(UMBRELLA, '#include "grid/hashed_grid.hpp"\n')
    assert complaints("harness/run/a.cpp", '#include "pairsum.hpp"\n')
    assert complaints("kernels/cases/a.hpp", '#include "sum/setup.hpp"\n')
    assert not complaints("harness/cli/a.cpp", '#include "harness/run/runner.hpp"\n#include "sum/registry.hpp"\n')
    assert not complaints("harness/gbench/a.cpp", '#include "grid/hashed_grid.hpp"\n')
    assert not complaints("kernels/backends/a.hpp", '#include "sum/block.hpp"\n#include <vector>\n')


def test_every_header_says_pragma_once():
    missing = [str(p) for p in sources() if p.suffix == ".hpp" and "#pragma once" not in p.read_text()]
    assert missing == []


def test_presets_leave_no_option_to_an_old_cache():
    presets = {p["name"]: p for p in json.loads((SOURCE / "CMakePresets.json").read_text())["configurePresets"]}
    options = set(re.findall(r"^option\((PAIRSUM_\w+)", (SOURCE / "CMakeLists.txt").read_text(), re.M))
    chosen = (SOURCE / "kernels/cmake/pairsum_choose.cmake").read_text()
    options |= {f"PAIRSUM_{choice}" for choice in re.search(r"set\(PAIRSUM_CHOICES (.*?)\)", chosen)[1].split()}
    options |= set(re.findall(r"set\((PAIRSUM_\w+) .* CACHE ", chosen))
    assert len(options) > 9 and "PAIRSUM_FORMULAS" in options and options <= presets["base"]["cacheVariables"].keys()
    for name, preset in presets.items():
        while preset["name"] != "base":
            assert preset.get("inherits"), name
            preset = presets[preset["inherits"]]
