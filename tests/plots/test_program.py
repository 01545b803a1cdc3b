"""plot.py as a user runs it: files, notes, errors."""
import json
import os
import xml.etree.ElementTree as tree

import matplotlib.image
import pytest

import plot

#: What a summary of one size, world, compiler and granularity cannot show.
NEED_MORE = {"size_scaling", "granularity", "compilers", "strategy_worlds"}


def refused(done):
    """Check that a run ended in one clear line and exit code 2; return the line."""
    assert done.returncode == 2 and done.stdout == ""
    assert done.stderr.startswith("plot.py: ") and done.stderr.count("\n") == 1
    return done.stderr


def test_writes_every_figure_as_svg_and_png(run, full):
    done, out = run(full)
    assert (done.returncode, done.stderr) == (0, "")
    assert [line.split(":")[0] for line in done.stdout.splitlines()] == list(plot.FIGURES)
    assert {path.name for path in out.iterdir()} == {
        f"{name}.{kind}" for name in plot.FIGURES for kind in ("svg", "png")}
    for name in plot.FIGURES:
        assert len(list(tree.parse(out / f"{name}.svg").iter())) > 100
        picture = matplotlib.image.imread(out / f"{name}.png")
        assert picture[0, 0, :3].min() == 1 and picture.min() < 0.5


def test_the_same_summary_gives_the_same_svg(run, two):
    _, out = run(two, "--only", "speedup")
    first = (out / "speedup.svg").read_bytes()
    run(two, "--only", "speedup")
    assert (out / "speedup.svg").read_bytes() == first


@pytest.mark.parametrize("table, skipped", [
    ("speedup", {"speedup", "efficiency"}), ("algorithm_speedup", {"algorithm_speedup"}),
    ("m_comparison", {"m_comparison"}), ("self_test", {"self_test"}),
    ("points", {"phase_split", "ladder", "barrier_wait", "roofline"})])
def test_a_figure_without_data_is_skipped_with_a_note(run_here, two, table, skipped):
    two[table] = []
    shown = {*skipped, *NEED_MORE, "speedup" if table != "speedup" else "self_test"}
    if table == "points":
        shown.discard("speedup")
    done, out = run_here(two, *(word for name in sorted(shown) for word in ("--only", name)))
    assert done.returncode == 0
    notes = {line.split(":")[0]: line for line in done.stdout.splitlines() if "skipped" in line}
    assert set(notes) == skipped | NEED_MORE
    assert all(f'"{table}"' in notes[name] for name in skipped)
    assert {path.stem for path in out.iterdir()} == shown - skipped - NEED_MORE


def test_one_thread_count_gives_no_speedup(run_here, two):
    two["speedup"] = [row for row in two["speedup"] if row["threads"] == 1]
    done, _ = run_here(two, "--only", "speedup")
    assert "speedup: skipped" in done.stdout and "2 or more threads" in done.stdout


def test_nulls_are_left_out(run_here, two):
    two["speedup"][-1].update(speedup=None, efficiency=None, low=None, high=None)
    two["m_comparison"][0].update(total_s=None, pairs_tested=None)
    two["points"][0].update(ns_per_pair=None)
    two["points"][0]["ns_per_pair_parts"].update(sum=None, all=None)
    two["points"][1]["phases"]["reduce_s"]["median"] = None
    two["environments"] = []
    done, out = run_here(two)
    assert (done.returncode, done.stderr) == (0, "") and len(os.listdir(out)) == 2 * (
        len(plot.FIGURES) - len(NEED_MORE))


def test_rows_that_repeat_a_point_are_noted(run_here, two):
    two["speedup"].append(dict(two["speedup"][-1], speedup=1.5))
    done, _ = run_here(two, "--only", "speedup")
    assert done.returncode == 0 and "note: speedup: 1 rows repeat" in done.stdout


def test_a_missing_file_is_refused(run, tmp_path):
    assert "cannot read" in refused(run(tmp_path / "none.json")[0])


@pytest.mark.parametrize("text, said", [
    ("", "not complete JSON"), ('{"schema": "pairsum.summary/2", "poi', "was it cut off?"),
    ("[]", "not a pairsum summary"), ('{"schema": "other/1"}', '"other/1"'),
    ('{"a": 1}\n{"a": 2}\n', "pairsum report"), ('{"a": NaN}', "NaN"), ("[" * 99999, "JSON"),
    ('{"schema": "pairsum.summary/2"}', '"environments"'),
    ('{"schema": "pairsum.summary/1"}', 'expected "pairsum.summary/2"')])
def test_what_is_no_summary_is_refused(run_here, tmp_path, text, said):
    path = tmp_path / "bad.json"
    path.write_text(text)
    assert said in refused(run_here(path)[0])


def test_bytes_are_refused(run_here, tmp_path):
    path = tmp_path / "bad.json"
    path.write_bytes(b"\x89PNG\xff\xfe")
    assert "not a text file" in refused(run_here(path)[0])


@pytest.mark.parametrize("table, field, value, said", [
    ("speedup", "threads", "2", "threads"), ("speedup", "threads", 0, "whole number"),
    ("speedup", "speedup", -1, "positive"), ("m_comparison", "M", True, "a number or null"),
    ("algorithm_speedup", "runtime", None, "expected text"),
    ("points", "ns_per_pair_parts", {"prepare": 1.0}, 'no "zero"'),
    ("points", "study", ["a"], "not one word"), ("points", "phases", None, "phases"),
    ("points", "point", [], "not an object"), ("points", "rounds", 0, "whole number"),
    ("points", "passes", {"wait_share": 0.1}, 'no table "busy_s"'),
    ("points", "passes", {"wait_share": 0.1, "busy_s": [[1, 2]], "barrier_wait_s": [[1]]}, "differ"),
    ("points", "passes", {"wait_share": 0.1, "busy_s": [["1"]], "barrier_wait_s": [[1]]}, "a number"),
    ("points", "model", {"intensity": 1.0}, "achieved_flops_per_s"),
    ("self_test", "holds", "yes", "true or false"), ("peaks", "flops_per_s", 0, "positive"),
    ("questions", "answer", None, "expected text"), ("m_comparison", "collision_share", "", "null")])
def test_a_wrong_value_is_refused_by_its_place(run_here, two, table, field, value, said):
    two[table][1][field] = value
    line = refused(run_here(two)[0])
    assert said in line and f"{table}[1]" in line


@pytest.mark.parametrize("change, said", [
    ({"answer": {"text": "take it"}}, 'answer has no "backend"'), ({"answer": []}, "not an object"),
    ({"title": None}, '"title" is null'), ({"caveats": [1]}, "caveats[0] is not text")])
def test_a_wrong_top_is_refused(run_here, two, change, said):
    assert said in refused(run_here({**two, **change})[0])


@pytest.mark.parametrize("key", ["answer", "peaks", "self_test", "questions", "compiler_comparison"])
def test_a_missing_table_is_refused(run_here, two, key):
    del two[key]
    assert f'"{key}"' in refused(run_here(two)[0])


def test_ties_are_checked(run_here, two):
    two["answer"]["ties"] = [{"backend": "symmetric"}]
    assert "answer.ties[0]" in refused(run_here(two)[0])


def test_nothing_to_recommend_is_fine(run_here, two):
    two["answer"] = None
    assert run_here(two, "--only", "speedup")[0].returncode == 0


def test_a_missing_field_is_refused(run_here, two):
    del two["m_comparison"][3]["pairs_tested"]
    assert 'm_comparison[3] has no "pairs_tested"' in refused(run_here(two)[0])


def test_an_infinite_number_is_refused(run_here, two, tmp_path):
    path = tmp_path / "huge.json"
    text = json.dumps(two).replace('"total_s": ', '"total_s": 1e999, "was": ')
    path.write_text(text)
    refused(run_here(path)[0])


def test_an_output_folder_that_cannot_be_made_is_refused(run_here, two, tmp_path):
    (tmp_path / "out").write_text("a file is in the way")
    assert "cannot make the folder" in refused(run_here(two)[0])


def test_a_file_that_cannot_be_written_leaves_nothing_behind(run, two, tmp_path):
    (tmp_path / "out" / f"{plot.FIGURES[0]}.svg").mkdir(parents=True)
    assert "cannot write" in refused(run(two)[0])
    assert os.listdir(tmp_path / "out") == [f"{plot.FIGURES[0]}.svg"]


def test_missing_matplotlib_is_one_line(run, two, tmp_path):
    (tmp_path / "matplotlib.py").write_text("raise ImportError('No module named matplotlib')")
    done, _ = run(two, env={**os.environ, "PYTHONPATH": str(tmp_path)})
    assert "needs matplotlib" in refused(done)


def test_help_teaches(capsys):
    with pytest.raises(SystemExit) as end:
        plot.main(["--help"])
    text = capsys.readouterr().out
    assert end.value.code == 0 and all(name in text for name in plot.FIGURES)
    assert "example:" in text


def test_labels_spread_in_order_and_within_bounds():
    import labels
    at = labels.spread([0.5, 0.5, 0.5, 0.9], 0.1, 0.0, 1.0)
    assert at == pytest.approx([0.4, 0.5, 0.6, 0.9])
    assert labels.spread([0.99, 1.0], 0.1, 0.0, 1.0) == pytest.approx([0.9, 1.0])
    assert labels.spread([], 0.1, 0.0, 1.0) == []
