"""What a run shows on a terminal: one line of progress while it goes on, then a table in colours."""

import json
import re

import pytest
from conftest import BIN, SMALL
from on_terminal import UPDATE, Chunk, complaints, run

COLOUR = re.compile(r"\x1b\[\d+m")
SLOWER = {"schema": "pairsum.plan/1", "study": "terminal", "title": "estimates that change", "budget_s": 9,
          "defaults": {"case": "dam_break", "M": 4, "threads": 1, "steps": 1, "rounds": [6, 10000]},
          "parts": [{"name": "short", "backend": "naive,symmetric", "dx": 0.08},
                    {"name": "long", "backend": "naive,pair_list", "dx": 0.03, "share": 2}]}


@pytest.mark.parametrize("columns, narrower", [(60, 40), (80, 50), (120, 70)])
def test_progress_is_one_line(tmp_path, columns, narrower):
    for budget in (7, 20, 60):  # on a busy machine a short study may end with its first update
        (tmp_path / "plan.json").write_text(json.dumps({**SLOWER, "budget_s": budget}))
        code, chunks = run([BIN / "pairsum", "run", "plan.json", "--out", f"rows{budget}.jsonl"], columns, tmp_path,
                           resize=(40, narrower))
        text = "".join(c.text for c in chunks)
        assert code == 0, text
        assert complaints(chunks) == []
        assert text.rstrip().splitlines()[-1].endswith(f"--out rows{budget}.jsonl") or f"report rows{budget}.jsonl" in text
        if len(UPDATE.findall(text)) > 4 and chunks[-1].columns == narrower:
            break
    else:
        pytest.fail(f"{len(UPDATE.findall(text))} updates, {chunks[-1].columns} columns at the end: {text}")


def update(percent, what="doing"):
    return f"\r\x1b[K[##..] {percent:3} %  ETA 0:10  {what}"


GOOD = [Chunk(2 + k / 5, update(10 * k), 60) for k in range(5)] + [Chunk(4, "\r\x1b[Kdone\r\n", 60)]


@pytest.mark.parametrize("change, says", [
    (lambda c: c, None),
    (lambda c: [*c[:3], Chunk(2.9, update(15), 60), *c[3:]], "went back from 20 to 15 %"),
    (lambda c: c[:-1], "left behind"),
    (lambda c: [*c[:-1], Chunk(4, "\r\ndone\r\n", 60)], "scrolled"),
    (lambda c: [*c[:2], Chunk(2.3, update(11, "x" * 40), 60), *c[2:]], "wider than 60 columns"),
    (lambda c: [*[Chunk(2 + k / 100, update(1), 60) for k in range(30)], *c[1:]], "updates in"),
])
def test_the_checker_of_transcripts_rejects(change, says):
    found = complaints(change(GOOD))
    assert (found == []) if says is None else any(says in line for line in found), found


@pytest.mark.parametrize("environment, colours", [({}, True), ({"NO_COLOR": ""}, True), ({"NO_COLOR": "1"}, False), ({"TERM": "dumb"}, False)])
def test_verdicts_have_colours_on_a_terminal(tmp_path, environment, colours):
    code, chunks = run([BIN / "pairsum", "run", *SMALL], 120, tmp_path, **environment)
    text = "".join(c.text for c in chunks)
    assert code == 0 and "ns/pair" in text
    assert bool(COLOUR.search(text)) == colours


def test_nothing_has_colours_in_a_pipe(pairsum):
    done = pairsum("run", *SMALL)
    assert done.returncode == 0 and "\x1b" not in done.stdout + done.stderr
