"""Work that is given to other threads and processes, and waited for, such that Ctrl-C and SIGTERM may come at any moment.

What a signal raises in the main thread between the taking of a lock and the note that it is taken leaves the lock taken: the
executor's own thread would wait for it for ever, and the end of the program for that thread.
"""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, Future
from contextlib import contextmanager
from queue import SimpleQueue
from types import FrameType
from typing import ParamSpec, TypeVar

Arguments = ParamSpec("Arguments")
Result = TypeVar("Result")

_RAISE = [getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)]


def give(
    executor: Executor,
    done: SimpleQueue[Future[Result]],
    function: Callable[Arguments, Result],
    *args: Arguments.args,
    **kwargs: Arguments.kwargs,
) -> Future[Result]:
    """Have *function* called by *executor*; the future that comes back is put into *done* when it is done.

    Who waits for *done* takes no lock that the executor needs.
    """
    with uninterrupted():
        future = executor.submit(function, *args, **kwargs)
        future.add_done_callback(done.put)
    return future


@contextmanager
def uninterrupted() -> Iterator[None]:
    """Let what signals raise in the main thread come only when the block is done; in other threads they raise nothing."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    came: list[tuple[int, FrameType | None]] = []
    handlers = {number: handler for number in _RAISE if callable(handler := signal.getsignal(number))}
    for held in handlers:
        signal.signal(held, lambda number, frame: came.append((number, frame)))
    try:
        yield
    finally:
        for held, handler in handlers.items():
            signal.signal(held, handler)
        for number, frame in came[:1]:
            handlers[number](number, frame)
