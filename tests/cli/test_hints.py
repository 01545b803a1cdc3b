"""A misspelt word is refused with the one that was meant; a word that is far from all with those that there are."""

import pytest
from conftest import refused

SMALL = ["run", "--dx", "0.08", "--M", "3"]
MISSPELT = [
    (["verfy"], 'unknown command "verfy"; did you mean verify?'),
    (["tuen"], 'unknown command "tuen"; did you mean tune?'),
    (["--verison"], "unknown option --verison of pairsum; did you mean --version?"),
    (["run", "--bugdet", "3"], "unknown option --bugdet of pairsum run; did you mean --budget?"),
    (["run", "--bugdet=3"], "unknown option --bugdet of pairsum run; did you mean --budget?"),
    (["tune", "--backends", "naive"], "unknown option --backends of pairsum tune; did you mean --backend?"),
    (["verify", "--smothing", "all"], "unknown option --smothing of pairsum verify; did you mean --smoothing?"),
    (["verify", "backend"], 'pairsum verify does not take "backend"; did you mean --backend?'),
    (["list", "--jsno"], "unknown option --jsno of pairsum list; did you mean --json?"),
    (["report", "rows.jsonl", "--tabels"], "unknown option --tabels of pairsum report; did you mean --tables?"),
    (["run", "quick", "--only", "bakcend=naive"], 'unknown level of --only "bakcend"; did you mean backend?'),
    (["run", "quick", "--only", "backend=symetric"], "has no backend symetric; did you mean symmetric?"),
    (["convert", "--fluids", "a.vtp", "b.hdf"], "unknown option --fluids of pairsum convert; did you mean --fluid?"),
    (["history", "--phase", "totl"], 'unknown phase "totl"; did you mean total?'),
    (["run", "tlak"], 'unknown plan "tlak"; did you mean talk?'),
    ([*SMALL, "--backend", "symetric_omp"], 'unknown backend "symetric_omp"; did you mean symmetric_omp?'),
    ([*SMALL, "--backend", "sliced"], "did you mean sliced_locks or sliced_2colour or sliced_2colour_tbb?"),
    ([*SMALL, "--case", "dambreak"], 'unknown case "dambreak"; did you mean dam_break?'),
    ([*SMALL, "--state", "perturbd"], 'unknown state "perturbd"; did you mean perturbed?'),
    ([*SMALL, "--interaction", "ferari09"], 'unknown interaction "ferari09"; did you mean ferrari09?'),
    ([*SMALL, "--smoothing", "wendlandc2"], 'unknown smoothing kernel "wendlandc2"; did you mean wendland_c2'),
    ([*SMALL, "--precision", "doubel"], 'unknown precision "doubel"; did you mean double?'),
    ([*SMALL, "--integrator", "euller"], 'unknown integrator "euller"; did you mean euler?'),
    ([*SMALL, "--grid", "hash_grid"], 'unknown grid "hash_grid"; did you mean hashed_grid?'),
    ([*SMALL, "--order", "lattce"], 'unknown order "lattce"; did you mean lattice?'),
    ([*SMALL, "--isa", "bset"], 'unknown isa "bset"; did you mean best?'),
    ([*SMALL, "--outside", "dorp"], 'unknown value of --outside "dorp"; did you mean drop?'),
    ([*SMALL, "--binding", "core_first"], 'unknown binding "core_first"; did you mean cores_first?'),
    (["tune", "--phase", "totl"], 'unknown phase "totl"; did you mean total?'),
    (["verify", "--backend", "tiles_opm"], 'unknown backend "tiles_opm"; did you mean tiles_omp?'),
]


@pytest.mark.parametrize("words, says", MISSPELT, ids=[" ".join(w) for w, _ in MISSPELT])
def test_a_misspelt_word_is_refused_with_what_was_meant(pairsum, words, says):
    assert refused(pairsum(*words), says)


def test_what_was_meant_is_not_followed_by_a_long_list(pairsum):
    assert pairsum("verify", "--backend", "tiles_opm").stderr.endswith("did you mean tiles_omp?\n")
    assert "valid: naive, naive_omp, " in pairsum("verify", "--backend", "xyzzy").stderr


@pytest.mark.parametrize("words", [
    ["xyzzy"], ["--xyzzy"], ["run", "--xyzzy", "3"], ["run", "xyzzy"], ["verify", "xyzzy"], ["report", "rows.jsonl", "--xyzzy"],
    *([*SMALL, f"--{level}", "xyzzy"] for level in ["backend", "case", "state", "interaction", "smoothing", "precision", "integrator", "grid",
                                                   "order", "isa", "outside", "binding"])], ids=" ".join)
def test_nothing_is_hinted_for_a_word_that_is_far_from_all(pairsum, words):
    done = pairsum(*words)
    assert refused(done, "xyzzy") and "did you mean" not in done.stderr


def test_keys_of_a_plan_file(pairsum, tmp_path):
    plan = tmp_path / "p.json"
    plan.write_text('{"schema": "pairsum.plan/1", "study": "s", "parts": [{"name": "a", "thread": 1}]}')
    assert refused(pairsum("run", plan, "--dry-run"), '"thread" is not known; did you mean threads? there are')
    plan.write_text('{"schema": "pairsum.plan/1", "study": "s", "parts": [{"name": "a", "xyzzy": 1}]}')
    done = pairsum("run", plan, "--dry-run")
    assert refused(done, '"xyzzy" is not known; there are') and "did you mean" not in done.stderr
