"""pairsum simulate: what it prints and keeps, how it goes on, and what it refuses."""

import os
import signal
import subprocess
import time

import pytest
from conftest import BIN, refused

h5py = pytest.importorskip("h5py", reason="python3-h5py is not installed")
np = pytest.importorskip("numpy")


def words(**changed):
    """The options of a small simulation, some changed."""
    given = {"dx": 0.06, "until": 0.06, "every": 0.02, "threads": 1} | changed
    return [text for name, value in given.items() for text in (f"--{name}", str(value))]


WORDS = words()


def wait_for(path, process):
    while not path.exists():
        assert process.poll() is None, "it ended before it wrote " + path.name
        time.sleep(0.002)


def datasets(path):
    with h5py.File(path) as file:
        return {name: file["PartType0"][name][()] for name in file["PartType0"]}, dict(file["Header"].attrs)


def same(one, other):
    (a, of_a), (b, of_b) = datasets(one), datasets(other)
    return a.keys() == b.keys() and all(np.array_equal(a[k], b[k]) for k in a) and of_a["Time"] == of_b["Time"]


@pytest.fixture
def kept(pairsum, tmp_path):
    """The folder of a simulation."""
    done = pairsum("simulate", *WORDS, "--snapshots", "whole")
    assert done.returncode == 0, done.stderr
    return tmp_path / "whole"


def test_keeps_snapshots_a_series_a_log_and_a_checkpoint(pairsum, kept):
    names = [f"snapshot_{k:04}.hdf" for k in range(4)]
    assert sorted(p.name for p in kept.iterdir()) == ["checkpoint.hdf", "log.csv", *names, "snapshots.xmf"]
    assert all(name in (kept / "snapshots.xmf").read_text() for name in names)
    log = (kept / "log.csv").read_text().splitlines()
    head = log[0].split(",")
    assert [line.split(",")[head.index("t_s")] for line in (log[1], log[-1])] == ["0", "0.06"]
    assert all(len(line.split(",")) == len(head) for line in log)
    columns, header = datasets(kept / names[-1])
    assert header["Time"] == 0.06 and header["Dimension"] == 3 and header["Lost"] == 0
    assert set(np.unique(columns["Kind"])) == {0, 1}
    done = pairsum("info", kept / names[-1])
    assert done.returncode == 0, done.stderr
    assert f"fluid     {(columns['Kind'] == 0).sum()}" in done.stdout


def test_goes_on_after_a_kill_with_the_same_bits(pairsum, tmp_path):
    longer, whole, cut = words(until=0.3, every=0.05), tmp_path / "whole", tmp_path / "cut"
    assert pairsum("simulate", *longer, "--snapshots", whole).returncode == 0
    process = subprocess.Popen([BIN / "pairsum", "simulate", *longer, "--snapshots", cut], stdout=subprocess.DEVNULL,
                               start_new_session=True)
    wait_for(cut / "snapshot_0002.hdf", process)
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    assert not (cut / "snapshot_0006.hdf").exists()
    (cut / "log.csv").write_text((cut / "log.csv").read_text() + "99999,0.9,torn")
    done = pairsum("simulate", *longer, "--snapshots", cut)
    assert done.returncode == 0 and "went on from t = 0." in done.stdout, done.stdout + done.stderr
    for k in range(7):
        assert same(cut / f"snapshot_{k:04}.hdf", whole / f"snapshot_{k:04}.hdf"), k
    assert (cut / "log.csv").read_text() == (whole / "log.csv").read_text()


def test_other_bits_are_told_apart(kept, tmp_path, pairsum):
    assert pairsum("simulate", *WORDS, "--cfl", "0.19", "--snapshots", "other").returncode == 0
    assert not same(tmp_path / "other/snapshot_0003.hdf", kept / "snapshot_0003.hdf")


def test_goes_further_when_it_is_told_to(pairsum, kept):
    done = pairsum("simulate", *words(until=0.08, log=0.0003), "--snapshots", kept)
    assert done.returncode == 0 and "went on from t = 0.06" in done.stdout
    assert (kept / "snapshot_0004.hdf").exists()


def test_a_longer_until_goes_on_at_the_same_pace(pairsum, tmp_path):
    given = ["simulate", "--dx", "0.08", "--threads", "1", "--snapshots", "s"]
    first = pairsum(*given, "--until", "0.02")
    done = pairsum(*given, "--until", "0.04")
    assert done.returncode == 0 and "went on from t = 0.02" in done.stdout, done.stderr
    assert len(list((tmp_path / "s").glob("snapshot_*.hdf"))) == 41  # every 1 ms as before
    start = float(first.stdout.splitlines()[1].split()[2])
    t, _, energy, change = done.stdout.splitlines()[1].split()[:4]
    assert t == "0.021" and float(change) == pytest.approx(100 * (float(energy) / start - 1), abs=0.06)


def test_fresh_removes_what_is_there_and_nothing_else(pairsum, kept):
    (kept / "snapshot_notes.hdf").write_text("mine")
    assert pairsum("simulate", *words(until=0.02), "--fresh", "--snapshots", kept).returncode == 0
    assert sorted(p.name for p in kept.glob("snap*")) == ["snapshot_0000.hdf", "snapshot_0001.hdf", "snapshot_notes.hdf",
                                                          "snapshots.xmf"]


def test_a_refused_request_removes_nothing(pairsum, kept, tmp_path):
    before = sorted(kept.iterdir())
    assert refused(pairsum("simulate", *words(cfl=7), "--fresh", "--snapshots", kept), "--cfl")
    assert sorted(kept.iterdir()) == before
    assert refused(pairsum("simulate", *words(cfl=7), "--snapshots", "new"), "--cfl")
    assert not (tmp_path / "new").exists()


def test_files_of_others_are_not_written_over(pairsum, tmp_path):
    (tmp_path / "theirs").mkdir()
    (tmp_path / "theirs/log.csv").write_text("precious\n")
    assert refused(pairsum("simulate", *WORDS, "--snapshots", "theirs"), "theirs", "--fresh")
    assert (tmp_path / "theirs/log.csv").read_text() == "precious\n"
    (tmp_path / "file").write_text("")
    assert refused(pairsum("simulate", *WORDS, "--snapshots", "file/s"), "cannot make the folder")


def test_another_simulation_is_not_gone_on_with(pairsum, kept):
    assert refused(pairsum("simulate", *WORDS, "--cfl", "0.1", "--snapshots", kept), "cfl 0.2", "0.1", "--fresh")
    assert pairsum("simulate", *WORDS, "--cfl", "0.1", "--fresh", "--snapshots", kept).returncode == 0


def test_a_damaged_checkpoint_is_refused(pairsum, kept):
    (kept / "checkpoint.hdf").write_bytes((kept / "checkpoint.hdf").read_bytes()[:3000])
    assert refused(pairsum("simulate", *WORDS, "--snapshots", kept), "checkpoint.hdf")


@pytest.mark.parametrize("changed, says", [
    ({"until": 0}, ["--until", "positive"]),
    ({"checkpoint": 0.1}, ["--checkpoint", "--snapshots"]),
    ({"cfl": 2}, ["--cfl", "between 0 and 1"]),
    ({"backend": "naive,symmetric"}, ["one of each", "--backend"]),
    ({"dt": 0.05, "until": 2, "every": 1}, ["step ", "particle ", "--dt"]),
    ({"interaction": "ferrari09_hard", "precision": "float"}, ["float"]),
    ({"state": "evolved:x"}, ["evolved:0.5"]),
])
def test_refusals(pairsum, changed, says):
    done = pairsum("simulate", *words(**changed))
    assert done.returncode == 2 and len(done.stderr.splitlines()) == 1, done.stderr
    assert all(word in done.stderr for word in says), done.stderr


def test_an_interrupt_keeps_the_checkpoint(tmp_path):
    process = subprocess.Popen([BIN / "pairsum", "simulate", *words(until=90), "--snapshots", "cut"], cwd=tmp_path, text=True,
                               stdout=subprocess.PIPE)
    wait_for(tmp_path / "cut/snapshot_0001.hdf", process)
    process.send_signal(signal.SIGINT)
    assert "goes on from the last checkpoint" in process.communicate()[0]
    assert process.returncode == 130
