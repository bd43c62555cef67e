"""Download a performance in any output format; what takes long is made on request, with a progress bar."""

from __future__ import annotations

import tempfile
from pathlib import Path

import streamlit as st
from streamlit.delta_generator import DeltaGenerator

from lipdb import plugins
from lipdb.errors import LipdbError
from lipdb.performance import Performance
from lipdb.progress import reported

FILMS = (".mp4", ".webp")
"""Formats whose every frame is drawn."""
TITLES = {
    ".csv": "weights, a row a frame",
    ".cues.json": "sprite cues as Rhubarb writes them",
    ".glb": "mesh with its animation",
    ".json": "line with its timed phones, to edit and to read again",
    ".mp4": "film with sound",
    ".parquet": "weights as a table for analysis",
    ".png": "contact sheet",
    ".tsv": "sprite cues, a line each",
    ".wav": "sound",
    ".webp": "moving picture without sound",
}


def content(performance: Performance, suffix: str) -> bytes:
    """The file that `Performance.save` writes. Raises `LipdbError`."""
    with tempfile.TemporaryDirectory(prefix="lipdb-") as folder:
        file = Path(folder) / f"line{suffix}"
        performance.save(file)
        return file.read_bytes()


def download(performance: Performance, *, key: str) -> None:
    """Choose a format and download it."""
    suffixes = sorted(plugins.exporters())
    left, right = st.columns([2, 3], vertical_alignment="bottom")
    suffix = left.selectbox("Format", suffixes, index=suffixes.index(".csv"), format_func=_title, key=f"{key}_format")
    try:
        made = _film(performance, suffix, key, right) if suffix in FILMS else content(performance, suffix)
    except LipdbError as error:
        right.error(str(error))
        return
    if made is not None:
        right.download_button(f"Download line{suffix}", made, f"line{suffix}", on_click="ignore", key=f"{key}_download", type="primary")


def _title(suffix: str) -> str:
    return f"{suffix}  ({TITLES[suffix]})" if suffix in TITLES else suffix


def _film(performance: Performance, suffix: str, key: str, where: DeltaGenerator) -> bytes | None:
    """The film, if it has been made; a button that makes it, otherwise, at the place *where* the film will stand."""
    place = f"{key}_film"
    of, kind, made = st.session_state.get(place, (None, "", b""))
    if of is performance and kind == suffix:
        return made
    asked = f"{key}_draw_asked"
    if not st.session_state.pop(asked, False):
        told = "Every frame is drawn; that takes some seconds."
        where.button(f"Draw {suffix}", key=f"{key}_draw", help=told, on_click=st.session_state.update, args=({asked: True},))
        return None
    bar = st.progress(0.0, "Drawing…")
    with reported(lambda what, done, total: bar.progress(done / total, f"{what.capitalize()}: {done} of {total} frames")):
        made = content(performance, suffix)
    bar.empty()
    st.session_state[place] = performance, suffix, made
    return made
