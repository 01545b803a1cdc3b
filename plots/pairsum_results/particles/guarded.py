"""Work in a process of its own: libraries may crash on damaged files, or print much where one line is due."""
import os
import signal
import sys
import traceback
from typing import Callable

from ..rows import ResultsError


def guarded(work: Callable[[], int], clean: Callable[[int], None]) -> int:
    """The exit code of `work`, done in a child, where only Python's own stderr is heard. If a signal ends the child,
    `clean` gets its process number, and ResultsError says it."""
    sys.stdout.flush()
    sys.stderr.flush()
    child = os.fork()
    if not child:
        os._exit(_alone(work))
    _, status = os.waitpid(child, 0)
    if os.WIFSIGNALED(status):
        clean(child)
        name = signal.Signals(os.WTERMSIG(status)).name
        raise ResultsError(f"{name} ended a library while it read the files: one of them is damaged, or too large")
    return os.WEXITSTATUS(status)


def _alone(work: Callable[[], int]) -> int:
    sys.stderr = open(os.dup(2), "w", encoding="utf-8", errors="backslashreplace")
    os.dup2(os.open(os.devnull, os.O_WRONLY), 2)
    code = 1
    try:
        code = work()
    except BaseException:  # noqa: BLE001 a fault of this program, which the parent would not see
        traceback.print_exc()
    for stream in (sys.stdout, sys.stderr):
        try:
            stream.flush()
        except OSError:
            code = 2
    return code
