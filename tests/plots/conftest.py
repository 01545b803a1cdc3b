"""Fixtures of the plot tests: made summaries, and ways to run plot.py: as a user does, or within this process."""
import contextlib
import io
import json
import pathlib
import subprocess
import sys

import pytest

PLOTS = pathlib.Path(__file__).resolve().parents[2] / "plots"
sys.dont_write_bytecode = True
sys.path[:0] = [str(PLOTS), str(pathlib.Path(__file__).resolve().parent)]

import made_summary  # noqa: E402  (needs the path above)
import plot  # noqa: E402
import style  # noqa: E402

MADE = {"two_threads": made_summary.make(),
        "sixteen_threads": made_summary.make((1, 2, 4, 8, 16)),
        "field": made_summary.field(),
        "one_panel": made_summary.make(states=("rest",), ms=(6,), intervals=False)}
FULL = made_summary.full(ms=(6, 7))


@pytest.fixture(params=[*MADE, "full"])
def any_made(request):
    """Each made summary in turn, and the one that fills every table."""
    style.apply()
    return {**MADE, "full": FULL}[request.param]


@pytest.fixture
def field():
    """The summary of every backend; not to be changed."""
    style.apply()
    return MADE["field"]


@pytest.fixture
def full():
    """The summary that fills every table; not to be changed."""
    style.apply()
    return FULL


@pytest.fixture(params=MADE)
def made(request):
    """Each made summary in turn."""
    style.apply()
    return MADE[request.param]


@pytest.fixture
def two():
    """A fresh small summary that a test may change."""
    style.apply()
    return made_summary.make(states=("rest",), ms=(6, 7))


@pytest.fixture
def arguments(tmp_path):
    """Return plot.py's words for a summary (dict or path), and its out folder."""
    def of(summary, *options):
        path = summary
        if isinstance(summary, dict):
            path = tmp_path / "summary.json"
            path.write_text(json.dumps(summary))
        out = tmp_path / "out"
        return [str(path), "--out", str(out), *options], out
    return of


@pytest.fixture
def run(arguments):
    """Run plot.py on a summary (dict or path); return the finished process and its out folder."""
    def call(summary, *options, env=None):
        words, out = arguments(summary, *options)
        done = subprocess.run([sys.executable, "-B", str(PLOTS / "plot.py"), *words], capture_output=True,
                              text=True, env=env)
        return done, out
    return call


@pytest.fixture
def run_here(arguments):
    """Do the same without a new process, most of whose time goes into importing matplotlib."""
    def call(summary, *options):
        words, out = arguments(summary, *options)
        with contextlib.redirect_stdout(io.StringIO()) as said, contextlib.redirect_stderr(io.StringIO()) as errors:
            status = plot.main(words)
        return subprocess.CompletedProcess(words, status, said.getvalue(), errors.getvalue()), out
    return call
