"""A new language while a person works on it: the phones proposed, what the person made of them, and the rows that come out."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from datetime import UTC, datetime

from lipdb.curated.schema import TIME_FORMAT, USER_LICENCE, USER_SOURCE, table_of
from lipdb.curated.tsv import Key, Records, Row, canonical_row
from lipdb.errors import InputError
from lipdb.languages.propose import Phone, Proposed, alias_rows, phone_rows, table
from lipdb.phones.segments import read_segment
from lipdb.schedule import SILENCE

WRITTEN = "written"
"""What speaks a language that no program speaks: nobody, its text is read in silence."""
NOBODY = "lipdb"
"""The author of rows that nobody has signed yet."""
TYPED_SOURCE = "lipdb"
"""Whose a row is that a rule proposed for a phone that somebody typed."""
_NAME = re.compile(r"[a-z][a-z0-9]{0,7}")


def _now() -> str:
    return datetime.now(UTC).strftime(TIME_FORMAT)


@dataclass
class Entry:
    """A phone of the draft: the *phone* as proposed, and as it stands: its *common* phones and *example*, what it is *spelt* in
    texts for the silent voice, the person's *note*, and whether and at what *time* (UTC) the person has *decided* it.
    """

    phone: Phone
    common: tuple[str, ...]
    example: str
    spelt: str = ""
    note: str = ""
    decided: bool = False
    time: str = ""

    @property
    def doubtful(self) -> bool:
        """Whether a person must still look at it."""
        return bool(self.phone.review) and not self.decided

    @property
    def changed(self) -> bool:
        """Whether the person chose other common phones than the proposed ones."""
        return self.common != self.phone.proposal.common


@dataclass
class Draft:
    """A language on its way: its *row*, its phones by name, *sentences* of *source*, common phones of its own, and *notes*.

    It was begun at *time* (UTC), so the same draft gives the same rows wherever and whenever it is kept.
    """

    row: Row
    entries: dict[str, Entry]
    proposed: Proposed
    sentences: tuple[str, ...] = ()
    source: str = USER_SOURCE
    common: dict[str, Row] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    time: str = field(default_factory=_now)

    @property
    def code(self) -> str:
        """The language's code."""
        return self.row["language"]

    @property
    def silent(self) -> bool:
        """Whether no program speaks it."""
        return self.row["speech"] == WRITTEN

    def in_order(self) -> list[Entry]:
        """The phones as a person should look at them: those that a rule doubts first, then by confidence, then by name."""
        return sorted(self.entries.values(), key=lambda one: (not one.phone.review, one.phone.proposal.confidence, one.phone.ipa))

    @property
    def next_doubtful(self) -> str:
        """The next phone that must be looked at; nothing when there is none."""
        return next((one.phone.ipa for one in self.in_order() if one.doubtful), "")

    def decide(self, name: str, *, common: Sequence[str], example: str, spelt: str = "", note: str = "") -> None:
        """Take over what a person says of phone *name*. Raises `InputError` for what can't be."""
        if not common:
            raise InputError(f"{name}: choose at least one common phone; say the word in front of a mirror and ask what is seen")
        if SILENCE in common:
            raise InputError(f"{name}: a phone can't be silent; take the nearest common phone, or leave the phone out")
        if not example.strip():
            raise InputError(f"{name}: give a word in which it is heard")
        entry = self.entries[name]
        entry.common, entry.example, entry.note, entry.decided = tuple(common), " ".join(example.split()), " ".join(note.split()), True
        entry.spelt, entry.time = "".join(spelt.split()), _now()

    def add(self, entries: Iterable[Entry]) -> list[str]:
        """Add those of *entries* that are not there yet; their names."""
        new = [one for one in entries if one.phone.ipa not in self.entries]
        self.entries |= {one.phone.ipa: one for one in new}
        return [one.phone.ipa for one in new]

    def leave_out(self, name: str) -> None:
        """Take phone *name* out of the language; what the voice says for it becomes unknown, which the check tells."""
        if len(self.entries) == 1:
            raise InputError(f"{name} is the only phone; add others first")
        del self.entries[name]

    def add_common(self, name: str, *, kind: str, ipa: str, kind_of: str, example: str, comment: str, records: Records) -> None:
        """Give the language a common phone of its own. Raises `InputError`."""
        known = records.get("common.tsv", {})
        if not _NAME.fullmatch(name):
            raise InputError(f"{name!r} is no name of a common phone; take up to eight small letters and digits, such as ue or bp")
        if (name,) in known or name in self.common:
            raise InputError(f"there is a common phone {name!r} already; choose another name, or map phones to that one")
        if kind_of and (kind_of,) not in known:
            raise InputError(f"there is no common phone {kind_of!r} to split it from")
        if not read_segment(ipa).letters:
            raise InputError(f"{ipa!r} has no letter of the IPA chart; give a typical sound of it, such as y or ɸ")
        cells = {"phone": name, "kind": kind, "ipa": ipa, "language": self.code, "example": example, "kind_of": kind_of}
        kind_of_table = table_of("common.tsv")
        assert kind_of_table is not None
        self.common[name] = canonical_row(kind_of_table, {**cells, "source": USER_SOURCE, "comment": comment})

    def drop_common(self, name: str) -> None:
        """Take back a common phone of its own; phones that map to it map to what was proposed again."""
        del self.common[name]
        for entry in self.entries.values():
            if name in entry.common:
                entry.common, entry.decided = entry.phone.proposal.common, False

    def tables(self, records: Records, *, author: str) -> dict[str, dict[Key, Row]]:
        """The rows of the language: its own tables, and those that it adds to ``common.tsv``; without *author* nobody's yet."""
        author = author or NOBODY
        phones = [self._signed(row, author=author) for row in phone_rows(self._kept(), author=author, time=self.time)]
        cells: dict[str, Iterable[dict[str, str]]] = {
            "language": [self.row],
            "phones": phones,
            "aliases": self._aliases(records),
            "sentences": [{"sentence": sentence, "source": self.source} for sentence in self.sentences],
        }
        found = {f"{self.code}/{name}.tsv": table(f"{self.code}/{name}.tsv", rows) for name, rows in cells.items()}
        if self.common:
            found["common.tsv"] = {(name,): row for name, row in self.common.items()}
        return {path: rows for path, rows in found.items() if rows}

    def overlay(self, records: Records) -> Records:
        """*records* with the language's own common phones."""
        return with_rows(records, {"common.tsv": {(name,): row for name, row in self.common.items()}})

    def _kept(self) -> Proposed:
        kept = tuple(entry.phone for name, entry in sorted(self.entries.items()))
        return Proposed(kept, self.proposed.readings, self.proposed.strange)

    def _signed(self, row: dict[str, str], *, author: str) -> dict[str, str]:
        """*row* as it stands: a person's where one decided it, else the rule's."""
        entry = self.entries[row["phone"]]
        row = {**row, "common": " ".join(entry.common), "example": entry.example}
        if self.silent or not entry.phone.count:
            row["source"] = TYPED_SOURCE
        if not entry.decided:
            return row
        proposed = f"Proposed {' '.join(entry.phone.proposal.common)}" if entry.changed else "Proposed by rule, reviewed"
        comment = ". ".join(filter(None, (entry.note.rstrip("."), proposed, entry.phone.reason)))
        signature = {"origin": "authored", "source": USER_SOURCE, "licence": USER_LICENCE, "author": author, "time": entry.time}
        return {**row, **signature, "comment": comment}

    def _aliases(self, records: Records) -> Iterable[dict[str, str]]:
        for row in alias_rows(self._kept(), records):
            if not (self.silent and row["notation"] == "espeak"):
                yield row
        for name, entry in sorted(self.entries.items()):
            if entry.spelt and entry.spelt != name:
                symbol = unicodedata.normalize("NFC", entry.spelt)
                yield {"notation": self.row["notation"], "symbol": symbol, "phones": name, "source": USER_SOURCE, "comment": "Spelling"}


def with_rows(records: Records, own: Mapping[str, Mapping[Key, Row]]) -> Records:
    """*records* and the rows of *own*, which win."""
    return {**records, **{path: {**records.get(path, {}), **rows} for path, rows in own.items()}}
