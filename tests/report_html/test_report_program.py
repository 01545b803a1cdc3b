"""report.py as a user runs it: what it says, what it refuses, and that it leaves nothing half-written."""
import os

import pytest
from selenium.webdriver.common.by import By

import browser
import page_check

EVIL = '<script>window.taken = 1</script><img src=x onerror="window.taken = 2">"\'{{ 7 * 7 }}</title>'


def refused(done, out):
    """Check that a run ended in one clear line, exit code 2 and no page; return the line."""
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("report.py: ") and done.stderr.count("\n") == 1
    assert not out.is_file()
    return done.stderr


@pytest.mark.parametrize("text, said", [
    ("", "not complete JSON"), ('{"schema": "pairsum.summary/1"}', 'expected "pairsum.summary/2"'),
    ('{"schema": "pairsum.summary/2", "poi', "was it cut off?")])
def test_a_broken_summary_is_refused(program, tmp_path, text, said):
    path = tmp_path / "bad.json"
    path.write_text(text)
    assert said in refused(*program(path))


def test_a_broken_summary_to_compare_with_is_refused(program, two, tmp_path):
    path = tmp_path / "bad.json"
    path.write_text("[]")
    line = refused(*program(two, path))
    assert "bad.json is not a pairsum summary" in line


def test_a_missing_table_is_refused(program, two):
    del two["questions"]
    assert 'no list "questions"' in refused(*program(two))


def test_a_page_that_cannot_be_written_is_refused(program, two, tmp_path):
    (tmp_path / "folder").mkdir()
    assert "cannot write" in refused(*program(two, out=tmp_path / "folder"))
    assert os.listdir(tmp_path) == ["folder"]
    assert "cannot write" in refused(*program(two, out=tmp_path / "none" / "report.html"))


def test_a_failed_run_leaves_the_old_page(program, tmp_path):
    out = tmp_path / "report.html"
    out.write_text("old")
    done, _ = program(tmp_path / "missing.json", out=out)
    assert done.returncode == 2 and out.read_text() == "old"
    assert os.listdir(tmp_path) == ["report.html"]


def test_the_same_summary_gives_the_same_page(program, two):
    first, second = program(two)[1], program(two)[1]
    assert first.read_bytes() == second.read_bytes()


def test_text_of_a_summary_cannot_become_markup(program, chromium, two):
    for table in ("questions", "self_test"):
        for row in two[table]:
            row.update({key: EVIL for key, value in row.items() if isinstance(value, str) and key != "backend"})
    two["title"] = two["answer"]["text"] = two["answer"]["backend"] = EVIL
    two["caveats"].append(EVIL)
    two["sources"] = [EVIL]
    two["environments"][0].update(host=EVIL, cpu=EVIL, compiler=EVIL, libraries={EVIL: EVIL})
    two["failed"] = [{"point": two["points"][0]["point"], "error": EVIL}]
    for entry in two["points"]:
        entry["point"]["granularity"] = entry["point"]["case"] = EVIL
    done, path = program(two)
    assert (done.returncode, done.stderr) == (0, "")
    html = path.read_text()
    assert html.count("<script") == 1 and "<img" not in html and "&lt;script&gt;" in html
    assert page_check.external(html) == []
    browser.show(chromium, path)
    assert chromium.execute_script("return window.taken === undefined")
    assert browser.console(chromium) == []
    assert EVIL in chromium.find_element(By.ID, "caveats").text


def test_a_planted_script_does_not_run(page, chromium, tmp_path):
    planted = tmp_path / "planted.html"
    planted.write_text(page.read_text().replace("<main>", "<main><script>window.taken = 1</script>"))
    browser.show(chromium, planted)
    assert chromium.execute_script("return window.taken === undefined")
    assert any("Content Security Policy" in line for line in browser.console(chromium))


def test_nulls_and_empty_tables_leave_gaps(program, chromium, two):
    two.update(answer=None, questions=[], self_test=[], peaks=[], environments=[], caveats=[], rounds=None)
    for entry in two["points"]:
        entry.update(passes=None, model=None)
    two["speedup"][0].update(speedup=None, low=None, high=None, efficiency=None)
    done, path = program(two)
    assert (done.returncode, done.stderr) == (0, "")
    browser.show(chromium, path)
    text = chromium.find_element(By.TAG_NAME, "body").text
    for words in ("nothing can be recommended", "No question was answered", "Not drawn: ", "Roofline (",
                  "No environment was recorded"):
        assert words in text
    assert "None" not in chromium.find_element(By.ID, "tables").text and "nan" not in text


def test_no_points_at_all_is_a_page_too(program, two):
    for table in ("points", "speedup", "algorithm_speedup", "m_comparison", "series"):
        two[table] = []
    done, _ = program(two)
    assert (done.returncode, done.stderr) == (0, "")


def test_an_answer_without_an_interval_says_so(program, two):
    two["answer"].update(low=None, high=None, confidence=None)
    assert "no interval: too few rounds" in program(two)[1].read_text()
