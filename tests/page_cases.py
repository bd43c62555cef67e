"""A page of the dashboard without a browser, on a database of its own: shared by tests of pages."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
import streamlit as st
from streamlit.testing.v1 import AppTest

import lipdb
from lipdb.paths import data_dir

DASHBOARD = data_dir("dashboard")


@contextmanager
def own_dashboard(folder: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[lipdb.Database]:
    """A database in *folder* that pages work on, and nothing left of another test's."""
    monkeypatch.syspath_prepend(str(DASHBOARD))
    monkeypatch.setenv("LIPDB_URL", str(folder / "lipdb.db"))
    forget()
    with lipdb.open(folder / "lipdb.db") as db:
        yield db
    forget()


def forget() -> None:
    """Drop what pages keep for all visitors."""
    st.cache_resource.clear()
    st.cache_data.clear()
    for name in [name for name in sys.modules if name == "parts" or name.startswith("parts.")]:
        del sys.modules[name]


def page(name: str, *, query: dict[str, str] | None = None, visitor: str = "anna", **session: Any) -> AppTest:
    """The page *name* as the app runs it, under the name of *visitor*."""
    pages = [f"st.Page({str(DASHBOARD / 'pages' / f'{one}.py')!r}, default={one == name})" for one in dict.fromkeys((name, "curves"))]
    script = f"import streamlit as st\nfrom parts.session import greet\npage = st.navigation([{', '.join(pages)}])\ngreet()\npage.run()\n"
    test = AppTest.from_string(script, default_timeout=60)
    for key, value in {"visitor": visitor, **session}.items():
        test.session_state[key] = value
    for key, value in (query or {}).items():
        test.query_params[key] = value
    return test.run()
