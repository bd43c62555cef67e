"""Read and write one table of curated data as canonical text.

Canonical text: a header line, rows sorted by their key, cells separated by tabs, LF line ends, every cell in its own
canonical form. ``format_rows(table, parse_rows(table, x)) == x`` for canonical x (design: one edited fact, one line).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from lipdb.curated.schema import Table

Key = tuple[str, ...]
Row = dict[str, str]
Rows = Mapping[Key, Row]
Records = Mapping[str, Rows]
"""All the curated data: path of a table below the folder -> key -> row."""


@dataclass(frozen=True, slots=True, order=True)
class Finding:
    """Something wrong in a file; prints as ``file:line:column: what``."""

    file: str
    line: int
    column: int
    message: str

    def __str__(self) -> str:
        return f"{self.file}:{self.line}:{self.column}: {self.message}"


def key_of(table: Table, row: Mapping[str, str]) -> Key:
    """The cells that name *row*."""
    return tuple(row[name] for name in table.key)


def format_rows(table: Table, rows: Rows) -> str:
    """The canonical text of *rows*."""
    lines = ["\t".join(table.names)]
    lines += ["\t".join(rows[key][name] for name in table.names) for key in sorted(rows)]
    return "\n".join(lines) + "\n"


def canonical_row(table: Table, cells: Mapping[str, str]) -> Row:
    """*cells* in canonical form, missing optional cells empty.

    Raises `ValueError` naming the column for a cell that is missing or wrong, or a column that the table lacks.
    """
    unknown = set(cells) - set(table.names)
    if unknown:
        raise ValueError(f"no such column: {', '.join(sorted(unknown))}; the columns are {', '.join(table.names)}")
    row: Row = {}
    for column in table.columns:
        cell = cells.get(column.name, "").strip()
        if not cell and not column.optional:
            raise ValueError(f"column {column.name} is empty")
        try:
            row[column.name] = column.canonical(cell) if cell else ""
        except ValueError as error:
            raise ValueError(f"column {column.name}: {error}") from error
    return row


def parse_rows(table: Table, text: str, *, file: str) -> tuple[dict[Key, Row], list[Finding]]:
    """The rows of *text* by key, and everything that is wrong with it; a wrong row is left out."""
    findings: list[Finding] = []
    rows: dict[Key, Row] = {}
    seen: dict[Key, int] = {}
    lines = text.removeprefix("\ufeff").replace("\r\n", "\n").split("\n")
    if tuple(lines[0].split("\t")) != table.names:
        return rows, [Finding(file, 1, 1, f"the header must be {' '.join(table.names)} (separated by tabs)")]
    for number, line in enumerate(lines[1:], 2):
        if not line:
            continue
        cells = line.split("\t")
        if len(cells) != len(table.names):
            findings.append(Finding(file, number, 1, f"{len(cells)} cells where the header has {len(table.names)}"))
            continue
        row, bad = _parse_cells(table, cells, file, number)
        findings += bad
        if bad:
            continue
        key = key_of(table, row)
        if key in seen:
            findings.append(Finding(file, number, 1, f"{' '.join(key)} stands already in line {seen[key]}"))
            continue
        seen[key], rows[key] = number, row
    return rows, findings


def _parse_cells(table: Table, cells: list[str], file: str, line: int) -> tuple[Row, list[Finding]]:
    row: Row = {}
    findings: list[Finding] = []
    offset = 1
    for column, raw in zip(table.columns, cells, strict=True):
        cell = raw.strip()
        try:
            if not cell and not column.optional:
                raise ValueError(f"{column.name} is empty")
            row[column.name] = column.canonical(cell) if cell else ""
        except ValueError as error:
            findings.append(Finding(file, line, offset, str(error)))
        offset += len(raw) + 1
    return row, findings
