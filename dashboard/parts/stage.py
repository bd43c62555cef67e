"""The player: faces, sound and lanes on one clock (dashboard/viewer)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import streamlit as st
from parts.viewer import component, link

from lipdb.performance import Performance
from lipdb.preview import preview


@st.cache_resource(max_entries=16, ttl=3600, show_spinner=False, hash_funcs={Performance: id})
def _packed(shown: tuple[Performance, ...]) -> tuple[dict[str, Any], list[tuple[bytes, str]], tuple[Performance, ...]]:
    """What the player gets, and the files behind its links. *shown* is kept too, so that no other one gets its ids."""
    files: list[tuple[bytes, str]] = []

    def put(content: bytes, media: str) -> str:
        files.append((content, media))
        return link(content, media)

    return preview(shown, put), files, shown


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

    *loop* is played over and over; with *autoplay* a new line begins by itself; *marks* are pointed out; *compact* has no
    lanes of poses.
    """
    mount = component("stage")
    if mount is None:
        return None
    data, files, _ = _packed(tuple(performances))
    for place, (content, media) in enumerate(files):
        link(content, media, f"{key} {place}")
    options = {"loop": loop, "autoplay": autoplay, "compact": compact, "marks": list(marks)}
    data = data | {name: value for name, value in options.items() if value} | {"id": f"{data['id']} {options}", "name": key}
    answer = mount(data=data, key=key, on_pick_change=lambda: None)
    return answer.get("pick")
