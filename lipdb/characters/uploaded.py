"""Files of a face that somebody uploaded: checked, and laid out in a folder under names of ours."""

from __future__ import annotations

import io
import json
import zipfile
from collections.abc import Iterator, Sequence
from pathlib import Path, PurePosixPath, PureWindowsPath

from lipdb.characters.pictures import LARGEST_FILE, NAMES, PICTURE_SUFFIXES, SHAPE
from lipdb.errors import InputError

MESHES = (".glb", ".vrm")
LARGEST = 64_000_000
"""Bytes of all files together, unpacked."""
MOST = 200
"""Pictures of a character, and entries of a ZIP file times two."""

Upload = tuple[str, bytes]
"""What the file is called where it comes from, and what is in it."""


def lay_out(files: Sequence[Upload], folder: Path) -> Path:
    """Write *files* into *folder*; the path to give to `lipdb.characters.add.add_character`.

    They are one .glb or .vrm file, or SVG and PNG pictures named after their shapes, as they are or in a .zip file. Their
    own names say what they are and which shape they show, but never where something is written. Raises `InputError`.
    """
    if not files:
        raise InputError("choose a .glb or .vrm file, or pictures named after their shapes")
    if sum(len(content) for _, content in files) > LARGEST:
        raise InputError(f"the files have more than {LARGEST // 1_000_000} MB together; export the head alone")
    found = list(_unpacked(files))
    meshes = [(name, content) for name, content in found if _suffix(name) in MESHES]
    pictures = [(name, content) for name, content in found if _suffix(name) in PICTURE_SUFFIXES]
    if len(meshes) == 1 and not pictures:
        name, content = meshes[0]
        file = folder / f"mesh{_suffix(name)}"
        file.write_bytes(content)
        return file
    if meshes or not pictures:
        shown = ", ".join(sorted({_suffix(name) or "without a suffix" for name, _ in found})[:5]) or "nothing"
        raise InputError(f"give one .glb or .vrm file, or pictures (.svg, .png, or a .zip of them); here is {len(found)} × {shown}")
    return _pictures(pictures, folder)


def _pictures(pictures: Sequence[Upload], folder: Path) -> Path:
    if len(pictures) > MOST:
        raise InputError(f"{len(pictures)} pictures; a character has {MOST} at most")
    names: dict[str, str] = {}
    for number, (name, content) in enumerate(pictures):
        shape = PureWindowsPath(name).stem
        if not SHAPE.fullmatch(shape):
            raise InputError(f"picture {shape[:40]!r}: name pictures after their shapes with letters, digits, _ and -")
        if shape in names:
            raise InputError(f"there are two pictures of the shape {shape!r}; keep one")
        names[shape] = f"{number}{_suffix(name)}"
        (folder / names[shape]).write_bytes(content)
    (folder / NAMES).write_text(json.dumps(names), encoding="utf-8")
    return folder


def _unpacked(files: Sequence[Upload]) -> Iterator[Upload]:
    """*files* with what is in ZIP files in place of them; never more than `LARGEST` bytes, whatever their headers say."""
    room = LARGEST
    for name, content in files:
        if _suffix(name) != ".zip":
            yield name, content
            continue
        try:
            with zipfile.ZipFile(io.BytesIO(content)) as packed:
                for entry in _entries(packed):
                    with packed.open(entry) as opened:
                        inside = opened.read(min(room, LARGEST) + 1)
                    room -= len(inside)
                    if room < 0:
                        raise InputError(f"the ZIP file unpacks to more than {LARGEST // 1_000_000} MB; put only the pictures in it")
                    if _suffix(entry.filename) in PICTURE_SUFFIXES and len(inside) > LARGEST_FILE:
                        raise InputError(f"a picture in the ZIP file is larger than {LARGEST_FILE >> 20} MiB; save it smaller")
                    yield entry.filename, inside
        except (zipfile.BadZipFile, NotImplementedError, RuntimeError, EOFError, OSError, ValueError) as error:
            # RuntimeError: a password is wanted.
            raise InputError("the ZIP file can't be unpacked (broken, or with a password); pack the pictures again") from error
        except Exception as error:
            if type(error).__name__ not in ("error", "LZMAError"):  # zlib's and lzma's own, which share no base
                raise
            raise InputError("the ZIP file is damaged; pack the pictures again") from error


def _entries(packed: zipfile.ZipFile) -> list[zipfile.ZipInfo]:
    """What is of use in a ZIP file: no folders, no hidden files, no notes of macOS."""
    listed = packed.infolist()
    if len(listed) > 2 * MOST:
        raise InputError(f"the ZIP file has {len(listed)} entries; put only the pictures in it")
    plain = [one for one in listed if not one.is_dir() and not PureWindowsPath(one.filename).name.startswith(".")]
    return [one for one in plain if not PurePosixPath(one.filename).parts[0].startswith("__MACOSX")]


def _suffix(name: str) -> str:
    return PureWindowsPath(name).suffix.lower()
