"""A copy of the scripts beside stub programs that log how they were called."""
import os
import pathlib
import shutil
import subprocess

import pytest

ROOT = pathlib.Path(__file__).parents[2]
SCRIPTS = ("run_all.sh", "run_tests.sh", ".ci/run",
           "harness/scripts/dependencies.sh", "harness/scripts/steps.sh")

PAIRSUM = """#!/bin/bash
echo "pairsum $*" >>"$LOG"
out= previous=
for argument; do
  [[ $previous != --out ]] || out=$argument
  previous=$argument
done
if [[ $1 == run ]]; then
  mkdir -p "$(dirname "$out")"
  echo "{${STUB_ROW-\\"kind\\":\\"round\\"}}" >>"$out"
  echo "rows: $out"
fi
if [[ $1 == verify ]]; then echo "a sum"; echo "all passed"; fi
if [[ $1 == report ]]; then
  printf '%s\\n' "the answer of $2" "Run it:  pairsum run --backend tiles_omp" "tables:  a folder" "page:    a page"
fi
if [[ "$*" == *"${STUB_SLOW-nothing}"* ]]; then exec sleep "${STUB_SECONDS:-1}"; fi
if [[ "$*" == *"${STUB_FAILS-nothing}"* ]]; then exit "$STUB_STATUS"; fi
"""
CMAKE = """#!/bin/bash
echo "cmake $*" >>"$LOG"
if [[ $1 == --build && -z ${STUB_NO_PROGRAM-} ]]; then
  mkdir -p build/study/bin
  cp "$STUBS/pairsum" build/study/bin/
fi
exit "${STUB_CMAKE_STATUS:-0}"
"""
LOGS = """#!/bin/bash
echo "${0##*/} $*" >>"$LOG"
"""


class Sandbox:
    """A folder with the scripts, a PATH that starts with stubs, and the log of the calls."""

    def __init__(self, folder):
        self.tree = folder / "tree"
        self.stubs = folder / "stubs"
        self.log = folder / "log"
        for name in SCRIPTS:
            target = self.tree / name
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, target)
        self.stubs.mkdir()
        self.log.touch()
        for name, text in {"pairsum": PAIRSUM, "cmake": CMAKE, "ctest": LOGS, "python": LOGS}.items():
            self.stub(name, text)
        self.environment = {"PATH": f"{self.stubs}:/usr/bin:/bin", "LOG": str(self.log),
                            "STUBS": str(self.stubs), "PYTHON": str(self.stubs / "python"),
                            "LC_ALL": "C"}

    def stub(self, name, text):
        path = self.stubs / name
        path.write_text(text)
        path.chmod(0o755)

    def links(self, *names):
        """Let PATH hold the stubs and these programs of the system alone."""
        for name in names:
            os.symlink(shutil.which(name, path="/usr/bin:/bin"), self.stubs / name)
        self.environment["PATH"] = str(self.stubs)

    def arguments(self, command, **variables):
        return {"args": command, "cwd": self.tree, "text": True, "stdin": subprocess.DEVNULL,
                "stdout": subprocess.PIPE, "stderr": subprocess.PIPE,
                "env": {**self.environment, **variables}}

    def run(self, *command, **variables):
        return subprocess.run(timeout=60, **self.arguments(command, **variables))

    def start(self, *command, **variables):
        return subprocess.Popen(start_new_session=True, **self.arguments(command, **variables))

    def calls(self, start=""):
        return [line for line in self.log.read_text().splitlines() if line.startswith(start)]


@pytest.fixture
def sandbox(tmp_path):
    return Sandbox(tmp_path)
