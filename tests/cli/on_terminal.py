"""Runs a program on a pseudo-terminal, and checks what it wrote there."""

import fcntl
import os
import pty
import re
import select
import struct
import subprocess
import termios
import time
from typing import NamedTuple

UPDATE = re.compile(r"\[[#.]+\] +(\d+) %")
MOST_A_SECOND = 10


class Chunk(NamedTuple):
    """What was read at once, seconds after the start, and how wide the terminal may have been when it was written."""
    seconds: float
    text: str
    columns: int


def set_columns(terminal, columns):
    fcntl.ioctl(terminal, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))


def run(words, columns, cwd, resize=None, timeout=120, **environment):
    """Exit code and transcript. `resize`: (percent, columns): the width from when so much is shown."""
    ours, theirs = pty.openpty()
    set_columns(theirs, columns)
    process = subprocess.Popen([str(w) for w in words], cwd=cwd, stdout=theirs, stderr=theirs, stdin=subprocess.DEVNULL,
                               env={**{k: v for k, v in os.environ.items() if k != "NO_COLOR"}, "TERM": "xterm", **environment})
    os.close(theirs)
    began, chunks, widest = time.monotonic(), [], columns
    while time.monotonic() - began < timeout:
        if not select.select([ours], [], [], 0.05)[0]:
            if process.poll() is not None:
                break
            continue
        try:
            text = os.read(ours, 65536).decode()
        except OSError:  # nobody has it open any more
            break
        chunks.append(Chunk(time.monotonic() - began, text, widest))
        shown = UPDATE.findall(text)
        if shown:
            widest = columns  # an update of after the resize was read
        if resize and shown and int(shown[-1]) >= resize[0]:
            columns, resize = resize[1], None
            set_columns(ours, columns)  # an update may be under way
    os.close(ours)
    process.kill()
    return process.wait(), chunks


def complaints(chunks):
    """What is wrong with the progress line of a transcript: it should stay one line that fits, never go back, be written
    no more than ten times a second, and be gone in the end."""
    found, line, column, escape = [], "", 0, ""
    percents, times = [], []
    for chunk in chunks:
        for c in chunk.text:
            if escape or c == "\x1b":
                escape += c
                if c.isalpha():
                    line = line[:column] if escape == "\x1b[K" else line
                    escape = ""
            elif c == "\r":
                column = 0
            elif c == "\n":
                if UPDATE.search(line):
                    found.append(f"scrolled: {line!r}")
                line, column = "", 0
            else:
                line, column = line[:column] + c + line[column + 1:], column + 1
                if column >= chunk.columns and UPDATE.search(line):
                    found.append(f"wider than {chunk.columns} columns: {line!r}")
        shown = [int(p) for p in UPDATE.findall(chunk.text)]
        percents += shown
        times += [chunk.seconds] * len(shown)
    if UPDATE.search(line):
        found.append(f"left behind: {line!r}")
    found += [f"went back from {a} to {b} %" for a, b in zip(percents, percents[1:]) if b < a]
    if times and len(times) > MOST_A_SECOND * (times[-1] - times[0]) + 3:  # the reader may be late at both ends
        found.append(f"{len(times)} updates in {times[-1] - times[0]:.2f} s")
    return found
