"""Read a person's text; write files and folders whole or not at all."""

from __future__ import annotations

import codecs
import os
import shutil
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from lipdb.errors import InputError, OutputError


def encoding_of(raw: bytes) -> str:
    """How *raw* text is written: UTF-16 where it begins with the mark of that, else UTF-8, with a mark or without."""
    return "utf-16" if raw.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)) else "utf-8-sig"


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask


UMASK = _umask()
"""What others may not do with new files. Asked for once: asking takes it off for a moment, in every thread."""


def read_text(file: Path) -> str:
    """The text in *file*, or on standard input where that is ``-``; UTF-8, or UTF-16 with a byte order mark.

    Raises `InputError` when it is not there or is neither.
    """
    piped = str(file) == "-"
    where = "standard input" if piped else file
    if piped and sys.stdin is None:  # a shell closed it (`<&-`)
        raise InputError(f"{where} is closed; pipe a text in")
    try:
        data = sys.stdin.buffer.read() if piped else file.read_bytes()
        return data.decode(encoding_of(data))
    except UnicodeDecodeError as error:
        raise InputError(f"{where}: no UTF-8 text (byte {error.start + 1}); save it as UTF-8") from error
    except OSError as error:
        raise InputError(f"{where}: can't be read ({error.strerror})") from error


@contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """A temporary path beside *path*, with its suffix, that takes its place when the block ends without an error.

    Raises `OutputError` when the folder is missing, read-only or full; *path* is then as it was before.
    """
    try:
        if not path.parent.is_dir():
            raise OutputError(f"{path}: the folder {path.parent} does not exist; make it first")
        if path.exists() and not path.is_file():
            # A device would not be written but replaced, for everybody.
            raise OutputError(f"{path}: this is {'a folder' if path.is_dir() else 'no file'}; give a file name")
        handle, name = tempfile.mkstemp(dir=path.parent, prefix=".lipdb-", suffix=path.suffix)
        os.close(handle)
    except OSError as error:
        raise OutputError(f"{path}: can't write into {path.parent} ({error.strerror}); choose another folder or name") from error
    temporary = Path(name)
    try:
        yield temporary
        temporary.chmod(0o666 & ~UMASK)
        temporary.replace(path)
    except OSError as error:
        raise OutputError(f"{path}: can't be written ({error.strerror or error}); free some space or choose another folder") from error
    finally:
        temporary.unlink(missing_ok=True)


@contextmanager
def whole_folder(path: Path, *, otherwise: str) -> Iterator[Path]:
    """A new folder of the same name near *path*, that takes its place when the block ends without an error.

    The folder above *path* is made where it is missing. Raises `OutputError` when it can't be written; *otherwise* says what
    a person can do then.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        near = Path(tempfile.mkdtemp(dir=path.parent, prefix=".lipdb-"))
    except OSError as error:
        raise OutputError(f"{path.parent}: can't be written ({error.strerror}); {otherwise}") from error
    temporary = near / path.name
    try:
        temporary.mkdir()
        yield temporary
        temporary.rename(path)
    except OSError as error:
        raise OutputError(f"{path}: can't be written ({error.strerror or error})") from error
    finally:
        shutil.rmtree(near, ignore_errors=True)
