"""Greps the includes: each folder may include what docs/design.md allows, and nothing else. Headers of the library are included
as <pairsum/...>, those of the program as "harness/..."."""

import fnmatch
import json
import os
import pathlib
import re

import pytest

SOURCE = pathlib.Path(os.environ["PAIRSUM_SOURCE"])
UMBRELLA = "kernels/pairsum.hpp"  # for users; no file of this project includes it
TOP = "kernels/library.cpp"  # what the library is made of
PLUGIN = "kernels/plugin.hpp"  # for shared objects and the program that loads them
ALONE_AT_THE_TOP = {UMBRELLA, TOP, PLUGIN}
ALLOWED = {  # folder: folders and headers it may include, besides itself
    UMBRELLA: ["core", "cases", "interactions", "smoothing", "sum", "integrators", "formula/entry.hpp", "vector/own_lanes.hpp"],
    TOP: ["cases", "core", "integrators", "sum", "formula/words.hpp", "registry.def"],
    PLUGIN: ["build_word.hpp"],
    "core": [],
    "pattern": ["core"],
    "particles": ["core"],
    "eos": ["core"],
    "smoothing": ["core"],
    "interactions": ["core", "smoothing", "eos"],
    "cases": ["core", "particles", "eos"],
    "files": ["core", "particles", "cases"],
    "grid": ["core", "pattern", "particles"],
    "sum": ["core", "pattern", "particles", "grid", "cases", "interactions/interaction.hpp"],
    "schedule": ["core", "pattern", "grid", "sum"],
    "backends": ["core", "schedule", "sum"],
    "formula": ["core", "smoothing", "interactions/interaction.hpp", "sum", "reference/reference_of.hpp", "vector/compiled_lanes.hpp"],
    "formulas": ["interactions", "formula/formula_source.hpp"],
    "reference": ["core", "particles", "interactions/interaction.hpp", "sum", "formula/costs_of.hpp", "formula/mixed.hpp", "formula/rate_names.hpp"],
    "vector": ["core", "pattern", "grid", "sum", "formula/formula_view.hpp", "formula/formulas.hpp", "formula/lanes_of.hpp",
               "formula/row_layout.hpp"],
    "integrators": ["core", "particles", "sum"],
    "ranks": ["core", "particles", "sum", "integrators/with_state.hpp"],
    "harness/rows": ["core"],
    "harness/stats": ["core"],
    "harness/measure": ["core"],
    "harness/terminal": ["harness/measure"],
    "harness/plugin": ["core", "sum", "plugin.hpp", "harness/rows"],
    "harness/environment": ["core", "harness/rows", "harness/plugin"],
    "harness/ranks": ["core", "sum", "ranks/job.hpp", "ranks/ranked.hpp", "harness/terminal"],
    "harness/model": ["core", "sum", "harness/measure", "harness/stats"],
    "harness/plan": ["core", "cases", "integrators", "sum", "schedule/block_shape.hpp", "harness/rows", "harness/environment", "harness/ranks"],
    "harness/evolve": ["core", "eos", "particles", "cases", "files", "interactions", "smoothing", "sum", "integrators", "formula/entry.hpp",
                       "vector/own_lanes.hpp", "harness/rows", "harness/plan", "harness/measure", "harness/environment", "harness/terminal", "harness/ranks"],
    "harness/verify": ["core", "particles", "cases", "sum", "harness/measure", "harness/ranks"],
    "harness/self_test": ["core", "particles", "sum", "harness/measure"],
    "harness/run": ["core", "cases", "integrators", "sum", "harness/rows", "harness/plan", "harness/measure", "harness/verify",
                    "harness/stats", "harness/environment", "harness/model", "harness/self_test", "harness/terminal", "harness/evolve", "harness/ranks"],
    "harness/simulate": ["core", "cases", "sum", "harness/rows", "harness/plan", "harness/measure", "harness/run", "harness/terminal",
                         "harness/evolve", "harness/ranks"],
    "harness/tune": ["core", "cases", "sum", "harness/rows", "harness/plan", "harness/measure", "harness/verify", "harness/stats",
                     "harness/environment", "harness/run", "harness/terminal"],
    "harness/cli": ["core", "cases", "files", "integrators", "particles", "sum", "harness/*"],
    "harness/gbench": ["core", "cases", "integrators", "sum", "harness/*", "grid", "smoothing", "particles"],
}
ALONE = ["backends", "formulas"]  # none includes another
DOOR = {"sum/registry.hpp", "sum/setup.hpp", "sum/summation.hpp", "sum/reference.hpp", "sum/setup_of.hpp", "sum/rate_table.hpp", "sum/grids.hpp",
        "sum/check.hpp", "sum/agreement.hpp", "sum/backend_traits.hpp", "sum/work_counts.hpp", "sum/costs.hpp", "sum/profile.hpp"}
INCLUDE = re.compile(r'^\s*#\s*include\s+([<"])([^">]+)[">]', re.M)
FORBIDDEN_IN_LIBRARY = re.compile(r"#\s*include\s+<(chrono|iostream)>|\bgetenv\b|\bprintf\s*\(")
USES_FILES = re.compile(r"#\s*include\s+<(fstream|cstdio|filesystem)>")

#: What reads files of the system: the limits of this job.
ASKS_THE_SYSTEM = {"kernels/core/job_limits.hpp", "kernels/core/job_limits.cpp"}


def folder_of(include):
    return "/".join(include.split("/")[:2]) if include.startswith("harness/") else include.split("/")[0]


def allowed(folder, target, include):
    return target == folder or any(fnmatch.fnmatchcase(name, a) for a in ALLOWED[folder] for name in (target, include))


def complaints(path, text):
    """What is wrong with the includes of file `path` (relative to the root) with this text."""
    folder = path if path in ALONE_AT_THE_TOP else folder_of(path) if path.startswith("harness/") else path.split("/")[1]
    found = []
    if folder not in ALLOWED:
        return [f"{path} is in a folder that no rule names"]
    for quote, include in INCLUDE.findall(text):
        in_library = include.startswith("pairsum/")
        if quote == '"' and (in_library or (not include.startswith("harness/") and ("/" in include or path.startswith("kernels/")))):
            found.append(f'{path} does not write <pairsum/...>: "{include}"')
        if quote == "<" and not in_library:
            if include.startswith("harness/"):
                found.append(f'{path} does not write "{include}"')
            continue  # of the system
        include = include.removeprefix("pairsum/")
        if include == "pairsum.hpp":
            found.append(f"{path} includes everything: {include}")
        elif not in_library and "/" not in include:
            continue  # beside it, or generated
        target = folder_of(include)
        if not allowed(folder, target, include):
            found.append(f"{path} includes {include}")
        if folder == target and folder in ALONE:
            found.append(f"{path} includes another: {include}")
        if folder.startswith("harness/") and include.startswith("sum/") and include not in DOOR:
            found.append(f"{path} goes around the registry: {include}")
    forbidden = FORBIDDEN_IN_LIBRARY.search(text) or (folder != "files" and USES_FILES.search(text))
    if path.startswith("kernels/") and path not in ASKS_THE_SYSTEM and forbidden:
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
    assert folders | ALONE_AT_THE_TOP == set(ALLOWED)
    assert {f"kernels/{p.name}" for p in (SOURCE / "kernels").glob("*.?pp")} == ALONE_AT_THE_TOP


@pytest.mark.parametrize("path, include", [
    ("kernels/core/a.hpp", "<pairsum/grid/cells.hpp>"),
    ("kernels/grid/a.hpp", '"grid/cells.hpp"'),
    ("kernels/grid/a.hpp", '"pairsum/grid/cells.hpp"'),
    ("kernels/grid/a.hpp", '"cells.hpp"'),
    ("kernels/cases/a.hpp", "<pairsum/sum/setup.hpp>"),
    *(("kernels/sum/a.hpp", f"<pairsum/{name}.hpp>") for name in ["schedule/block", "backends/a", "formula/entry", "vector/rows",
                                                                 "reference/reference_of", "interactions/count", "smoothing/gaussian"]),
    *(("kernels/schedule/a.hpp", f"<pairsum/{name}.hpp>") for name in ["backends/a", "formula/entry", "vector/rows", "interactions/count"]),
    *(("kernels/backends/a.cpp", f"<pairsum/{name}.hpp>") for name in [
        "backends/naive", "formula/entry", "vector/rows", "reference/reference_of", "interactions/interaction", "smoothing/gaussian"]),
    *(("kernels/formula/a.hpp", f"<pairsum/{name}.hpp>") for name in ["backends/a", "schedule/block", "interactions/count", "vector/rows"]),
    ("kernels/formulas/a.cpp", "<pairsum/formulas/b.hpp>"),
    ("kernels/vector/a.hpp", "<pairsum/formula/entry.hpp>"),
    ("kernels/vector/a.hpp", "<pairsum/schedule/block.hpp>"),
    ("kernels/reference/a.hpp", "<pairsum/formula/formula_of.hpp>"),
    (UMBRELLA, "<pairsum/grid/hashed_grid.hpp>"),
    (TOP, "<pairsum/backends/naive.hpp>"),
    ("kernels/sum/a.hpp", "<chrono>"),
    ("kernels/sum/a.hpp", "<fstream>"),
    ("kernels/sum/a.hpp", "<pairsum/files/formats.hpp>"),
    ("kernels/files/a.cpp", "<chrono>"),
    ("kernels/files/a.cpp", "<pairsum/grid/cells.hpp>"),
    ("kernels/new_folder/a.hpp", "<vector>"),
    ("kernels/another.hpp", "<vector>"),
    ("harness/run/a.cpp", "<pairsum/pairsum.hpp>"),
    ("harness/run/a.cpp", "<pairsum/sum/problem.hpp>"),
    ("harness/run/a.cpp", '"sum/registry.hpp"'),
    ("harness/verify/a.cpp", '"harness/run/world.hpp"'),
    ("harness/run/a.cpp", "<harness/stats/medians.hpp>"),
    ("harness/cli/a.cpp", "<pairsum/grid/hashed_grid.hpp>"),
    ("harness/cli/a.cpp", "<pairsum/backends/naive.hpp>"),
    ("harness/self_test/a.cpp", '"harness/verify/verifier.hpp"'),
    ("harness/gbench/a.cpp", "<pairsum/sum/problem.hpp>"),
    ("harness/run/a.cpp", "<pairsum/ranks/job.hpp>"),
    ("harness/new_folder/a.cpp", "<vector>")])
def test_the_checker_rejects(path, include):
    assert complaints(path, f"#include {include}\n")


@pytest.mark.parametrize("path, includes", [
    ("kernels/backends/a.cpp", ["<pairsum/schedule/block.hpp>", "<pairsum/sum/rate_copies.hpp>", "<vector>"]),
    ("kernels/files/a.cpp", ["<pairsum/cases/case.hpp>", "<fstream>"]),
    ("kernels/formula/a.hpp", ["<pairsum/reference/reference_of.hpp>"]),
    ("harness/run/a.cpp", ["<pairsum/sum/registry.hpp>", '"harness/model/cost.hpp"']),
    ("harness/cli/a.cpp", ['"harness/run/runner.hpp"', '"build_info.hpp"', "<fmt/format.h>"]),
    ("harness/gbench/a.cpp", ["<pairsum/grid/hashed_grid.hpp>"])])
def test_the_checker_accepts(path, includes):
    assert complaints(path, "".join(f"#include {include}\n" for include in includes)) == []


def test_every_header_says_pragma_once():
    missing = [str(p) for p in sources() if p.suffix == ".hpp" and "#pragma once" not in p.read_text()]
    assert missing == []


def test_presets_leave_no_option_to_an_old_cache():
    presets = {p["name"]: p for p in json.loads((SOURCE / "CMakePresets.json").read_text())["configurePresets"]}
    options = set(re.findall(r"^option\((PAIRSUM_\w+)", (SOURCE / "CMakeLists.txt").read_text(), re.M))
    chosen = (SOURCE / "kernels/cmake/pairsum_choose.cmake").read_text()
    options |= {f"PAIRSUM_{choice}" for choice in re.search(r"set\(PAIRSUM_CHOICES (.*?)\)", chosen)[1].split()}
    options |= set(re.findall(r"set\((PAIRSUM_\w+) .* CACHE ", chosen))
    assert len(options) > 9 and options <= presets["base"]["cacheVariables"].keys()
    for name, preset in presets.items():
        while preset["name"] != "base":
            assert preset.get("inherits"), name
            preset = presets[preset["inherits"]]
