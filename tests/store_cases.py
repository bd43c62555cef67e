"""The small text that tests of the store begin with, and the curve in it that they edit."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import pytest

from lipdb.store import Store

DATABASES = Path(__file__).parent / "data" / "databases"
TEXT = DATABASES / "text"
CURVES = "curves/facefx.tsv"
KEY = ("aa", "bmp", "PBM")


@pytest.fixture
def store(tmp_path: Path) -> Iterator[Store]:
    """A store of its own, filled from `TEXT`."""
    with closing(Store.open(tmp_path / "a.db", TEXT)) as opened:
        yield opened
