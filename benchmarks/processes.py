"""What a command costs, with all the processes that it starts, whoever their parents are."""

from __future__ import annotations

import ctypes
import os
import subprocess
import sys
import time
from collections.abc import Mapping, Sequence
from typing import NamedTuple

_SUBREAPER = 36  # PR_SET_CHILD_SUBREAPER


class Run(NamedTuple):
    """One run: seconds by the clock, seconds of processors, megabytes of the largest process."""

    wall: float
    processor: float
    memory: float


def measured(command: Sequence[str], environment: Mapping[str, str] | None = None) -> Run:
    """Run *command* and measure it, with what it leaves behind.

    Workers may be children of a server that outlives the command for a moment. Under Linux such orphans become children of
    this process, which waits for them; elsewhere their part is missing.
    """
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(_SUBREAPER, 1, 0, 0, 0)
    started = time.perf_counter()
    process = subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    error = process.stderr.read() if process.stderr else b""
    usages = [os.wait4(process.pid, 0)]
    wall = time.perf_counter() - started
    if usages[0][1]:
        raise SystemExit(f"{' '.join(command)} failed: {error.decode()}")
    while True:
        try:
            usages.append(os.wait4(-1, 0))
        except ChildProcessError:
            break
    spent = [usage for _, _, usage in usages]
    return Run(wall, sum(usage.ru_utime + usage.ru_stime for usage in spent), max(usage.ru_maxrss for usage in spent) / 1e3)
