"""The processes of this machine that count: how they begin, what they import, how long they may take, and how they end."""

from __future__ import annotations

import ctypes
import gc
import multiprocessing
import os
import pickle
import signal
import threading
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from functools import lru_cache
from multiprocessing import connection
from typing import Any, TypeVar

Task = TypeVar("Task")
Result = TypeVar("Result")

# Never forks of this process: one with threads can wait for a lock that nobody holds. A server without threads forks workers
# that have their imports already; where there is no such thing each is spawned.
_METHOD = "forkserver" if "forkserver" in multiprocessing.get_all_start_methods() else "spawn"
# pyarrow imports pandas with the first array.
_IMPORTED = ["lipdb.coverage.scan", "lipdb.coverage.fast.counter", "lipdb.speech.espeak", "phonemizer.backend.espeak.wrapper", "pandas"]
PRELOADED = "lipdb.coverage.preload"
"""What the server of processes imports for a program that does nothing but count."""
READERS = {"cmn": "pypinyin"}
"""What reads the text of a language, takes long to import, and does so without a word."""


def make_ready(language: str) -> None:
    """Begin to import what processes need to count *language*, beside whatever this process does next.

    Only for a program that does nothing else: whatever it forks from the same server has no pandas in pyarrow.
    """
    _serve([PRELOADED, *filter(None, [READERS.get(language)])])


def _serve(modules: list[str]) -> None:
    """Start the server from which processes are forked, with *modules* imported; a second time does nothing."""
    if _METHOD == "forkserver":
        from multiprocessing import forkserver, resource_tracker

        multiprocessing.get_context(_METHOD).set_forkserver_preload(modules)
        resource_tracker.ensure_running()  # Else the server would start it, and let Ctrl-C through again.
        before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})  # Ctrl-C is this process's business, not its imports'.
        try:
            forkserver.ensure_running()
        finally:
            signal.pthread_sigmask(signal.SIG_SETMASK, before)


@contextmanager
def process_pool(count: int) -> Iterator[ProcessPoolExecutor]:
    """*count* processes; afterwards none of them is left, whatever they do."""
    _serve(_IMPORTED)
    context = multiprocessing.get_context(_METHOD)
    pool = ProcessPoolExecutor(count, mp_context=context, initializer=_begin, initargs=(dict(os.environ),))
    try:
        yield pool
    finally:
        _end(pool)


@dataclass(frozen=True, slots=True)
class Packed:
    """Work that is pickled once for all tasks, and unpickled once in each process: it may hold all the tables of a voice."""

    raw: bytes

    def __call__(self, task: Any) -> Any:
        """Do the work for *task*."""
        return _unpacked(self.raw)(task)


@lru_cache(maxsize=1)
def _unpacked(raw: bytes) -> Callable[[Any], Any]:
    work: Callable[[Any], Any] = pickle.loads(raw)
    return work


CAN_LIMIT = hasattr(signal, "setitimer")


def within(seconds: float, work: Callable[[Task], Result], task: Task) -> Result:
    """Do *work*, for *seconds* of the processor's time at most: then the system ends the process.

    A call that hangs in C can't be stopped in any other way; time of the processor, so that a busy or sleeping machine does no harm.
    """
    signal.setitimer(signal.ITIMER_VIRTUAL, seconds)
    try:
        return work(task)
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)


def _begin(environment: Mapping[str, str]) -> None:
    """Prepare a worker process: Ctrl-C is its parent's business, and it ends when its parent does, however that ends.

    *environment* is its parent's, which may have changed since the first process was made ready.
    """
    os.environ.clear()
    os.environ.update(environment)
    _keep_memory()
    gc.freeze()  # What is there now stays: nobody need look through it for garbage again and again.
    gc.enable()
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    parent = multiprocessing.parent_process()
    if parent is not None:
        threading.Thread(target=_follow, args=(parent.sentinel,), daemon=True).start()


def _keep_memory() -> None:
    """Have the C library keep memory that arrays let go of; to be given it anew can take as long as the work that is done in it.

    Only glibc knows how.
    """
    with suppress(AttributeError, OSError, TypeError):
        options = ctypes.CDLL(None).mallopt
        options(-3, 1 << 25)  # M_MMAP_THRESHOLD, the largest that it takes
        options(-1, 1 << 28)  # M_TRIM_THRESHOLD


def _follow(parent: int) -> None:
    connection.wait([parent])
    os._exit(1)


def _end(pool: ProcessPoolExecutor) -> None:
    """End the processes of *pool* at once, whatever they do."""
    for process in list((pool._processes or {}).values()):
        process.terminate()
    # Waits for the pool's own thread, which finds out and takes what is left of them away.
    pool.shutdown(cancel_futures=True)
