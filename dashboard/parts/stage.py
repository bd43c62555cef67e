"""The player: faces, sound and lanes on one clock (dashboard/viewer)."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import streamlit as st
from streamlit.components.v2.get_bidi_component_manager import get_bidi_component_manager
from streamlit.components.v2.manifest_scanner import ComponentConfig, ComponentManifest
from streamlit.runtime import get_instance

from lipdb.preview import preview

if TYPE_CHECKING:
    from lipdb.performance import Performance

VIEWER = Path(__file__).resolve().parents[1] / "viewer"
MISSING = (
    "The player is not built: Node was not there when lipdb was installed. Install it again with a network "
    "(`pip install --force-reinstall lipdb`), or run `python dashboard/viewer/build.py` in a checkout."
)


@st.cache_resource
def _components() -> dict[str, Any] | None:
    """The components of the viewer, registered once a server; None when it has not been built."""
    built = VIEWER / "dist"
    if not (built / "stage.js").is_file():
        return None
    names = ("stage", "keys")
    manifest = ComponentManifest("lipdb", "1", [ComponentConfig(name, "dist") for name in names])
    get_bidi_component_manager().register_from_manifest(manifest, VIEWER)
    html = {name: f'<div class="{name}"></div>' for name in names}
    return {name: st.components.v2.component(f"lipdb.{name}", html=html[name], js=f"{name}.js", css=f"{name}.css") for name in names}


def link(content: bytes, media: str) -> str:
    """A URL under which the browser finds *content*."""
    return str(get_instance().media_file_mgr.add(content, media, coordinates=str(hash(content))))


def stage(
    performances: Sequence[Performance],
    *,
    key: str,
    loop: tuple[float, float] | None = None,
    autoplay: bool = False,
    compact: bool = False,
    marks: Sequence[tuple[float, float]] = (),
) -> float | None:
    """Show *performances* of one line; the instant in seconds that the visitor has just clicked on, or None.

    *loop* is played over and over, at once with *autoplay*; *marks* are pointed out; *compact* has no lanes of poses.
    """
    components = _components()
    if components is None:
        st.warning(MISSING)
        return None
    data = preview(performances, link)
    options = {"loop": loop, "autoplay": autoplay, "compact": compact, "marks": list(marks)}
    data |= {name: value for name, value in options.items() if value} | {"id": f"{data['id']} {options}"}
    answer = components["stage"](data=data, key=key, on_pick_change=lambda: None)
    return answer.get("pick")
