"""Pages of the dashboard without a browser, each test on a database of its own."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
import streamlit as st

import lipdb

DASHBOARD = Path(__file__).resolve().parents[1] / "dashboard"


@contextmanager
def behind_pages(file: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[lipdb.Database]:
    """The database in *file*, on which pages work within the block; afterwards nothing of them is left in the process."""
    monkeypatch.syspath_prepend(str(DASHBOARD))
    monkeypatch.setenv("LIPDB_URL", str(file))
    st.cache_resource.clear()
    with lipdb.open(str(file)) as database:
        yield database
    st.cache_resource.clear()
    for name in [name for name in sys.modules if name == "parts" or name.startswith("parts.")]:
        del sys.modules[name]
