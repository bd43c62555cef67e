"""Try a language before it is saved: speak with it, check it, and see what its common phones cost."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from lipdb.curated.folder import write_folder
from lipdb.curated.schema import table_of
from lipdb.curated.tsv import Finding, Key, Records, Row
from lipdb.database import Database
from lipdb.errors import InputError
from lipdb.languages.conformance import check_language
from lipdb.languages.draft import with_rows
from lipdb.languages.inventory import CommonPhone, inventory
from lipdb.languages.report import Report
from lipdb.languages.reuse import OWN, Part, common_phones, reuse
from lipdb.schedule import SILENCE

if TYPE_CHECKING:
    from lipdb.performance import Performance


class Trial(Database):
    """*database* with the rows of *own* as well, which are not in it; to look at and to play only."""

    def __init__(self, database: Database, own: Mapping[str, Mapping[Key, Row]]) -> None:
        super().__init__(database.store.read_only())
        self._all = with_rows(database.records, own)

    @property
    def records(self) -> Records:
        """All the curated data, the trial's among them."""
        return self._all


def perform(trial: Database, text: str, *, language: str, character: str) -> Performance:
    """*text* as the *trial*'s *language* says it, on *character*; labels that no table knows yet are mapped by articulation."""
    if not text.strip():
        raise InputError("there is nothing to say; give a word")
    return trial.animate(trial.say(text, language=language, allow_unknown=True), character=character)


@dataclass(frozen=True, slots=True)
class Placed:
    """A finding and the row that it is about: the name of its *table* and the row's first words, if it is about one."""

    finding: Finding
    error: bool
    table: str
    row: str

    def to_row(self) -> dict[str, Any]:
        """Plain data for a listing."""
        return {
            "kind": "error" if self.error else "note",
            "table": self.table,
            "row": self.row,
            "what": self.finding.message.replace(" (--json has all)", ""),
        }


@dataclass(frozen=True, slots=True)
class Checked:
    """The outcome of the conformance kit, with the rows that its findings are about, errors first."""

    report: Report
    findings: tuple[Placed, ...]

    @property
    def errors(self) -> int:
        """How many findings must be mended."""
        return len(self.report.errors)


def check_records(code: str, records: Records) -> Checked:
    """Check language *code* of *records* as `check_language` checks a folder. Raises `InputError` when it is not there."""
    with tempfile.TemporaryDirectory(prefix="lipdb-") as folder:
        root = Path(folder)
        needed = {path: rows for path, rows in records.items() if _needed(path, code)}
        write_folder(needed, root)
        report = check_language(code, root, base=root)
    placed = [_placed(one, records, error=True) for one in report.errors] + [_placed(one, records, error=False) for one in report.notes]
    return Checked(report, tuple(placed))


def _needed(path: str, code: str) -> bool:
    """Whether the kit looks at the table at *path*: curves and faces of others tell nothing of a language."""
    return not path.startswith("characters/") and ("/curves/" not in path or path.startswith(f"{code}/"))


def _placed(finding: Finding, records: Records, *, error: bool) -> Placed:
    table = table_of(finding.file)
    keys = sorted(records.get(finding.file, {}))
    there = table is not None and 2 <= finding.line <= len(keys) + 1
    row = " ".join(keys[finding.line - 2]) if there and finding.column >= 1 else ""
    return Placed(finding, error, finding.file.rpartition("/")[2], row)


@dataclass(frozen=True, slots=True)
class Cost:
    """What a language's common phones cost: its *pairs*, those that it takes over from *donors*, and each new common phone's own."""

    part: Part
    donors: tuple[str, ...]
    own: tuple[CommonPhone, ...]

    @property
    def shared(self) -> int:
        """Pairs without silence that another language has too."""
        return sum(self.part.shared.values())


def cost(records: Records, code: str) -> Cost:
    """What the common phones of language *code* cost, measured against all other languages together.

    Raises `InputError` for a language without phones.
    """
    donors = [path.split("/")[0] for path in sorted(records) if path.endswith("/language.tsv")]
    donors = [donor for donor in donors if donor != code and common_phones(records, donor)]
    found = reuse(records, code, donors, {})
    part = next(part for part in found.parts if part.name == OWN)
    return Cost(part, tuple(donors), tuple(one for one in inventory(records) if one.phone in found.own and code in one.languages))


def price(records: Records, code: str) -> int:
    """How many pairs, with silence, one more common phone costs language *code*, if every phone of it can be its neighbour."""
    others = len(common_phones(records, code) - {SILENCE})
    return 2 * (others + 1) + 1
