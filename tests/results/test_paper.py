"""What is made for a paper: figures of a column's width, tables and methods that LaTeX can read."""
import re

import artists
import made
import pytest

import pairsum_results as pr
from pairsum_results import figures, paper


@pytest.fixture(scope="module")
def report(tmp_path_factory):
    return artists.report(tmp_path_factory.mktemp("rows"), artists.everything(threads=(1, 2)))


def faults(text):
    """What LaTeX would stumble over: bare special characters, braces and environments that do not match, lines of a
    table with more or fewer cells than columns."""
    body = "\n".join(line for line in text.splitlines() if not line.startswith("%"))
    table = re.sub(r"\\begin\{tabular\}\{(\w+)\}|\\(?:begin|end)\{[\w*]+\}|\\\\", "", body)
    found = re.findall(r"(?<!\\)[#$_^~<>|\"%]|\\(?![a-z&%$#_{}])", table)
    depth = 0
    for brace in re.findall(r"(?<!\\)[{}]", body):
        depth += 1 if brace == "{" else -1
    opened, closed = (re.findall(rf"\\{word}\{{([\w*]+)\}}", body) for word in ("begin", "end"))
    found += ["brace"] * (depth != 0) + ["environment"] * (sorted(opened) != sorted(closed))
    for columns, rows in re.findall(r"\\begin\{tabular\}\{(\w+)\}(.*?)\\end\{tabular\}", body, re.DOTALL):
        found += [row for row in rows.split(r"\\")[:-1] if len(re.findall(r"(?<!\\)&", row)) != len(columns) - 1]
    return found


def test_everything_for_a_paper_is_written(report, tmp_path):
    paths = paper.write(report, tmp_path)
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted(path.name for path in paths)
    assert {"ladder.pdf", "ladder-2.pdf", "self_test.pdf", "tables.tex", "methods.tex"} <= {p.name for p in paths}
    for path in paths:
        if path.suffix == ".pdf":
            box = re.search(rb"/MediaBox \[ 0 0 ([\d.]+) ", path.read_bytes())
            assert float(box[1]) == pytest.approx(84 / 25.4 * 72, abs=0.01) and b"/Type3" not in path.read_bytes()
    figure = figures.draw(figures.sheets(report, figures.PAPER)[0], report, figures.PAPER)
    assert figures.rendered(figure, "pdf") == figures.rendered(figure, "pdf")


def test_tables_and_methods_are_latex_and_hold_the_numbers(report):
    text = paper.latex_tables(report)
    assert faults(text) == [] and text.count(r"\toprule") == text.count(r"\end{table*}") > 5
    assert r"symmetric\_omp & 7 & 2 & " in text and "cap of 5 %" not in text
    assert faults(paper.methods(report)) == []


@pytest.mark.parametrize("planted", ["5 % of it", "a_b", "a & b & c \\\\", r"\begin{table*}", "{", "x^2", r"\3"])
def test_what_latex_would_stumble_over_is_found(planted):
    good = "\\begin{tabular}{lr}\na\\_b & 1 \\% \\\\\n\\end{tabular}\n"
    assert faults(good) == []
    assert faults(good.replace("a\\_b & 1 \\% \\\\", f"a\\_b & 1 \\% \\\\\n{planted}\n& \\\\"))


def test_methods_state_machine_build_rounds_and_statistics(tmp_path):
    change = {"host": "node_1", "flags": "-O3 -Da^b~", "dirty": True}
    rows = made.study(made.talk(), 6, [made.environment(**change)])
    rows.append(made.head("void", round=7, reason="disturbed"))
    text = paper.methods(artists.report(tmp_path, rows))
    assert faults(text) == []
    for part in ("revision abc1234 with uncommitted changes", "-O3 -Da\\textasciicircum{}b\\textasciitilde{}",
                 "GNU 12.2.0", "some model with 2 cores (Linux 6.1, governor performance)", "cores\\_first 0,1",
                 "dam\\_break (3D, rest", "1000000 fluid and 1014966 boundary", "12 points", "on 1 to 2 threads, each "
                 "in 6 rounds of 1 repetition of 2 steps", "Of 7 rounds 1 were void", "at most 1 \\%", "order statistics",
                 "medians over rounds", "Student's t", "Holm"):
        assert part in text, part


def test_a_folder_that_cannot_be_made_is_one_line(report, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(pr.ResultsError, match="cannot write"):
        paper.write(report, tmp_path / "file")
