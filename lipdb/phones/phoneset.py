"""The phones of one language: what labels mean, which common phones they map to, and what to say of unknown ones."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from difflib import get_close_matches
from types import MappingProxyType

from lipdb.curated.tsv import Records
from lipdb.errors import InputError, PhonesetError, ScheduleError, UnknownSymbolError
from lipdb.phones.articulation import NEUTRAL, classify
from lipdb.phones.labels import IPA_NOTATIONS, SAMPA_NOTATIONS, Label, read_label
from lipdb.phones.likeness import nearest
from lipdb.phones.mapping import ARTICULATION, COMMON, Mapped, Mappings, bracketed, unbracketed
from lipdb.phones.symbols import Symbols
from lipdb.schedule import SILENCE, Phone, Schedule

_NO_LINE: Mapping[str, tuple[str, ...]] = MappingProxyType({})
LONGEST_SHOWN = 40
MOST_EXPLAINED = 5
"""Of more unknown symbols than this the reasons are left out: that is a wrong tier or notation, not a missing row."""
_SILENT = Mapped(SILENCE, (SILENCE,), COMMON, "silence")


@dataclass(frozen=True, slots=True)
class Unknown:
    """A symbol that no table knows: how often it came, the phone that is nearest to it, and why that one."""

    symbol: str
    count: int
    proposal: str
    reason: str

    def __str__(self) -> str:
        nearest = f"nearest {self.proposal!r}, " if self.proposal else ""
        return f"{shortened(self.symbol)!r} ({self.count}x, {nearest}{self.reason})"

    @property
    def brief(self) -> str:
        """The same without the reason."""
        return f"{shortened(self.symbol)!r} ({self.count}x{f', nearest {self.proposal!r}' if self.proposal else ''})"


class PhoneSet:
    """The phones of a language as a character says them; iterating gives what each of them maps to."""

    def __init__(self, language: str, symbols: Symbols, mappings: Mappings, common: frozenset[str]) -> None:
        self.language = language
        self.symbols = symbols
        self.mappings = mappings
        self.common = common

    @classmethod
    def from_records(cls, records: Records, language: str, character: str | None = None) -> PhoneSet:
        """The phone set of *language*, with *character*'s own mappings. Raises `PhonesetError` when there is none."""
        rows = list(records.get(f"{language}/language.tsv", {}).values())
        if not rows:
            known = sorted(path.split("/")[0] for path in records if path.endswith("/language.tsv"))
            raise PhonesetError(f"no language {language!r}; there are {', '.join(known) or 'none'}")
        common = frozenset(row["phone"] for row in records.get("common.tsv", {}).values())
        symbols = Symbols.from_records(records, language, rows[0]["notation"])
        return cls(language, symbols, Mappings.from_records(records, language, character), common)

    def __iter__(self) -> Iterator[Mapped]:
        return (self.mapping(phone) for phone in sorted(self.symbols.phones))

    def mapping(self, phone: str, line: Mapping[str, tuple[str, ...]] = _NO_LINE) -> Mapped:
        """What *phone* (or an IPA segment in brackets, or ``_``) maps to. Raises `PhonesetError` for any other name."""
        found = _SILENT if phone == SILENCE else self.mappings.find(phone, line)
        if found is None:
            near = get_close_matches(phone, self.symbols.phones, 1)
            raise PhonesetError(f"{self.language} has no phone {phone!r}" + (f"; did you mean {near[0]!r}?" if near else ""))
        return found

    def notation_of(self, schedule: Schedule) -> str:
        """The notation that *schedule* is written in: the one it names, or else the one that knows most of its phones.

        Of several that know as many, the language's own goes first, then the alphabet decides. Raises `InputError` for a
        notation that the language does not read.
        """
        known = self.symbols.notations
        if schedule.notation:
            if schedule.notation not in known:
                near = get_close_matches(schedule.notation, known, 1)
                hint = f"did you mean {near[0]!r}?" if near else f"it reads {', '.join(known)}"
                raise InputError(f"{self.language} reads no notation {schedule.notation!r}; {hint}")
            return schedule.notation
        counts = Counter(phone.symbol for phone in schedule.phones)
        score = {name: sum(n for symbol, n in counts.items() if self.symbols.parts(symbol, name, common=False)) for name in known}
        return max(known, key=score.__getitem__)

    def resolve(
        self, schedule: Schedule, line: Mapping[str, tuple[str, ...]] = _NO_LINE, *, allow_unknown: bool = False
    ) -> tuple[Schedule, tuple[Unknown, ...]]:
        """Turn the labels of a raw schedule into phones of the language with their common phones and layers.

        Stress, tone and length become attributes; labels of several phones are split, each part with time by the number of
        its common phones (in hand-checked English, vowels and consonants last alike: 78 and 80 ms). The result is in the
        language's own notation; resolving it again changes nothing but the layers. *line* is the line's own layer.

        Raises `UnknownSymbolError` listing every unknown symbol unless *allow_unknown*: they are then mapped by
        articulation, or to the neutral vowel when nothing is known of them, never to silence. Unknown symbols are returned
        in both cases.
        """
        self._check_line(line)
        notation = self.notation_of(schedule)
        edges, phones, missing = [schedule.edges[0]], list[Phone](), Counter[str]()
        known = {symbol: self._known(symbol, notation, line) for symbol in {phone.symbol for phone in schedule.phones}}
        for phone, end in zip(schedule.phones, schedule.edges[1:], strict=True):
            found = [_spoken(phone, *part) for part in known[phone.symbol]]
            if not found:
                missing[phone.symbol] += 1
                found = [self._by_articulation(phone, notation)]
            edges += _share(edges[-1], end, found)
            phones += found
        unknown = tuple(self._unknown(symbol, count, notation) for symbol, count in sorted(missing.items()))
        if unknown and not allow_unknown:
            raise UnknownSymbolError(self._complaint(unknown, notation))
        done = replace(schedule, edges=tuple(edges), phones=tuple(phones), language=self.language, notation=self.symbols.own)
        return done, unknown

    def _known(self, symbol: str, notation: str, line: Mapping[str, tuple[str, ...]]) -> list[tuple[Mapped, Label | None]]:
        """What one label stands for, each part with the label whose attributes it carries; nothing when it is unknown.

        Vowels and finals carry stress, tone and length; a label of one phone, or of consonants alone, carries its own.
        """
        parts = [self.mapping(part, line) for part in self.symbols.parts(symbol, notation)]
        label = read_label(symbol, notation)
        carried = [part.kind not in ("consonant", "initial", "silence") for part in parts]
        return [(part, label if carries or not any(carried) else None) for part, carries in zip(parts, carried, strict=True)]

    def _by_articulation(self, phone: Phone, notation: str) -> Phone:
        segment = self._segment(phone.symbol, notation)
        guess = classify(segment)
        common = tuple(c for c in guess.common if c in self.common) if guess else ()
        return replace(phone, symbol=bracketed(segment), common=common or (NEUTRAL,), layer=ARTICULATION)

    def _segment(self, symbol: str, notation: str) -> str:
        """*symbol* as an IPA segment: through X-SAMPA where the notation is that, else as it is written."""
        form = read_label(symbol, notation).short
        return unbracketed(symbol) or self.symbols.segment_of(form, notation) or form

    def _unknown(self, symbol: str, count: int, notation: str) -> Unknown:
        """What to say of a symbol: IPA and SAMPA are read letter by letter, of other notations the spelling says more."""
        phonetic = notation in IPA_NOTATIONS | SAMPA_NOTATIONS
        say = (self._sounding, self._written) if phonetic else (self._written, self._sounding)
        proposal, reason = (
            say[0](symbol, notation)
            or say[1](symbol, notation)
            or ("", f"nothing is known of it; the neutral vowel {NEUTRAL} takes its place")
        )
        return Unknown(symbol, count, proposal, reason)

    def _sounding(self, symbol: str, notation: str) -> tuple[str, str] | None:
        """The phone that looks most like *symbol* read as IPA, and why."""
        segment = self._segment(symbol, notation)
        guess, near = classify(segment), nearest(segment, {phone.phone: phone.ipa for phone in self})
        return (near[0], f"by articulation it is {' '.join(guess.common)}: {guess.reason}") if guess and near else None

    def _written(self, symbol: str, notation: str) -> tuple[str, str] | None:
        """What a symbol that is written nearly as *symbol* stands for, and which one."""
        alike = get_close_matches(read_label(symbol, notation).short, self.symbols.spellings(notation), 1)
        return (" ".join(self.symbols.parts(alike[0], notation)), f"written nearly as {alike[0]!r}") if alike else None

    def _complaint(self, unknown: tuple[Unknown, ...], notation: str) -> str:
        shown = [one.brief if len(unknown) > MOST_EXPLAINED else str(one) for one in unknown]
        return (
            f"{self.language}: {len(unknown)} unknown symbol{'s' if len(unknown) > 1 else ''} in notation {notation}: "
            f"{'; '.join(shown)}. "
            f"Add rows to {self.language}/aliases.tsv, or use --allow-unknown to map by articulation"
        )

    def _check_line(self, line: Mapping[str, tuple[str, ...]]) -> None:
        for phone, common in line.items():
            wrong = [name for name in common if name not in self.common]
            if wrong or not common:
                near = get_close_matches(wrong[0], self.common, 1) if wrong else []
                what = f"common phone {wrong[0]!r} does not exist" if wrong else "there is no common phone for it"
                raise InputError(f"the line's mapping of {phone!r}: {what}" + (f"; did you mean {near[0]!r}?" if near else ""))
            if phone not in self.symbols.phones and not unbracketed(phone):
                near = get_close_matches(phone, self.symbols.phones, 1)
                raise InputError(
                    f"the line's mapping: {self.language} has no phone {phone!r}" + (f"; did you mean {near[0]!r}?" if near else "")
                )


def shortened(symbol: str) -> str:
    """*symbol* as far as it can be shown in a line: a damaged file may hold a whole text as one label."""
    return symbol if len(symbol) <= LONGEST_SHOWN else symbol[: LONGEST_SHOWN - 1] + "…"


def _spoken(phone: Phone, mapped: Mapped, label: Label | None) -> Phone:
    """One part of *phone*, with the attributes of *label* or, where that has none, those that *phone* came with."""
    if label is None or mapped.phone == SILENCE:
        return Phone(mapped.phone, mapped.common, mapped.layer, phone.word)
    tone, stress, long = label.tone or phone.tone, label.stress or phone.stress, label.long or phone.long
    return Phone(mapped.phone, mapped.common, mapped.layer, phone.word, tone, stress, long)


def _share(start: int, end: int, phones: list[Phone]) -> list[int]:
    """The ends of *phones* between *start* and *end* (µs), each as long as it has common phones."""
    sizes = [len(phone.common) for phone in phones]
    if end - start < sum(sizes):
        raise ScheduleError(
            f"schedule: {phones[0].symbol!r} at {start} µs lasts {end - start} µs, too short for {sum(sizes)} common phones"
        )
    return [start + (end - start) * sum(sizes[: k + 1]) // sum(sizes) for k in range(len(sizes))]
