"""Canonical text in and out of the store."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import sqlalchemy as sa

from lipdb.curated.folder import table_files, write_folder
from lipdb.curated.schema import table_of
from lipdb.curated.tsv import Records
from lipdb.errors import OutputError
from lipdb.store.cells import flat
from lipdb.store.conflict import EditConflictError
from lipdb.store.history import state_at
from lipdb.store.merge import merge
from lipdb.store.revisions import Changed, author_of, last_change, read_flat, write
from lipdb.store.tables import record


@dataclass(frozen=True, slots=True)
class Loaded:
    """What loading text did: the revision (None when the text said nothing new), and how many rows it changed."""

    revision: int | None
    added: int
    changed: int
    removed: int

    def to_json(self) -> dict[str, Any]:
        """Plain data for a listing."""
        return {"revision": self.revision, "added": self.added, "changed": self.changed, "removed": self.removed}


def load_text(connection: sa.Connection, records: Records, *, since: int | None, author: str, time: str, note: str) -> Loaded:
    """Make the store's rows those of *records*, which were dumped at revision *since* (None: they win everywhere).

    Raises `EditConflictError` when somebody changed a row after *since* that *records* change too.
    """
    mine = read_flat(connection, record)
    base = mine if since is None else state_at(connection, since)
    outcome = merge(base, flat(records), mine)
    if outcome.conflicts:
        newest = max(last_change(connection, (one.path, one.key)) for one in outcome.conflicts)
        # In this merge the text is what the caller brings, and the store has what others saved.
        sides = [one.swapped() for one in outcome.conflicts]
        raise EditConflictError(sides, revision=newest, author=author_of(connection, newest), doing="text not loaded")
    changes = [Changed(place, mine.get(place), row) for place, row in outcome.followed.items()]
    number = write(connection, changes, author=author, time=time, note=note) if changes else None
    added = sum(one.before is None for one in changes)
    removed = sum(one.after is None for one in changes)
    return Loaded(number, added, len(changes) - added - removed, removed)


def dump_text(records: Records, folder: Path) -> None:
    """Write *records* below *folder* and remove the tables that they don't have.

    Raises `OutputError` when the folder can't be written.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        write_folder(records, folder)
        for file in table_files(folder):
            path = file.relative_to(folder).as_posix()
            if path not in records and table_of(path) is not None:
                file.unlink()
    except OSError as error:
        raise OutputError(f"{folder}: can't be written ({error.strerror}); choose another folder") from error
