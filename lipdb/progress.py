"""Long work tells how far it is, to whoever wants to know; the work itself knows nothing of terminals."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import TypeVar

T = TypeVar("T")
Report = Callable[[str, int, int], object]
"""Called with what is done, how many steps are done, and how many there are."""

_report: ContextVar[Report | None] = ContextVar("report", default=None)


@contextmanager
def reported(report: Report) -> Iterator[None]:
    """Within the block, long work calls *report* after each step."""
    token = _report.set(report)
    try:
        yield
    finally:
        _report.reset(token)


def steps(items: Iterable[T], *, total: int, what: str) -> Iterator[T]:
    """*items*, each reported as a step of *total* once it has been used."""
    report = _report.get()
    for done, item in enumerate(items, 1):
        yield item
        if report is not None:
            report(what, done, total)


def report(what: str, done: int, total: int) -> None:
    """Tell whoever wants to know that *done* of *total* steps are done."""
    told = _report.get()
    if told is not None:
        told(what, done, total)
