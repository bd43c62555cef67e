"""Read and write a whole folder of curated data."""

from __future__ import annotations

import os
from contextlib import ExitStack
from pathlib import Path

from lipdb.curated.check import check
from lipdb.curated.schema import table_of
from lipdb.curated.tsv import Finding, Key, Records, Row, format_rows, parse_rows
from lipdb.errors import PhonesetError
from lipdb.files import whole_file


def require_folder(folder: Path) -> None:
    """Raise `PhonesetError` when *folder* is not there."""
    if not folder.is_dir():
        raise PhonesetError(f"{folder}: no such folder; give the folder of curated data with --phonesets or LIPDB_PHONESETS")


def table_files(folder: Path) -> list[Path]:
    """Every ``.tsv`` file below *folder*, sorted. Raises `PhonesetError` for a folder that can't be read."""

    def refuse(error: OSError) -> None:
        # Left out, its tables would seem to be gone, and `load` would empty them.
        if not isinstance(error, FileNotFoundError):
            raise PhonesetError(f"{error.filename}: this folder can't be read ({error.strerror}); look whether you may") from error

    return sorted(Path(place, name) for place, _, names in os.walk(folder, onerror=refuse) for name in names if name.endswith(".tsv"))


def scan_folder(folder: Path, *, below: str = "") -> tuple[dict[str, dict[Key, Row]], list[Finding]]:
    """Every table of *folder*, or only those in its folder *below*, and everything that is wrong in it, all at once."""
    records: dict[str, dict[Key, Row]] = {}
    findings: list[Finding] = []
    for file in table_files(folder / below):
        path = file.relative_to(folder).as_posix()
        table = table_of(path)
        if table is None:
            findings.append(Finding(path, 1, 1, "no table has this name; see docs/data.md for the layout"))
            continue
        try:
            text = file.read_text("utf-8")
        except (UnicodeDecodeError, OSError) as error:
            findings.append(Finding(path, 1, 1, f"can't be read as UTF-8 text ({error})"))
            continue
        records[path], bad = parse_rows(table, text, file=path)
        findings += bad
    return records, findings


def read_folder(folder: Path) -> dict[str, dict[Key, Row]]:
    """Every table below *folder*. Raises `PhonesetError` with all findings when anything is wrong."""
    require_folder(folder)
    records, findings = scan_folder(folder)
    if findings:
        raise PhonesetError("\n".join(str(finding) for finding in findings))
    if not records:
        raise PhonesetError(f"{folder}: no curated data in it; it should hold common.tsv and a folder for each language")
    return records


def read_checked_folder(folder: Path) -> dict[str, dict[Key, Row]]:
    """Every table below *folder*, every name that a row mentions being there. Raises `PhonesetError` with all findings."""
    records = read_folder(folder)
    if findings := check(records):
        raise PhonesetError("\n".join(str(finding) for finding in findings))
    return records


def write_folder(records: Records, folder: Path) -> list[str]:
    """Write *records* below *folder*, changing only files whose text differs; the paths that were written.

    No file takes its place before all are written.
    """
    written = []
    with ExitStack() as files:
        for path, rows in sorted(records.items()):
            table = table_of(path)
            if table is None:
                raise PhonesetError(f"{path}: no table has this name; see docs/data.md for the layout")
            text = format_rows(table, rows)
            file = folder / path
            if file.is_file() and file.read_bytes() == text.encode():
                continue
            file.parent.mkdir(parents=True, exist_ok=True)
            files.enter_context(whole_file(file)).write_text(text, "utf-8", newline="\n")
            written.append(path)
    return written
