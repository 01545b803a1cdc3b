"""The example plug-in, built against what was installed: the programs take its backend and its interaction like their own, and
refuse what is no plug-in of their build."""

import json
import os
import re
import shutil
import subprocess

import pytest

from conftest import BUILD, OPTIONS, SOURCE, must

SMALL = ["--dx", "0.08", "--M", "3", "--grid", "hashed_grid"]
MORE = """
foreach(name taken other bare coloured wrong)
  add_library(${name} MODULE ${name}.cpp)
  target_link_libraries(${name} PRIVATE pairsum::pairsum)
  set_target_properties(${name} PROPERTIES PREFIX "")
endforeach()
"""
REFUSED = {
    "taken": """#include <pairsum/plugin.hpp>
#include <pairsum/sum/registry.hpp>
static void add_all(pairsum::registry& r) { r.add(pairsum::registry::instance().backends().front()); }
PAIRSUM_PLUGIN(taken, add_all)
""",
    "other": """#include <pairsum/plugin.hpp>
extern "C" {
extern const pairsum::plugin pairsum_plugin;
const pairsum::plugin pairsum_plugin{"0.0.9 of another build", "other", nullptr};
}
""",
    "bare": "int nothing() { return 0; }\n",
    "coloured": """#include <pairsum/plugin.hpp>
#include <pairsum/sum/registry.hpp>
static void add_all(pairsum::registry& r) {
  pairsum::backend_entry b = pairsum::registry::instance().backends().front();
  b.traits.name = "red";
  b.traits.description = "\\x1b[31m red";
  r.add(b);
}
PAIRSUM_PLUGIN(coloured, add_all)
"""}


def wrong_backend(project):
    """The example's backend under another name, which leaves out one block of each pass."""
    text = (project / "reverse_passes.cpp").read_text()
    for old, new in (("    sum_block(", "    if (k > 0) sum_block("), ("reverse_passes", "wrong_passes"), ("reverse_blocks", "wrong_blocks")):
        assert old in text
        text = text.replace(old, new)
    return text + """
#include <pairsum/plugin.hpp>
#include <pairsum/sum/registry.hpp>
static void add_all(pairsum::registry& r) { r.add(pairsum::backends::wrong_passes()); }
PAIRSUM_PLUGIN(wrong, add_all)
"""


@pytest.fixture(scope="session")
def folder(prefix, tmp_path_factory):
    """Where the example, and what is refused, was built."""
    project, build = tmp_path_factory.mktemp("project") / "plugin", tmp_path_factory.mktemp("built")
    shutil.copytree(SOURCE / "examples/plugin", project)
    with open(project / "CMakeLists.txt", "a") as lists:
        lists.write(MORE)
    for name, text in {**REFUSED, "wrong": wrong_backend(project)}.items():
        (project / f"{name}.cpp").write_text(text)
    must("cmake", "-S", project, "-B", build, f"-DCMAKE_PREFIX_PATH={prefix}", *OPTIONS)
    must("cmake", "--build", build)
    shutil.copy(build / "example.so", build / "copy.so")
    (build / "text.so").write_text("no shared object\n" * 100)
    return build


@pytest.fixture(scope="session")
def plugin(folder):
    return folder / "example.so"


@pytest.fixture
def call(prefix, tmp_path):
    """Calls an installed program in an empty folder; returns the finished process."""

    def run(*words, program="pairsum", **environment):
        if not (BUILD / "bin" / program).exists():
            pytest.skip(f"{program} is not in this build")
        return subprocess.run([prefix / "bin" / program, *map(str, words)], cwd=tmp_path, text=True, capture_output=True, timeout=300,
                              env={**os.environ, "OMP_WAIT_POLICY": "passive", **environment})

    return run


def fine(done):
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def listed(text):
    made = json.loads(text)
    return [b["name"] for b in made["backends"]], made["interactions"]


def test_list(call, plugin, built):
    own = listed(fine(call("list", "--json")))
    backends, interactions = listed(fine(call("list", "--json", "--plugin", plugin)))
    assert own == (built("BACKENDS"), built("INTERACTIONS"))
    assert backends == own[0] + ["reverse_passes"]
    assert sorted(interactions) == sorted(own[1] + ["density"])
    assert "reverse_passes" in fine(call("list", "--plugin", plugin))


def test_the_environment_names_it_too_and_it_is_loaded_once(call, plugin):
    assert "reverse_passes" in fine(call("list", "--plugin", plugin, "--plugin", plugin, PAIRSUM_PLUGINS=f"{plugin}:{plugin}"))


def verified(text):
    """What stands in front of the error of each sum."""
    assert re.search(r"^([1-9]\d*) of \1 sums agree", text, re.M), text
    return [line.split() for line in text.splitlines() if line.startswith("3D ")]


def test_its_backend_sums_every_formula(call, plugin, built):
    lines = verified(fine(call("verify", "--plugin", plugin, "--dim", "3", "--backend", "reverse_passes", "--threads", "2", *SMALL)))
    assert {line[2] for line in lines} == {*built("INTERACTIONS"), "density"}
    assert {line[1] for line in lines} == set(built("PRECISIONS"))


def test_every_backend_sums_its_interaction(call, plugin, built):
    lines = verified(fine(call("verify", "--each", "--plugin", plugin, "--dim", "3", "--interaction", "density", "--threads", "2", *SMALL)))
    assert {line[4] for line in lines} == {*built("BACKENDS"), "reverse_passes"}


RUN = ["run", *SMALL, "--steps", "2", "--rounds", "1", "--threads", "1,2", "--oversubscribe", "--out", "rows.jsonl"]


def test_rows_of_a_run_name_it(call, plugin, tmp_path):
    fine(call(*RUN, "--plugin", plugin, "--interaction", "ferrari09,density", "--backend", "reverse_passes,naive_omp"))
    rows = [json.loads(line) for line in (tmp_path / "rows.jsonl").read_text().splitlines()]
    environment, = (row for row in rows if row["kind"] == "environment")
    assert re.fullmatch(r"example\.so [0-9a-f]{16}", environment["libraries"]["plugin example"])
    samples = [row for row in rows if row["kind"] == "sample"]
    assert {row["environment"] for row in samples} == {environment["environment"]}
    assert all(row["phases"]["sum_s"] > 0 for row in samples)
    measured = {(row["point"]["backend"], row["point"]["interaction"]) for row in samples}
    assert measured == {(b, i) for b in ("reverse_passes", "naive_omp") for i in ("ferrari09", "density")}


def test_rows_with_it_and_without_are_not_mixed(call, plugin):
    fine(call(*RUN, "--plugin", plugin, "--backend", "naive_omp"))
    done = call(*RUN, "--backend", "naive_omp")
    assert done.returncode == 2
    assert "rows of another machine or build" in done.stderr and "plugin example: example.so" in done.stderr


def test_tune(call, plugin):
    text = fine(call("tune", "--plugin", plugin, *SMALL, "--backend", "reverse_passes", "--budget", "3"))
    assert "reverse_passes" in text


def test_bench(call, plugin):
    made = json.loads(fine(call("--plugin", plugin, *SMALL, "--threads", "2", "--oversubscribe", "--benchmark_filter=reverse_passes", "--benchmark_format=json",
                                "--benchmark_min_time=0.01", program="pairsum_bench")))
    assert made["context"]["plugin example"].startswith("example.so ")
    assert [b["name"].split("/")[0] for b in made["benchmarks"]] == ["reverse_passes"]
    assert not made["benchmarks"][0].get("error_occurred")


def test_bench_ends_with_1_where_rates_are_wrong(call, folder):
    done = call("--plugin", folder / "wrong.so", *SMALL, "--threads", "1", "--benchmark_filter=^(wrong_passes|naive)/", "--benchmark_format=json",
                "--benchmark_min_time=0.01", program="pairsum_bench")
    assert done.returncode == 1, done.stdout + done.stderr
    wrong = {b["name"].split("/")[0]: b for b in json.loads(done.stdout)["benchmarks"]}
    assert wrong["wrong_passes"]["error_occurred"] and "rate" in wrong["wrong_passes"]["error_message"]
    assert "error_occurred" not in wrong["naive"] and wrong["naive"]["real_time"] > 0


def refused(done, *says):
    assert done.returncode == 2, done.stdout + done.stderr
    assert done.stdout == ""
    assert len(done.stderr.splitlines()) == 1, done.stderr
    for word in says:
        assert word in done.stderr, done.stderr


@pytest.mark.parametrize("name, says", [
    ("absent", ["cannot open", "No such file"]),
    ("text", ["cannot open", "invalid ELF header"]),
    ("bare", ["no plug-in", "PAIRSUM_PLUGIN"]),
    ("other", ['of build "0.0.9 of another build"', 'this program of "0.1', "rebuild the plug-in"]),
    ("coloured", ["a name or description in it has control characters"]),
    ("taken", ["there is a backend naive already"])])
@pytest.mark.parametrize("program, words", [("pairsum", ["list"]), ("pairsum_bench", [])])
def test_refusals(call, folder, program, words, name, says):
    file = folder / f"{name}.so"
    refused(call(*words, "--plugin", file, program=program), str(file), *says)


def test_other_refusals(call, plugin, folder):
    refused(call("list", "--plugin", plugin, "--plugin", folder / "copy.so"), "copy.so", "there is a plug-in example already")
    refused(call("list", "--plugin", ""), "--plugin")
    refused(call("list", "--plugin", "a:b.so"), "a:b.so", "colon")
    refused(call("list", "--plugin", "a\nb.so"), r"a\nb.so", "control characters")
    refused(call("list", PAIRSUM_PLUGINS=folder / "absent.so"), "absent.so")
    refused(call("run", "compilers", "--plugin", plugin, "--program", "/bin/true"), "--plugin", "compares builds")
