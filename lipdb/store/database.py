"""The store: curated data that people edit, with every revision kept. The only door to the database.

Each method is one transaction. A `Store` may be shared by threads; a file may be shared by programs.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from copy import copy
from datetime import UTC, datetime
from pathlib import Path
from typing import Self

import sqlalchemy as sa

from lipdb.curated.folder import read_checked_folder, read_folder
from lipdb.curated.schema import TIME_FORMAT
from lipdb.curated.tsv import Finding, Key, Row
from lipdb.errors import InputError, StoreError
from lipdb.paths import home, phonesets_dir
from lipdb.store.cells import nested, records_from
from lipdb.store.edit import Edit
from lipdb.store.engines import database_url, description, has_content, is_file, make_engine, place_of, reading, writing
from lipdb.store.failures import plain_errors
from lipdb.store.history import Change, Revision, difference, read_changes, read_revisions, require_revision, state_at
from lipdb.store.migrate import require_current, schema_of
from lipdb.store.revisions import Present, newest_revision, present_rows
from lipdb.store.scans import Scan, add_scan, read_scans
from lipdb.store.search import Wanted, find_revisions, read_authors, read_kinds
from lipdb.store.setup import create, upgrade_tables
from lipdb.store.shipped import Upgrade, merge_shipped, merged_digest, remember, text_digest
from lipdb.store.tables import SCHEMA, change, record
from lipdb.store.text import Loaded, dump_text, load_text
from lipdb.store.undo import undo


def _now() -> str:
    return datetime.now(UTC).strftime(TIME_FORMAT)


class Store:
    """Curated data in SQLite or PostgreSQL. Make one with `Store.open`."""

    def __init__(self, url: sa.URL, phonesets: Path) -> None:
        self.where = place_of(url)
        self.phonesets = phonesets
        self._url = url
        self._shut = False
        with plain_errors(self.where):
            engine = make_engine(url)
        self._reader, self._writer = reading(engine), writing(engine)

    @classmethod
    def open(cls, place: str | Path | None = None, phonesets: Path | str | None = None) -> Self:
        """The store at *place*, made and filled from *phonesets* when there is none yet.

        *place* is a SQLite file or an address; without it ``LIPDB_URL``, else ``lipdb.db`` in the user's data folder.
        Raises `StoreError` when it can't be used, `SchemaVersionError` when its schema is older or newer.
        """
        store = cls.locate(place, phonesets)
        try:
            schema = store._schema()
            if schema:
                require_current(schema, store.where)
            else:
                create(store._url, store.phonesets, time=_now())
        except BaseException:
            store.close()
            raise
        return store

    @classmethod
    def locate(cls, place: str | Path | None = None, phonesets: Path | str | None = None) -> Self:
        """The store at *place* whatever its schema: nothing is opened, made or checked yet. For `upgrade`."""
        return cls(database_url(place), phonesets_dir(phonesets))

    def read_only(self) -> Self:
        """The same store for those who may only look: every way to write raises `StoreError`."""
        view = copy(self)
        view._shut = True
        return view

    def require_writable(self) -> None:
        """Raise `StoreError` when this is a view to look at; see `read_only`."""
        if self._shut:
            raise StoreError(f"{self.where}: this view is for looking only; nothing was saved")

    def require_current(self) -> None:
        """Raise `SchemaVersionError` when somebody upgraded the database while it was open here."""
        require_current(self._schema(), self.where)

    def close(self) -> None:
        """Close every connection. The store may be used again."""
        self._reader.dispose()

    @property
    def characters_folder(self) -> Path:
        """Where the files of characters that people add are kept: beside the database file, else in the user's data folder."""
        return (Path(self.where).parent if is_file(self._url) else home()) / "characters"

    def describe(self) -> str:
        """Which database this is, in a line: where, what kind, which schema."""
        return f"{self.where} ({description(self._reader)}, schema {SCHEMA})"

    # Reading

    def records(self, prefix: str | None = None) -> dict[str, dict[Key, Row]]:
        """All the curated data, or that of the tables whose path begins with *prefix*."""
        return self.snapshot(prefix)[0]

    def snapshot(self, prefix: str | None = None) -> tuple[dict[str, dict[Key, Row]], int]:
        """The records and the store's revision at one instant: what an editor shows, and what it saves against."""
        query = sa.select(record.c.path, record.c.key, record.c.cells)
        if prefix:
            query = query.where(record.c.path.startswith(prefix, autoescape=True))
        with self._reading() as connection:
            return records_from(connection.execute(query).all()), newest_revision(connection)

    def record(self, path: str, key: Sequence[str]) -> Present | None:
        """The row with *key* of the table at *path* and the revision that changed it last; None when it is not there."""
        place = (path, tuple(key))
        with self._reading() as connection:
            return present_rows(connection, {place: None}).get(place)

    @property
    def revision(self) -> int:
        """The number of the newest revision."""
        with self._reading() as connection:
            return newest_revision(connection)

    @property
    def outdated(self) -> bool:
        """Whether the text in *phonesets* is other than the one merged last; then `upgrade` has something to do."""
        with self._reading() as connection:
            return merged_digest(connection) != text_digest(self.phonesets)

    # Editing

    @contextmanager
    def edit(self, *, author: str, note: str = "", by_hand: bool = True) -> Iterator[Edit]:
        """A block whose `put` and `delete` are saved together at its end, as one revision; see `Edit`.

        An error inside the block saves nothing. A program that stores rows with their own provenance (a generator, an
        import) says *by_hand* False. Raises `EditConflictError` at the end of the block.
        """
        edit = Edit(author=author, note=note, by_hand=by_hand)
        yield edit
        with self._writing() as connection:
            edit.save(connection)

    def undo(self, number: int, *, author: str, note: str = "") -> int | None:
        """Take back what revision *number* did, as a new revision; its number, None when nothing of it is left.

        Raises `EditConflictError` when a row is no longer as that revision left it.
        """
        with self._writing() as connection:
            return undo(connection, number, author=author, time=_now(), note=note)

    # History

    def history(self, prefix: str | None = None, key: Sequence[str] | None = None, *, limit: int | None = None) -> list[Revision]:
        """The revisions that changed tables below *prefix* (there the row with *key*), newest first."""
        with self._reading() as connection:
            return read_revisions(connection, prefix, key, limit)

    def find(self, wanted: Wanted, *, limit: int | None = None) -> list[Revision]:
        """The revisions that *wanted* names, newest first."""
        with self._reading() as connection:
            return find_revisions(connection, wanted, limit=limit)

    def authors(self) -> list[str]:
        """Everybody who has made a revision, sorted."""
        with self._reading() as connection:
            return read_authors(connection)

    def kinds(self) -> list[str]:
        """What the tables are about that have ever changed, sorted, such as ``curves`` and ``links``."""
        with self._reading() as connection:
            return read_kinds(connection)

    def changes(self, number: int, prefix: str | None = None) -> list[Change]:
        """What revision *number* did to the rows below *prefix*."""
        with self._reading() as connection:
            require_revision(connection, number)
            return read_changes(connection, change.c.revision_id == number, prefix=prefix)

    def diff(self, old: int, new: int, prefix: str | None = None) -> list[Change]:
        """How the state at revision *new* differs from the one at *old*, whichever came first; sorted by place.

        The `Change.revision` of each is *new*.
        """
        low, high = sorted((old, new))
        with self._reading() as connection:
            require_revision(connection, low)
            require_revision(connection, high)
            changes = read_changes(connection, change.c.revision_id > low, change.c.revision_id <= high, prefix=prefix)
        ends = sorted(difference(changes).items())
        return [Change(new, *place, *(pair if old <= new else pair[::-1])) for place, pair in ends]

    def at(self, number: int) -> dict[str, dict[Key, Row]]:
        """The records as they were at revision *number*; 0 is the empty store."""
        with self._reading() as connection:
            return nested(state_at(connection, number))

    # Scans

    @property
    def scans_folder(self) -> Path:
        """Where results of scans are put, unless a person names a file: beside the database file, else in the user's data folder."""
        return (Path(self.where).parent if is_file(self._url) else home()) / "scans"

    def add_scan(self, scan: Scan) -> Scan:
        """Register a scan of a corpus; the same with its number and the store's revision."""
        with self._writing() as connection:
            return add_scan(connection, scan)

    def scans(self, language: str | None = None) -> list[Scan]:
        """The scans of *language*, or all, newest first."""
        with self._reading() as connection:
            return read_scans(connection, language)

    # Text

    def load(self, folder: Path, *, author: str, note: str = "", since: int | None = None) -> Loaded:
        """Make the records what the text in *folder* says, as one revision.

        With *since*, the revision that the folder was dumped from, rows that others changed after it stay unless the
        text changed them too; that raises `EditConflictError`. Without it the text wins everywhere. Where *folder* is the one
        that `upgrade` merges, nothing of it waits to be merged any more.
        """
        records = read_folder(folder)
        with self._writing() as connection:
            loaded = load_text(connection, records, since=since, author=author, time=_now(), note=note or f"Load {folder.name}")
            if folder.resolve() == self.phonesets.resolve():
                remember(connection, records, text_digest(folder))
        return loaded

    def dump(self, folder: Path, number: int | None = None) -> int:
        """Write the records, or those of revision *number*, as canonical text below *folder*; the revision they are of.

        Tables that the store does not have are removed from it, so that loading it gives this state again.
        """
        records, newest = self.snapshot() if number is None else (self.at(number), number)
        dump_text(records, folder)
        return newest

    # Care

    def upgrade(self) -> Upgrade:
        """Bring the schema up to date and merge the shipped text three ways: rows nobody edited follow, others stay."""
        self.require_writable()
        before = self._schema()
        if before:
            upgrade_tables(self._url)
        else:
            create(self._url, self.phonesets, time=_now())
        records, digest = read_checked_folder(self.phonesets), text_digest(self.phonesets)
        with self._writing() as connection:
            outcome, number = merge_shipped(connection, records, digest, time=_now())
        return Upgrade(before, SCHEMA, number, outcome)

    def check(self) -> list[Finding]:
        """Everything that is wrong with the database and with what it holds; empty when all is well."""
        from lipdb.store.check import findings

        require_current(self._schema(), self.where)
        with self._reading() as connection:
            return findings(connection, self.where)

    def backup(self, file: Path) -> None:
        """Copy the whole store, history included, into the SQLite file *file*, in place of an older one.

        Raises `InputError` when *file* is the store itself, `OutputError` when it can't be written.
        """
        from lipdb.store.backup import back_up

        if is_file(self._url) and file.resolve() == Path(self.where).resolve():
            raise InputError(f"{file}: this is the database itself; give the backup another name")
        with self._reading() as connection:
            back_up(connection, file)

    # Inside

    @contextmanager
    def _reading(self) -> Iterator[sa.Connection]:
        with plain_errors(self.where), self._reader.connect() as connection:
            yield connection

    @contextmanager
    def _writing(self) -> Iterator[sa.Connection]:
        self.require_writable()
        with plain_errors(self.where), self._writer.begin() as connection:
            # A program that runs for days must not write into the tables of a newer one.
            require_current(schema_of(connection, self.where), self.where)
            yield connection

    def _schema(self) -> str:
        # SQLite would make a missing file; reading must not.
        if not has_content(self._url):
            return ""
        with self._reading() as connection:
            return schema_of(connection, self.where)
