"""Files that visitors upload: limited in size, handed on as bytes, and laid out on disk under names of ours for as long as needed."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Protocol

from lipdb.errors import InputError, LipdbError

LARGEST = 64_000_000
"""Bytes of all files of one upload."""


class Uploaded(Protocol):
    """What `st.file_uploader` gives."""

    name: str
    size: int

    def getvalue(self) -> bytes:
        """What is in it."""


def contents(files: Sequence[Uploaded], *, largest: int = LARGEST) -> list[tuple[str, bytes]]:
    """What *files* are called and what is in them. Raises `InputError` when one is empty or they are too large together."""
    for file in files:
        if not file.size:
            raise InputError(f"{file.name[:60]} is empty; choose another file")
    if sum(file.size for file in files) > largest:
        raise InputError(f"the upload has more than {largest // 1_000_000} MB; make it smaller")
    return [(file.name, file.getvalue()) for file in files]


@contextmanager
def scratch() -> Iterator[Path]:
    """A new folder that is gone afterwards; errors from inside do not name it."""
    with tempfile.TemporaryDirectory(prefix="lipdb-") as folder:
        try:
            yield Path(folder)
        except LipdbError as error:
            error.args = (str(error).replace(f"{folder}/", "").replace(folder, "the upload"),)
            raise
