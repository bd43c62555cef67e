"""Keep a new language: as a folder of text in the workspace for review with git, and as rows of the database."""

from __future__ import annotations

import io
import shutil
import zipfile
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from lipdb.curated.check import check
from lipdb.curated.folder import read_folder, write_folder
from lipdb.curated.schema import table_of
from lipdb.curated.tsv import Key, Records, Row, format_rows
from lipdb.errors import ConflictError, InputError, OutputError, PhonesetError
from lipdb.files import whole_file, whole_folder
from lipdb.languages.compare import Place, applied, new_findings
from lipdb.languages.draft import with_rows

if TYPE_CHECKING:
    from lipdb.store import Store

Tables = Mapping[str, Mapping[Key, Row]]
Changes = Mapping[Place, Row | None]
"""What becomes of rows; None: it goes."""
COMMON = "common.tsv"


def ready_workspace(folder: Path, store: Store) -> int | None:
    """Fill the workspace *folder* from *store* when it is not there yet; the revision that it was made from, else None.

    Raises `OutputError`.
    """
    return None if folder.is_dir() else store.dump(folder)


def save_text(code: str, own: Tables, folder: Path) -> list[Path]:
    """Write the tables of the new language *code*, and what it adds to ``common.tsv``, into the workspace *folder*; the files.

    All of it or nothing, and never over what is there. Raises `InputError` when the language is there already, `PhonesetError`
    when the workspace is not in order or lacks what the rows mention, `OutputError` when it can't be written.
    """
    if (folder / code).exists():
        raise InputError(f"{folder / code} is there already and is never overwritten; rename it, or merge the two (Compare and merge)")
    there = read_folder(folder)
    taken = sorted(key[0] for key, row in own.get(COMMON, {}).items() if there.get(COMMON, {}).get(key, row) != row)
    if taken:
        raise InputError(f"{folder / COMMON} has another common phone {taken[0]!r}; choose another name for the new one")
    merged = with_rows(there, own)
    wrong = [one for one in check(merged) if one.file in own]
    if wrong:
        raise PhonesetError(f"{wrong[0].file}: {wrong[0].message}; mend it first")
    tables = {path: rows for path, rows in own.items() if path.startswith(f"{code}/")}
    with whole_folder(folder / code, otherwise="choose another workspace with --phonesets") as temporary:
        write_folder(tables, temporary.parent)
    if COMMON in own:
        _write_common(merged[COMMON], folder, undo=folder / code)
    return [folder / path for path in sorted(own)]


def _write_common(rows: Mapping[Key, Row], folder: Path, *, undo: Path) -> None:
    table = table_of(COMMON)
    assert table is not None
    try:
        with whole_file(folder / COMMON) as temporary:
            temporary.write_text(format_rows(table, rows), "utf-8", newline="\n")
    except OutputError:
        shutil.rmtree(undo, ignore_errors=True)
        raise


def save_rows(changes: Changes, store: Store, *, author: str, note: str, seen: int) -> int | None:
    """Make the rows of *store* those of *changes* (None: the row goes) as one revision, each with its own provenance.

    Its number, None when nothing changed. *seen* is the revision that the person saw. Raises `EditConflictError` when somebody
    saved the same since, `PhonesetError` when something would be wrong that is not now.
    """
    now = store.records()
    _require_sound(now, applied(now, changes))
    with store.edit(author=author, note=note, by_hand=False) as edit:
        for (path, key), row in changes.items():
            if row is None:
                edit.delete(path, key, expected_revision=seen)
            else:
                edit.put(path, row, expected_revision=seen)
    return edit.revision


def save_merged(changes: Changes, folder: Path, *, seen: Records) -> list[Path]:
    """Make the rows of the workspace *folder* those of *changes*; the files that changed.

    *seen* are its records as the person saw them. Raises `ConflictError` when one of the rows is another one by now,
    `PhonesetError` when something would be wrong that is not now, `OutputError` when it can't be written.
    """
    now = read_folder(folder)
    for path, key in changes:
        if now.get(path, {}).get(key) != seen.get(path, {}).get(key):
            raise ConflictError(f"{folder / path}: somebody changed {' '.join(key)} in the meantime; nothing is written, compare again")
    result = applied(now, changes)
    _require_sound(now, result)
    paths = sorted({path for path, _ in changes})
    try:
        folder.mkdir(parents=True, exist_ok=True)
        written = write_folder({path: result[path] for path in paths if path in result}, folder)
        gone = [path for path in paths if path not in result]
        for path in gone:
            (folder / path).unlink(missing_ok=True)
    except OSError as error:
        raise OutputError(f"{folder}: can't be written ({error.strerror}); choose another workspace with --phonesets") from error
    return [folder / path for path in sorted((*written, *gone))]


def _require_sound(before: Records, after: Records) -> None:
    if wrong := new_findings(before, after):
        more = f" (and {len(wrong) - 1} more)" if len(wrong) > 1 else ""
        raise PhonesetError(f"{wrong[0].file}: {wrong[0].message}{more}; choose otherwise, or mend it first")


def zipped(own: Tables) -> bytes:
    """The tables of *own* as a zip of canonical text, the same bytes for the same rows."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for path, rows in sorted(own.items()):
            table = table_of(path)
            assert table is not None
            archive.writestr(zipfile.ZipInfo(path, (1980, 1, 1, 0, 0, 0)), format_rows(table, rows), zipfile.ZIP_DEFLATED)
    return buffer.getvalue()
