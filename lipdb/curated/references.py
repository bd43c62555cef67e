"""The names that cells of curated data may hold: which column of which table mentions which other table."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass

from lipdb.curated.tsv import Records, Row

SILENCE = "_"
Parts = Mapping[str, str]
"""What the ``{parts}`` of a table's pattern are in a path."""


class Names:
    """The names that rows may mention."""

    def __init__(self, records: Records) -> None:
        self.records = records
        self.sources = self.of("sources.tsv")
        self.common = self.of("common.tsv")
        self.languages = frozenset(path.split("/")[0] for path in records if path.endswith("/language.tsv"))
        self.sets = self.of("poses/sets.tsv")
        self.marks = frozenset(mark.lower() for mark in self.of("marks.tsv"))
        self.notation = {language: self._cell(f"{language}/language.tsv", "notation") for language in self.languages}
        self._seen: dict[str, frozenset[str]] = {}

    def of(self, path: str) -> frozenset[str]:
        """The first key cell of every row of *path*."""
        return frozenset(key[0] for key in self.records.get(path, {}))

    def phones(self, language: str) -> frozenset[str]:
        """The phones of *language*."""
        return self._once(f"{language}/phones.tsv")

    def poses(self, pose_set: str) -> frozenset[str]:
        """The poses of *pose_set*."""
        return self._once(f"poses/{pose_set}.tsv")

    def character_poses(self, character: str) -> frozenset[str]:
        """The poses of the set that *character* plays."""
        return self.poses(self._cell(f"characters/{character}/character.tsv", "pose_set"))

    def _once(self, path: str) -> frozenset[str]:
        if path not in self._seen:
            self._seen[path] = self.of(path)
        return self._seen[path]

    def _cell(self, path: str, column: str) -> str:
        return next((row[column] for row in self.records.get(path, {}).values()), "")


@dataclass(frozen=True, slots=True)
class Reference:
    """Cells of *column* that must be names (one, or with *many* any number) of *what*, which *known* lists."""

    column: str
    what: str
    known: Callable[[Names, Parts, Row], Collection[str]]
    many: bool = False


def _common(names: Names, _parts: Parts, _row: Row) -> Collection[str]:
    return names.common


def _own_phones(names: Names, parts: Parts, _row: Row) -> Collection[str]:
    return names.phones(parts["language"])


def _set_poses(names: Names, parts: Parts, _row: Row) -> Collection[str]:
    return names.poses(parts["pose_set"])


def _set(column: str) -> Reference:
    return Reference(column, "pose set", lambda names, _parts, _row: names.sets)


_COMMON = Reference("common", "common phone", _common, many=True)
_PAIR = (Reference("left", "common phone", _common), Reference("right", "common phone", _common))
_CURVE = (*_PAIR, Reference("pose", "pose", _set_poses))
SOURCE = Reference("source", "source", lambda names, _parts, _row: names.sources)

REFERENCES: Mapping[str, tuple[Reference, ...]] = {
    "common.tsv": (
        Reference("language", "language", lambda names, _parts, _row: names.languages),
        Reference("kind_of", "common phone", _common),
    ),
    "ipa.tsv": (_COMMON,),
    "shape_names.tsv": (_set("pose_set"), Reference("pose", "pose", lambda names, _parts, row: names.poses(row["pose_set"]))),
    "constraints/{pose_set}.tsv": (Reference("pose", "pose", _set_poses), Reference("other", "pose", _set_poses)),
    "links/{pose_set}/{target}.tsv": (
        Reference("pose", "pose", _set_poses),
        Reference("shape", "pose of the other set", lambda names, parts, _row: names.poses(parts["target"])),
    ),
    "curves/{pose_set}.tsv": _CURVE,
    "frequencies/{corpus}.tsv": _PAIR,
    "targets/{pose_set}.tsv": (Reference("phone", "common phone", _common), Reference("pose", "pose", _set_poses)),
    "timing/{pose_set}.tsv": (Reference("phone", "common phone", _common),),
    "{language}/phones.tsv": (_COMMON,),
    "{language}/aliases.tsv": (
        Reference("phones", "phone", lambda names, parts, _row: names.phones(parts["language"]) | {SILENCE}, many=True),
    ),
    "{language}/syllables.tsv": (Reference("initial", "phone", _own_phones), Reference("final", "phone", _own_phones)),
    "{language}/curves/{pose_set}.tsv": _CURVE,
    "characters/{character}/character.tsv": (_set("pose_set"), _set("shapes")),
    "characters/{character}/links.tsv": (Reference("pose", "pose", lambda names, parts, _row: names.character_poses(parts["character"])),),
    "characters/{character}/curves/{pose_set}.tsv": _CURVE,
    "characters/{character}/mapping.tsv": (
        Reference("language", "language", lambda names, _parts, _row: names.languages),
        Reference("phone", "phone", lambda names, _parts, row: names.phones(row["language"])),
        _COMMON,
    ),
}
