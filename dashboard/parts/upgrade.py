"""Pages that stay open while lipdb is upgraded: they say so, and what to do."""

from __future__ import annotations

from importlib.metadata import version
from typing import Any

import streamlit as st

RUNNING = version("lipdb")
"""The lipdb that this server runs."""

# A tab outlives the server that it was loaded from: it remembers in the browser which lipdb that was. Streamlit asks nothing of a
# server that is back until somebody clicks; so this does.
_SCRIPT = """
export default ({ data, parentElement, setTriggerValue }) => {
  window.lipdbLoaded ??= data.version;
  const root = parentElement.querySelector(".upgrade");
  root.hidden = window.lipdbLoaded === data.version;
  root.querySelector("span").textContent =
    `This page was loaded from lipdb ${window.lipdbLoaded}; the dashboard runs ${data.version} now. Reload it. `;
  root.querySelector("button").onclick = () => window.location.reload();
  const app = document.querySelector('[data-testid="stApp"]');
  let away = false;
  const connection = new MutationObserver(() => {
    const there = app.dataset.testConnectionState === "CONNECTED";
    if (there && away) setTriggerValue("back", true);
    away = !there;
  });
  connection.observe(app, { attributeFilter: ["data-test-connection-state"] });
  return () => connection.disconnect();
};
"""
_HTML = '<div class="upgrade" role="alert" hidden><span></span><button type="button">Reload</button></div>'
_STYLE = """
.upgrade { background: #e69f00; color: #000; border-radius: 0.5rem; padding: 0.75rem; font-size: 0.9rem; }
.upgrade[hidden] { display: none; }
.upgrade button { display: block; margin-top: 0.5rem; padding: 0.1rem 0.75rem; border: 1px solid; border-radius: 0.5rem; }
.upgrade button { font: inherit; background: none; color: inherit; cursor: pointer; }
"""


@st.cache_resource
def _component() -> Any:
    return st.components.v2.component("lipdb_upgrade", html=_HTML, css=_STYLE, js=_SCRIPT)


def warn_of_upgrade() -> None:
    """Say so when a newer lipdb was installed since the server started, or when the tab is older than the server."""
    installed = version("lipdb")
    if installed != RUNNING:
        st.warning(
            f"lipdb {installed} was installed while this page was open; the dashboard still runs {RUNNING}. "
            "Restart `lipdb dashboard`, then reload this page.",
            icon=":material/upgrade:",
        )
    with st.sidebar:
        _component()(data={"version": RUNNING}, key="upgrade", on_back_change=lambda: None)
