"""Curated text in a zip that somebody sends: looked at in memory, nothing is unpacked."""

from __future__ import annotations

import io
import zipfile
from pathlib import PurePosixPath

from lipdb.curated.schema import table_of
from lipdb.curated.tsv import Key, Row, parse_rows
from lipdb.errors import InputError, PhonesetError

LARGEST = 64_000_000
"""Bytes that the text may have when it is unpacked; what ships has 1.4 million."""
MOST_FILES = 2_000


def read_zip(data: bytes) -> dict[str, dict[Key, Row]]:
    """The tables in the zip *data*, by path; a folder around them all is left out.

    Raises `InputError` for what is no zip, too large or without a table, `PhonesetError` with all findings when text is wrong.
    """
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            texts = _texts(archive)
    except (zipfile.BadZipFile, zipfile.LargeZipFile, NotImplementedError, RuntimeError, EOFError, ValueError) as error:
        raise InputError(f"this is no zip that can be read ({error}); pack the folder of curated text again") from error
    records: dict[str, dict[Key, Row]] = {}
    findings = []
    for path, text in texts.items():
        table = table_of(path)
        assert table is not None
        records[path], bad = parse_rows(table, text, file=path)
        findings += bad
    if findings:
        raise PhonesetError("\n".join(str(one) for one in findings))
    return records


def _texts(archive: zipfile.ZipFile) -> dict[str, str]:
    files = [one for one in archive.infolist() if not one.is_dir() and one.filename.endswith(".tsv")]
    if len(files) > MOST_FILES or sum(one.file_size for one in files) > LARGEST:
        raise InputError(f"the zip has more than {MOST_FILES} tables or {LARGEST // 1_000_000} MB of text; send the language's folder only")
    known = _named(files)
    if not known:
        raise InputError("there is no table in the zip; it should hold a language's folder, such as pl/phones.tsv")
    texts = {}
    for path, one in known.items():
        with archive.open(one) as file:
            # The directory of a zip may lie about sizes.
            content = file.read(LARGEST + 1)
        try:
            texts[path] = content.decode()
        except UnicodeDecodeError as error:
            raise InputError(f"{path}: no UTF-8 text (byte {error.start + 1}); save it as UTF-8") from error
    return texts


def _named(files: list[zipfile.ZipInfo]) -> dict[str, zipfile.ZipInfo]:
    """*files* by the tables that they are, without the folders around all of them; files that are none are left out."""
    parts = [PurePosixPath(one.filename.replace("\\", "/")).parts for one in files]
    depths = range(max(map(len, parts), default=0))
    found = [
        {path: one for name, one in zip(parts, files, strict=True) if table_of(path := "/".join(name[depth:])) is not None}
        for depth in depths
    ]
    return max(found, key=len, default={})
