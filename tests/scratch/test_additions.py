"""One file and one word in a list add a backend, a smoothing kernel, an interaction, a case and an integrator."""

import difflib

import pytest

from conftest import REGISTRY, Addition, configure, copy, documented

QUICK = ["--dx", "0.02", "--M", "2,4", "--threads", "1,2"]


def changes(before, after):
    """New files, changed files, and the lines that changed in the registry."""
    new = {name for name in after if name not in before}
    changed = {name for name in after if name in before and after[name] != before[name]} | (before.keys() - after.keys())
    lines = difflib.ndiff(before[REGISTRY].decode().splitlines(), after[REGISTRY].decode().splitlines())
    return new, changed, [line for line in lines if line[0] in "+-"]


def test_each_is_one_file_and_one_line(tree, additions):
    new, changed, lines = changes(*tree[1:])
    assert new == {a.path for a in additions}
    assert changed == {REGISTRY}
    assert sorted(lines) == sorted(f"+   {a.word}" for a in additions)


def test_another_change_is_seen():
    before = {REGISTRY: b"a\nb\n", "other": b"1"}
    assert changes(before, {REGISTRY: b"a\nc\n", "other": b"2", "new": b""}) == ({"new"}, {REGISTRY, "other"}, ["- b", "+ c"])
    assert changes(before, {REGISTRY: b"a\nb\n"}) == (set(), {"other"}, [])


def test_the_document_has_one_of_each():
    folders = [a.path.split("/")[1] for a in documented().values()]
    assert sorted(folders) == ["backends", "cases", "integrators", "interactions", "smoothing"]


def test_each_is_listed(listed):
    names = {kind: [entry["name"] for entry in listed[kind] if not entry.get("unavailable")]
             for kind in ["backends", "cases", "integrators"]}
    assert {"my_sum", "wrong_sum"} == set(names["backends"])
    assert "my_case" in names["cases"]
    assert "my_steps" in names["integrators"]
    assert "my_kernel" in listed["smoothings"]
    assert "my_pairs" in listed["interactions"]


@pytest.mark.parametrize("words", [["--interaction", "ferrari09"], ["--interaction", "my_pairs"], ["--case", "my_case"],
                                   ["--smoothing", "my_kernel"]])
def test_each_is_verified(pairsum, words):
    done = pairsum("verify", "--backend", "my_sum", *QUICK, *words)
    assert done.returncode == 0, done.stdout + done.stderr
    agree, of = done.stdout.splitlines()[-1].split()[0:3:2]
    assert agree == of and int(of) > 0


def test_the_integrator_makes_verified_steps(pairsum, tmp_path):
    done = pairsum("run", "--case", "lattice", "--dim", "2", "--dx", "0.05", "--state", "perturbed", "--smoothing", "my_kernel",
                   "--backend", "my_sum", "--integrator", "my_steps", "--M", "4", "--threads", "1", "--steps", "3",
                   "--rounds", "1", "--repetitions", "1", "--out", tmp_path / "rows.jsonl")
    assert done.returncode == 0, done.stdout + done.stderr
    assert (tmp_path / "rows.jsonl").read_text().count('"integrator":"my_steps"') == 3


@pytest.mark.parametrize("words", [["--interaction", "my_pairs"], ["--interaction", "ferrari09"], ["--case", "my_case"]])
def test_a_backend_that_drops_pairs_is_found_out(pairsum, words):
    done = pairsum("verify", "--backend", "wrong_sum", *QUICK, *words)
    assert done.returncode == 1, done.stdout + done.stderr
    assert "FAILED" in done.stdout


@pytest.mark.parametrize("registry, path", [
    ("PAIRSUM_ALL_BACKENDS", "kernels/backends/nowhere.hpp"),
    ("PAIRSUM_ALL_SMOOTHINGS", "kernels/smoothing/nowhere.hpp"),
    ("PAIRSUM_ALL_SMOOTHED_INTERACTIONS", "kernels/interactions/nowhere.hpp"),
    ("PAIRSUM_ALL_PLAIN_INTERACTIONS", "kernels/interactions/nowhere.hpp"),
    ("PAIRSUM_ALL_CASES", "kernels/cases/nowhere.hpp"),
    ("PAIRSUM_ALL_INTEGRATORS", "kernels/integrators/nowhere.hpp")])
def test_a_word_without_a_file_is_refused(tmp_path, registry, path):
    folder = copy(tmp_path)
    Addition(path, "nowhere", "", registry).list(folder)
    done = configure(folder, "-DPAIRSUM_HARNESS=OFF")
    assert done.returncode != 0
    message = " ".join(done.stdout.split())
    assert f"there is no file {path}" in message and registry in message


def test_what_was_left_out_is_listed_with_the_option_that_brings_it(listed, pairsum):
    missing = {(m["kind"], m["word"]): m["option"] for m in listed["unavailable"]}
    assert missing[("dimension", "3")] == "PAIRSUM_DIMS" and ("dimension", "2") not in missing
    assert missing[("precision", "float")] == "PAIRSUM_PRECISIONS"
    assert missing[("interaction", "monaghan94")] == "PAIRSUM_INTERACTIONS"
    assert missing[("smoothing kernel", "gaussian")] == "PAIRSUM_SMOOTHINGS"
    assert "PAIRSUM_BACKENDS" in {b["name"]: b["unavailable"] for b in listed["backends"]}["naive"]
    assert "unavailable" in pairsum("list").stdout


@pytest.mark.parametrize("words, option", [(["--precision", "float"], "PAIRSUM_PRECISIONS"), (["--dim", "3"], "PAIRSUM_DIMS"),
                                           (["--interaction", "count"], "PAIRSUM_INTERACTIONS"),
                                           (["--smoothing", "gaussian"], "PAIRSUM_SMOOTHINGS"),
                                           (["--backend", "naive"], "PAIRSUM_BACKENDS")])
def test_what_was_left_out_is_refused_with_the_option_that_brings_it(pairsum, words, option):
    here = {"--dim": "2", "--interaction": "my_pairs", "--smoothing": "my_kernel", "--backend": "my_sum", **dict([words])}
    done = pairsum("run", *[word for pair in here.items() for word in pair])
    assert done.returncode == 2 and f"-D{option}=" in done.stderr and done.stderr.count("\n") == 1


@pytest.mark.parametrize("option, valid", [("DIMS=4", "1;2;3"), ("DIMS=", "1;2;3"), ("PRECISIONS=half", "double;float"),
                                           ("SMOOTHINGS=gauss", "wendland_c2"), ("BACKENDS=gpu", "naive")])
def test_an_option_with_a_wrong_word_is_refused(tmp_path, option, valid):
    everything = [f"-DPAIRSUM_{choice}=all" for choice in ["DIMS", "PRECISIONS", "BACKENDS", "INTERACTIONS", "SMOOTHINGS"]]
    done = configure(copy(tmp_path), "-DPAIRSUM_HARNESS=OFF", *everything, f"-DPAIRSUM_{option}")
    assert done.returncode != 0
    assert option.split("=")[0] in done.stdout and valid in done.stdout
