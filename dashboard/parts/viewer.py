"""The browser components of dashboard/viewer: registered once a server, with links to what is too large to send along."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import streamlit as st
from streamlit.components.v2.get_bidi_component_manager import get_bidi_component_manager
from streamlit.components.v2.manifest_scanner import ComponentConfig, ComponentManifest
from streamlit.runtime import get_instance

VIEWER = Path(__file__).resolve().parents[1] / "viewer"
NAMES = ("stage", "keys")
MISSING = (
    "The player is not built: Node was not there when lipdb was installed. Install it again with a network "
    "(`pip install --force-reinstall lipdb`), or run `python dashboard/viewer/build.py` in a checkout."
)


@st.cache_resource(max_entries=8)
def _components(manager: int) -> dict[str, Any] | None:  # noqa: ARG001  (a server has one; tests in one process have many)
    """The components of the viewer, registered once with *manager*; None when it has not been built."""
    built = VIEWER / "dist"
    if not all((built / f"{name}.js").is_file() for name in NAMES):
        return None
    manifest = ComponentManifest("lipdb", "1", [ComponentConfig(name, "dist") for name in NAMES])
    get_bidi_component_manager().register_from_manifest(manifest, VIEWER)
    html = {name: f'<div class="{name}"></div>' for name in NAMES}
    return {name: st.components.v2.component(f"lipdb.{name}", html=html[name], js=f"{name}.js", css=f"{name}.css") for name in NAMES}


def component(name: str) -> Any | None:
    """The component *name*, to be mounted; says what to do and is None when the viewer has not been built."""
    components = _components(id(get_bidi_component_manager()))
    if components is None:
        st.warning(MISSING)
        return None
    return components[name]


def link(content: bytes, media: str, place: str = "") -> str:
    """A URL under which the browser finds *content*, for as long as the page shows nothing else at *place*."""
    return str(get_instance().media_file_mgr.add(content, media, coordinates=place or str(hash(content))))
