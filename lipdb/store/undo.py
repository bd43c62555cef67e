"""Take back what a revision did."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import sqlalchemy as sa

from lipdb.curated.tsv import Row
from lipdb.errors import InputError
from lipdb.store.cells import Place
from lipdb.store.conflict import EditConflictError, Versions
from lipdb.store.history import Change, read_changes, require_revision
from lipdb.store.revisions import Changed, Present, author_of, last_change, present_rows, write
from lipdb.store.tables import change


def undo(connection: sa.Connection, number: int, *, author: str, time: str, note: str) -> int | None:
    """Make a revision that takes back revision *number*; its number, None when nothing of *number* is left.

    A row that was changed later and came back to what *number* made of it can be taken back: undoing from the newest
    revision backwards always works. Raises `EditConflictError` when a row is something else now.
    """
    require_revision(connection, number)
    if number <= 1:
        raise InputError(f"revision {number} can't be undone: nothing comes before revision 1, which filled the store")
    changes = read_changes(connection, change.c.revision_id == number)
    present = present_rows(connection, {(one.path, one.key): None for one in changes})
    _refuse_lost_work(connection, changes, present)
    back = list(_taken_back(changes, present))
    return write(connection, back, author=author, time=time, note=note or f"Undo revision {number}") if back else None


def _now(present: Mapping[Place, Present], one: Change) -> Row | None:
    there = present.get((one.path, one.key))
    return there.row if there else None


def _taken_back(changes: Sequence[Change], present: Mapping[Place, Present]) -> Iterator[Changed]:
    for one in changes:
        if _now(present, one) != one.before:
            yield Changed((one.path, one.key), one.after, one.before)


def _refuse_lost_work(connection: sa.Connection, changes: Sequence[Change], present: Mapping[Place, Present]) -> None:
    pairs = [(one, _now(present, one)) for one in changes]
    lost = [Versions(one.path, one.key, mine=one.before, theirs=now) for one, now in pairs if now not in (one.before, one.after)]
    if lost:
        newest = max(last_change(connection, (one.path, one.key)) for one in lost)
        doing = f"revision {changes[0].revision} not undone"
        raise EditConflictError(lost, revision=newest, author=author_of(connection, newest), doing=doing)
