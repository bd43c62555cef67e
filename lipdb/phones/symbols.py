"""From the labels of any notation to the phones of one language."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field

from lipdb.curated.tsv import Records
from lipdb.phones.labels import IPA_NOTATIONS, SAMPA_NOTATIONS, Label, read_label
from lipdb.phones.mapping import bracketed, unbracketed
from lipdb.phones.segments import without_diacritics
from lipdb.phones.syllables import Syllables
from lipdb.schedule import SILENCE

JOINTS = re.compile(r"[-\s‿|.]+")
# X-SAMPA: nasal, syllabic, and the two-sign diacritics such as _h and _d.
_SAMPA_DIACRITICS = re.compile(r"(?:~|=|_.)+$")
Parts = tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Symbols:
    """What the labels of each notation stand for in one language.

    *own* is the notation whose symbols are the phones themselves; *aliases* has notation -> symbol -> phones, where
    notations that write IPA also know the aliases of ``ipa``, and those that write SAMPA those of ``xsampa``; *marks* are
    labels of pauses and noises in any notation; *segments* are the IPA segments that the common table knows, and *xsampa*
    their X-SAMPA spellings.
    """

    own: str
    phones: frozenset[str]
    aliases: Mapping[str, Mapping[str, Parts]]
    marks: frozenset[str]
    segments: frozenset[str]
    xsampa: Mapping[str, str]
    syllables: Syllables
    _read: dict[tuple[str, str], Parts] = field(default_factory=dict, repr=False, compare=False)

    @classmethod
    def from_records(cls, records: Records, language: str, own: str) -> Symbols:
        """The symbols of *language*."""
        phones = [row["phone"] for row in records.get(f"{language}/phones.tsv", {}).values()]
        aliases = _aliases(records, language)
        # A phone's own name goes before an alias, so what was resolved once stays as it is.
        aliases[own] = aliases.get(own, {}) | {phone: (phone,) for phone in phones}
        for family, base in ((IPA_NOTATIONS, "ipa"), (SAMPA_NOTATIONS, "xsampa")):
            shared = aliases.get(base, {})
            aliases |= {notation: shared | aliases.get(notation, {}) for notation in family}
        ipa = records.get("ipa.tsv", {}).values()
        return cls(
            own,
            frozenset(phones),
            aliases,
            frozenset(row["mark"].lower() for row in records.get("marks.tsv", {}).values()),
            frozenset(row["phone"] for row in ipa),
            {spelling: row["phone"] for row in ipa for spelling in row["xsampa"].split()},
            Syllables.from_rows(records.get(f"{language}/syllables.tsv", {}).values()),
        )

    @property
    def notations(self) -> tuple[str, ...]:
        """Every notation that the language reads, its own first."""
        return (self.own, *sorted(self.aliases.keys() - {self.own}))

    def spellings(self, notation: str) -> tuple[str, ...]:
        """Every symbol of *notation*, and every written syllable where the notation is the language's own."""
        return (*self.aliases.get(notation, {}), *(self.syllables.phones if notation == self.own else ()))

    def parts(self, symbol: str, notation: str, *, common: bool = True) -> Parts:
        """The phones that *symbol* of *notation* stands for, ``_`` for a pause; nothing when it is unknown.

        In this order: a symbol or alias of the notation, as it is, without its attributes, without its length; a pause or
        noise; a written syllable; several labels joined by ``-``, ``.``, ``|`` or a space, or several IPA symbols in a row; a
        symbol without its diacritics; and with *common* an IPA segment of the common table, in brackets.
        """
        key = (symbol, notation if common else notation + "!")
        if key not in self._read:
            self._read[key] = self._look(symbol, notation, common)
        return self._read[key]

    def _look(self, symbol: str, notation: str, common: bool) -> Parts:
        label = read_label(symbol, notation)
        if unbracketed(symbol) in self.segments:
            return (symbol,)
        if label.text in ("", SILENCE):
            return (SILENCE,)
        table = self.aliases.get(notation, {})
        for form in label.forms:
            if form in table:
                return table[form]
        if label.text.lower() in self.marks:
            return (SILENCE,)
        return (
            (self.syllables.split(label.bare, self.phones) if notation == self.own else ())
            or self._joined(label.bare, notation, common)
            or self._row_of(label.bare, table, notation)
            or table.get(_plain(label.short, notation), ())
            or (self._segment(label, notation) if common else ())
        )

    def _joined(self, text: str, notation: str, common: bool) -> Parts:
        """The phones of labels joined by a hyphen and the like, if every one of them is known."""
        words = [word for word in JOINTS.split(text) if word]
        if len(words) < 2:
            return ()
        found = [self.parts(word, notation, common=common) for word in words]
        return tuple(phone for parts in found for phone in parts) if all(found) else ()

    def _row_of(self, text: str, table: Mapping[str, Parts], notation: str) -> Parts:
        """The phones of IPA symbols in a row, longest first, if they cover all of *text*.

        Not for plain ASCII, which may be a word: a tier of words is no tier of phones.
        """
        if notation not in IPA_NOTATIONS or text.isascii():
            return ()
        found: list[str] = []
        while text:
            size = next((size for size in range(len(text), 0, -1) if text[:size] in table), 0)
            if not size:
                return ()
            found += table[text[:size]]
            text = text[size:].lstrip("ː")
        return tuple(found)

    def _segment(self, label: Label, notation: str) -> Parts:
        segment = next((found for form in label.forms if (found := self.segment_of(form, notation)) in self.segments), "")
        return (bracketed(segment),) if segment else ()

    def segment_of(self, symbol: str, notation: str) -> str:
        """The IPA segment that *symbol* of *notation* writes, without diacritics that do not show; nothing when it is none."""
        plain = _plain(symbol, notation)
        if notation in IPA_NOTATIONS:
            return symbol if symbol in self.segments else plain
        return self.xsampa.get(symbol) or self.xsampa.get(plain, "") if notation in SAMPA_NOTATIONS else ""


def _plain(symbol: str, notation: str) -> str:
    """*symbol* without diacritics that do not show, where the notation writes such."""
    if notation in IPA_NOTATIONS:
        return without_diacritics(symbol)
    return _SAMPA_DIACRITICS.sub("", symbol) if notation in SAMPA_NOTATIONS else symbol


def _aliases(records: Records, language: str) -> dict[str, dict[str, Parts]]:
    found: dict[str, dict[str, Parts]] = {}
    for row in records.get(f"{language}/aliases.tsv", {}).values():
        found.setdefault(row["notation"], {})[row["symbol"]] = tuple(row["phones"].split())
    return found
