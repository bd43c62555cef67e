"""The folder of one language: its own tables, the shared ones that they mention, and where in the files each row stands."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from lipdb.curated.folder import scan_folder
from lipdb.curated.schema import CODE, Table, table_of
from lipdb.curated.tsv import Finding, Key, Records, Row
from lipdb.errors import InputError

SHARED = ("common.tsv", "ipa.tsv", "marks.tsv", "sources.tsv")
"""Shared tables that every language leans on: what is wrong there is wrong here."""


def require_code(code: str) -> None:
    """Raise `InputError` when *code* can't be a language's."""
    if not CODE.fullmatch(code):
        raise InputError(f"{code!r} is no code of a language; take two or three small letters (ISO 639) such as pl, or pl_east")


@dataclass(frozen=True, slots=True)
class LanguageFolder:
    """The folder ``root/code`` with all records that it can mention.

    *records* are those of *root* where that is a whole folder of curated text, else the language's own and the shared
    ones of *base*; *findings* is what is wrong in the text of the language's tables and of `SHARED`.
    """

    code: str
    root: Path
    records: Records
    findings: tuple[Finding, ...]

    @property
    def row(self) -> Row | None:
        """The language's row, if it could be read."""
        return self.records.get(f"{self.code}/language.tsv", {}).get((self.code,))

    def rows(self, name: str) -> dict[Key, Row]:
        """The rows of the language's table *name*, such as ``phones``; none where the table is not there."""
        return dict(self.records.get(f"{self.code}/{name}.tsv", {}))


def find_language(code: str, folder: Path) -> Path:
    """The folder that holds the folder of language *code*: *folder* itself, or the one above when *folder* is the language's.

    Raises `InputError` when neither is so, or *code* is none.
    """
    require_code(code)
    if (folder / code).is_dir():
        return folder
    if folder.name == code and any(folder.glob("*.tsv")):
        return folder.resolve().parent
    if not folder.is_dir():
        raise InputError(f"{folder}: no such folder; give the folder of curated text, or the language's own")
    there = ", ".join(sorted(file.parent.name for file in folder.glob("*/language.tsv"))) or "none"
    raise InputError(f"{folder}: no language {code!r} there (there are: {there}); make it with `lipdb language new {code}`")


def read_language(code: str, folder: Path, *, base: Path) -> LanguageFolder:
    """Read language *code* in *folder*; shared tables that *folder* lacks come from *base*.

    Raises `InputError` when there is no such language. Everything else that is wrong is a finding.
    """
    root = find_language(code, folder)
    whole = (root / "common.tsv").is_file()
    records, findings = scan_folder(root if whole else base)
    if not whole:
        own, more = scan_folder(root, below=code)
        records = {path: rows for path, rows in records.items() if not path.startswith(f"{code}/")} | own
        findings = [one for one in findings if not one.file.startswith(f"{code}/")] + more
    ours = [one for one in findings if one.file in SHARED or one.file.startswith(f"{code}/")]
    return LanguageFolder(code, root, records, tuple(ours))


class Places:
    """Where rows and cells stand in the files below *root*, however these are sorted: lines and columns from 1."""

    def __init__(self, root: Path, records: Records) -> None:
        self._root, self._records = root, records
        self._known: dict[str, dict[Key, tuple[int, list[int]]]] = {}

    def of(self, path: str, key: Key, column: str) -> tuple[int, int]:
        """Line and column of the cell *column* in the row with *key*; 1 and 1 for a row that is in no file."""
        table = table_of(path)
        if table is None or key not in (rows := self._rows(path, table)):
            return 1, 1
        line, offsets = rows[key]
        return line, offsets[table.names.index(column)]

    def moved(self, finding: Finding) -> Finding:
        """*finding* of `lipdb.curated.check`, which counts lines as canonical text has them, where the file has it."""
        table, rows = table_of(finding.file), self._records.get(finding.file, {})
        if table is None or not 2 <= finding.line <= len(rows) + 1:
            return finding
        key = sorted(rows)[finding.line - 2]
        column = 0
        while column + 1 < len(table.names) and _offset(table, rows[key], column + 1) <= finding.column:
            column += 1
        return Finding(finding.file, *self.of(finding.file, key, table.names[column]), finding.message)

    def _rows(self, path: str, table: Table) -> dict[Key, tuple[int, list[int]]]:
        if path not in self._known:
            file = self._root / path
            self._known[path] = _places(table, file.read_text("utf-8-sig", "replace")) if file.is_file() else {}
        return self._known[path]


def _offset(table: Table, row: Row, column: int) -> int:
    return 1 + sum(len(row[name]) + 1 for name in table.names[:column])


def _places(table: Table, text: str) -> dict[Key, tuple[int, list[int]]]:
    """Line and column offsets of every row that can be read, by key; of equal keys the first."""
    found: dict[Key, tuple[int, list[int]]] = {}
    for number, line in enumerate(text.split("\n"), 1):
        cells = line.split("\t")
        if number == 1 or len(cells) != len(table.names):
            continue
        try:
            canonical = {column.name: column.canonical(cell.strip()) for column, cell in zip(table.columns, cells, strict=True) if cell}
            key = tuple(canonical[name] for name in table.key)
        except (ValueError, KeyError):
            continue
        found.setdefault(key, (number, [1 + sum(len(cell) + 1 for cell in cells[:i]) for i in range(len(cells))]))
    return found
