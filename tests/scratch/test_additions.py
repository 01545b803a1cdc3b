"""One file and one word in a list add a backend, and a formula."""

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
    assert sorted(lines) == sorted(f"+ {a.line}" for a in additions)


def test_another_change_is_seen():
    before = {REGISTRY: b"a\nb\n", "other": b"1"}
    assert changes(before, {REGISTRY: b"a\nc\n", "other": b"2", "new": b""}) == ({"new"}, {REGISTRY, "other"}, ["- b", "+ c"])
    assert changes(before, {REGISTRY: b"a\nb\n"}) == (set(), {"other"}, [])


def test_the_document_has_one_of_each():
    folders = [a.path.split("/")[1] for a in documented().values()]
    assert sorted(folders) == ["backends", "formulas"]


def test_each_is_listed(listed):
    assert {"my_sum", "wrong_sum", "naive", "tiles_omp"} <= {b["name"] for b in listed["backends"]}
    assert "my_pairs" in listed["interactions"]


@pytest.mark.parametrize("backend, interaction", [("my_sum", "ferrari09"), ("my_sum", "my_pairs"), ("symmetric_omp", "my_pairs"),
                                                  ("tiles_omp", "my_pairs")])
def test_each_is_verified(pairsum, backend, interaction):
    done = pairsum("verify", "--backend", backend, *QUICK, "--interaction", interaction)
    assert done.returncode == 0, done.stdout + done.stderr
    agree, of = done.stdout.splitlines()[-1].split()[0:3:2]
    assert agree == of and int(of) > 0


@pytest.mark.parametrize("interaction", ["my_pairs", "ferrari09"])
def test_a_backend_that_drops_pairs_is_found_out(pairsum, interaction):
    done = pairsum("verify", "--backend", "wrong_sum", *QUICK, "--interaction", interaction)
    assert done.returncode == 1, done.stdout + done.stderr
    assert "FAILED" in done.stdout


@pytest.mark.parametrize("line, says", [
    ("BACKEND(nowhere)", "no file kernels/backends/nowhere.cpp"),
    ("FORMULA(nowhere, plain)", "no file kernels/formulas/nowhere.cpp"),
    ("SMOOTHING(nowhere)", "no file kernels/smoothing/nowhere.hpp"),
    ("CASE(nowhere)", "no file kernels/cases/nowhere.cpp"),
    ("INTEGRATOR(nowhere)", "no file kernels/integrators/nowhere.cpp"),
    ("BACKEND(now here)", "is no word of the form KIND(name)")])
def test_a_word_without_a_file_is_refused(tmp_path, line, says):
    folder = copy(tmp_path)
    Addition("", "", "", line).list(folder)
    done = configure(folder, "-DPAIRSUM_HARNESS=OFF")
    message = " ".join(done.stdout.split())
    assert done.returncode != 0 and says in message and REGISTRY in message and line.partition(",")[0].rstrip(")") in message


def test_what_was_left_out_is_listed_with_the_option_that_brings_it(listed, pairsum):
    missing = {(m["kind"], m["word"]): m["option"] for m in listed["unavailable"]}
    assert missing[("dimension", "3")] == "PAIRSUM_DIMS" and ("dimension", "2") not in missing
    assert missing[("precision", "float")] == "PAIRSUM_PRECISIONS"
    assert missing[("interaction", "monaghan94")] == "PAIRSUM_INTERACTIONS"
    assert missing[("smoothing kernel", "gaussian")] == "PAIRSUM_SMOOTHINGS"
    assert "in other builds" in pairsum("list").stdout
    assert "-DPAIRSUM_SMOOTHINGS=all" in pairsum("list", "smoothings").stdout


@pytest.mark.parametrize("words, option", [(["--precision", "float"], "PAIRSUM_PRECISIONS"), (["--dim", "3"], "PAIRSUM_DIMS"),
                                           (["--interaction", "count"], "PAIRSUM_INTERACTIONS"),
                                           (["--smoothing", "gaussian"], "PAIRSUM_SMOOTHINGS")])
def test_what_was_left_out_is_refused_with_the_option_that_brings_it(pairsum, words, option):
    here = {"--dim": "2", "--interaction": "my_pairs", "--smoothing": "wendland_c2", "--backend": "my_sum", **dict([words])}
    done = pairsum("run", *[word for pair in here.items() for word in pair])
    assert done.returncode == 2 and f"-D{option}=" in done.stderr and done.stderr.count("\n") == 1


@pytest.mark.parametrize("option, valid", [("DIMS=4", "1;2;3"), ("DIMS=", "1;2;3"), ("PRECISIONS=half", "double;float"),
                                           ("SMOOTHINGS=gauss", "wendland_c2"), ("INTERACTIONS=", "ferrari09")])
def test_an_option_with_a_wrong_word_is_refused(tmp_path, option, valid):
    everything = [f"-DPAIRSUM_{choice}=all" for choice in ["DIMS", "PRECISIONS", "INTERACTIONS", "SMOOTHINGS"]]
    done = configure(copy(tmp_path), "-DPAIRSUM_HARNESS=OFF", *everything, f"-DPAIRSUM_{option}")
    assert done.returncode != 0
    assert option.split("=")[0] in done.stdout and valid in done.stdout
