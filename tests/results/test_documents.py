"""What docs/results-in-python.md says: its code runs, its ladder is right, its columns and functions exist."""
import inspect
import json
import re
import shlex

import pandas as pd
import pytest
from committed import committed
from conftest import ROOT

import pairsum_results as pr
from pairsum_results import __main__ as program

DOCUMENT = (ROOT / "docs/results-in-python.md").read_text()
BLOCKS = re.findall(r"^```(\w*)\n(.*?)^```", DOCUMENT, re.MULTILINE | re.DOTALL)


@pytest.fixture(scope="module")
def executed(tmp_path_factory):
    """The names that the code blocks leave, executed in order in a folder that has the committed rows."""
    folder = tmp_path_factory.mktemp("clone")
    for path in committed("results/*/*.jsonl"):
        (folder / path.relative_to(ROOT)).parent.mkdir(parents=True, exist_ok=True)
        (folder / path.relative_to(ROOT)).symlink_to(path)
    names, talk = {}, next((folder / "results/talk").glob("*.jsonl"))
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        for language, text in BLOCKS:
            if language == "python":
                exec(compile(text, "results-in-python.md", "exec"), names)
            for line in re.findall(r"^pairsum (.*)", text, re.MULTILINE):
                assert program.main(shlex.split(line.replace("FILE.jsonl", talk.name))) == 0, line
    return names


def test_the_ladder_of_ten_lines_is_that_of_the_package(executed):
    block = next(text for language, text in BLOCKS if "ladder = " in text)
    assert len(block.replace("(\n", "(").strip().split("\n\n")[1].splitlines()) <= 10
    of_package = pr.ladder(executed["results"]).query("world == 'dam_break 3D' and at == 'most_threads'")
    table, own = of_package.set_index("backend"), executed["ladder"]
    assert len(own) > 20 and own["ratio"].to_dict() == pytest.approx(table["ratio"].to_dict(), rel=1e-12)
    assert own["ms"].to_dict() == pytest.approx((1e3 * table["time_s"]).to_dict(), rel=1e-12)
    assert own.index.to_list() == table.index.to_list()


def test_what_else_the_document_computes_is_what_it_says(executed):
    one = executed["one"].iloc[0]
    assert (one["backend"], one["base_backend"]) == (executed["best"], executed["worst"]) and one["ratio"] > 2
    assert {"host", "cpu", "git", "point", "round", "sum_s"} <= set(executed["table"])
    assert len(executed["h"].steps) >= 48 and len(executed["changed"]) >= 8
    assert set(executed["changed"]["verdict"]) <= {"faster", "slower"}


def test_every_column_of_rounds_and_points_is_explained(executed):
    named = set(re.findall(r"`([\w.]+)`", DOCUMENT))
    of_tables = {*executed["results"].rounds, *executed["results"].points}
    assert {re.sub("_(low|high)$", "", name) for name in of_tables} - named == set()
    assert "colour" not in named  # so a missing one would be found


def test_every_table_and_column_that_is_named_exists(executed):
    results = executed["results"]
    rows = [line.split("|")[1] for line in DOCUMENT.splitlines() if line.startswith("| `") and "pr." not in line]
    frames = {name: value for name, value in vars(results).items() if isinstance(value, pd.DataFrame)}
    columns = {column for frame in frames.values() for column in frame}
    for name in re.findall(r"`([\w.]+)`", " ".join(rows)):
        assert name in columns or name.removeprefix("results.") in frames, name
    said = dict(re.findall(r"^\| `results\.(\w+)` \|(.*)\|$", DOCUMENT, re.MULTILINE))
    for table, text in said.items():
        for column in re.findall(r"`(\w+)`", text):
            assert column in frames[table], (table, column)


def test_every_function_is_listed_and_takes_what_is_said():
    public = {name for name, value in vars(pr).items() if inspect.isfunction(value)}
    listed = dict(re.findall(r"`pr\.(\w+)\(([\w, ]*)\)`", DOCUMENT))
    assert public == set(listed)
    for name, arguments in listed.items():
        inspect.signature(getattr(pr, name)).bind(*arguments.split(", "))


def test_what_is_said_to_be_in_the_summary_is_there():
    summary = json.loads(committed("results/*/*/summary.json")[0].read_text())
    keys = {*summary, *summary["points"][0]}
    text = "".join(path.read_text() for path in (ROOT / "docs").glob("*.md"))
    named = re.findall(r"`(\w+)`(?: and `(\w+)`)? in\s`summary\.json`", text)
    assert named and {name for names in named for name in names if name} <= keys


def test_lines_are_short():
    assert [line for line in DOCUMENT.splitlines() if len(line) > 100] == []
