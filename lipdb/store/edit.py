"""One edit: rows staged by a person or a program, saved together as one revision."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime

import sqlalchemy as sa

from lipdb.curated.schema import TIME_FORMAT, Table, table_of
from lipdb.curated.tsv import Row, canonical_row, key_of
from lipdb.errors import PhonesetError
from lipdb.store.cells import Place
from lipdb.store.conflict import EditConflictError, Versions
from lipdb.store.provenance import completed, signed
from lipdb.store.revisions import Changed, Present, author_name, author_of, last_change, present_rows, write


@dataclass(frozen=True, slots=True)
class _Staged:
    row: Row | None
    expected: int | None
    accepted: bool = False


class Edit:
    """Rows to be saved together. Made by `Store.edit`; `put` and `delete` only stage, the end of its block saves.

    By hand, rows with provenance are signed (see `lipdb.store.provenance`); else they are stored as given.
    *revision* is the revision that was made, None while there is none and when nothing changed.
    """

    def __init__(self, *, author: str, note: str = "", by_hand: bool = True) -> None:
        self.author = author_name(author)
        self.note = note
        self.time = datetime.now(UTC).strftime(TIME_FORMAT)
        self.revision: int | None = None
        self._by_hand = by_hand
        self._staged: dict[Place, _Staged] = {}

    def put(self, path: str, row: Mapping[str, str], expected_revision: int | None = None, *, accepted: bool = False) -> None:
        """Stage *row* of the table at *path*, new or in place of the one with its key.

        *expected_revision* is the revision at which the editor saw the row; None saves over anything. With *accepted*, a
        row that a program made becomes the author's own though its values stay: somebody looked and found it right.
        Raises `PhonesetError` for a path that is no table's or a cell that is wrong.
        """
        table = _table(path)
        try:
            given = completed(table, row, author=self.author, time=self.time) if self._by_hand else row
            clean = canonical_row(table, given)
            "".join(clean.values()).encode()
        except ValueError as error:
            raise PhonesetError(f"{path}: {error}") from error
        self._staged[path, key_of(table, clean)] = _Staged(clean, expected_revision, accepted)

    def delete(self, path: str, key: Sequence[str], expected_revision: int | None = None) -> None:
        """Stage the removal of the row with *key*; a row that is not there stays away."""
        table = _table(path)
        if len(key) != len(table.key):
            raise PhonesetError(f"{path}: a row is named by {', '.join(table.key)}; {' '.join(key)!r} has {len(key)} parts")
        self._staged[path, tuple(key)] = _Staged(None, expected_revision)

    def save(self, connection: sa.Connection) -> None:
        """Write what is staged, within the writing transaction of *connection*.

        Raises `EditConflictError` when a row changed after the revision at which its editor saw it.
        """
        present = present_rows(connection, self._staged)
        self._refuse_lost_work(connection, present)
        changes = list(self._changes(present))
        if changes:
            self.revision = write(connection, changes, author=self.author, time=self.time, note=self.note)

    def _changes(self, present: Mapping[Place, Present]) -> Iterator[Changed]:
        for place in sorted(self._staged):
            before = present[place].row if place in present else None
            after = self._signed(place, before)
            if after != before:
                yield Changed(place, before, after)

    def _signed(self, place: Place, before: Row | None) -> Row | None:
        staged = self._staged[place]
        if staged.row is None or not self._by_hand:
            return staged.row
        return signed(_table(place[0]), staged.row, before, author=self.author, time=self.time, accepted=staged.accepted)

    def _refuse_lost_work(self, connection: sa.Connection, present: Mapping[Place, Present]) -> None:
        conflicts, newest = [], 0
        for place, staged in self._staged.items():
            if staged.expected is None:
                continue
            there = present.get(place)
            theirs = there.row if there else None
            last = there.revision if there else last_change(connection, place)
            if last > staged.expected and theirs != self._signed(place, theirs):
                conflicts.append(Versions(*place, staged.row, theirs))
                newest = max(newest, last)
        if conflicts:
            raise EditConflictError(conflicts, revision=newest, author=author_of(connection, newest), doing="not saved")


def _table(path: str) -> Table:
    table = table_of(path)
    if table is None:
        raise PhonesetError(f"{path}: no table has this name; see docs/data.md for the layout")
    return table
