"""The pose gallery: every pose at full weight. Pictures are drawn once for what they are drawn of, and kept on disk."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from pathlib import Path

import streamlit as st
from parts.session import database

from lipdb.characters.character import Character
from lipdb.characters.exercise import held
from lipdb.errors import OutputError
from lipdb.files import whole_file
from lipdb.preview import mesh_bytes
from lipdb.progress import reported
from lipdb.render.gallery import SIDE, Mixtures, is_hidden, pose_gallery
from lipdb.speech.cache import cache_folder

FORMAT = 1
"""Counts up when the same face is drawn otherwise."""
ACROSS = 5
MOST = 600
"""Pictures that are kept; those that were used longest ago go first."""
REST = ""
"""What the face at rest is called among pictures of poses."""
AJAR = 0.6
"""How far the mouth is opened for poses of which closed lips show nothing."""


def gallery(name: str) -> None:
    """Each pose of the character *name* at full weight, those of the tongue in an open mouth. Raises `LipdbError`."""
    db = database()
    who = db.character(name)
    pose_set = db.pose_set(who.pose_set)
    rows = {row["pose"]: row["description"] for row in db.records[f"poses/{who.pose_set}.tsv"].values()}
    drawn = pictures(who, {REST: {pose_set.opening: 0.0}} | {pose: {pose: 1.0} for pose in pose_set.poses})
    inside = _hidden(who, drawn, drawn.pop(REST))
    drawn |= pictures(who, {pose: {pose: 1.0, pose_set.opening: AJAR} for pose in inside})
    shown = list(drawn.items())
    for start in range(0, len(shown), ACROSS):
        for column, (pose, picture) in zip(st.columns(ACROSS), shown[start : start + ACROSS], strict=False):
            note = f"  \n*with {pose_set.opening} at {AJAR:g}; with closed lips nothing of it is seen*" if pose in inside else ""
            column.image(picture, caption=f"**{pose}**  \n{rows.get(pose, '')}{note}", width="stretch")


def _hidden(who: Character, drawn: Mapping[str, bytes], rest: bytes) -> list[str]:
    """The poses that move shapes of a mesh, and yet look like the face at *rest*."""
    if not who.mesh:
        return []
    return [pose for pose, picture in drawn.items() if _shapes(who, {pose: 1.0}) and is_hidden(picture, rest)]


def pictures(who: Character, mixtures: Mixtures) -> dict[str, bytes]:
    """The PNG of each of *mixtures*: what is kept, and what is missing drawn with a progress bar. Raises `LipdbError`."""
    files = _files(who, mixtures)
    found = {name: _read(file) for name, file in files.items()}
    if missing := {name: mixture for name, mixture in mixtures.items() if not found[name]}:
        bar = st.progress(0.0, "Drawing poses…")
        with reported(lambda what, done, total: bar.progress(done / max(total, 1), f"{what}: {done} of {total}")):
            found |= (drawn := pose_gallery(who, missing))
        bar.empty()
        _keep({files[name]: picture for name, picture in drawn.items()})
    return found


def _files(who: Character, mixtures: Mixtures) -> dict[str, Path]:
    """Where each picture is kept: its name is a digest of the face and of the weights of its shapes."""
    shown = mesh_bytes(who) if who.mesh else b"".join(file.read_bytes() for _, file in sorted(who.pictures.items()))
    face = hashlib.sha256(shown).hexdigest()
    folder = cache_folder() / "gallery"
    files = {}
    for name, mixture in mixtures.items():
        weights = sorted(_shapes(who, mixture).items())
        files[name] = folder / f"{hashlib.sha256(repr((FORMAT, SIDE, face, weights)).encode()).hexdigest()[:32]}.png"
    return files


def _shapes(who: Character, mixture: Mapping[str, float]) -> dict[str, float]:
    """The weights of the shapes that *mixture* moves."""
    track = who.shapes(held(list(mixture), mixture, seconds=0))
    return {shape: float(weight) for shape, weight in zip(track.poses, track.weights[0], strict=True) if weight}


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
