"""pairsum list: everything on one screen, a line each of one kind, all that a backend says of itself."""

import json
import os
import pathlib
import re

import pytest
from conftest import refused

SOURCE = pathlib.Path(os.environ["PAIRSUM_SOURCE"])
KINDS = ["backends", "plans", "cases", "interactions", "smoothings", "integrators", "grids", "precisions", "dims", "orders", "states", "isas"]


@pytest.fixture
def listed(pairsum):
    return json.loads(pairsum("list", "--json").stdout)


def fits_a_screen(text):
    lines = text.splitlines()
    return len(lines) <= 24 and max(map(len, lines)) <= 80


def test_the_check_of_a_screen_rejects():
    assert not fits_a_screen("x\n" * 25) and not fits_a_screen("x" * 81) and fits_a_screen("x" * 80)


def test_everything_is_on_one_screen(pairsum, listed):
    done = pairsum("list")
    assert done.returncode == 0 and fits_a_screen(done.stdout), done.stdout
    for backend in listed["backends"]:
        family = re.search(rf"^  {backend['conflicts']} (.*\n(?: {{11}}.*\n)*)", done.stdout, re.M)[1]
        assert re.sub("_(omp|tbb)$", "", backend["name"]) in re.split(r"[,\s]+", family)
    for kind in KINDS[1:]:
        words = [w["name"] if isinstance(w, dict) else str(w) for w in listed[kind]]
        line = re.search(rf"^{kind} +(\d+)  (.*)$", done.stdout, re.M)
        assert line[2].startswith(words[0]), line[0]
        assert kind == "plans" or all(re.search(rf"\b{re.escape(word)}\b", done.stdout) for word in words)
    assert f"\ninteractions {len(listed['interactions']):>3}  " in done.stdout
    plans = re.search(rf"^plans +{len(listed['plans'])}  (.*\n +.*)$", done.stdout, re.M)[1]
    assert re.findall(r"\w+", plans.split("(")[0]) == [p["name"] for p in listed["plans"]] and "compilers*" in plans
    assert "pairsum list backends NAME" in done.stdout


@pytest.mark.parametrize("word, said", [("tiles_omp", "backends: pairsum list backends tiles_omp"),
                                        ("dam_break", "cases: pairsum list cases"), ("quick", "plans: pairsum list plans")])
def test_a_word_of_a_kind_is_told_where_it_is(pairsum, word, said):
    assert refused(pairsum("list", word), f'"{word}" is one of the {said}')


@pytest.mark.parametrize("kind", KINDS)
def test_a_kind_has_a_line_for_each_word(pairsum, listed, kind):
    done = pairsum("list", kind)
    assert (done.returncode, done.stderr) == (0, "")
    words = [w["name"] if isinstance(w, dict) else str(w) for w in listed[kind]]
    firsts = [line.split()[0] for line in done.stdout.splitlines() if not line.startswith(" ")]
    assert [word for word in firsts if word in words] == words
    for word in listed[kind]:
        if isinstance(word, dict) and "description" in word:
            assert re.search(rf"^{word['name']} .*{re.escape(word['description'])}$", done.stdout, re.M)
    for missing in listed["unavailable"]:
        if (kind, missing["kind"]) in [("interactions", "interaction"), ("smoothings", "smoothing kernel"), ("precisions", "precision"), ("dims", "dimension")]:
            assert re.search(rf"^{missing['word']} +not in this build; configure with -D{missing['option']}=all$", done.stdout, re.M)


def test_a_line_of_a_backend_names_family_and_runtime(pairsum, listed):
    text = pairsum("list", "backends").stdout
    for b in listed["backends"]:
        assert re.search(rf"^{b['name']} +{b['conflicts']} +{b['runtime']} +{re.escape(b['description'])}$", text, re.M), b["name"]


def anchors(document):
    return {"#" + re.sub("[^a-z0-9 -]", "", title.lower()).replace(" ", "-") for title in re.findall("^## (.*)$", document, re.M)}


def test_a_backend_says_all_of_itself_and_its_source_and_section_exist(pairsum, listed):
    sections = anchors((SOURCE / "docs/strategies.md").read_text())
    assert "#gather" in sections
    for b in listed["backends"]:
        text = pairsum("list", "backends", b["name"]).stdout
        said = dict(re.findall(r"^  (\S[a-z ]*?) {2,}(.*)$", text, re.M))
        assert text.startswith(f"{b['name']}: {b['description']}\n")
        assert said["family"].startswith(b["conflicts"] + ": ") and said["runtime"] == b["runtime"]
        assert said["each pair"].startswith("is computed once" if b["symmetric"] else "is computed twice")
        assert said["same bits"].startswith("for every number" if b["deterministic"] else "no")
        assert said["grids"].split(", ") == listed["grids"] and said["precisions"].split(", ") == b["precisions"]
        isas = ["scalar"] if b["conflicts"] == "atomics" else ["scalar", *listed["isas"]]
        assert said["isa"].split("; ")[0].split(", ") == isas
        assert said["blocks"].startswith("yes" if b["blocks"] else "no")
        assert (SOURCE / said["source"]).is_file()
        path, anchor = said["docs"].split("#")
        assert path == "docs/strategies.md" and "#" + anchor in sections


def test_a_plan_says_what_it_asks_and_what_this_build_lacks_of_it(pairsum, listed):
    text = pairsum("list", "plans").stdout
    lacks = {m["word"] for m in listed["unavailable"]}
    for plan in listed["plans"]:
        shown = json.loads((SOURCE / f"harness/plan/plans/{plan['name']}.json").read_text())
        entry = re.search(rf"^{plan['name']} +{shown['budget_s']} s  (.*\n(?: {{21}}.*\n)*)", text, re.M)[1]
        entry = re.sub(r"\s+", " ", entry)
        assert entry.startswith(shown["title"])
        assert ("name the other with --program" in entry) == (plan["name"] == "compilers")
        wanted = {"vector": "precision mixed", "field": "dimension 2"}.get(plan["name"])
        if wanted:
            assert (f"{wanted} is not in this build; configure with -D" in entry) == (wanted.split()[1] in lacks), entry
    assert max(map(len, text.splitlines())) <= 80


def test_plans_that_the_build_cannot_run_can_be_dry_run(pairsum, listed):
    lacks = {m["word"] for m in listed["unavailable"]}
    for plan in listed["plans"]:
        done = pairsum("run", plan["name"], "--dry-run")
        assert (done.returncode, done.stderr) == (0, ""), plan["name"]
    vector = pairsum("run", "vector", "--dry-run").stdout
    assert ("left out: precision mixed is not in this build" in vector) == ("mixed" in lacks)
    assert ("part float_perturbed: nothing of it can be measured here" in vector) == ("float" in lacks)
    assert re.search(r"^part double_rest: \d+ points", vector, re.M)
    assert "compares 2 builds" in pairsum("run", "compilers", "--dry-run").stdout
    if "mixed" in lacks:
        assert refused(pairsum("run", "vector"), "precision mixed is not in this build")
    assert refused(pairsum("run", "compilers"), "--program")


@pytest.mark.parametrize("words, says", [
    (["backend"], ['unknown kind "backend"; did you mean backends?', "valid: backends, plans, cases"]),
    (["octrees"], ['unknown kind "octrees"; valid: backends']),
    (["backends", "symetric_omp"], ['unknown backend "symetric_omp"; did you mean symmetric_omp?']),
    (["plans", "talk"], ["of one of the backends alone"]),
    (["plans", "--json"], ["list --json prints everything"]),
])
def test_list_refuses(pairsum, words, says):
    assert refused(pairsum("list", *words), *says)
