"""What the programs write, and where: output that is lost, pipes that are closed, files that may not grow, messages."""

import json
import os
import resource
import shutil
import signal
import subprocess

import pytest
from conftest import BIN, SMALL, refused

TUNED = ["--dx", "0.1", "--M", "3", "--threads", "1", "--backend", "naive", "--grid", "hashed_grid", "--budget", "1"]
BENCHED = ["--dx", "0.1", "--M", "3", "--threads", "1"]
SPEAKING = {
    "list": ["pairsum", "list", "--json"],
    "help": ["pairsum", "--help"],
    "version": ["pairsum", "--version"],
    "verify": ["pairsum", "verify", "--dim", "3", "--dx", "0.1", "--M", "3", "--threads", "1", "--backend", "naive", "--isa", "scalar"],
    "run": ["pairsum", "run", *SMALL, "--out", "more.jsonl"],
    "dry run": ["pairsum", "run", *SMALL, "--dry-run"],
    "report": ["pairsum", "report", "--tables", "rows.jsonl"],
    "report --help": ["pairsum", "report", "--help"],
    "compare": ["pairsum", "compare", "naive_omp", "symmetric_omp", "--in", "rows.jsonl"],
    "history": ["pairsum", "history", "rows.jsonl"],
    "compare --json": ["pairsum", "compare", "naive_omp", "symmetric_omp", "--in", "rows.jsonl", "--json"],
    "tune": ["pairsum", "tune", *TUNED],
    "bench": ["pairsum_bench", *BENCHED, "--benchmark_list_tests"],
    "bench that runs": ["pairsum_bench", *BENCHED, "--benchmark_filter=^naive/|smoothing", "--benchmark_min_time=0.001"],
}
SPEAKS_ELSEWHERE = ["bench that runs"]  # what was built is said on stderr


def ran(words, folder, **how):
    how = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **how}
    return subprocess.run([BIN / words[0], *words[1:]], cwd=folder, text=True, timeout=300, **how)


@pytest.mark.parametrize("what", SPEAKING)
def test_output_that_is_lost_is_an_error(rows, tmp_path, what):
    with open("/dev/full", "w") as full:
        done = ran(SPEAKING[what], tmp_path, stdout=full)
    program = SPEAKING[what][0]
    assert done.returncode == 2
    assert done.stderr.splitlines()[-1] == f"{program}: its output is lost: No space left on device", done.stderr
    assert done.stderr.count("\n") == 1 or what in SPEAKS_ELSEWHERE, done.stderr


def test_a_message_that_is_lost_leaves_the_code(tmp_path):
    with open("/dev/full", "w") as full:
        assert ran(["pairsum", "jump"], tmp_path, stderr=full).returncode == 2
        assert ran(["pairsum", "jump"], tmp_path, stdout=full, stderr=full).returncode == 2


@pytest.mark.parametrize("kind", ["json", "csv", "console"])
def test_a_lost_file_of_bench_is_an_error(pairsum, tmp_path, kind):
    words = [*SMALL[:6], "--benchmark_filter=^naive/", "--benchmark_min_time=0.01", f"--benchmark_out_format={kind}"]
    done = pairsum(*words, "--benchmark_out=/dev/full", program="pairsum_bench")
    assert done.returncode == 2 and "naive/" in done.stdout
    assert done.stderr.endswith("\npairsum_bench: cannot write /dev/full: No space left on device\n"), done.stderr
    assert pairsum(*words, "--benchmark_out=kept", program="pairsum_bench").returncode == 0
    assert "naive/" in (tmp_path / "kept").read_text()


@pytest.mark.parametrize("restored", [True, False], ids=["usual", "SIGPIPE ignored"])
@pytest.mark.parametrize("what", SPEAKING)
def test_a_closed_pipe_ends_quietly(rows, tmp_path, what, restored):
    reader, writer = os.pipe()
    os.close(reader)
    try:
        done = ran(SPEAKING[what], tmp_path, stdout=writer, restore_signals=restored)
    finally:
        os.close(writer)
    assert done.returncode == -signal.SIGPIPE
    assert done.stderr == "" or what in SPEAKS_ELSEWHERE


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


def test_messages_are_one_line_without_control_characters(pairsum, rows):
    word, shown = "1\n2\x1b[31m\x9b3\x7f", r"1\n2\x1b[31m\x9b3\x7f"
    for words in (["run", "--isa", word], ["verify", "--backend", word], [word], ["run", "--" + word], ["run", word + ".json"], ["report", word],
                  ["compare", word, "b", "--in", rows], ["report", rows, "--" + word], ["history", "--phase", word, rows]):
        done = pairsum(*words)
        assert refused(done), words
        assert is_shown(done.stderr), words
        assert shown in done.stderr.replace("\\xc2", ""), (words, done.stderr)


def is_shown(text):
    return all(c.isprintable() or c == "\n" for c in text)


def test_what_is_printed_has_no_control_characters_of_others(pairsum, tmp_path):
    """Names of files and folders, whose users may choose any."""
    word = "a\nb\x1b[31mc\x7f\x9b"
    folder = tmp_path / word
    said = []
    for words in (["run", *SMALL, "--out", folder / "rows.jsonl"], ["history", folder], ["compare", folder, folder / "rows.jsonl"],
                  ["tune", *TUNED, "--save", tmp_path / (word + ".json")], ["tune", *TUNED, "--json", "--save", tmp_path / (word + ".json")]):
        done = pairsum(*words)
        assert done.returncode in ([0, 2] if words[1] == folder else [0]), (words, done.stderr)  # where it has nothing to compare
        said.append(done.stdout + done.stderr)
        assert is_shown(said[-1]), (words, said[-1])
    assert refused(pairsum("run", *SMALL, "--out", os.fsdecode(b"\xff.jsonl")), r"\xff.jsonl: its name should be UTF-8")
    done = pairsum("report", "--tables", folder, "--out", os.fsdecode(bytes(tmp_path) + b"/\xff"))
    assert done.returncode == 0 and is_shown(done.stdout)
    shutil.copy(folder / "rows.jsonl", folder / f"{word}.jsonl")
    done = pairsum("report", "--tables", folder)
    assert done.returncode == 0 and "taken once" in done.stdout and is_shown(done.stdout), done.stdout
    command = said[0].splitlines()[-1].strip()
    subprocess.run(["bash", "-c", command], check=True, cwd=tmp_path, capture_output=True)
    cut = (folder / "rows.jsonl").read_bytes()[:-3]
    (folder / "rows.jsonl").write_bytes(cut)
    done = pairsum("run", *SMALL, "--out", folder / "rows.jsonl")
    assert done.returncode == 0 and "is taken away" in done.stdout and "resuming" in done.stdout and is_shown(done.stdout)


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
    run = ["run", *words, "--oversubscribe", "--steps", "2", "--out", "rows.jsonl", "--rounds"]
    assert ran(["pairsum", *run, "2"], tmp_path).returncode == 0
    before = (tmp_path / "rows.jsonl").read_text()
    assert before.count('"kind":"round"') == 2
    for command in (["verify", "--dim", "3", "--isa", "scalar", *words], ["tune", "--budget", "5", *words], [*run, "3"]):
        done = ran(["pairsum", *command], tmp_path, env=huge)
        assert done.returncode == 2, (command, done.stdout, done.stderr)
        assert "before its work was done" in done.stdout + done.stderr, (command, done.stderr)
    after = (tmp_path / "rows.jsonl").read_text()
    assert after.startswith(before) and after.count('"kind":"round"') == 2, "what was not measured is no round"
    assert ran(["pairsum", *run, "3"], tmp_path).returncode == 0
    assert (tmp_path / "rows.jsonl").read_text().count('"kind":"round"') == 5


@pytest.mark.skipif(os.geteuid() != 0, reason="hides /sys, which only root may")
def test_a_machine_without_sys_is_measured_quietly(tmp_path):
    words = [BIN / "pairsum", "run", *SMALL, "--out", "rows.jsonl"]
    hidden = subprocess.run(["unshare", "-m", "bash", "-c", 'mount -t tmpfs none /sys || exit 77; exec "$@"', "-", *words], cwd=tmp_path, text=True,
                            capture_output=True, timeout=300)
    if hidden.returncode == 77 or "unshare" in hidden.stderr:
        pytest.skip("no mount of one's own here")
    assert (hidden.returncode, hidden.stderr) == (0, "")
