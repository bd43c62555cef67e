"""Pages of the dashboard without a browser, each test on a database of its own."""

from __future__ import annotations

import functools
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
import streamlit as st
from streamlit.components.v2.manifest_scanner import scan_component_manifests
from streamlit.testing.v1 import AppTest

import lipdb

# Each AppTest looks through all installed packages for components: half a second, and always the same ones.
installed_components = functools.cache(scan_component_manifests)
DASHBOARD = Path(__file__).resolve().parents[1] / "dashboard"


@contextmanager
def behind_pages(file: str | Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[lipdb.Database]:
    """The database in *file*, on which pages work within the block; afterwards nothing of them is left in the process."""
    monkeypatch.syspath_prepend(str(DASHBOARD))
    monkeypatch.setenv("LIPDB_URL", str(file))
    monkeypatch.setattr("streamlit.components.v2.manifest_scanner.scan_component_manifests", installed_components)
    listen_on("localhost")
    forget()
    with lipdb.open(str(file)) as database:
        yield database
    forget()


def listen_on(address: str) -> None:
    """Where the pages think that they are served, as `lipdb dashboard --address` tells them."""
    st.config.set_option("server.address", address)


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
    test = AppTest.from_string(script, default_timeout=120)
    for key, value in {"visitor": visitor, **session}.items():
        test.session_state[key] = value
    for key, value in (query or {}).items():
        test.query_params[key] = value
    return test.run()
