"""Lines and performances as pages need them, kept for as long as the data they were made from stays."""

from __future__ import annotations

import hashlib
import tempfile
from dataclasses import replace
from pathlib import Path

import streamlit as st
from parts.session import database

from lipdb import Database, Line
from lipdb.engine import Stages
from lipdb.errors import InputError
from lipdb.performance import Performance
from lipdb.store.history import Change

EXAMPLES = {"en": "Hello! Bob may find five blue whales."}
"""What a language begins with on the front page; the others with their shortest sample."""
LONGEST = 2000
"""Letters of a sentence: two minutes of speech."""
LARGEST = 20_000_000
"""Bytes that an uploaded file may have: three and a half minutes of speech in studio quality."""


@st.cache_resource(max_entries=64, show_spinner=False)
def _past(revision: int) -> Database:
    return database().at(revision)


def state(revision: int | None) -> Database:
    """The database now, or as it was at *revision*."""
    return database() if revision is None else _past(revision)


@st.cache_resource(max_entries=16, show_spinner=False)
def changes_of(_db: Database, number: int) -> list[Change]:
    """What revision *number* did; that never changes."""
    return _db.store.changes(number)


@st.cache_resource(max_entries=128, ttl=3600, show_spinner=False)
def _spoken(text: str, language: str, voice: str, revision: int) -> Line:  # noqa: ARG001  (the revision decides)
    return database().say(text, language=language, voice=voice)


def spoken(text: str, language: str, voice: str = "") -> Line:
    """*text* as *language*'s own voice or another says it. Raises `LipdbError`."""
    # Not max_chars of the field: Streamlit ignores what is pasted beyond it, without a word.
    if len(text) > LONGEST:
        raise InputError(f"the text has {len(text):,} letters; give up to {LONGEST:,} at once here, and a longer one to `lipdb say`")
    return _spoken(text, language, voice, database().store.revision)


@st.cache_resource(max_entries=64, ttl=3600, show_spinner=False)
def _played(key: str, revision: int, _line: Line, character: str, past: int | None) -> Performance:  # noqa: ARG001
    db = state(past)
    who = db.character(character)
    if past is not None:
        who = replace(who, title=f"{who.title or who.name}, at revision {past}")
    return db.animate(_line, character=who)


def played(line: Line, character: str, *, past: int | None = None) -> Performance:
    """*line* on *character*, as the data are now or were at revision *past*. Raises `LipdbError`."""
    return _played(key_of(line), database().store.revision, line, character, past)


@st.cache_resource(max_entries=16, ttl=3600, show_spinner=False)
def _staged(key: str, revision: int, _line: Line, character: str) -> Stages:  # noqa: ARG001
    return database().stages(_line, character=character)


def staged(line: Line, character: str) -> Stages:
    """What each stage of the engine makes of *line* on *character*. Raises `LipdbError`."""
    return _staged(key_of(line), database().store.revision, line, character)


def key_of(line: Line) -> str:
    """Equal for equal lines."""
    digest = hashlib.sha256(repr(line.to_json()).encode())
    if line.sound:
        digest.update(line.sound.samples.tobytes())
    return digest.hexdigest()


@st.cache_resource(max_entries=8, ttl=3600, show_spinner=False)
def recorded(
    aligned: bytes,
    suffix: str,
    audio: bytes | None,
    language: str,
    revision: int,  # noqa: ARG001  (it decides)
    *,
    allow_unknown: bool = False,
) -> Line:
    """The line in an uploaded file that was aligned already, with its sound. Raises `LipdbError`."""
    if max(len(aligned), len(audio or b"")) > LARGEST:
        raise InputError(f"a file is larger than {LARGEST // 1_000_000} MB; cut the recording into shorter ones")
    with tempfile.TemporaryDirectory(prefix="lipdb-") as folder:
        file, sound = Path(folder) / f"upload{suffix}", Path(folder) / "upload.wav"
        file.write_bytes(aligned)
        sound.write_bytes(audio or b"")
        try:
            return database().sync(file, audio=None if audio is None else sound, language=language, allow_unknown=allow_unknown)
        except InputError as error:
            # The visitor's own words, not the places of the copies.
            told = str(error).replace(str(file), "the aligned file").replace(str(sound), "the recording")
            raise InputError(told) from error
