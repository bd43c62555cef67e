"""pyarrow as it is needed here: without pandas."""

from __future__ import annotations

import sys
from importlib.abc import MetaPathFinder

import pyarrow as pa


class _NoPandas(MetaPathFinder):
    def find_spec(self, fullname: str, path: object = None, target: object = None) -> None:  # noqa: ARG002
        if fullname == "pandas":
            raise ModuleNotFoundError(f"{fullname} is not looked for", name=fullname)


def without_pandas() -> None:
    """Keep pyarrow from importing pandas, a third of a second, in a process that counts and does nothing else.

    pyarrow asks for pandas once, with the first array, and never again: so in this process it can't turn tables into pandas'.
    Whoever else imports pandas gets it.
    """
    finder = _NoPandas()
    sys.meta_path.insert(0, finder)
    try:
        pa.array([])
    finally:
        sys.meta_path.remove(finder)
