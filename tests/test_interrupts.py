"""Ctrl-C and the like while work is given to other threads and processes."""

import signal
import threading

import pytest

from lipdb.coverage.executors import Workers
from lipdb.interrupts import uninterrupted


@pytest.fixture(autouse=True)
def heard():
    """Ctrl-C raises, also where the tests were started in the background: a shell makes those deaf to it."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def test_what_comes_meanwhile_comes_afterwards() -> None:
    done = []
    with pytest.raises(KeyboardInterrupt), uninterrupted():
        signal.raise_signal(signal.SIGINT)
        signal.raise_signal(signal.SIGINT)
        done.append("all of it")
    assert done
    with pytest.raises(KeyboardInterrupt):
        signal.raise_signal(signal.SIGINT)


def test_nothing_is_held_back_where_nothing_would_be_raised() -> None:
    ignored = signal.signal(signal.SIGTERM, signal.SIG_IGN)
    try:
        with uninterrupted():
            assert signal.getsignal(signal.SIGTERM) is signal.SIG_IGN
    finally:
        signal.signal(signal.SIGTERM, ignored)
    before, seen = signal.getsignal(signal.SIGINT), []

    def elsewhere() -> None:
        with uninterrupted():
            seen.append(signal.getsignal(signal.SIGINT))

    thread = threading.Thread(target=elsewhere)
    thread.start()
    thread.join()
    assert seen == [before]


@pytest.mark.parametrize("threads", [True, False])
def test_a_task_is_given_whole_or_not_at_all(threads, monkeypatch) -> None:
    given = []
    with Workers(1, threads=threads) as crew:
        submit = crew._executor.submit

        def interrupted(*task):
            signal.raise_signal(signal.SIGINT)
            given.append(submit(*task))
            return given[-1]

        monkeypatch.setattr(crew._executor, "submit", interrupted)
        with pytest.raises(KeyboardInterrupt):
            crew.alone(abs, -1)
        assert given[0].result(60) == 1
