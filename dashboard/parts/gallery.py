"""The pose gallery: every pose at full weight. Pictures are drawn once for what they are drawn of, and kept on disk."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from pathlib import Path

import streamlit as st
from parts.session import database

from lipdb.characters.character import Character
from lipdb.characters.exercise import held
from lipdb.errors import OutputError
from lipdb.files import whole_file
from lipdb.preview import mesh_bytes
from lipdb.progress import reported
from lipdb.render.gallery import SIDE, pose_gallery
from lipdb.speech.cache import cache_folder

FORMAT = 1
"""Counts up when the same face is drawn otherwise."""
ACROSS = 5
MOST = 600
"""Pictures that are kept; those that were used longest ago go first."""


def gallery(name: str) -> None:
    """Each pose of the character *name* at full weight. Raises `LipdbError`."""
    db = database()
    who = db.character(name)
    rows = {row["pose"]: row["description"] for row in db.records[f"poses/{who.pose_set}.tsv"].values()}
    drawn = list(pictures(who, db.pose_set(who.pose_set).poses).items())
    for start in range(0, len(drawn), ACROSS):
        for column, (pose, picture) in zip(st.columns(ACROSS), drawn[start : start + ACROSS], strict=False):
            column.image(picture, caption=f"**{pose}**  \n{rows.get(pose, '')}", width="stretch")


def pictures(who: Character, poses: Sequence[str]) -> dict[str, bytes]:
    """The PNG of each of *poses*: what is kept, and what is missing drawn with a progress bar. Raises `LipdbError`."""
    files = _files(who, poses)
    found = {pose: _read(file) for pose, file in files.items()}
    if missing := [pose for pose in poses if not found[pose]]:
        bar = st.progress(0.0, "Drawing poses…")
        with reported(lambda what, done, total: bar.progress(done / max(total, 1), f"{what}: {done} of {total}")):
            found |= (drawn := pose_gallery(who, missing))
        bar.empty()
        _keep({files[pose]: picture for pose, picture in drawn.items()})
    return {pose: found[pose] for pose in poses}


def _files(who: Character, poses: Sequence[str]) -> dict[str, Path]:
    """Where each picture is kept: its name is a digest of the face and of the weights of its shapes."""
    shown = mesh_bytes(who) if who.mesh else b"".join(file.read_bytes() for _, file in sorted(who.pictures.items()))
    face = hashlib.sha256(shown).hexdigest()
    folder = cache_folder() / "gallery"
    files = {}
    for pose in poses:
        track = who.shapes(held(poses, {pose: 1.0}, seconds=0))
        weights = sorted(zip(track.poses, map(float, track.weights[0]), strict=True))
        files[pose] = folder / f"{hashlib.sha256(repr((FORMAT, SIDE, face, weights)).encode()).hexdigest()[:32]}.png"
    return files


def _read(file: Path) -> bytes:
    """What is kept in *file*, marked as used; nothing where there is none."""
    try:
        picture = file.read_bytes()
        file.touch()
    except OSError:
        return b""
    return picture


def _keep(drawn: dict[Path, bytes]) -> None:
    """Write pictures; a folder that can't be written is done without."""
    try:
        for file, picture in drawn.items():
            file.parent.mkdir(parents=True, exist_ok=True)
            with whole_file(file) as temporary:
                temporary.write_bytes(picture)
        kept = sorted(file.parent.glob("[!.]*.png"), key=lambda one: one.stat().st_mtime, reverse=True)
        for old in kept[MOST:]:
            old.unlink(missing_ok=True)
    except (OutputError, OSError):
        return
