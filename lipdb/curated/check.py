"""Checks across tables: every name that a row mentions exists, nothing means two things, nothing is missing."""

from __future__ import annotations

import unicodedata
from collections.abc import Callable, Collection, Iterator, Mapping
from difflib import get_close_matches

from lipdb.curated.references import REFERENCES, SILENCE, SOURCE, Names, Parts
from lipdb.curated.schema import Table, table_of
from lipdb.curated.tsv import Finding, Key, Records, Row


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


def _wrong(table: Table, parts: Parts, row: Row, names: Names) -> Iterator[tuple[str, str]]:
    """Column and message of everything that is wrong with one row."""
    references = REFERENCES.get(table.pattern, ())
    for reference in (*references, SOURCE) if "source" in table.names else references:
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


def _common_phone(_parts: Parts, row: Row, names: Names) -> Iterator[tuple[str, str]]:
    rows, above = names.records["common.tsv"], [row["phone"]]
    while (phone := rows.get((above[-1],), {}).get("kind_of", "")) and phone not in above:
        above.append(phone)
    if phone == row["phone"]:
        yield "kind_of", f"{row['phone']!r} would be a kind of itself: {' > '.join([*above, phone])}"
    elif SILENCE in above and row["kind_of"]:
        yield "kind_of", "silence has no kinds"


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
    "common.tsv": _common_phone,
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
        if table and table.pattern == "poses/{pose_set}.tsv":
            yield from _twice(records, path, "position", "position")
            if (name := path[6:-4]) not in names.sets:
                yield Finding(path, 1, 1, f"pose set {name!r} has no row in poses/sets.tsv")
        if path.startswith("characters/") and not records.get("/".join([*path.split("/")[:2], "character.tsv"])):
            yield Finding(path, 1, 1, "this character has no character.tsv")
    yield from _twice(records, "ipa.tsv", "xsampa", "X-SAMPA")


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
