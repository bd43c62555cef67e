"""Keys and cells as JSON text, the form in which the store keeps them."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Sequence
from functools import cache
from typing import Any

from lipdb.curated.schema import table_of
from lipdb.curated.tsv import Key, Records, Row
from lipdb.store.provenance import PROVENANCE

Place = tuple[str, Key]
"""Where a fact is: the path of its table and its key."""

Flat = dict[Place, Row]
"""Records in one dictionary."""


def key_text(key: Sequence[str]) -> str:
    """A key as a JSON list."""
    return json.dumps(list(key), ensure_ascii=False, separators=(",", ":"))


def cells_text(row: Row) -> str:
    """A row as a JSON object, its columns sorted: equal rows are equal text."""
    return json.dumps(row, ensure_ascii=False, separators=(",", ":"), sort_keys=True)


def key_from(text: str) -> Key:
    """The key that `key_text` wrote."""
    return tuple(json.loads(text))


def row_from(path: str, text: str | None) -> Row | None:
    """The row of the table *path* that `cells_text` wrote; None for none. Columns as for `records_from`."""
    return None if text is None else _completed(json.loads(text), _optional(path))


def records_from(rows: Sequence[tuple[str, str, str]]) -> dict[str, dict[Key, Row]]:
    """Records of ``(path, key, cells)`` as stored; optional columns that came later than a row are empty in it."""
    # One call of the JSON reader for everything: a call a row costs four times as much.
    keys: list[list[str]] = _parse_all(row[1] for row in rows)
    cells: list[Row] = _parse_all(row[2] for row in rows)
    records: dict[str, dict[Key, Row]] = {}
    optional = {path: _optional(path) for path in {row[0] for row in rows}}
    for (path, _, _), key, row in zip(rows, keys, cells, strict=True):
        records.setdefault(path, {})[tuple(key)] = _completed(row, optional[path])
    return records


def _completed(row: Row, optional: frozenset[str]) -> Row:
    """*row* with the *optional* columns that came later than it."""
    later = optional - row.keys()
    return {**row, **dict.fromkeys(later, "")} if later else row


@cache
def _optional(path: str) -> frozenset[str]:
    table = table_of(path)
    return frozenset(column.name for column in table.columns if column.optional) if table else frozenset()


def _parse_all(texts: Iterable[str]) -> list[Any]:
    parsed: list[Any] = json.loads(f"[{','.join(texts)}]")
    return parsed


def stored(records: Records) -> Iterator[tuple[str, str, str]]:
    """``(path, key, cells)`` of every row, in the order in which text has them."""
    for path in sorted(records):
        for key in sorted(records[path]):
            yield path, key_text(key), cells_text(records[path][key])


def flat(records: Records) -> Flat:
    """*records* in one dictionary."""
    return {(path, key): row for path, rows in records.items() for key, row in rows.items()}


def nested(rows: Flat) -> dict[str, dict[Key, Row]]:
    """The records of one dictionary; a table without rows is no table."""
    records: dict[str, dict[Key, Row]] = {}
    for (path, key), row in rows.items():
        records.setdefault(path, {})[key] = row
    return records


def differing(row: Row | None, other: Row | None) -> str:
    """The cells of *row* that *other* has otherwise, for a person to read; who and when only if nothing else differs."""
    if row is None:
        return "not there"
    names = [name for name in row if other is None or row[name] != other.get(name)]
    names = [name for name in names if name not in PROVENANCE] or names
    return ", ".join(f"{name} {row[name]}" if row[name] else f"no {name}" for name in names)
