"""Two versions of curated data side by side: which rows differ, what becomes of each, and the rows that come out."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from lipdb.curated.check import check
from lipdb.curated.folder import scan_folder
from lipdb.curated.tsv import Finding, Key, Records, Row
from lipdb.errors import InputError, PhonesetError
from lipdb.store.cells import differing, flat, nested
from lipdb.store.merge import merge

Place = tuple[str, Key]
LEFT, RIGHT = "left", "right"


@dataclass(frozen=True, slots=True)
class Difference:
    """A row that the two sides have otherwise: None where a side has none.

    *taken* is the side that is taken unless a person says otherwise: with a common ancestor the one that changed the row. Where
    both did, or nobody can know, it is the left one, and with an ancestor that is a *conflict*.
    """

    path: str
    key: Key
    left: Row | None
    right: Row | None
    taken: str = LEFT
    conflict: bool = False

    @property
    def place(self) -> Place:
        """Where the row is."""
        return self.path, self.key

    @property
    def kind(self) -> str:
        """What happened to the row on the way from left to right."""
        return "added" if self.left is None else "removed" if self.right is None else "changed"

    def to_row(self) -> dict[str, Any]:
        """A line of a listing: only the cells that differ."""
        sides = {LEFT: differing(self.left, self.right), RIGHT: differing(self.right, self.left)}
        return {"what": "conflict" if self.conflict else self.kind, "table": self.path, "row": " ".join(self.key), **sides}


def read_version(folder: Path) -> Records:
    """The records in *folder*: a folder of curated text, one of a few languages, or a language's own.

    Raises `InputError` when it is none of these, `PhonesetError` with all findings when the text is wrong.
    """
    own = require_version(folder)
    records, findings = scan_folder(folder.resolve().parent, below=folder.resolve().name) if own else scan_folder(folder)
    if findings:
        raise PhonesetError("\n".join(str(folder / str(one)) for one in findings))
    return records


def require_version(folder: Path) -> bool:
    """Whether *folder* is a language's own. Raises `InputError` when there is no curated text in it."""
    own = (folder / "language.tsv").is_file()
    # A folder that is none of these may hold a whole disk.
    if not own and not (folder / "common.tsv").is_file() and not any(folder.glob("*/language.tsv")):
        raise InputError(f"{folder}: no curated text there; give a folder with common.tsv, with folders of languages, or a language's own")
    return own


def completed(side: Records, other: Records) -> Records:
    """*side* as far as it goes, the rest as in *other*: of a language's folder only that folder is compared.

    A whole folder of curated text has ``sources.tsv``. In one that has not, shared tables only add rows.
    """
    if "sources.tsv" in side:
        return side
    folders = {path.split("/")[0] for path in side if "/" in path}
    shared = {path: {**other.get(path, {}), **rows} for path, rows in side.items() if "/" not in path}
    kept = {path: rows for path, rows in other.items() if "/" not in path or path.split("/")[0] not in folders}
    return {**kept, **side, **shared}


def differences(left: Records, right: Records, base: Records | None = None, *, below: str = "") -> list[Difference]:
    """The rows of the tables below *below* that differ, conflicts first; *base* is what both sides were made from, if that is known."""
    one, other = _below(left, below), _below(right, below)
    if base is None:
        places = sorted(place for place in one.keys() | other.keys() if one.get(place) != other.get(place))
        return [Difference(*place, one.get(place), other.get(place)) for place in places]
    merged = merge(_below(base, below), other, one)
    conflicts = [Difference(row.path, row.key, row.mine, row.theirs, LEFT, conflict=True) for row in merged.conflicts]
    settled = [Difference(row.path, row.key, row.mine, row.theirs, LEFT) for row in merged.kept]
    settled += [Difference(*place, one.get(place), row, RIGHT) for place, row in merged.followed.items()]
    return [*conflicts, *sorted(settled, key=lambda row: row.place)]


def _below(records: Records, below: str) -> dict[Place, Row]:
    return flat({path: rows for path, rows in records.items() if path.startswith(below)})


def chosen_rows(found: list[Difference], choices: Mapping[Place, str]) -> dict[Place, Row | None]:
    """What becomes of each row that differs, by what a person chose (``left`` or ``right``), or by itself; None: it goes."""
    return {one.place: one.left if choices.get(one.place, one.taken) == LEFT else one.right for one in found}


def changed_rows(target: Records, chosen: Mapping[Place, Row | None]) -> dict[Place, Row | None]:
    """The part of *chosen* that changes *target*."""
    return {(path, key): row for (path, key), row in chosen.items() if target.get(path, {}).get(key) != row}


def applied(target: Records, changes: Mapping[Place, Row | None]) -> Records:
    """*target* with *changes*."""
    rows = flat(target)
    for place, row in changes.items():
        if row is None:
            rows.pop(place, None)
        else:
            rows[place] = row
    return nested(rows)


def new_findings(target: Records, result: Records) -> list[Finding]:
    """What would be wrong in *result* that was not wrong in *target*."""
    before = {(one.file, one.message) for one in check(target)}
    return [one for one in check(result) if (one.file, one.message) not in before]
