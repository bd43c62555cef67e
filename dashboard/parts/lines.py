"""Lines and performances as pages need them, kept for as long as the data they were made from stays."""

from __future__ import annotations

import hashlib
import tempfile
from pathlib import Path

import streamlit as st
from parts.session import database

from lipdb import Database, Line
from lipdb.performance import Performance

LARGEST = 32_000_000
"""Bytes that an uploaded file may have."""


@st.cache_resource(max_entries=64, show_spinner=False)
def _past(revision: int) -> Database:
    return database().at(revision)


def state(revision: int | None) -> Database:
    """The database now, or as it was at *revision*."""
    return database() if revision is None else _past(revision)


@st.cache_resource(max_entries=128, show_spinner=False)
def _spoken(text: str, language: str, revision: int) -> Line:  # noqa: ARG001  (the revision decides)
    return database().say(text, language=language)


def spoken(text: str, language: str) -> Line:
    """*text* as *language*'s voice says it. Raises `LipdbError`."""
    return _spoken(text, language, database().store.revision)


@st.cache_resource(max_entries=64, show_spinner=False)
def _played(key: str, revision: int, _line: Line, character: str, past: int | None) -> Performance:  # noqa: ARG001
    return state(past).animate(_line, character=character)


def played(line: Line, character: str, *, past: int | None = None) -> Performance:
    """*line* on *character*, as the data are now or were at revision *past*. Raises `LipdbError`."""
    return _played(key_of(line), database().store.revision, line, character, past)


def key_of(line: Line) -> str:
    """Equal for equal lines."""
    return hashlib.sha256(repr(line.to_json()).encode()).hexdigest()


@st.cache_resource(max_entries=16, show_spinner=False)
def recorded(aligned: bytes, suffix: str, audio: bytes | None, language: str, revision: int) -> Line:  # noqa: ARG001
    """The line in an uploaded file that was aligned already, with its sound. Raises `LipdbError`."""
    with tempfile.TemporaryDirectory(prefix="lipdb-") as folder:
        file = Path(folder) / f"upload{suffix}"
        file.write_bytes(aligned)
        sound = None
        if audio is not None:
            sound = Path(folder) / "upload.wav"
            sound.write_bytes(audio)
        try:
            return database().sync(file, audio=sound, language=language)
        except Exception as error:
            # The visitor's own names, not those of the copies.
            error.args = (str(error).replace(str(file), "the uploaded file").replace(str(sound), "the recording"),)
            raise
