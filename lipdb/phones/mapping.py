"""Which common phones a phone maps to, and which layer says so."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from lipdb.curated.tsv import Records, Row

LINE, COMMON, ARTICULATION = "line", "common", "articulation"


def bracketed(segment: str) -> str:
    """How a schedule writes an IPA *segment* that the language has no phone for: ``[ʁ]``, never taken for a phone's name."""
    return f"[{segment}]"


def unbracketed(symbol: str) -> str:
    """The IPA segment in ``[ʁ]``; nothing for any other symbol."""
    return symbol[1:-1] if len(symbol) > 2 and symbol[0] == "[" and symbol[-1] == "]" else ""


@dataclass(frozen=True, slots=True)
class Mapped:
    """A phone, its common phones, and where the mapping comes from: the layer and the provenance of its row."""

    phone: str
    common: tuple[str, ...]
    layer: str
    kind: str = ""
    ipa: str = ""
    example: str = ""
    origin: str = ""
    source: str = ""
    licence: str = ""
    author: str = ""
    time: str = ""
    comment: str = ""

    def to_row(self) -> dict[str, str]:
        """Plain text cells for a listing."""
        return {name: " ".join(self.common) if name == "common" else str(getattr(self, name)) for name in self.__dataclass_fields__}


_CELLS = ("kind", "ipa", "example", "origin", "source", "licence", "author", "time", "comment")


def _mapped(phone: str, row: Row, layer: str, base: Mapped | None = None) -> Mapped:
    cells = {name: row[name] for name in _CELLS if name in row}
    if base is not None:
        cells = {"kind": base.kind, "ipa": base.ipa, "example": base.example} | cells
    return Mapped(phone, tuple(row["common"].split()), layer, **cells)


@dataclass(frozen=True, slots=True)
class Mappings:
    """The layers of one language's mapping, as one character says it: the most specific that has a phone wins.

    The common layer holds IPA segments in brackets.
    """

    character: Mapping[str, Mapped]
    language: Mapping[str, Mapped]
    common: Mapping[str, Mapped]

    @classmethod
    def from_records(cls, records: Records, language: str, character: str | None) -> Mappings:
        """The layers character, language and common; the line's own comes with each call of `find`."""
        own = {
            row["phone"]: _mapped(row["phone"], row, f"language:{language}") for row in records.get(f"{language}/phones.tsv", {}).values()
        }
        common = {
            bracketed(row["phone"]): _mapped(bracketed(row["phone"]), {**row, "ipa": row["phone"]}, COMMON)
            for row in records.get("ipa.tsv", {}).values()
        }
        rows = records.get(f"characters/{character}/mapping.tsv", {}).values() if character else ()
        special = {
            row["phone"]: _mapped(row["phone"], row, f"character:{character}", own.get(row["phone"]))
            for row in rows
            if row["language"] == language
        }
        return cls(special, own, common)

    def find(self, phone: str, line: Mapping[str, tuple[str, ...]]) -> Mapped | None:
        """The winning mapping of *phone*, or None when no layer has it. *line* is the line's own layer."""
        below = self.character.get(phone) or self.language.get(phone) or self.common.get(phone)
        if phone not in line:
            return below
        kind, ipa, example = (below.kind, below.ipa, below.example) if below else ("", "", "")
        return Mapped(phone, tuple(line[phone]), LINE, kind, ipa, example, origin="authored", source=LINE)
