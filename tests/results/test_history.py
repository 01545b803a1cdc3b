"""The history of made revisions whose changes, and whose machines' pace, are known."""
import re

import artists
import made
import numpy as np
import pandas as pd
import pytest
import scipy.stats

import pairsum_results as pr
from pairsum_results import __main__ as program
from pairsum_results import figures, stats
from pairsum_results.figures import revisions
from pairsum_results.figures.sheet import sheet
from pairsum_results.history import load_history
from pairsum_results.history_report import notes, tracks

BACKENDS = ["naive", "symmetric", "naive_omp", "symmetric_omp", "locks_omp", "copies_omp"]


@pytest.fixture
def measure(tmp_path):
    """Writes the rows of a revision: each backend's time times what `change` says, on a machine that is so slow, and
    whose pace shows it. Every point and the paces have 1 % of scatter, and the rounds that of made.py."""
    def of(git, day, change={}, slow=1.0, paces=True, rounds=12, environment={}, backends=BACKENDS, schema=3, **place):
        random = np.random.default_rng(day)
        name, paced = f"{day:016x}", random.normal(1, 0.01, rounds)

        def point(backend, time):
            noise = random.normal(0, 0.01, rounds)
            factor = slow * time * change.get(backend, 1)
            return (made.point(backend, 6, 2 if "_" in backend else 1, **place), factor,
                    lambda k: {"time": np.exp(noise[k - 1]), "environment": name})

        before = [made.environment(name, git=git, **environment), *(
            {**made.pace(k, threads, threads * 1e9 * paced[k - 1] / slow / made.DISTURBANCE[(k - 1) % 6]), "environment": name}
            for k in range(1, rounds + 1) for threads in (1, 2) if paces), *(
            {**made.peak(threads, threads * 1e9 / slow, 1e10), "environment": name} for threads in (1, 2))]
        rows = made.study([point(backend, 1 / (k + 1)) for k, backend in enumerate(backends)], rounds, before)
        rows = [{**row, "utc": f"2026-11-{day:02d}T00:00:00Z"} for row in rows]
        rows = [row for row in map(made.former, rows) if row] if schema == 2 else rows
        return made.write(tmp_path / f"all/talk/{git}-{day}.jsonl", rows)
    return of


def verdicts(h):
    return h.steps.join(h.lines[["backend"]], on="line").set_index("backend")["verdict"].to_dict()


def test_a_slower_backend_is_found_and_no_other_accused(measure):
    h = load_history([measure("bbbb222", 2, {"symmetric_omp": 1.1}, slow=1.4), measure("aaaa111", 1)])
    assert h.revisions["git"].to_list() == ["aaaa111", "bbbb222"]  # as measured, not as named
    assert verdicts(h) == {**dict.fromkeys(BACKENDS, "not resolved"), "symmetric_omp": "slower"}
    found = h.slower.iloc[0]
    assert found["low"] < 1 / 1.1 < found["high"] and found["high"] - found["low"] < 0.05
    assert found["time_s"] / found["base_time_s"] == pytest.approx(1.4 * 1.1, rel=0.02)  # as timed, which is said, too
    assert h.steps["machine_ratio"].to_list() == pytest.approx([1 / 1.4] * 6, rel=0.01)
    assert h.steps["newest"].all() and (h.steps["rounds"] == 0).all()


def test_a_copy_of_a_revisions_rows_changes_nothing(measure, tmp_path):
    files = [measure("aaaa111", 1), measure("bbbb222", 2, {"symmetric_omp": 1.1}, slow=1.4)]
    wanted = load_history(files)
    for file in files:
        lines = file.read_text().splitlines(keepends=True)
        for name, kept in (("whole", lines), ("half", lines[:len(lines) // 2])):
            copy = tmp_path / name / file.name
            copy.parent.mkdir(exist_ok=True)
            copy.write_text("".join(kept))
            found = load_history([*files, copy])
            pd.testing.assert_frame_equal(found.steps, wanted.steps)
            assert found.revisions["git"].to_list() == ["aaaa111", "bbbb222"] and len(found.slower) == 1


def test_without_paces_a_slow_machine_is_taken_for_a_slow_revision(measure):
    """The test above must be able to fail: its finding hangs on the paces."""
    h = load_history([measure("aaaa111", 1, paces=False, rounds=30), measure("bbbb222", 2, slow=1.4, rounds=30)])
    assert set(verdicts(h).values()) == {"slower"} and h.steps["machine_ratio"].isna().all()
    assert h.steps["ratio"].to_list() == pytest.approx([1 / 1.4] * 6, rel=0.02)


def test_nothing_is_accused_that_did_not_change(measure):
    h = load_history([measure("aaaa111", 1), measure("bbbb222", 2, slow=0.7), measure("cccc333", 3, slow=1.2)])
    assert set(h.steps["verdict"]) == {"not resolved"} and len(h.steps) == 12 and h.slower.empty
    assert h.steps.groupby("line")["revision"].agg(list).to_list() == [[1, 2]] * 6


def test_only_the_newest_revision_of_a_machine_is_guilty(measure, capsys, tmp_path):
    files = [measure("aaaa111", 1), measure("bbbb222", 2, {"naive": 1.2}), measure("cccc333", 3, {"naive": 1.2})]
    h = load_history(files)
    assert (h.steps["verdict"] == "slower").sum() == 1 and h.slower.empty
    assert program.main(["history", *map(str, files), "--out", str(tmp_path / "out")]) == 0
    assert " ".join(capsys.readouterr().out.split()).startswith(
        "0 of 6 points got slower, 0 faster, 6 not resolved, in the newest revision of their machine; 1 of 6 points got "
        "slower, 0 faster, 5 not resolved, in revisions before (sum, 95 % confidence over each of the two).")


def test_a_long_history_does_not_blunt_the_verdict_on_the_newest(tmp_path):
    error = np.sqrt(2 * np.log(np.resize(made.DISTURBANCE, 12)).var(ddof=1) / 12)
    slower = np.exp(scipy.stats.t.isf(0.002, 22) * error)  # by Welch, p = 0.004
    for k in range(1, 8):
        e = made.environment(f"{k:016x}", git=f"{k:07x}", utc=f"2026-11-0{k}T00:00:00Z")
        made.write(tmp_path / f"{k}.jsonl", made.study(
            [(made.point(name), slower if k == 7 and name == "naive" else 1.0, {"environment": e["environment"]})
             for name in BACKENDS], 12, [e]))
    steps = load_history(tmp_path).steps
    assert sorted(steps.loc[steps["newest"], "p"]) == pytest.approx([0.004, 1, 1, 1, 1, 1]) and len(steps) == 36
    assert steps.loc[steps["verdict"] != "not resolved", ["newest", "verdict"]].to_numpy().tolist() == [[True, "slower"]]
    assert set(stats.verdicts(steps)) == {"not resolved"}  # Holm over all of them: 0.004 > 0.05 / 36


def test_another_machine_is_no_revision_but_stands_beside(measure):
    elsewhere = {"host": "other", "cpu": "another model"}
    h = load_history([measure("aaaa111", 1), measure("aaaa111", 2, slow=2, environment=elsewhere)])
    assert h.steps.empty and len(h.elsewhere) == 6 and h.machines["name"].to_list() == ["node", "other"]
    e = h.elsewhere.iloc[0]
    assert e["low"] < 0.5 < e["high"] and e["bandwidth_ratio"] == 1
    assert e["flops_ratio"] == pytest.approx(0.5, rel=0.02)
    assert (h.lines["machine"][e["base"]], h.lines["machine"][e["line"]]) == (0, 1)
    h = load_history([measure("aaaa111", 1), measure("bbbb222", 2, environment=elsewhere)])
    assert h.steps.empty and h.elsewhere.empty  # another revision on another machine: nothing to compare


@pytest.mark.parametrize("change", [{"cores": 4}, {"compiler": "Clang 14.0.6"}, {"binding": "none: EPERM"}])
def test_other_compilers_cores_and_bindings_are_no_revision_either(measure, change):
    assert load_history([measure("aaaa111", 1), measure("bbbb222", 2, environment=change)]).steps.empty


def test_flags_belong_to_the_revision_unless_one_was_measured_with_several(measure):
    files = [measure("aaaa111", 1), measure("bbbb222", 2, environment={"flags": "-O2"})]
    assert len(load_history(files).steps) == 6
    h = load_history([*files, measure("bbbb222", 3)])
    assert h.steps["line"].nunique() == len(h.steps) == 6 and sorted(h.machines["name"]) == ["node, -O2", "node, -O3"]


def test_steps_of_another_number_are_compared_in_the_summation_alone(measure):
    files = [measure("aaaa111", 1), measure("bbbb222", 2)]
    text = files[1].read_text()
    lines = [line for line in text.splitlines() if '"step": 2' not in line]
    files[1].write_text("\n".join(lines).replace('"rows": 12', '"rows": 6') + "\n")
    assert len(load_history(files).steps) == 6 and load_history(files, "total_s").steps.empty


def test_points_that_lost_other_numbers_of_particles_are_other_points(measure):
    before, after = measure("aaaa111", 1), measure("bbbb222", 2, {"naive": 1.3})
    assert verdicts(load_history([before, after]))["naive"] == "slower"
    before.write_text(re.sub(r'"lost": \w+', '"lost": 7', before.read_text()))
    assert load_history([before, after]).steps.empty


def test_uncommitted_changes_have_no_revision(measure, tmp_path, capsys):
    files = [measure("aaaa111", 1), measure("bbbb222", 2, {"naive": 2}, environment={"dirty": True})]
    assert program.main(["history", *map(str, files), "--out", str(tmp_path / "out")]) == 0
    out = capsys.readouterr().out
    assert out.startswith("No point was measured with two revisions on one machine: 6 points, 1 revision")
    assert "12 rounds left out: built from a tree with uncommitted changes" in out


def test_revisions_measured_in_the_same_rounds_are_paired(tmp_path):
    one, two = (made.environment(digit * 16, git=git, utc=f"2026-11-0{digit}T00:00:00Z")
                for digit, git in (("1", "bbbb222"), ("2", "aaaa111")))
    points = [(made.point(name), 1.0, {"environment": e["environment"], "time": factor})
              for name in BACKENDS for e, factor in ((two, 1.02), (one, 1))]  # in whichever order rounds took them
    h = load_history([made.write(tmp_path / "rows.jsonl", made.study(points, before=[one, two]))])
    assert h.revisions["git"].to_list() == ["bbbb222", "aaaa111"]
    assert h.steps["rounds"].to_list() == [6] * 6 and not any("apart" in note for note in notes(h))
    assert h.steps["ratio"].to_list() == pytest.approx([1 / 1.02] * 6)


def test_rounds_of_the_same_number_in_several_studies_are_different_rounds(tmp_path):
    one, two = (made.environment(digit * 16, git=git, utc=f"2026-11-0{digit}T00:00:00Z", dirty=digit == "3")
                for digit, git in (("1", "aaaa111"), ("2", "bbbb222")))

    def rows(*environments):
        content = made.study([(made.point("naive"), 1.0, {"environment": e["environment"]}) for e in environments],
                             before=list(environments))
        return [*content, *({**row, "study": "field"} for row in content if row["kind"] in ("sample", "round"))]

    assert load_history(made.write(tmp_path / "a.jsonl", rows(one, two))).steps["rounds"].to_list() == [12]
    dirty = made.environment("3" * 16, dirty=True)
    assert load_history(made.write(tmp_path / "b.jsonl", rows(dirty, one))).dirty == 12


def test_the_program_says_what_is_slower_and_ends_with_1(measure, tmp_path, capsys):
    for git, day, change in (("aaaa111", 1, {}), ("bbbb222", 2, {"locks_omp": 1.3, "naive": 0.7})):
        measure(git, day, change, slow=1 + 0.1 * day, schema=1 + day)
    assert program.main(["history", str(tmp_path / "all")]) == 1  # the rows are in a folder below
    out, folder = capsys.readouterr().out, tmp_path / "all/history"
    assert out.startswith("1 of 6 points got slower, 1 faster, 4 not resolved, in the newest revision of their machine")
    slower = re.search(r"slower now; problem: dam_break 3D dx=0.00594; machine: node; from: aaaa111; to: bbbb222\n"
                       r"point +ms +ms now +pace +ratio \[low, high\]\nlocks_omp M=6 threads=2 .* 0\.7\d\d \[", out)
    assert slower and "faster now" in out and f"page: {folder / 'history.html'}\n" in out
    steps = pd.read_csv(folder / "history.csv")
    assert len(steps) == 6 and steps.set_index("backend")["verdict"]["locks_omp"] == "slower"
    page = (folder / "history.html").read_text()
    assert page.count("<svg") == 6
    assert page.index("Slower in the newest revision (1)") < page.index("Changed (1)") < page.index("No change resolved (4)")
    label = 'aria-label="locks_omp M=6, dam_break 3D dx=0.00594, node, time over revisions"'
    assert label in page.split("Changed (1)")[0]
    assert program.main(["history", str(tmp_path / "all"), "--phase", "total", "--out", str(tmp_path / "out")]) == 1


def test_points_that_move_together_are_said_to(measure):
    alike = dict.fromkeys(BACKENDS, 1.3)  # but for the pace, as if the machine had changed
    said = [note for note in notes(load_history([measure("aaaa111", 1), measure("bbbb222", 2, alike)])) if "together" in note]
    assert said == []  # fewer than 5 on either number of threads
    names = ["naive_omp", "symmetric_omp", "locks_omp", "copies_omp", "naive_tbb"]
    alike = dict.fromkeys(names, 1.3)
    h = load_history([measure("aaaa111", 3, backends=names), measure("bbbb222", 4, alike, backends=names)])
    (said,) = [note for note in notes(h) if "together" in note]
    assert said.endswith("would tell: dam_break 3D dx=0.00594 on 2 threads (node, bbbb222): 5 points by 0.77")


def test_what_is_drawn_lies_where_the_ratios_say(measure):
    h = load_history([measure("aaaa111", 1), measure("bbbb222", 2, {"naive": 2}), measure("cccc333", 3, {"naive": 1})])
    panels = revisions.sections(tracks(h))
    assert {title: len(some) for title, some in panels.items()} == {"Changed": 1, "No change resolved": 5}
    with figures.applied(figures.Look()):
        drawn = sheet(panels["Changed"], figures.Look())
    (title, axes), = artists.panels(drawn).items()
    own = h.steps[h.steps["line"].map(h.lines["backend"]) == "naive"]
    slow, back = own.itertuples()
    assert title == "naive M=6, dam_break 3D dx=0.00594, node" and artists.overlaps(drawn) == []
    assert [label.get_text() for label in axes.get_xticklabels()] == ["aaaa111", "bbbb222", "cccc333"]
    line = artists.lines(axes)["1 thread"]
    assert line == [(0, 1), (1, pytest.approx(1 / slow.ratio)), (2, pytest.approx(1 / slow.ratio / back.ratio))]
    assert line[1][1] == pytest.approx(2, rel=0.02) and line[2][1] == pytest.approx(1, abs=0.02)  # up is slower
    spans = [segment[:, 1] for some in axes.collections for segment in some.get_segments() if len(segment)]
    wanted = [(1 / e.high, 1 / e.low) for e in (back, slow)]  # faster, then slower
    assert sorted(spans[k][1] - spans[k][0] for k in (0, 1)) == pytest.approx(sorted(
        [wanted[0][1] / slow.ratio - wanted[0][0] / slow.ratio, wanted[1][1] - wanted[1][0]]))
    marks = {mark.get_marker(): list(mark.get_xdata()) for mark in axes.lines if mark.get_marker() in "^vs"}
    assert marks == {"s": [0], "^": [1], "v": [2]}


def test_bad_input_is_one_line_and_2(measure, tmp_path, capsys):
    (tmp_path / "empty").mkdir()
    broken = tmp_path / "broken.jsonl"
    broken.write_text(measure("aaaa111", 1).read_text() + '{"cut')
    for words, says in (([str(tmp_path / "empty")], "has no rows files (*.jsonl) in it, nor in the folders below"),
                        ([str(broken)], "the last line is cut"), ([str(tmp_path / "none")], "cannot be read")):
        assert program.main(["history", *words, "--out", str(tmp_path / "out")]) == 2
        error = capsys.readouterr().err
        assert says in error and error.count("\n") == 1 and not (tmp_path / "out").exists()
    assert program.main(["history", "--phase", "tea"]) == 2
    assert 'unknown phase "tea"; valid: index' in capsys.readouterr().err

