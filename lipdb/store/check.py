"""Everything that can be wrong with a store: the file, the tables, the history, and what the rows say."""

from __future__ import annotations

from collections.abc import Iterator

import sqlalchemy as sa

from lipdb.curated.check import check
from lipdb.curated.schema import table_of
from lipdb.curated.tsv import Finding, Key, Records, Row, canonical_row, key_of
from lipdb.store.cells import records_from
from lipdb.store.history import read_changes
from lipdb.store.migrate import schema_findings
from lipdb.store.tables import change, record


def findings(connection: sa.Connection, where: str) -> list[Finding]:
    """What is wrong, sorted; a row is named by the line that it would have in a dump."""
    found = [Finding(where, 0, 0, message) for message in (*_file_findings(connection), *schema_findings(connection))]
    if found:
        return found
    records = records_from(connection.execute(sa.select(record.c.path, record.c.key, record.c.cells)).all())
    # What rows say about each other can only be asked when each of them is in order.
    found += list(_row_findings(records)) or check(records)
    found += [Finding(where, 0, 0, message) for message in _history_findings(connection, records)]
    return sorted(found)


def _file_findings(connection: sa.Connection) -> Iterator[str]:
    if connection.dialect.name != "sqlite":
        return
    for (message,) in connection.exec_driver_sql("PRAGMA integrity_check"):
        if message != "ok":
            yield f"the file is damaged: {' '.join(message.split())}; put a backup in its place"
    for table, row, other, _ in connection.exec_driver_sql("PRAGMA foreign_key_check"):
        yield f"row {row} of table {table} names a row of {other} that is not there"


def _row_findings(records: Records) -> Iterator[Finding]:
    for path, rows in records.items():
        if table_of(path) is None:
            yield Finding(path, 1, 1, "no table has this name; see docs/data.md for the layout")
            continue
        for line, key in enumerate(sorted(rows), 2):
            if message := _wrong(path, key, rows[key]):
                yield Finding(path, line, 1, message)


def _wrong(path: str, key: Key, row: Row) -> str:
    table = table_of(path)
    assert table is not None
    try:
        clean = canonical_row(table, row)
    except ValueError as error:
        return str(error)
    if key_of(table, clean) != key:
        return f"the row is stored under the name {' '.join(key)}"
    return "" if clean == row else "the row is not written in canonical form"


def _history_findings(connection: sa.Connection, records: Records) -> Iterator[str]:
    """Rows whose newest change does not say what the record says."""
    newest = sa.select(sa.func.max(change.c.id)).group_by(change.c.path, change.c.key)
    said = {(one.path, one.key): one.after for one in read_changes(connection, change.c.id.in_(newest)) if one.after is not None}
    present = {(path, key): row for path, rows in records.items() for key, row in rows.items()}
    for path, key in sorted(said.keys() | present.keys()):
        if said.get((path, key)) != present.get((path, key)):
            yield f"{path} {' '.join(key)} is not what its newest revision made of it"
