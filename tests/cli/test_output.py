"""What the programs write, and where: output that is lost, pipes that are closed, files that may not grow, messages."""

import json
import os
import resource
import signal
import subprocess

import pytest
from conftest import BIN, SMALL, refused

SPEAKING = {
    "list": ["pairsum", "list", "--json"],
    "help": ["pairsum", "--help"],
    "verify": ["pairsum", "verify", "--dim", "3", "--dx", "0.1", "--M", "3", "--threads", "1", "--backend", "naive", "--isa", "scalar"],
    "run": ["pairsum", "run", *SMALL, "--out", "more.jsonl"],
    "dry run": ["pairsum", "run", *SMALL, "--dry-run"],
    "report": ["pairsum", "report", "--tables", "rows.jsonl"],
    "report --help": ["pairsum", "report", "--help"],
    "compare": ["pairsum", "compare", "naive_omp", "symmetric_omp", "--in", "rows.jsonl"],
    "history": ["pairsum", "history", "rows.jsonl"],
    "bench": ["pairsum_bench", "--dx", "0.1", "--M", "3", "--threads", "1", "--benchmark_list_tests"],
}


def ran(words, folder, **how):
    how = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **how}
    return subprocess.run([BIN / words[0], *words[1:]], cwd=folder, text=True, timeout=300, **how)


@pytest.mark.parametrize("what", SPEAKING)
def test_output_that_is_lost_is_an_error(rows, tmp_path, what):
    with open("/dev/full", "w") as full:
        done = ran(SPEAKING[what], tmp_path, stdout=full)
    program = "pairsum_bench" if what == "bench" else "pairsum"
    assert done.returncode == 2 and done.stderr.startswith(f"{program}: its output is lost: ") and done.stderr.count("\n") == 1, done.stderr


def test_a_message_that_is_lost_leaves_the_code(tmp_path):
    with open("/dev/full", "w") as full:
        assert ran(["pairsum", "jump"], tmp_path, stderr=full).returncode == 2
        assert ran(["pairsum", "jump"], tmp_path, stdout=full, stderr=full).returncode == 2


@pytest.mark.parametrize("restored", [True, False], ids=["usual", "SIGPIPE ignored"])
@pytest.mark.parametrize("what", SPEAKING)
def test_a_closed_pipe_ends_quietly(rows, tmp_path, what, restored):
    reader, writer = os.pipe()
    os.close(reader)
    try:
        done = ran(SPEAKING[what], tmp_path, stdout=writer, restore_signals=restored)
    finally:
        os.close(writer)
    assert (done.returncode, done.stderr) == (-signal.SIGPIPE, "")


def test_closed_descriptors_are_not_taken_by_files(pairsum, tmp_path):
    """The store of references would be descriptor 1, and what a process says of particles that leave would be in it."""
    words = ["run", "--case", "dam_break", *SMALL[:6], "--dt", "0.01", "--steps", "60", "--outside", "drop", "--rounds", "2"]
    done = subprocess.run(["bash", "-c", 'exec "$@" <&- >&- 2>&-', "-", BIN / "pairsum", *words, "--out", "rows.jsonl"], cwd=tmp_path, timeout=300)
    assert done.returncode == 0
    kinds = [json.loads(line)["kind"] for line in (tmp_path / "rows.jsonl").read_text().splitlines()]
    assert kinds.count("round") == 2 and kinds.count("void") == 0 and kinds[-1] == "end"


def no_larger_than(size):
    return lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))


def test_files_that_may_not_grow_are_an_error(rows, tmp_path):
    before = rows.read_bytes()
    done = ran(["pairsum", "run", *SMALL[:-1], "100", "--out", rows], tmp_path, preexec_fn=no_larger_than(len(before) + 100))
    assert done.returncode == 2 and "File too large" in done.stderr, done.stderr
    assert rows.read_bytes().startswith(before) and rows.read_bytes().endswith(b"\n")
    done = ran(["pairsum", "report", rows, "--out", "said"], tmp_path, preexec_fn=no_larger_than(1000))
    assert refused(done, "cannot write said/", "File too large")
    assert not list((tmp_path / "said").rglob("*.tmp"))


def test_a_killed_report_leaves_no_file_that_is_not_whole(tmp_path):
    """Killed in the midst of a file's bytes."""
    script = ("import os, pathlib, signal, sys\n"
              "from pairsum_results.summary import write_file\n"
              "class text(str):\n"
              "    def encode(self):\n"
              "        os.kill(os.getpid(), signal.SIGKILL)\n"
              "write_file(pathlib.Path('old.txt'), 'new')\n"
              "write_file(pathlib.Path('old.txt'), text())\n")
    (tmp_path / "old.txt").write_text("old")
    python = {**os.environ, "PYTHONPATH": str(BIN.parent / "share/pairsum/python")}
    done = subprocess.run([os.environ.get("PYTHON", "/usr/bin/python3"), "-c", script], cwd=tmp_path, env=python, timeout=60)
    assert done.returncode == -signal.SIGKILL
    assert [(path.name, path.read_text()) for path in tmp_path.iterdir()] == [("old.txt", "new")]


@pytest.mark.parametrize("word, shown", [("1\n2", r"1\n2"), ("\x1b[31mred", r"\x1b[31mred"), ("\x9b31m", r"\x9b31m"), ("a\x7f", r"a\x7f")])
def test_messages_are_one_line_without_control_characters(pairsum, rows, word, shown):
    for words in (["run", "--isa", word], ["verify", "--backend", word], [word], ["run", "--" + word], ["run", word + ".json"], ["report", word],
                  ["compare", word, "b", "--in", rows], ["report", rows, "--" + word], ["history", "--phase", word, rows]):
        done = pairsum(*words)
        assert refused(done), words
        assert all(c.isprintable() or c == "\n" for c in done.stderr), words
        assert shown in done.stderr.replace("\\xc2", ""), (words, done.stderr)


def test_messages_are_cut(pairsum, rows):
    long = "a" * 100_000
    for words in (["run", "--isa", long], ["run", "--dx", "1," * 10_000], ["run", long + ".json"], [long], ["report", long], ["run", "--" + long],
                  ["run", "--isa", "b c " * 25_000], ["report", "b c " * 25_000], ["compare", long, "b", "--in", rows]):
        done = pairsum(*words)
        assert refused(done), words[0]
        assert len(done.stderr) < 5000, words[0]


def test_a_library_that_ends_the_program_gives_it_no_code_of_ours(tmp_path):
    """libgomp calls exit(1) where it cannot make a thread, and 1 is ours for a verification that failed."""
    huge = {**os.environ, "OMP_STACKSIZE": "1000G"}
    words = ["--dx", "0.08", "--M", "3", "--threads", "2", "--backend", "naive_omp,symmetric_omp"]
    for command in (["verify", "--dim", "3", "--isa", "scalar"], ["tune", "--budget", "5"], ["run", "--steps", "2", "--rounds", "1", "--out", "rows.jsonl"]):
        done = ran(["pairsum", *command, *words], tmp_path, env=huge)
        assert done.returncode == 2, (command, done.stdout, done.stderr)
        assert "before its work was done" in done.stdout + done.stderr, (command, done.stderr)
    assert '"round"' not in (tmp_path / "rows.jsonl").read_text() if (tmp_path / "rows.jsonl").exists() else True




@pytest.mark.skipif(os.geteuid() != 0, reason="hides /sys, which only root may")
def test_a_machine_without_sys_is_measured_quietly(tmp_path):
    words = [BIN / "pairsum", "run", *SMALL, "--out", "rows.jsonl"]
    hidden = subprocess.run(["unshare", "-m", "bash", "-c", 'mount -t tmpfs none /sys || exit 77; exec "$@"', "-", *words], cwd=tmp_path, text=True,
                            capture_output=True, timeout=300)
    if hidden.returncode == 77 or "unshare" in hidden.stderr:
        pytest.skip("no mount of one's own here")
    assert (hidden.returncode, hidden.stderr) == (0, "")
