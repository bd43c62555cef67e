"""Who counts: threads or processes of this machine, or an existing Dask cluster, all through one interface.

Each is a `concurrent.futures.Executor`: tasks go in, results come out in any order. What is lost with a worker is done again by
others: Dask does so itself, and for processes of this machine `Workers` starts new ones.
"""

from __future__ import annotations

import ctypes
import gc
import multiprocessing
import os
import pickle
import signal
import threading
from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import ExitStack, suppress
from dataclasses import dataclass
from functools import lru_cache, partial
from multiprocessing import connection
from typing import Any, Generic, NamedTuple, Self, TypeVar

from lipdb.errors import LipdbError

Task = TypeVar("Task")
Result = TypeVar("Result")
THREADS = "threads"
AHEAD = 2
"""Tasks for each worker that are not done yet: so that none is idle, and memory stays bounded."""


class Done(NamedTuple, Generic[Task, Result]):
    """A task and its result; None when it ended the worker that did it, twice, the second time with nothing beside it."""

    task: Task
    result: Result | None


class Workers:
    """Those who work. Use it as a context manager; afterwards none of them is left.

    *count* is how many (0: one a core); *threads* of this process or processes of their own. *scheduler* may be ``threads`` too;
    with the address of a Dask scheduler, or ``local`` for a cluster of our own, they are Dask's. *seconds* tells how much time of
    a processor a task may take before a process gives it up; only the processes of this machine obey it.
    """

    def __init__(
        self, count: int = 0, *, threads: bool = False, scheduler: str = "", seconds: Callable[[Any], float] | None = None
    ) -> None:
        self.count = count or cores()
        self._threads = threads or scheduler == THREADS
        self._scheduler = "" if scheduler == THREADS else scheduler
        self._seconds = seconds
        self._executor: Executor
        self._stack = ExitStack()

    def __enter__(self) -> Self:
        self._start()
        return self

    def __exit__(self, *_: object) -> None:
        self._stack.close()

    def map(self, work: Callable[[Task], Result], tasks: Iterable[Task]) -> Iterator[Done[Task, Result]]:
        """The result of *work* for each of *tasks*, in any order; *work* and tasks are such as can be pickled.

        Tasks are taken only as fast as they are done. Raises what *work* raises.
        """
        suspects: list[Task] = []
        running: dict[Future[Result], Task] = {}
        packed = self._packed(work)
        for task in tasks:
            running[self._submit(packed, task)] = task
            if len(running) >= self.count * AHEAD:
                yield from self._finished(running, suspects)
        while running:
            yield from self._finished(running, suspects)
        for task in suspects:
            yield Done(task, self.alone(work, task))

    def alone(self, work: Callable[[Task], Result], task: Task) -> Result | None:
        """The result of *work* for *task* with nothing beside it; None when it ended its worker.

        Raises `LipdbError` when workers end whatever they are given.
        """
        future = self._submit(self._packed(work), task)
        wait([future])
        if not _lost(future):
            return future.result()
        alive = self._submit(_nothing, task)
        wait([alive])
        if _lost(alive):
            raise LipdbError("the processes that count end as soon as they begin; count with --scheduler threads, or see `lipdb doctor`")
        return None

    def _finished(self, running: dict[Future[Result], Task], suspects: list[Task]) -> Iterator[Done[Task, Result]]:
        """Wait for some of *running*; those whose worker was lost become *suspects*."""
        for future in wait(running, return_when=FIRST_COMPLETED).done:
            task = running.pop(future)
            if _lost(future):
                suspects.append(task)
            else:
                yield Done(task, future.result())

    def _packed(self, work: Callable[[Task], Result]) -> Callable[[Task], Result]:
        """*work* such as processes of this machine take it."""
        return work if self._threads or self._scheduler else _Packed(pickle.dumps(work))

    def _submit(self, work: Callable[[Task], Result], task: Task) -> Future[Result]:
        limited = self._seconds and not self._threads and not self._scheduler and _CAN_LIMIT
        do = partial(_within, self._seconds(task), work) if limited and self._seconds else work
        try:
            return self._executor.submit(do, task)
        except BrokenProcessPool:
            self._stack.close()
            self._start()
            return self._executor.submit(do, task)

    def _start(self) -> None:
        if self._scheduler:
            from lipdb.coverage.dask_workers import dask_executor

            self._executor, self.count = self._stack.enter_context(dask_executor(self._scheduler, self.count))
        elif self._threads:
            self._executor = ThreadPoolExecutor(self.count)
            self._stack.callback(self._executor.shutdown, cancel_futures=True)
        else:
            _serve(_IMPORTED)
            context = multiprocessing.get_context(_METHOD)
            pool = ProcessPoolExecutor(self.count, mp_context=context, initializer=_begin, initargs=(dict(os.environ),))
            self._executor = pool
            self._stack.callback(_end, pool)


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


@dataclass(frozen=True, slots=True)
class _Packed:
    """Work that is pickled once for all tasks, and unpickled once in each process: it may hold all the tables of a voice."""

    raw: bytes

    def __call__(self, task: Any) -> Any:
        return _unpacked(self.raw)(task)


@lru_cache(maxsize=1)
def _unpacked(raw: bytes) -> Callable[[Any], Any]:
    work: Callable[[Any], Any] = pickle.loads(raw)
    return work


def _nothing(task: object) -> None:
    """What a worker can do if it can do anything."""


def cores() -> int:
    """How many processors this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def _lost(future: Future[Result]) -> bool:
    """Whether the worker of *future* was lost with it."""
    error = future.exception()
    # By name, for Dask is imported only by those who use it.
    return isinstance(error, BrokenProcessPool) or type(error).__name__ == "KilledWorker"


_CAN_LIMIT = hasattr(signal, "setitimer")


def _within(seconds: float, work: Callable[[Task], Result], task: Task) -> Result:
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
