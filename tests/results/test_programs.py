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
from committed import committed
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
    assert out.startswith("On node symmetric_omp (M = 6, 2 threads) is the fastest of 6 backends: 2.00 [2.00, 2.00] times")
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


def run(*words, **environment):
    return subprocess.run([sys.executable, "-B", "-m", "pairsum_results", *words], cwd=ROOT / "plots", text=True,
                          capture_output=True, env={**os.environ, **environment})


def test_errors_are_one_line_and_exit_code_2(rows, tmp_path):
    done = run("report", str(tmp_path / "none.jsonl"))
    assert (done.returncode, done.stdout) == (2, "") and done.stderr.startswith("pairsum: ") and done.stderr.count("\n") == 1
    assert run("report", "--help").returncode == 0 and run("compare", "a").returncode == 2
    (tmp_path / "file").write_text("")
    done = run("report", rows([(made.point("naive"), 1.0)]), "--out", str(tmp_path / "file/inside"))
    assert done.returncode == 2 and "cannot write" in done.stderr and done.stderr.count("\n") == 1
    bare = rows([(made.point("naive"), 1.0)], "rows")
    done = run("report", bare)
    assert done.returncode == 2 and done.stderr == (
        f"pairsum: {bare} does not end in .jsonl, so --out DIR should name the folder for the files\n")


@pytest.mark.parametrize("module", ["pandas", "scipy", "matplotlib", "jinja2"])
@pytest.mark.parametrize("name", ["report", "history"])
def test_a_module_that_lacks_is_one_line_and_exit_code_2(rows, tmp_path, module, name):
    """1 would say that something got slower."""
    path = rows([(made.point("naive"), 1.0)])
    (tmp_path / "lacking").mkdir()
    (tmp_path / f"lacking/{module}.py").write_text(f"raise ModuleNotFoundError(name='{module}')")
    done = run(name, path, "--out", str(tmp_path / "out"), PYTHONPATH=str(tmp_path / "lacking"))
    assert done.returncode == 2 and f"python3-{module}" in done.stderr.split("(Debian: ")[1]
    assert done.stderr.count("\n") == 1 and done.stderr.startswith("pairsum: ")


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
    assert "dam_break rest dx=0.00594 M=6 threads=1     6/6    1050.0    525.00  2.000 [2.000, 2.000]  faster\n" in text
    assert "Of 2 comparisons B is faster in 2, slower in 0, no difference is resolved in 0 (95 %" in text
    assert "slower in 2" in compare_sides("symmetric", "naive", [path]).text()
    assert "2100.0      1050.0  2.000" in compare_sides("naive M=6", "symmetric", [path], "total").text()


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
    assert "threads=2 scalar / avx512 slab:4" in text and "Of 2 comparisons B is faster in 2" in text
    assert "threads=2 avx512 / avx512 slab:4" in compare_sides("tiles_omp block=auto", "tiles_omp block=slab:4", [path]).text()
    assert "Of 1 comparison " in compare_sides("naive_omp", "symmetric_omp", [path]).text()
    assert "Of 1 comparison " in compare_sides("naive_omp", "symmetric_omp isa=avx512", [path]).text()


def in_study(name, content):
    return [{**row, "study": name} for row in content]


def test_backends_are_compared_in_all_rows_below_results_without_a_word_more(tmp_path, monkeypatch, capsys):
    """Points of different machines, builds and studies are never compared with each other."""
    for study, slow, name in (("talk", 1, "1"), ("field", 2, "2"), ("field", 3, "3")):
        e = made.environment(name * 16, git=f"{name}abc1234", host="other" if name == "3" else "node")
        points = [(made.point(backend), slow * time, {"environment": e["environment"]})
                  for backend, time in (("naive", 1.0), ("symmetric", 0.5))]
        made.write(tmp_path / f"results/{study}/{name}.jsonl", in_study(study, made.study(points, before=[e])))
    monkeypatch.chdir(tmp_path)
    assert program.main(["compare", "naive", "symmetric"]) == 0
    out = capsys.readouterr().out
    assert "Of 3 comparisons B is faster in 3, slower in 0" in out and out.count("2.000 [2.000, 2.000]") == 3
    for origin in ("talk, 1abc1234: ", "field, 2abc1234: ", "field, 3abc1234: "):
        assert out.count(f"\n{origin}dam_break rest dx=0.00594 M=6 threads=1 ") == 1


def test_revisions_of_several_builds_are_told_apart_where_they_may_be_mixed(rows):
    builds = [made.environment(digit * 16, git=git, host=host) for digit, git, host in (
        ("1", "1a2b3c4d", "node"), ("2", "1a2b3c4d", "other"), ("3", "5e6f7a8b", "node"))]
    files = [rows([(made.point("naive"), 1.0, {"environment": e["environment"]})], f"{e['environment']}.jsonl", before=[e])
             for e in builds]
    with pytest.raises(pr.ResultsError, match="different machines or builds: host .node, other."):
        compare_sides("1a2b3c4d", "5e6f7a8b", files)
    text = compare_sides("1a2b3c4d", "5e6f7a8b", files, allow_mixed=True).text()
    assert "1a2b3c4d, node/5e6f7a8b: naive" in text and "1a2b3c4d, other/5e6f7a8b: naive" in text


def test_points_of_different_seeds_are_different_points(rows):
    def points(environment):
        return [(made.point(backend, state="perturbed"), seed * time, {"seed": seed, "environment": environment})
                for backend, time in (("naive", 1.0), ("symmetric", 0.5)) for seed in (1, 2)]

    one, other = (made.environment(digit * 16, git=git) for digit, git in (("1", "1a2b3c4d"), ("2", "5e6f7a8b")))
    path = rows([point for e in (one, other) for point in points(e["environment"])], before=[one, other])
    text = compare_sides("1a2b3c4d", "5e6f7a8b", [path]).text()
    assert "Of 4 comparisons" in text and text.count("1.000 [1.000, 1.000]") == 4
    assert "\n1: naive dam_break perturbed" in text and "\n2: naive dam_break perturbed" in text
    text = compare_sides("naive", "symmetric", [path]).text()
    assert "Of 4 comparisons" in text and text.count("2.000 [2.000, 2.000]") == 4
    builds = pr.compiler_comparison(pr.load(path))
    assert builds["ratio"].to_list() == pytest.approx([1, 1, 1, 1])


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
    with pytest.raises(pr.ResultsError, match="no point in common .same study, seed, case, dx, grid, M, threads, particles lost, backend"):
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


def test_whoever_reads_the_output_may_stop(rows, tmp_path):
    command = f"{sys.executable} -m pairsum_results report --tables {rows(made.talk())} --out {tmp_path} | head -n 1"
    done = subprocess.run(["bash", "-c", command], capture_output=True, text=True, cwd=ROOT / "plots")
    assert done.stdout.count("\n") == 1 and done.stderr == ""


@pytest.mark.skipif(not (ROOT / ".git").exists(), reason="no git repository")
def test_git_takes_rows_and_summaries_alone():
    def ignored(names):
        command = ["git", "-c", f"safe.directory={ROOT}", "-C", ROOT, "check-ignore", "--no-index", "--stdin"]
        return subprocess.run(command, input="\n".join(names), capture_output=True, text=True).stdout.split()

    taken = [str(path.relative_to(ROOT)) for pattern in ("*.jsonl", "*/summary.json", "README.md")
             for path in committed(f"results/{'' if pattern == 'README.md' else '*/'}{pattern}")]
    assert len(taken) > 14 and ignored(taken) == []
    made_again = [f"results/talk/{folder}{name}" for folder in ("", "FILE/") for name in (
        "report.html", "ladder.svg", "tables.txt", "rounds.csv", "csv/points.csv", "paper/tables.tex")]
    made_again += ["results/talk/summary.json", "results/quick/FILE.jsonl", "results/history/history.html"]
    assert ignored([*made_again, "results/talk/FILE.jsonl", "results/talk/FILE/summary.json"]) == made_again


@pytest.mark.parametrize("words", [["history", "nothing"], ["report"], ["compare", "a", "b", "--xyzzy"]], ids=" ".join)
def test_a_message_that_is_lost_leaves_the_code(words, tmp_path):
    with open("/dev/full", "w", encoding="utf-8") as full:
        done = subprocess.run([sys.executable, "-m", "pairsum_results", *words], cwd=tmp_path, stderr=full, check=False,
                              env={**os.environ, "PYTHONPATH": str(ROOT / "plots")})
    assert done.returncode == 2


def test_a_time_beyond_all_numbers_is_no_traceback(rows, tmp_path, capsys):
    path = rows([(made.point("naive"), 1e307), (made.point("symmetric"), 1.0)])
    assert program.main(["report", "--tables", path, "--out", str(tmp_path / "out")]) == 0, capsys.readouterr().err


def test_points_that_lost_different_numbers_of_particles_are_not_compared(rows):
    path = rows([(made.point("naive"), 1.0, {"lost": 7}), (made.point("symmetric"), 0.5), (made.point("tiles_omp"), 0.5, {"lost": 7})])
    with pytest.raises(pr.ResultsError, match="threads, particles lost, backend|threads, particles lost"):
        compare_sides("naive", "symmetric", [path])
    assert "Of 1 comparison B is faster in 1" in compare_sides("naive", "tiles_omp", [path]).text()
