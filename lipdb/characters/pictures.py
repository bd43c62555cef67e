"""A face of pictures: one SVG or PNG a shape, in a folder."""

from __future__ import annotations

import io
import json
import re
import shutil
from collections.abc import Mapping
from pathlib import Path

from lipdb.errors import MeshError, OutputError

PICTURE_SUFFIXES = (".svg", ".png")
NAMES = "names.json"
"""Shape to file, in a folder whose files have names of ours; where it is missing, files are named after their shapes."""
SHAPE = re.compile(r"\w[\w-]{0,59}")
LARGEST_SIDE = 4096
LARGEST_FILE = 16 * 1024 * 1024

_OURS = re.compile(r"\d{1,4}\.(?:svg|png)")


def picture_files(folder: Path) -> dict[str, Path]:
    """Shape to picture: every SVG and PNG of *folder*. Raises `MeshError` when there are none, or two of one shape."""
    if (folder / NAMES).is_file():
        pictures = _named(folder)
    else:
        pictures = {}
        for file in sorted(folder.iterdir()) if folder.is_dir() else []:
            if file.suffix.lower() not in PICTURE_SUFFIXES or not file.is_file():
                continue
            if file.stem in pictures:
                raise MeshError(f"{folder}: {pictures[file.stem].name} and {file.name} show one shape; keep one of them")
            pictures[file.stem] = file
    if not pictures:
        raise MeshError(f"{folder}: no SVG or PNG pictures in it; name each after its shape, such as A.svg")
    return pictures


def _named(folder: Path) -> dict[str, Path]:
    try:
        names = json.loads((folder / NAMES).read_text(encoding="utf-8"))
        pictures = {str(shape): folder / str(name) for shape, name in names.items()}
    except (OSError, ValueError, AttributeError) as error:
        raise MeshError(f"{folder / NAMES}: can't be read; add the character again") from error
    if not all(_OURS.fullmatch(file.name) and file.parent == folder for file in pictures.values()):
        raise MeshError(f"{folder / NAMES}: names a file that is not beside it; add the character again")
    return pictures


def copy_pictures(files: Mapping[str, Path], place: Path) -> tuple[str, ...]:
    """Copy *files*, shape to picture, into the new folder *place* under names of ours; the shapes.

    Raises `MeshError` for one that is no picture, or more than a picture, `OutputError` when *place* can't be written.
    """
    for shape, file in files.items():
        check_picture(shape, file)
    names = {shape: f"{number}{file.suffix.lower()}" for number, (shape, file) in enumerate(sorted(files.items()))}
    try:
        place.mkdir()
        for shape, name in names.items():
            shutil.copyfile(files[shape], place / name)
        (place / NAMES).write_text(json.dumps(names, ensure_ascii=False, sort_keys=True) + "\n", encoding="utf-8")
    except OSError as error:
        raise OutputError(f"{place}: can't be written ({error.strerror}); free some space or choose another place") from error
    return tuple(files)


def check_picture(shape: str, file: Path) -> None:
    """Raise `MeshError` unless *file* is an SVG or PNG that a browser may show, and *shape* can name one."""
    from lipdb.render.flat import read_picture

    if not SHAPE.fullmatch(shape):
        raise MeshError(f"{file}: name pictures after their shapes with letters, digits, _ and -")
    if file.stat().st_size > LARGEST_FILE:
        raise MeshError(f"{file}: larger than {LARGEST_FILE >> 20} MiB; save it smaller")
    if file.suffix.lower() == ".png":
        _check_size(file)
    read_picture(file, 64, 64)


def _check_size(file: Path) -> None:
    """Look at the head of a PNG before anything is unpacked."""
    from PIL import Image

    try:
        with Image.open(io.BytesIO(file.read_bytes()), formats=["PNG"]) as opened:
            size = opened.size
    except Image.DecompressionBombError:
        size = (LARGEST_SIDE + 1,) * 2
    except (OSError, SyntaxError, ValueError, Image.DecompressionBombWarning) as error:
        raise MeshError(f"{file}: not a PNG picture; draw it again") from error
    if max(size) > LARGEST_SIDE:
        raise MeshError(f"{file}: wider or higher than {LARGEST_SIDE} pixels; save it smaller")
