"""The programs as a user runs them: report and compare."""
import csv
import json
import os
import subprocess
import sys

import jsonschema
import made
import pandas as pd
import pytest
from conftest import ROOT

import pairsum_results as pr
from pairsum_results import __main__ as program
from pairsum_results.sides import compare_sides

COMPARISON = json.loads((ROOT / "plots/pairsum_results/comparison.schema.json").read_text())
SCHEMA = json.loads((ROOT / "plots/pairsum_results/summary.schema.json").read_text())


@pytest.fixture
def rows(tmp_path):
    """Writes the rows of points and returns the file."""
    def of(points, name="talk/rows.jsonl", **how):
        return str(made.write(tmp_path / name, made.study(points, **how)))
    return of


def test_report_writes_what_it_prints_and_the_summary_keeps_its_schema(rows, tmp_path, capsys):
    path = rows([*made.talk(), (made.point("again_naive_omp"), 1.0)])
    assert program.main(["report", "--tables", path]) == 0
    out, folder = capsys.readouterr().out, tmp_path / "talk/rows"
    assert out.startswith("On node symmetric_omp (M = 6, 2 threads) is the fastest of 12 measured: 2.00 [2.00, 2.00] times")
    assert out.endswith((folder / "tables.txt").read_text()
                        + f"tables:  {folder}/tables.txt, tables.md, csv/, rounds.csv, summary.json\n")
    assert (folder / "tables.md").read_text().startswith("# talk on node\n")
    summary = json.loads((folder / "summary.json").read_text())
    jsonschema.validate(summary, SCHEMA)
    assert summary["points"][summary["answer"]["point"]]["backend"] == "symmetric_omp"
    points, rounds = pd.read_csv(folder / "csv/points.csv"), pd.read_csv(folder / "rounds.csv")
    assert len(rounds) == 6 * len(points) and set(rounds["host"]) == {"node"} and set(rounds["git"]) == {"abc1234"}
    assert rounds.groupby("point")["sum_s"].median().to_list() == pytest.approx(points["sum_s"].to_list(), rel=1e-12)
    assert program.main(["report", "--tables", rows([(made.point("naive"), 1.0)]), "--out", str(folder)]) == 0
    assert not (folder / "csv/algorithm_speedup.csv").exists()  # of the report before
    with open(folder / "csv/points.csv", encoding="utf-8") as stream:
        assert len(list(csv.reader(stream))) == 2


def test_the_schema_of_the_summary_rejects(rows, tmp_path):
    program.main(["report", "--tables", rows(made.talk()), "--out", str(tmp_path)])
    summary = json.loads((tmp_path / "summary.json").read_text())
    jsonschema.validate(summary, SCHEMA)
    for broken in ({"answer": 7}, {"caveats": None}, {"colour": "red"}, {"schema": "pairsum.summary/2"},
                   {"points": [{"series": -1}]}, {"speedup": [{**summary["speedup"][0], "verdict": "maybe"}]}):
        with pytest.raises(jsonschema.ValidationError):
            jsonschema.validate({**summary, **broken}, SCHEMA)


def test_the_schema_holds_for_the_committed_rows(tmp_path):
    for path in (ROOT / "results/self_test", ROOT / "results/vector"):
        assert program.main(["report", "--tables", str(path), "--out", str(tmp_path)]) == 0
        jsonschema.validate(json.loads((tmp_path / "summary.json").read_text()), SCHEMA)


def test_errors_are_one_line_and_exit_code_2(rows, tmp_path):
    def run(*words, **environment):
        return subprocess.run([sys.executable, "-B", "-m", "pairsum_results", *words], cwd=ROOT / "plots", text=True,
                              capture_output=True, env={**os.environ, **environment})
    done = run("report", str(tmp_path / "none.jsonl"))
    assert (done.returncode, done.stdout) == (2, "") and done.stderr.startswith("pairsum: ") and done.stderr.count("\n") == 1
    assert run("report", "--help").returncode == 0 and run("compare", "a").returncode == 2
    (tmp_path / "file").write_text("")
    done = run("report", rows([(made.point("naive"), 1.0)]), "--out", str(tmp_path / "file/inside"))
    assert done.returncode == 2 and "cannot write" in done.stderr and done.stderr.count("\n") == 1
    (tmp_path / "pandas.py").write_text("raise ModuleNotFoundError(name='pandas')")
    done = run("report", "x", PYTHONPATH=str(tmp_path))
    assert done.returncode == 2 and "lacks pandas (Debian: python3-pandas" in done.stderr and done.stderr.count("\n") == 1


def test_a_ladder_in_ten_lines_of_pandas(rows):
    results = pr.load([rows(made.talk())])
    rounds = results.rounds.query("threads == 2")
    times = rounds.groupby("backend")["evaluation_s"].median().sort_values()
    assert times.index.to_list() == ["symmetric_omp", "symmetric_tbb", "naive_omp", "naive_tbb"]
    assert (times["naive_omp"] / times).to_list() == pytest.approx([2, 1.6, 1, 0.8])


def test_backends_are_compared_round_by_round(rows):
    path = rows(made.talk())
    text = compare_sides("naive", "symmetric", [path]).text()
    assert text.startswith("A: naive\nB: symmetric\npoint") and "measured apart" not in text
    assert "dam_break rest dx=0.00594 M=6 threads=1     6/6  1050.0  525.00  2.000 [2.000, 2.000]  faster\n" in text
    assert "Of 2 comparisons B is faster in 2, slower in 0, no difference is resolved in 0 (95 %" in text
    assert "slower in 2" in compare_sides("symmetric", "naive", [path]).text()
    assert "2100.0  1050.0  2.000" in compare_sides("naive M=6", "symmetric", [path], "total").text()


def test_backends_may_differ_in_levels_that_are_named(rows):
    mixed = {"precision": "mixed", "grid": "compact_grid"}
    path = rows([(made.point("naive"), 1.0), (made.point("naive", 7), 1.2), (made.point("naive", None, **mixed), 0.25)])
    text = compare_sides("naive precision=double", "naive precision=mixed grid=compact_grid", [path]).text()
    assert "M=6/compact_grid threads=1" in text and "4.000 [4.000, 4.000]" in text and "Of 2 comparisons" in text
    one = compare_sides("naive M=7 precision=double", "naive M=none precision=mixed grid=compact_grid", [path]).text()
    assert "Of 1 comparison B is faster in 1" in one


def test_blocks_and_vector_units_tell_pairs_apart(rows):
    def units(lanes):
        return {"work": made.work(vector_units={"block": "none", "lanes": lanes, "vectors": 9, "occupancy": 0.8})}
    path = rows([(made.point("naive_omp", 7, 2), 1.0),
                 (made.point("tiles_omp", 7, 2, isa="avx512", block="auto"), 0.5, units(8)),
                 (made.point("tiles_omp", 7, 2, isa="avx512", block="slab:4"), 0.25, units(8)),
                 (made.point("symmetric_omp", 7, 2), 0.8), (made.point("symmetric_omp", 7, 2, isa="avx512"), 0.4, units(8))])
    text = compare_sides("naive_omp", "tiles_omp", [path]).text()  # each on what it is made for
    assert "threads=2 avx512 slab:4" in text and "Of 2 comparisons B is faster in 2" in text
    assert "threads=2 avx512 / avx512 slab:4" in compare_sides("tiles_omp block=auto", "tiles_omp block=slab:4", [path]).text()
    assert "Of 1 comparison " in compare_sides("naive_omp", "symmetric_omp", [path]).text()
    assert "Of 1 comparison " in compare_sides("naive_omp", "symmetric_omp isa=avx512", [path]).text()


def test_files_and_revisions_are_unpaired_unless_measured_together(rows):
    def build(digit, **change):
        return made.environment(digit * 16, **change)

    def by(e, time, backend="naive"):
        return (made.point(backend), time, {"environment": e["environment"]})

    gcc, clang = build("1", git="1a2b3c4d"), build("2", compiler="Clang 14.0.6", git="5e6f7a8b")
    a, b = rows([by(gcc, 1.0)], "apart/a.jsonl", before=[gcc]), rows([by(clang, 0.5)], "apart/b.jsonl", before=[clang])
    text = compare_sides(a, b, []).text()
    assert "measured apart, so not paired" in text and "  2.000 [1.5" in text and "faster in 1" in text
    assert "they differ in compiler (Clang 14.0.6, GNU 12.2.0), git (1a2b3c4d, 5e6f7a8b)" in text
    both = rows([by(gcc, 1.0), by(clang, 0.8)], "both.jsonl", before=[gcc, clang])
    text = compare_sides("1a2b3c4d", "5e6f7a8b99", [both]).text()
    assert "1.250 [1.250, 1.250]  faster\n" in text and "measured apart" not in text
    elsewhere, dirty = build("3", host="elsewhere"), build("4", dirty=True)
    other, changed = (rows([by(e, 1.0)], f"{e['environment']}.jsonl", before=[e]) for e in (elsewhere, dirty))
    for side, says in ((other, r"measured on different machines \(host \(elsewhere, node\)"),
                       (changed, "built from a tree with uncommitted changes"), (both, "holds rows of several builds")):
        with pytest.raises(pr.ResultsError, match=says):
            compare_sides(a, side, [])
    assert "host (elsewhere, node)" in compare_sides(a, other, [], allow_mixed=True).text()
    with pytest.raises(pr.ResultsError, match="no point in common .same study, case, dx, grid, M, threads, backend"):
        compare_sides(a, rows([by(gcc, 1.0, "symmetric")], "c.jsonl", before=[gcc]), [])


def test_wrong_sides_are_refused_in_one_line(rows):
    path = rows(made.talk())
    for a, b, says in (("naive", "naive", 'not "naive" twice'), (path, "naive", 'is a file, "naive" is none'),
                       ("naive", "abc1234", '"naive" is a backend, "abc1234" a revision'),
                       ("abc1", "abc1234", "both name the revision abc1234"),
                       ("naive", "gather", '"gather" is neither a backend nor a revision of these rows; there are'),
                       ("naive", "symetric_omp M=6", "of these rows; did you mean symmetric_omp? there are"),
                       ("naive", "symmetric threads=2", "have no point in common"),
                       ("naive", "symmetric precison=mixed", 'unknown level "precison"; did you mean precision? valid: state'),
                       ("naive", "symmetric mixed", '"mixed" behind symmetric is no level')):
        with pytest.raises(pr.ResultsError, match="^[^\n]*$") as caught:
            compare_sides(a, b, [path])
        assert says in str(caught.value)
    with pytest.raises(pr.ResultsError, match='unknown phase "foo"; valid: index, prepare'):
        compare_sides("naive", "symmetric", [path], "foo")


def test_a_comparison_is_a_document_too(rows, capsys):
    corrupt = {"error": "rate 7 is off", "phases": None, "work": None}
    path = rows([*made.talk(), (made.point("corrupt_naive_omp"), 1.0, corrupt)])
    found = compare_sides("naive", "symmetric", [path])
    document = found.document()
    jsonschema.validate(document, COMPARISON)
    assert document["differ"] is None and [p["error"] for p in document["left_out"]] == ["rate 7 is off"]
    six = document["pairs"][0]
    assert (six["a"]["backend"], six["b"]["backend"], six["a"]["M"]) == ("naive", "symmetric", 6)
    assert six["a"]["time_s"] == pytest.approx(1.05) and six["b"]["time_s"] == pytest.approx(0.525)
    assert (six["ratio"], six["rounds"], six["verdict"]) == (pytest.approx(2), 6, "faster")
    assert program.main(["compare", "naive", "symmetric", "--in", path, "--json"]) == 0
    said = capsys.readouterr()
    assert json.loads(said.out) == document and said.err == ""
    for wrong in ({"schema": "pairsum.compare/2"}, {"pairs": [{**six, "verdict": "better"}]}, {"more": 1}):
        with pytest.raises(jsonschema.ValidationError):
            jsonschema.validate({**document, **wrong}, COMPARISON)


def test_few_rounds_have_null_bounds_in_the_document(rows):
    path = rows([(made.point("naive"), 1.0), (made.point("symmetric"), 0.5)], rounds=2)
    only, = compare_sides("naive", "symmetric", [path]).document()["pairs"]
    assert only["low"] is None and only["high"] is None and only["verdict"] == "not resolved"


@pytest.mark.parametrize("words, says", [
    (["compare", "a", "b", "--phsae", "total"], "unknown option --phsae of pairsum compare; did you mean --phase?"),
    (["report", "a", "--table"], None),  # the beginning of an option is that option
    (["report", "a", "--xyzzy=3"], "unknown option --xyzzy of pairsum report; pairsum report --help lists"),
    (["history", "--pahse=sum"], "unknown option --pahse of pairsum history; did you mean --phase?"),
    (["compare", "a", "b", "c"], 'pairsum compare does not take "c"; pairsum compare --help')])
def test_misspelt_options_are_refused_with_what_was_meant(words, says, capsys, monkeypatch):
    monkeypatch.setattr(program, "_report", lambda options: None)
    if says is None:
        assert program.main(words) == 0
        return
    with pytest.raises(SystemExit) as left:
        program.main(words)
    assert left.value.code == 2 and says in capsys.readouterr().err


def test_every_committed_summary_keeps_its_schema():
    paths = sorted(ROOT.glob("results/*/*/summary.json"))
    assert len(paths) > 5
    for path in paths:
        jsonschema.validate(json.loads(path.read_text()), SCHEMA)


def test_whoever_reads_the_output_may_stop(rows, tmp_path):
    command = f"{sys.executable} -m pairsum_results report --tables {rows(made.talk())} --out {tmp_path} | head -n 1"
    done = subprocess.run(["bash", "-c", command], capture_output=True, text=True, cwd=ROOT / "plots")
    assert done.stdout.count("\n") == 1 and done.stderr == ""
