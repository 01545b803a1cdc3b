"""Fixtures of the tests of report.html: made summaries, the program, pages and a browser."""
import json
import pathlib
import subprocess
import sys

import pytest

_TESTS = pathlib.Path(__file__).resolve().parents[1]
PLOTS = _TESTS.parent / "plots"
sys.dont_write_bytecode = True
sys.path[:0] = [str(PLOTS), str(_TESTS / "plots"), str(_TESTS / "report_html")]

import browser  # noqa: E402  (needs the path above)
import made_summary  # noqa: E402


def other_machine():
    """Return the made summary of another machine, with one series and more threads."""
    made = made_summary.make((1, 2, 4, 8), states=("rest",), ms=(6, 7))
    made["environments"][0].update(host="bignode", cpu="Another CPU 7702")
    return made


@pytest.fixture
def two():
    """A fresh small summary that a test may change."""
    return made_summary.make(states=("rest",), ms=(6, 7))


@pytest.fixture(scope="session")
def program(tmp_path_factory):
    """Run report.py on summaries (dicts or paths); return the finished process and the page's path."""
    def call(*summaries, out=None):
        folder = tmp_path_factory.mktemp("report")
        paths = []
        for number, summary in enumerate(summaries):
            paths.append(summary if not isinstance(summary, dict) else folder / f"{number}.json")
            if isinstance(summary, dict):
                paths[-1].write_text(json.dumps(summary))
        out = out or folder / "report.html"
        more = ["--compare", *map(str, paths[1:])] if len(paths) > 1 else []
        done = subprocess.run([sys.executable, "-B", str(PLOTS / "report.py"), str(paths[0]), "--out",
                               str(out), *more], capture_output=True, text=True)
        return done, out
    return call


@pytest.fixture(scope="session")
def page(program):
    """The report of a summary with every key filled."""
    done, path = program(made_summary.full(ms=(6, 7)))
    assert (done.returncode, done.stderr) == (0, "")
    return path


@pytest.fixture(scope="session")
def compared(program):
    """The report of two machines."""
    done, path = program(made_summary.make(states=("rest",), ms=(6, 7)), other_machine())
    assert (done.returncode, done.stderr) == (0, "")
    return path


@pytest.fixture(scope="session")
def chromium():
    """A headless Chromium for all tests."""
    driver = browser.start()
    yield driver
    driver.quit()
