"""The conformance kit: whether the folder of a language keeps what every language promises.

Every phone has a mapping, a source and an example; the voice reads the sample text with symbols that are known; text,
records and labels come back as they were; no symbol means two things; every phone occurs in the sample.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from lipdb.curated.check import check
from lipdb.curated.folder import scan_folder, write_folder
from lipdb.curated.schema import table_of
from lipdb.curated.tsv import Finding, format_rows
from lipdb.errors import LipdbError, PhonesetError
from lipdb.languages.folder import SHARED, LanguageFolder, Places, find_language, read_language
from lipdb.languages.report import Coverage, Remark, Report
from lipdb.languages.rules import rules
from lipdb.languages.sample import Hearing
from lipdb.phones.phoneset import PhoneSet
from lipdb.plugins import voices

if TYPE_CHECKING:
    from lipdb.speech.voice import Voice

TABLES = ("language", "phones", "aliases", "sentences")
"""What a language must have."""
SHOWN = 12


def check_language(code: str, folder: Path, *, base: Path) -> Report:
    """Check language *code* in *folder*, which may be a whole folder of curated text, one with this language only, or its own.

    Shared tables that *folder* lacks are those of *base*. Raises `InputError` when there is no such language.
    """
    found = read_language(code, folder, base=base)
    places = Places(found.root, found.records)
    errors = [*found.findings, *_between(found, places), *_text(found)]
    remarks: list[Remark] = []
    coverage = None
    if found.row:
        phoneset = PhoneSet.from_records(found.records, code)
        remarks += rules(found, phoneset)
        try:
            hearing = Hearing(found, phoneset, _voice(found))
        except LipdbError as error:
            what = f"the voice can't be heard, so nothing that it says is checked: {error}"
            remarks.append(Remark(f"{code}/language.tsv", (code,), "speech" if found.row["speech"] not in voices() else "voice", what))
        else:
            remarks += hearing.remarks()
            coverage = hearing.coverage()
            remarks += _pairs(code, coverage)
    placed = [(Finding(one.path, *places.of(one.path, one.key, one.column), one.message), one.note) for one in remarks]
    errors += [finding for finding, note in placed if not note]
    return Report(code, found.root, tuple(sorted(set(errors))), tuple(sorted(finding for finding, note in placed if note)), coverage)


def tidy_language(code: str, folder: Path) -> list[Path]:
    """Write the tables of language *code* in *folder* in canonical form; the files that changed.

    Raises `InputError` when there is no such language, and `PhonesetError` with all findings for tables that can't be read:
    nothing is written then.
    """
    root = find_language(code, folder)
    records, findings = scan_folder(root, below=code)
    if findings:
        raise PhonesetError("\n".join(str(root / str(finding)) for finding in findings))
    return [root / path for path in write_folder(records, root)]


def _between(found: LanguageFolder, places: Places) -> Iterator[Finding]:
    """What is wrong between the tables of the language, and the tables that it lacks."""
    code = found.code
    broken = {one.file for one in found.findings}
    empty = {f"{code}/{name}.tsv" for name in TABLES if not found.rows(name)}
    for one in check(found.records):
        # A table that is not complete or can't be read is said once, below or already.
        said = "without this table" in one.message or _follows(one, code, broken | empty)
        if (one.file in SHARED or one.file.startswith(f"{code}/")) and not said:
            yield places.moved(one)
    for path in sorted(empty - broken):
        there = path in found.records
        yield Finding(path, 1, 1, f"this table {'has no rows' if there else 'is missing'}; every language has {Path(path).name}")


def _follows(one: Finding, code: str, broken: Collection[str]) -> bool:
    """Whether *one* misses a name of a table that is not there or has rows that can't be read: it may stand in one of them."""
    tables = {"phone ": f"{code}/phones.tsv", "common phone ": "common.tsv", "source ": "sources.tsv"}
    table = next((table for what, table in tables.items() if one.message.startswith(what)), "")
    return table in broken and "does not exist" in one.message


def _text(found: LanguageFolder) -> Iterator[Finding]:
    """Text that is not as the records would be written: a round trip would change it."""
    broken = {one.file for one in found.findings}
    for path, rows in found.records.items():
        table = table_of(path)
        if table is None or path in broken or not path.startswith(f"{found.code}/"):
            continue
        given, canonical = (found.root / path).read_bytes(), format_rows(table, rows).encode()
        if given != canonical:
            yield Finding(path, _first_difference(given, canonical), 1, f"not canonical from here on{_why(given)}; --tidy writes it so")


def _first_difference(one: bytes, other: bytes) -> int:
    """The first line, from 1, in which two texts differ."""
    lines = zip(one.split(b"\n"), other.split(b"\n"), strict=False)
    return next((number for number, (a, b) in enumerate(lines, 1) if a != b), min(one.count(b"\n"), other.count(b"\n")) + 1)


def _why(given: bytes) -> str:
    if given.startswith(b"\xef\xbb\xbf"):
        return " (it begins with a byte order mark)"
    if b"\r" in given:
        return " (its lines end with CR LF)"
    return "" if given.endswith(b"\n") else " (the last line has no end)"


def _voice(found: LanguageFolder) -> Voice:
    row, makers = found.rows("language")[found.code,], voices()
    if row["speech"] not in makers:
        raise PhonesetError(f"no voice plug-in {row['speech']!r}; there are {', '.join(sorted(makers))}")
    return makers[row["speech"]](found.records, found.code)


def _pairs(code: str, coverage: Coverage | None) -> Iterator[Remark]:
    """A note on the pairs that the sample lacks."""
    if coverage and coverage.missing:
        shown = " ".join("-".join(pair) for pair in coverage.missing[:SHOWN])
        rest = f" and {len(coverage.missing) - SHOWN} more (--json has all)" if len(coverage.missing) > SHOWN else ""
        message = f"{len(coverage.missing)} of {coverage.possible} pairs of common phones and pauses occur in no sentence: {shown}{rest}"
        yield Remark(f"{code}/sentences.tsv", (), "sentence", message, note=True)
