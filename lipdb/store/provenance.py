"""Who made a row, and how: what an edit by hand writes into a row's origin, source, licence, author and time."""

from __future__ import annotations

from collections.abc import Mapping

from lipdb.curated.schema import BY_HAND, USER_LICENCE, USER_SOURCE, Table
from lipdb.curated.tsv import Row

PROVENANCE = ("origin", "source", "licence", "author", "time")


def completed(table: Table, row: Mapping[str, str], *, author: str, time: str) -> dict[str, str]:
    """*row* with the provenance cells that it leaves empty filled in, as the author's own work."""
    own = {"source": USER_SOURCE}
    if "origin" in table.names:
        own |= {"origin": "authored", "licence": USER_LICENCE, "author": author, "time": time}
    elif "source" not in table.names or "source" in table.key:
        own = {}
    return {**row, **{name: row.get(name) or cell for name, cell in own.items()}}


def signed(table: Table, row: Row, before: Row | None, *, author: str, time: str, accepted: bool = False) -> Row:
    """What a person's edit of *before* into *row* stores.

    A row whose values change becomes `authored`, by this author, now. Its source and licence are the given ones, but
    those that *row* merely kept from a generated, fitted or imported row give way to the user's own: that source did
    not make the new values. A row whose values stay keeps origin, author and time; when a person has looked at it and
    *accepted* it as it is, it becomes `authored` too, and keeps its source, unless it was made by hand already.
    """
    if "origin" not in table.names:
        return row
    if before is not None and not _changes(table, row, before):
        if accepted and before["origin"] not in BY_HAND:
            return {**row, "origin": "authored", "author": author, "time": time}
        return {**row, **{name: before[name] for name in ("origin", "author", "time")}}
    result = {**row, "origin": "authored", "author": author, "time": time}
    if before is not None and before["origin"] != "authored" and row["source"] == before["source"]:
        result |= {"source": USER_SOURCE, "licence": USER_LICENCE}
    return result


def _changes(table: Table, row: Row, before: Row) -> bool:
    return any(row[name] != before[name] for name in table.names if name not in PROVENANCE and name != "comment")
