"""A scan in a process of its own: for a server, which must not wait, break or grow with it.

The process is given what to do as JSON on standard input, and answers in lines of JSON: how far it is, and in the end the
scan, or what is wrong. It ends with whoever started it.
"""

from __future__ import annotations

import hashlib
import json
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import IO, Any

import lipdb
from lipdb.coverage.plain_arrow import without_pandas
from lipdb.coverage.processes import make_ready
from lipdb.coverage.register import EXACT, scan
from lipdb.errors import LipdbError, OutputError
from lipdb.files import whole_file
from lipdb.progress import report, reported

STEP = 0.1
"""Seconds from one report to the next, at least."""
PATIENCE = 10
"""Seconds in which a process that is to end may end in order; ended at once, it loses no more than what was not counted to its end."""


def kept(content: bytes, folder: Path, *, suffix: str) -> Path:
    """The file below *folder* that holds *content*, to be scanned now and again later; the same content is one file.

    Its name says nothing of where it came from. Raises `OutputError`.
    """
    file = folder / "uploads" / f"{hashlib.sha256(content).hexdigest()[:32]}{suffix}"
    if not file.is_file():
        try:
            file.parent.mkdir(parents=True, exist_ok=True)
            with whole_file(file) as partial:
                partial.write_bytes(content)
        except OSError as error:
            raise OutputError(f"the text can't be kept to be counted ({error.strerror}); make room where the database is") from error
    return file


def scan_apart(paths: Sequence[str], *, language: str, mode: str = EXACT, title: str = "", url: str | None = None) -> dict[str, Any]:
    """Scan as `lipdb.coverage.register.scan` does, and tell the same, as plain data; leaving early ends the process.

    *url* names the database as `lipdb.open` takes it. Raises `LipdbError`.
    """
    asked = {"paths": list(paths), "language": language, "mode": mode, "title": title, "url": url}
    told: dict[str, Any] = {}
    command = [sys.executable, "-m", "lipdb.coverage.apart"]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, encoding="utf-8") as process:
        assert process.stdin is not None
        assert process.stdout is not None
        try:
            process.stdin.write(json.dumps(asked))
            process.stdin.close()
            for line in process.stdout:
                told = json.loads(line)
                if "done" in told:
                    report(told["what"], told["done"], told["total"])
        except BaseException:
            process.terminate()
            try:
                process.wait(PATIENCE)
            except subprocess.TimeoutExpired:
                process.kill()
            raise
    if "scan" not in told:
        raise LipdbError(told.get("error") or "counting ended before its time; what is counted is kept, so start it again")
    scanned: dict[str, Any] = told["scan"]
    return scanned


def answer(asked: dict[str, Any], out: IO[str]) -> None:
    """Do what is *asked* and write what becomes of it to *out*."""

    def tell(**told: Any) -> None:
        out.write(json.dumps(told) + "\n")
        out.flush()

    try:
        with lipdb.open(asked["url"]) as db, reported(_seldom(lambda what, done, total: tell(what=what, done=done, total=total))):
            done = scan(db, asked["paths"], language=asked["language"], mode=asked["mode"], title=asked["title"])
        tell(scan=done.to_json())
    except LipdbError as error:
        tell(error=str(error))


def _seldom(tell: Callable[[str, int, int], None]) -> Callable[[str, int, int], None]:
    last = 0.0

    def told(what: str, done: int, total: int) -> None:
        nonlocal last
        if done == total or time.monotonic() - last > STEP:
            last = time.monotonic()
            tell(what, done, total)

    return told


if __name__ == "__main__":
    # As an exception, so that those who count are ended in order.
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))
    told_to_do = json.load(sys.stdin)
    make_ready(told_to_do["language"])
    without_pandas()
    answer(told_to_do, sys.stdout)
