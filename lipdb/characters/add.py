"""Make a character of somebody's files: copy them into the workspace and propose its rows."""

from __future__ import annotations

import shutil
import tempfile
from dataclasses import dataclass
from itertools import chain, count
from pathlib import Path
from typing import TYPE_CHECKING, Any

from lipdb.characters.character import MESH_FILE, NAME, PICTURES
from lipdb.characters.gltf_read import read_glb
from lipdb.characters.gltf_write import write_glb
from lipdb.characters.match import Match, match
from lipdb.characters.obj_read import read_objects
from lipdb.characters.pictures import copy_pictures, picture_files
from lipdb.curated.schema import USER_SOURCE
from lipdb.errors import InputError, OutputError
from lipdb.poses import SHARED

if TYPE_CHECKING:
    from lipdb.curated.tsv import Records, Row

BINARY = (".glb", ".vrm")


@dataclass(frozen=True, slots=True)
class Added:
    """A character whose files are in place, in *folder*: its rows, still to be saved, and how its shapes were told."""

    name: str
    folder: Path
    character: Row
    links: tuple[Row, ...]
    match: Match

    @property
    def shape_set(self) -> str:
        """The known set that its shapes look like."""
        return self.match.shape_set

    @property
    def tables(self) -> dict[str, tuple[Row, ...]]:
        """The rows to save, by the path of their table."""
        return {f"characters/{self.name}/character.tsv": (self.character,), f"characters/{self.name}/links.tsv": self.links}

    def rows(self) -> list[dict[str, str]]:
        """Every link with its certainty; a missing shape stands as a link to nothing. For listings."""
        return [
            {"pose": p.pose, "shape": p.shape or f"({p.known})", "gain": p.gain, "certainty": p.certainty, "comment": p.comment}
            for p in sorted(self.match.proposals, key=lambda p: (p.pose, p.certainty == "missing", p.shape, p.known))
        ]

    def to_json(self) -> dict[str, Any]:
        """Plain data."""
        return {
            "character": self.name,
            "shape_set": self.shape_set,
            "share": round(self.match.share, 3),
            "doubtful": list(self.match.doubtful),
            "missing": list(self.match.missing),
            "links": self.rows(),
        }


def add_character(path: Path, *, name: str, title: str = "", records: Records, folder: Path) -> Added:
    """Copy the face at *path* into *folder*, below *name*, and propose its rows; saving them is the caller's.

    *path* is a .glb, .vrm or .gltf file, a folder of OBJ files (one a shape, one of them called neutral), or a folder of
    SVG or PNG pictures named after their shapes. Files get names of ours, never their own. Raises `InputError` for a
    name that can't be or is taken, or shapes that no known set has, `MeshError` for broken files, `OutputError` when
    *folder* can't be written; nothing is left behind then.
    """
    if not NAME.fullmatch(name):
        raise InputError(f"character name {name!r}: use small letters, digits and _, beginning with a letter")
    if f"characters/{name}/character.tsv" in records:
        raise InputError(f"there is a character {name!r} already; choose another name")
    with _Workspace(folder, name) as work:
        try:
            drawing, shapes = _copy(path, work.place, name)
        except OSError as error:
            raise InputError(f"{path}: can't be read ({error.strerror}); give files that you may read") from error
        matched = match(shapes, records)
        place = work.keep()
    row = {"character": name, "pose_set": SHARED, "shapes": "", "title": title or name, "source": USER_SOURCE}
    row["drawing"] = drawing if place.name == name else f"{place.name}/{drawing}"
    row["comment"] = f"Shapes matched by name to {matched.shape_set}"
    return Added(name, place, row, _link_rows(matched), matched)


def _link_rows(matched: Match) -> tuple[Row, ...]:
    rows = []
    for p in matched.proposals:
        if p.certainty == "missing":
            continue
        comment = f"{p.known}: doubtful" if p.certainty == "doubtful" else p.comment
        row = {"pose": p.pose, "shape": p.shape, "gain": p.gain, "combine": p.combine, "curve": p.curve, "source": USER_SOURCE}
        rows.append({**row, "comment": comment})
    return tuple(rows)


class _Workspace:
    """A new folder that takes the character's name only if all went well."""

    def __init__(self, folder: Path, name: str) -> None:
        self.folder, self.name = folder, name
        try:
            folder.mkdir(parents=True, exist_ok=True)
            self.place = Path(tempfile.mkdtemp(prefix=".lipdb-", dir=folder))
        except OSError as error:
            raise OutputError(f"{folder}: can't be written ({error.strerror}); choose another place for the database") from error

    def __enter__(self) -> _Workspace:
        return self

    def keep(self) -> Path:
        """Take the character's name, with a number where that is taken; the folder's final place.

        What has the name belongs to a face whose adding was undone, and may be redone, or to another database in this place.
        """
        names = chain([self.name], (f"{self.name}_{number}" for number in count(2)))
        final = next(self.folder / name for name in names if not (self.folder / name).exists())
        try:
            self.place.chmod(0o755)
            return self.place.rename(final)
        except OSError as error:
            raise OutputError(f"{final}: can't be written ({error.strerror}); free some space or choose another place") from error

    def __exit__(self, *_: object) -> None:
        shutil.rmtree(self.place, ignore_errors=True)


def _copy(path: Path, place: Path, name: str) -> tuple[str, tuple[str, ...]]:
    """Copy what is at *path* to *place*; the drawing's kind and the names of the shapes."""
    if path.is_file() and path.suffix.lower() in (*BINARY, ".gltf"):
        mesh = read_glb(path, name=name)
        if path.suffix.lower() in BINARY:
            _copy_file(path, place / MESH_FILE)
        else:
            write_glb(place / MESH_FILE, mesh)
        return MESH_FILE, mesh.shape_names
    if path.is_dir() and any(file.suffix.lower() == ".obj" for file in path.iterdir()):
        mesh = read_objects(path, name=name)
        write_glb(place / MESH_FILE, mesh)
        return MESH_FILE, mesh.shape_names
    if path.is_dir():
        return PICTURES, copy_pictures(picture_files(path), place / PICTURES)
    what = "give" if path.exists() else "no such file; give"
    raise InputError(f"{path}: {what} a .glb, .vrm or .gltf file, a folder of OBJ files, or a folder of SVG or PNG pictures")


def _copy_file(source: Path, target: Path) -> None:
    try:
        shutil.copyfile(source, target)
    except OSError as error:
        raise OutputError(f"{target}: can't be written ({error.strerror}); free some space or choose another place") from error
