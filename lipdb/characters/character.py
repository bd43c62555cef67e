"""A character: a name, a pose set, links from its poses to shapes of its own, and something to draw."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Self

from lipdb.characters.links import closing_shapes, through_links
from lipdb.characters.own_links import links_of
from lipdb.characters.pictures import picture_files
from lipdb.curves.through import Link, link_from_row
from lipdb.errors import InputError, MeshError, PhonesetError
from lipdb.paths import data_dir
from lipdb.poses import PoseSet
from lipdb.track import Track

if TYPE_CHECKING:
    from lipdb.characters.mesh import Mesh
    from lipdb.curated.tsv import Records

BUILT = "built:"
MESH_FILE, PICTURES = "mesh.glb", "pictures"
NAME = re.compile(r"[a-z][a-z0-9_]{0,39}")


@dataclass(frozen=True, eq=False)
class Character:
    """Who speaks.

    *links* lead from the poses of *pose_set* to the character's own shapes; *closures* are the shapes that close its
    mouth. *drawing* says what there is to draw: ``built:robin``, ``built:crab`` and ``built:flat`` come with lipdb;
    ``mesh.glb`` and ``pictures`` are kept in *folder*.
    """

    name: str
    title: str
    pose_set: str
    drawing: str
    links: tuple[Link, ...]
    closures: tuple[str, ...] = ()
    folder: Path | None = None

    @classmethod
    def from_records(cls, records: Records, name: str, *, folder: Path | None = None) -> Self:
        """The character *name* of the curated tables; *folder* is where the files of added characters are.

        Its links are those of ``links/POSE_SET/SHAPES.tsv``, where the character's row names SHAPES (one shape a pose
        when that is the pose set itself); rows of ``characters/NAME/links.tsv`` come on top of them and win. Raises
        `InputError` when there is no such character, `PhonesetError` when its tables don't fit together.
        """
        path = f"characters/{name}/character.tsv"
        row = records.get(path, {}).get((name,)) if NAME.fullmatch(name) else None
        if row is None:
            known = sorted(p.split("/")[1] for p in records if p.endswith("/character.tsv"))
            raise InputError(f"there is no character {name!r}; there are {', '.join(known) or 'none'}")
        poses = PoseSet.from_records(records, row["pose_set"])
        links = tuple(link_from_row(link.row) for link in links_of(records, name))
        if not links:
            raise PhonesetError(f"characters/{name}: no links to its shapes; name a set in {path}, column shapes, or add links.tsv")
        must_reach = [pose for pose, must in zip(poses.poses, poses.must_reach, strict=True) if must]
        place, _, drawing = row["drawing"].rpartition("/")
        own = folder / (place or name) if folder else None
        return cls(name, row["title"], row["pose_set"], drawing, links, closing_shapes(links, must_reach), own)

    def shapes(self, track: Track) -> Track:
        """Weights of the character's own shapes for *track*, which holds weights of its poses."""
        return through_links(track, self.links)

    @cached_property
    def mesh(self) -> Mesh | None:
        """The mesh to draw, or None for a character of pictures. Raises `MeshError` when its file is missing or broken."""
        if self.drawing.startswith(BUILT):
            return built_mesh(self.drawing.removeprefix(BUILT))
        if self.drawing == MESH_FILE:
            file = self._own(MESH_FILE)
            return _read_mesh(file, self.name, file.stat().st_mtime_ns)
        return None

    @cached_property
    def pictures(self) -> Mapping[str, Path]:
        """Shape to SVG or PNG file; empty for a character with a mesh. Raises `MeshError` when there are none."""
        if self.drawing == f"{BUILT}flat":
            return picture_files(data_dir("phonesets") / "characters" / "flat")
        return picture_files(self._own(PICTURES)) if self.drawing == PICTURES else {}

    def _own(self, what: str) -> Path:
        if self.folder is None or not (self.folder / what).exists():
            where = self.folder / what if self.folder else what
            raise MeshError(f"character {self.name!r}: {where} is missing; copy it from where it was added, or add it by another name")
        return self.folder / what


@lru_cache(maxsize=8)
def _read_mesh(file: Path, name: str, _changed: int) -> Mesh:
    """The mesh in *file*, read again when the file has changed."""
    from lipdb.characters.gltf_read import read_glb

    return read_glb(file, name=name)


def built_mesh(name: str) -> Mesh | None:
    """The mesh of a character that comes with lipdb; None for the flat mouth. Raises `MeshError` for another name."""
    from lipdb.characters.crab import crab
    from lipdb.characters.human import robin

    built: dict[str, Callable[[], Mesh | None]] = {"robin": robin, "crab": crab, "flat": lambda: None}
    if name not in built:
        raise MeshError(f"drawing built:{name}: no such face comes with lipdb; there are {', '.join(sorted(built))}")
    return built[name]()
