"""What the conformance kit has to say of a language: errors, notes, and how much its sample text covers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

from lipdb.curated.tsv import Finding, Key

Pair = tuple[str, str]
REVIEW = "review:"
"""How the comment of a row begins that nobody has looked at yet, and a note on a mapping that a person should look at."""


class Remark(NamedTuple):
    """Something about the cell *column* of the row with *key* in the table at *path*; a *note* is no error."""

    path: str
    key: Key
    column: str
    message: str
    note: bool = False


@dataclass(frozen=True, slots=True)
class Coverage:
    """The pairs of common phones, pauses included, that a language can have, and which of them its sample text has.

    *possible* are all ordered pairs of the language's common phones and silence; *origins* counts those that occur by where their
    curve comes from (the least worked on of what moves the face), ``fall-back`` being what no table has.
    """

    sentences: int
    phones: int
    phones_heard: int
    possible: int
    occurring: int
    missing: tuple[Pair, ...]
    origins: Mapping[str, int]

    def to_json(self) -> dict[str, Any]:
        """Plain data for a program."""
        return {
            "sentences": self.sentences,
            "phones": self.phones,
            "phones_heard": self.phones_heard,
            "pairs_possible": self.possible,
            "pairs_occurring": self.occurring,
            "pairs_missing": ["-".join(pair) for pair in self.missing],
            "origins": dict(self.origins),
        }

    def __str__(self) -> str:
        share = 100 * self.occurring / self.possible if self.possible else 0.0
        curves = ", ".join(f"{count} {origin}" for origin, count in self.origins.items())
        return (
            f"{self.sentences} sentences with {self.phones_heard} of {self.phones} phones and {self.occurring} of {self.possible} pairs "
            f"of common phones and pauses ({share:.1f} %); their curves: {curves}"
        )


@dataclass(frozen=True, slots=True)
class Report:
    """The outcome for one language: *errors* must be mended, *notes* are for a person to look at.

    *coverage* is None where the voice or the sample text is missing. The files of the findings are below *root*.
    """

    language: str
    root: Path
    errors: tuple[Finding, ...]
    notes: tuple[Finding, ...]
    coverage: Coverage | None

    def to_json(self) -> dict[str, Any]:
        """Plain data for a program."""
        return {
            "language": self.language,
            "folder": str(self.root),
            "errors": [_plain(one) for one in self.errors],
            "notes": [_plain(one) for one in self.notes],
            "coverage": self.coverage.to_json() if self.coverage else None,
        }


def _plain(finding: Finding) -> dict[str, Any]:
    return {"file": finding.file, "line": finding.line, "column": finding.column, "message": finding.message}
