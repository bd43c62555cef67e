"""Who counts: threads or processes of this machine, or an existing Dask cluster, all through one interface.

Each is a `concurrent.futures.Executor`: tasks go in, results come out in any order. What is lost with a worker is done again by
others: Dask does so itself, and for processes of this machine `Workers` starts new ones.
"""

from __future__ import annotations

import os
import pickle
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Executor, Future, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import ExitStack
from functools import partial
from queue import SimpleQueue
from typing import Any, Generic, NamedTuple, Self, TypeVar

from lipdb.coverage.processes import CAN_LIMIT, Packed, process_pool, within
from lipdb.errors import LipdbError
from lipdb.interrupts import give

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
        done: SimpleQueue[Future[Result]] = SimpleQueue()

        def finished() -> Iterator[Done[Task, Result]]:
            """Wait for one that is *running*; when its worker was lost its task is one of the *suspects*."""
            future = done.get()
            task = running.pop(future)
            if _lost(future):
                suspects.append(task)
            else:
                yield Done(task, future.result())

        packed = self._packed(work)
        for task in tasks:
            running[self._submit(packed, task, done)] = task
            if len(running) >= self.count * AHEAD:
                yield from finished()
        while running:
            yield from finished()
        for task in suspects:
            yield Done(task, self.alone(work, task))

    def alone(self, work: Callable[[Task], Result], task: Task) -> Result | None:
        """The result of *work* for *task* with nothing beside it; None when it ended its worker.

        Raises `LipdbError` when workers end whatever they are given.
        """
        done: SimpleQueue[Future[Any]] = SimpleQueue()
        self._submit(self._packed(work), task, done)
        future = done.get()
        if not _lost(future):
            result: Result = future.result()
            return result
        self._submit(_nothing, task, done)
        if _lost(done.get()):
            raise LipdbError("the processes that count end as soon as they begin; count with --scheduler threads, or see `lipdb doctor`")
        return None

    def _packed(self, work: Callable[[Task], Result]) -> Callable[[Task], Result]:
        """*work* such as processes of this machine take it."""
        return work if self._threads or self._scheduler else Packed(pickle.dumps(work))

    def _submit(self, work: Callable[[Task], Result], task: Task, done: SimpleQueue[Future[Result]]) -> Future[Result]:
        """Have *work* done for *task*; the future that comes back is put into *done* when it is done."""
        limited = self._seconds and not self._threads and not self._scheduler and CAN_LIMIT
        do = partial(within, self._seconds(task), work) if limited and self._seconds else work
        try:
            return give(self._executor, done, do, task)
        except BrokenProcessPool:
            self._stack.close()
            self._start()
            return give(self._executor, done, do, task)

    def _start(self) -> None:
        if self._scheduler:
            from lipdb.coverage.dask_workers import dask_executor

            self._executor, self.count = self._stack.enter_context(dask_executor(self._scheduler, self.count))
        elif self._threads:
            self._executor = ThreadPoolExecutor(self.count)
            self._stack.callback(self._executor.shutdown, cancel_futures=True)
        else:
            self._executor = self._stack.enter_context(process_pool(self.count))


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
