#!/usr/bin/env python3
"""A soak: studies run one after another while they are killed, stopped, robbed of disk and time of day, under load.

After every disturbance the rows file must hold every round that was ever finished, once. At the end no process, no file
in /dev/shm and none in the temporary folder may be left. Prints one JSON object of counts; exit code 1 if anything was
lost, doubled or left.
"""
import argparse
import collections
import json
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

DISK = 32 << 20  # bytes of the small disk
FEWEST = 5  # starts of a study, however slow the machine
ACTIONS = ["kill the study", "kill a worker", "kill all", "stop", "interrupt", "terminate", "fill the disk", "set the clock",
           "load", "nothing"]


class Faults(Exception):
    """What must not happen, in one line."""


def finished_rounds(text: str, cut: bool = False) -> dict[int, str]:
    """The rounds that a rows file has closed, with the time of that. `cut`: its last line may be incomplete. Raises
    Faults for a line that is no row, and for a round that is closed twice or whose rows are not those it counts."""
    lines = text.split("\n")
    last = lines.pop()
    if last and not cut:
        raise Faults(f"the last line is cut: {last[:60]}")
    closed: dict[int, str] = {}
    void: set[int] = set()
    samples: collections.Counter = collections.Counter()
    for number, line in enumerate(lines, 1):
        try:
            row = json.loads(line)
        except ValueError:
            raise Faults(f"line {number} is no JSON: {line[:60]}") from None
        if row["kind"] == "sample":
            samples[row["round"]] += 1
        if row["kind"] == "void":
            void.add(row["round"])
        if row["kind"] == "round":
            if row["round"] in closed:
                raise Faults(f"round {row['round']} is closed twice")
            if row["rows"] != samples[row["round"]]:
                raise Faults(f"round {row['round']} has {samples[row['round']]} rows of {row['rows']}")
            closed[row["round"]] = row["utc"]
    if lost := sorted(set(closed) & void):
        raise Faults(f"round {lost[0]} was finished and is void")
    return closed


def nothing_lost(before: dict[int, str], after: dict[int, str]) -> None:
    """Raises Faults unless every round of before is in after, unchanged."""
    for number, utc in before.items():
        if after.get(number) != utc:
            raise Faults(f"round {number}, finished at {utc}, is {'gone' if number not in after else 'another'}")


def in_group(group: int) -> list[int]:
    """The processes of a session that are alive."""
    found = []
    for entry in pathlib.Path("/proc").iterdir():
        try:
            fields = (entry / "stat").read_text().rsplit(")", 1)[1].split()
        except (OSError, IndexError):
            continue
        if int(fields[3]) == group and fields[0] != "Z":
            found.append(int(entry.name))
    return found


def send(pids: list[int], what: signal.Signals) -> None:
    for pid in pids:
        try:
            os.kill(pid, what)
        except ProcessLookupError:
            pass


class Soak:
    def __init__(self, program: str, words: list[str], folder: pathlib.Path, seed: int, wait_s: float):
        self.wait_s = wait_s
        self.words, self.folder, self.random = [program, "run", *words], folder, random.Random(seed)
        self.counts: collections.Counter = collections.Counter()
        self.rounds: dict[str, dict[int, str]] = {}
        for name in ("disk", "tmp"):
            (folder / name).mkdir()
        self.disk = folder / "disk"
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={DISK}", "soak", str(self.disk)], check=False,
                                 stderr=subprocess.DEVNULL)
        self.mounted = mounted.returncode == 0
        self.clock, self.ballast = folder / "clock", self.disk / "ballast"
        self.clock.write_text("0")
        library = folder / "jumping_clock.so"
        source = pathlib.Path(__file__).with_name("jumping_clock.c")
        subprocess.run(["cc", "-shared", "-fPIC", "-O1", "-o", str(library), str(source)], check=True)
        self.environment = {**os.environ, "TMPDIR": str(folder / "tmp"), "LD_PRELOAD": str(library),
                            "JUMPING_CLOCK": str(self.clock)}

    def rows(self, path: pathlib.Path, cut: bool) -> None:
        text = path.read_text() if path.exists() else ""
        after = finished_rounds(text, cut)
        nothing_lost(self.rounds.get(path.name, {}), after)
        self.rounds[path.name] = after

    def study(self, path: pathlib.Path, until: float) -> bool:
        """One start; true if the study ended by itself, with every round it wants."""
        over = time.time() >= until and self.counts["starts"] >= FEWEST
        action = "nothing" if over else self.random.choice(ACTIONS)
        log = (self.folder / "log").open("w+")
        with subprocess.Popen([*self.words, "--out", str(path)], stdout=log, stderr=log, env=self.environment,
                              start_new_session=True) as process:
            group = process.pid
            if action != "nothing":
                try:
                    process.wait(self.random.expovariate(1 / self.wait_s))
                except subprocess.TimeoutExpired:
                    self.disturb(action, process, group)
            process.wait()
            self.end_of_group(group)
        if self.ballast.exists():
            self.ballast.unlink()
        self.counts["starts"] += 1
        self.rows(path, cut=action.startswith("kill"))
        log.seek(0)
        said = log.read()
        if process.returncode not in (0, 2, 130, 143, -9, -15) or action == "nothing" and process.returncode:
            raise Faults(f"after '{action}' exit {process.returncode}: {said[-2000:]}")
        return process.returncode == 0

    def disturb(self, action: str, process: subprocess.Popen, group: int) -> None:
        self.counts[action] += 1
        workers = [pid for pid in in_group(group) if pid != process.pid]
        if action == "kill the study":
            send([process.pid], signal.SIGKILL)
        elif action == "kill a worker":
            send(workers, signal.SIGKILL)
        elif action == "kill all":
            send([process.pid, *workers], signal.SIGKILL)
        elif action == "stop":
            stopped = [process.pid, *workers]
            send(stopped, signal.SIGSTOP)
            time.sleep(self.random.uniform(0.1, 2))
            send(stopped, signal.SIGCONT)
        elif action == "interrupt":
            send([process.pid, *workers], signal.SIGINT)  # as a terminal does
        elif action == "terminate":
            send([process.pid], signal.SIGTERM)
        elif action == "fill the disk" and self.mounted:
            with self.ballast.open("wb") as stream:
                room = os.statvfs(self.disk)
                try:
                    stream.write(bytes(max(0, room.f_bavail * room.f_frsize - self.random.randrange(20_000))))
                except OSError:
                    pass
        elif action == "set the clock":
            self.clock.write_text(str(self.random.randrange(-10**6, 10**6)))
        elif action == "load":
            busy = "while :; do :; done"
            with subprocess.Popen(["timeout", str(self.random.uniform(1, 5)), "sh", "-c", busy]) as load:
                load.wait()

    def end_of_group(self, group: int) -> None:
        """Workers end with their study, within seconds."""
        for _ in range(100):
            if not in_group(group):
                return
            time.sleep(0.1)
        left = in_group(group)
        send(left, signal.SIGKILL)
        raise Faults(f"processes {left} were left behind")

    def run(self, seconds: float) -> None:
        shared = in_shared_memory()
        until, number = time.time() + seconds, 0
        while time.time() < until or self.counts["starts"] < FEWEST:
            number += 1
            path = self.disk / f"{number}.jsonl"
            while not self.study(path, until):
                pass
            self.counts["studies"] += 1
            self.counts["rounds"] += len(self.rounds[path.name])
            shutil.move(path, self.folder)  # the disk is small
        if left := sorted(in_shared_memory() - shared):
            raise Faults(f"left in /dev/shm: {left}")
        if left := sorted(os.listdir(self.folder / "tmp")):
            raise Faults(f"left in the temporary folder: {left}")


def in_shared_memory() -> set[str]:
    """Names in /dev/shm, but those that MPI jobs and clang's OpenMP make there, of programs that run beside a soak."""
    return {name for name in os.listdir("/dev/shm") if not name.startswith(("vader_segment", "__KMP_"))}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default="build/study/bin/pairsum")
    parser.add_argument("--seconds", type=float, default=3600)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--wait", type=float, default=4.0, help="seconds before something is done to a study, on average")
    parser.add_argument("words", nargs="*", default=["quick"], help="what is run (default: quick); after --")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="soak-") as folder:
        soak = Soak(str(pathlib.Path(given.program).resolve()), given.words, pathlib.Path(folder), given.seed, given.wait)
        fault = ""
        try:
            soak.run(given.seconds)
        except Faults as found:
            fault = str(found)
        finally:
            if soak.mounted:
                subprocess.run(["umount", str(soak.disk)], check=False)
    print(json.dumps({**soak.counts, "kills": sum(n for word, n in soak.counts.items() if word.startswith("kill")),
                      "fault": fault or None}))
    return 1 if fault else 0


if __name__ == "__main__":
    sys.exit(main())
