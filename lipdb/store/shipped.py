"""The shipped text in the store: the first fill, the base of the merge, and what says that the text is newer."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import sqlalchemy as sa

from lipdb.curated.folder import require_folder, table_files
from lipdb.curated.tsv import Records
from lipdb.errors import PhonesetError
from lipdb.store.cells import flat, stored
from lipdb.store.merge import Merge, merge
from lipdb.store.revisions import Changed, read_flat, write
from lipdb.store.tables import fact, record, shipped

PROGRAM = "lipdb"
"""The author of revisions that bring shipped text."""

_DIGEST = "shipped text"


@dataclass(frozen=True, slots=True)
class Upgrade:
    """What `Store.upgrade` did: the schema before and after, the merge, and the revision when rows followed."""

    schema_before: str
    schema: str
    revision: int | None
    merge: Merge

    def to_json(self) -> dict[str, Any]:
        """Plain data for a listing."""
        return {"schema_before": self.schema_before, "schema": self.schema, "revision": self.revision, **self.merge.to_json()}


def text_digest(folder: Path) -> str:
    """A digest of every table below *folder*: two folders with the same text have the same. Raises `PhonesetError`."""
    require_folder(folder)
    digest = hashlib.sha256()
    for file in table_files(folder):
        try:
            content = file.read_bytes()
        except OSError as error:
            raise PhonesetError(f"{file}: can't be read ({error.strerror}); look whether you may") from error
        digest.update(f"{file.relative_to(folder).as_posix()} {len(content)}\n".encode() + content)
    return digest.hexdigest()


def merged_digest(connection: sa.Connection) -> str:
    """The digest of the text that was merged last; empty when no text was."""
    return connection.scalar(sa.select(fact.c.value).where(fact.c.name == _DIGEST)) or ""


def fill(connection: sa.Connection, records: Records, digest: str, *, time: str) -> None:
    """Make revision 1 of the shipped *records* in an empty store."""
    changes = [Changed(place, None, row) for place, row in sorted(flat(records).items())]
    write(connection, changes, author=PROGRAM, time=time, note="Fill from the shipped text")
    remember(connection, records, digest)


def merge_shipped(connection: sa.Connection, records: Records, digest: str, *, time: str) -> tuple[Merge, int | None]:
    """Merge the shipped *records* into the store; the outcome, and the revision when rows followed."""
    mine = read_flat(connection, record)
    outcome = merge(read_flat(connection, shipped), flat(records), mine)
    changes = [Changed(place, mine.get(place), row) for place, row in outcome.followed.items()]
    number = write(connection, changes, author=PROGRAM, time=time, note="Follow newer shipped text") if changes else None
    remember(connection, records, digest)
    return outcome, number


def remember(connection: sa.Connection, records: Records, digest: str) -> None:
    """Take *records* for the text that was merged last."""
    connection.execute(sa.delete(shipped))
    connection.execute(sa.insert(shipped), [{"path": path, "key": key, "cells": cells} for path, key, cells in stored(records)])
    connection.execute(sa.delete(fact).where(fact.c.name == _DIGEST))
    connection.execute(sa.insert(fact), {"name": _DIGEST, "value": digest})
