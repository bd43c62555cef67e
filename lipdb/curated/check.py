"""Checks across tables: every name that a row mentions exists, nothing means two things, nothing is missing."""

from __future__ import annotations

import unicodedata
from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass
from difflib import get_close_matches

from lipdb.curated.schema import Table, table_of
from lipdb.curated.tsv import Finding, Key, Records, Row

SILENCE = "_"
Parts = Mapping[str, str]


def check(records: Records) -> list[Finding]:
    """Everything that is wrong between the tables of *records*, sorted by file and line; nothing when all is well.

    A finding's line is the row's line in canonical text, its column where the cell begins.
    """
    names = Names(records)
    found: list[Finding] = []
    for path, rows in records.items():
        table = table_of(path)
        parts = table.parts(path) if table else None
        if table is None or parts is None:
            found.append(Finding(path, 1, 1, "no table has this name; see docs/data.md for the layout"))
            continue
        for line, key in enumerate(sorted(rows), 2):
            row = rows[key]
            found += [Finding(path, line, _column(table, row, name), message) for name, message in _wrong(table, parts, row, names)]
    return sorted({*found, *_missing(records, names)})


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
_CURVE = (Reference("left", "common phone", _common), Reference("right", "common phone", _common), Reference("pose", "pose", _set_poses))
_SOURCE = Reference("source", "source", lambda names, _parts, _row: names.sources)

REFERENCES: Mapping[str, tuple[Reference, ...]] = {
    "common.tsv": (Reference("language", "language", lambda names, _parts, _row: names.languages),),
    "ipa.tsv": (_COMMON,),
    "poses/sets.tsv": (),
    "constraints/{pose_set}.tsv": (Reference("pose", "pose", _set_poses), Reference("other", "pose", _set_poses)),
    "links/{pose_set}/{target}.tsv": (
        Reference("pose", "pose", _set_poses),
        Reference("shape", "pose of the other set", lambda names, parts, _row: names.poses(parts["target"])),
    ),
    "curves/{pose_set}.tsv": _CURVE,
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


def _wrong(table: Table, parts: Parts, row: Row, names: Names) -> Iterator[tuple[str, str]]:
    """Column and message of everything that is wrong with one row."""
    references = REFERENCES.get(table.pattern, ())
    for reference in (*references, _SOURCE) if "source" in table.names else references:
        cell = row[reference.column]
        known = reference.known(names, parts, row) if cell else ()
        for name in (cell.split() if reference.many else [cell]) if cell else []:
            if name not in known:
                yield reference.column, f"{reference.what} {name!r} does not exist{_hint(name, known)}"
    if special := _SPECIAL.get(table.pattern):
        yield from special(parts, row, names)


def _hint(name: str, known: Collection[str]) -> str:
    near = get_close_matches(name, known, 1, 0.5)
    if near:
        return f"; did you mean {near[0]!r}?"
    return f"; there are {', '.join(sorted(known))}" if 0 < len(known) <= 12 else ""


def _pose_set(_parts: Parts, row: Row, names: Names) -> Iterator[tuple[str, str]]:
    if not names.poses(row["pose_set"]):
        yield "pose_set", f"there is no poses/{row['pose_set']}.tsv with its poses"


def _constraint(parts: Parts, row: Row, names: Names) -> Iterator[tuple[str, str]]:
    if row["pose"] == row["other"]:
        yield "other", "a pose can't constrain itself"
    elif (row["other"], row["pose"]) in names.records[f"constraints/{parts['pose_set']}.tsv"] and row["pose"] > row["other"]:
        yield "other", "the same two poses stand in another row the other way round"


def _curve(_parts: Parts, row: Row, _names: Names) -> Iterator[tuple[str, str]]:
    keys = row["keys"].split()
    if row["left"] == row["right"] == SILENCE:
        yield "right", "two silences never meet; a pause is one phone"
    elif keys and row["left"] == SILENCE and not keys[0].endswith(":0"):
        yield "keys", "a curve out of silence must begin with weight 0"
    elif keys and row["right"] == SILENCE and not keys[-1].endswith(":0"):
        yield "keys", "a curve into silence must end with weight 0"


def _alias(parts: Parts, row: Row, names: Names) -> Iterator[tuple[str, str]]:
    language, symbol = parts["language"], row["symbol"]
    if symbol != unicodedata.normalize("NFC", symbol):
        yield "symbol", f"{symbol!r} is not in Unicode's composed form (NFC), so it would never be found"
    if row["notation"] == names.notation.get(language) and symbol in names.phones(language) and row["phones"] != symbol:
        yield "symbol", f"{symbol!r} is a phone of this notation itself, so it would mean two things"
    if symbol.lower() in names.marks and row["phones"] != SILENCE:
        yield "symbol", f"{symbol!r} is a mark of a pause or a noise (marks.tsv), so it would mean two things"


def _phone(parts: Parts, row: Row, names: Names) -> Iterator[tuple[str, str]]:
    if row["phone"].lower() in names.marks:
        yield "phone", f"{row['phone']!r} is a mark of a pause or a noise (marks.tsv), so it would mean two things"
    if SILENCE in row["common"].split():
        yield "common", f"a phone of {parts['language']} can't be silence; labels of pauses belong in marks.tsv"


def _own_name(part: str) -> Callable[[Parts, Row, Names], Iterator[tuple[str, str]]]:
    def checked(parts: Parts, row: Row, _names: Names) -> Iterator[tuple[str, str]]:
        if row[part] != parts[part]:
            yield part, f"{row[part]!r} stands in the folder of {parts[part]!r}"

    return checked


def _character(parts: Parts, row: Row, names: Names) -> Iterator[tuple[str, str]]:
    yield from _own_name("character")(parts, row, names)
    path = f"links/{row['pose_set']}/{row['shapes']}.tsv"
    if row["shapes"] and row["shapes"] != row["pose_set"] and not names.records.get(path):
        yield "shapes", f"no links lead there; add {path}"


_SPECIAL: Mapping[str, Callable[[Parts, Row, Names], Iterator[tuple[str, str]]]] = {
    "poses/sets.tsv": _pose_set,
    "constraints/{pose_set}.tsv": _constraint,
    "curves/{pose_set}.tsv": _curve,
    "{language}/curves/{pose_set}.tsv": _curve,
    "characters/{character}/curves/{pose_set}.tsv": _curve,
    "{language}/language.tsv": _own_name("language"),
    "{language}/phones.tsv": _phone,
    "{language}/aliases.tsv": _alias,
    "characters/{character}/character.tsv": _character,
}


def _missing(records: Records, names: Names) -> Iterator[Finding]:
    """Tables and rows that ought to be there, and names that stand for two things in one table."""
    for path in ("sources.tsv", "common.tsv", "poses/sets.tsv"):
        if not records.get(path):
            yield Finding(path, 1, 1, "this table must be there and have rows")
    folders = {path.split("/")[0] for path in records if (table := table_of(path)) and table.pattern.startswith("{language}/")}
    for language in sorted(folders):
        for path in (f"{language}/language.tsv", f"{language}/phones.tsv"):
            if not records.get(path):
                yield Finding(path, 1, 1, f"language {language!r} is not complete without this table")
    for path in records:
        table = table_of(path)
        if table and table.pattern == "poses/{pose_set}.tsv" and (name := path[6:-4]) not in names.sets:
            yield Finding(path, 1, 1, f"pose set {name!r} has no row in poses/sets.tsv")
        if path.startswith("characters/") and not records.get("/".join([*path.split("/")[:2], "character.tsv"])):
            yield Finding(path, 1, 1, "this character has no character.tsv")
    yield from _twice(records, "ipa.tsv", "xsampa", "X-SAMPA")
    for path in records:
        if path.startswith("poses/") and path != "poses/sets.tsv":
            yield from _twice(records, path, "position", "position")


def _twice(records: Records, path: str, column: str, what: str) -> Iterator[Finding]:
    """Findings for words of *column* that an earlier row of the same table has."""
    first: dict[str, Key] = {}
    table = table_of(path)
    for line, (key, row) in enumerate(sorted(records.get(path, {}).items()), 2):
        for word in row[column].split():
            if word in first and table:
                yield Finding(path, line, _column(table, row, column), f"{what} {word!r} stands for {first[word][0]!r} already")
            first.setdefault(word, key)


def _column(table: Table, row: Row, name: str) -> int:
    """Where the cell *name* begins in the row's line, from 1."""
    before = table.names[: table.names.index(name)]
    return 1 + sum(len(row[other]) + 1 for other in before)
