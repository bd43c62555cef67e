"""The register of scans: which corpus was counted when, how, by which mapping, and where its result is.

The counts themselves are Parquet files; here stands only what finds them.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

import sqlalchemy as sa

from lipdb.store.revisions import newest_revision
from lipdb.store.tables import scan


@dataclass(frozen=True, slots=True)
class Scan:
    """One scan. *corpus* are the paths as they were given, *content* a digest of what was read, *counter* the key of the way of
    counting, *mapping* a digest of what decided the common phones, *revision* the store's revision that this was, *path* the
    result, *totals* its sums.
    """

    time: str
    language: str
    mode: str
    corpus: tuple[str, ...]
    content: str
    counter: str
    mapping: str
    path: str
    totals: Mapping[str, Any]
    revision: int = 0
    id: int = 0

    def to_json(self) -> dict[str, Any]:
        """Plain data for a listing."""
        told = asdict(self)
        return {"id": told.pop("id"), **told.pop("totals"), **told, "corpus": list(self.corpus)}


def add_scan(connection: sa.Connection, one: Scan) -> Scan:
    """Register *one*, with the store's revision and a number of its own. An older scan with the same result's path is replaced."""
    connection.execute(sa.delete(scan).where(scan.c.path == one.path))
    told = {**asdict(one), "corpus": json.dumps(list(one.corpus)), "totals": json.dumps(dict(one.totals))}
    del told["id"]
    told["revision"] = newest_revision(connection)
    number = connection.execute(sa.insert(scan), told).inserted_primary_key
    assert number is not None
    return Scan(**{**asdict(one), "revision": told["revision"], "id": number[0]})


def read_scans(connection: sa.Connection, language: str | None = None) -> list[Scan]:
    """The scans of *language*, or all, newest first."""
    query = sa.select(scan).order_by(scan.c.id.desc())
    if language:
        query = query.where(scan.c.language == language)
    return [_scan(dict(row)) for row in connection.execute(query).mappings()]


def _scan(row: dict[str, Any]) -> Scan:
    return Scan(**{**row, "corpus": tuple(json.loads(row["corpus"])), "totals": json.loads(row["totals"])})
