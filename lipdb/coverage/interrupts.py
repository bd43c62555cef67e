"""Signals such as Ctrl-C, held back while locks are taken."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

_HELD = (signal.SIGINT, signal.SIGTERM)


@contextmanager
def uninterrupted() -> Iterator[None]:
    """Let what SIGINT and SIGTERM raise in the main thread come only when the block is done; in other threads they raise nothing.

    A pool takes its locks in Python. An exception between the taking of one and the note that it is taken would leave it taken, and
    the pool's own thread would wait for it for ever, and whoever ends the pool for that thread.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    came: list[tuple[int, FrameType | None]] = []
    handlers = {number: handler for number in _HELD if callable(handler := signal.getsignal(number))}
    for held in handlers:
        signal.signal(held, lambda number, frame: came.append((number, frame)))
    try:
        yield
    finally:
        for held, handler in handlers.items():
            signal.signal(held, handler)
        for number, frame in came[:1]:
            handlers[signal.Signals(number)](number, frame)
