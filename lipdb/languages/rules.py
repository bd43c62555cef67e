"""What the tables of a language must keep by themselves, without its voice."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterator
from difflib import get_close_matches
from itertools import groupby

from lipdb.languages.folder import LanguageFolder
from lipdb.languages.precedent import precedents, without_length
from lipdb.languages.report import REVIEW, Remark
from lipdb.phones.labels import IPA_NOTATIONS
from lipdb.phones.phoneset import PhoneSet
from lipdb.phones.proposal import propose
from lipdb.phones.segments import read_segment
from lipdb.phones.symbols import JOINTS
from lipdb.schedule import SILENCE

_LOOKALIKES = str.maketrans({"g": "ɡ", ":": "ː", "ε": "ɛ", "ǝ": "ə", "γ": "ɣ", "ı": "ɪ", "ʹ": "ʲ"})
Parts = tuple[str, ...]


def rules(folder: LanguageFolder, phoneset: PhoneSet) -> Iterator[Remark]:
    """Everything that is wrong with, or ought to be looked at in, the language's phones and aliases."""
    yield from _round_trips(folder, phoneset)
    yield from _joined(folder, phoneset)
    yield from _lookalikes(folder, phoneset)
    yield from _overlaps(folder, phoneset)
    yield from _phones(folder)


def common_of(phoneset: PhoneSet, parts: Parts) -> Parts:
    """The common phones of *parts* in a row; a name that is no phone stands for itself (another finding says so)."""
    found = [(part, phoneset.mappings.find(part, {})) for part in parts]
    return tuple(common for part, mapped in found for common in (mapped.common if mapped else (part,)))


def _round_trips(folder: LanguageFolder, phoneset: PhoneSet) -> Iterator[Remark]:
    """A phone's own name and its IPA, read as labels, give the phone back; several segments may be several phones, too."""
    own, path = phoneset.symbols.own, f"{folder.code}/phones.tsv"
    for key, row in folder.rows("phones").items():
        phone = row["phone"]
        back = phoneset.symbols.parts(phone, own, common=False)
        if back != (phone,):
            yield Remark(path, key, "phone", f"{phone!r} read as a label of {own} gives {_shown(back)} and not itself")
        ipa = () if " " in row["ipa"] else phoneset.symbols.parts(row["ipa"], "ipa", common=False)
        looks = common_of(phoneset, ipa)
        if ipa and looks != tuple(row["common"].split()):
            message = f"IPA {row['ipa']!r} is read as {_shown(ipa)}, which looks like {' '.join(looks)} and not like this row"
            yield Remark(path, key, "ipa", message)


def _joined(folder: LanguageFolder, phoneset: PhoneSet) -> Iterator[Remark]:
    """A symbol that holds a joint is not also several symbols in a row with another meaning; nor is a phone a syllable."""
    for key, row in folder.rows("aliases").items():
        words = [word for word in JOINTS.split(row["symbol"]) if word]
        # Labels of espeak come one by one, and one of its signs is a full stop.
        if len(words) < 2 or row["notation"] == "espeak":
            continue
        read = [phoneset.symbols.parts(word, row["notation"], common=False) for word in words]
        apart = tuple(part for parts in read for part in parts)
        if all(read) and apart != tuple(row["phones"].split()):
            message = f"{row['symbol']!r} means two things: {row['phones']} as it stands, {_shown(apart)} when it is taken apart"
            yield Remark(f"{folder.code}/aliases.tsv", key, "symbol", message)
    for key, row in folder.rows("syllables").items():
        parts = tuple(part for part in (row["initial"], row["final"]) if part)
        if row["syllable"] in phoneset.symbols.phones and common_of(phoneset, parts) != common_of(phoneset, (row["syllable"],)):
            message = f"{row['syllable']!r} means two things: the phone of this name, and the syllable {_shown(parts)}"
            yield Remark(f"{folder.code}/syllables.tsv", key, "syllable", message)


def _lookalikes(folder: LanguageFolder, phoneset: PhoneSet) -> Iterator[Remark]:
    """Signs that readers can't tell apart, such as g and ɡ, mean the same."""
    first: dict[tuple[str, str], tuple[str, str]] = {}
    for key, row in sorted(folder.rows("aliases").items()):
        if row["notation"] not in IPA_NOTATIONS:
            continue
        seen = row["notation"], unicodedata.normalize("NFD", row["symbol"]).translate(_LOOKALIKES)
        symbol, phones = first.setdefault(seen, (row["symbol"], row["phones"]))
        if common_of(phoneset, tuple(phones.split())) != common_of(phoneset, tuple(row["phones"].split())):
            message = f"{row['symbol']!r} means two things: {row['phones']} here, {phones} where it is written {symbol!r}"
            yield Remark(f"{folder.code}/aliases.tsv", key, "symbol", message)


def _overlaps(folder: LanguageFolder, phoneset: PhoneSet) -> Iterator[Remark]:
    """Symbols in a row that can be cut in two ways: the longest first wins, which a person should know."""
    rows = sorted(folder.rows("aliases").items())
    for notation, group in groupby(rows, key=lambda item: item[0][0]):
        if notation not in IPA_NOTATIONS:
            continue
        table = {row["symbol"]: tuple(row["phones"].split()) for _, row in group}
        cuts = list(_cut_in_two(table, phoneset))
        if cuts:
            text, one, other = cuts[0]
            more = f", and {len(cuts) - 1} more like it" if len(cuts) > 1 else ""
            message = f"written without spaces, {text!r} is read as {one} but could be {other}{more}; labels with one symbol each are safe"
            yield Remark(f"{folder.code}/aliases.tsv", (notation, one.split()[0]), "symbol", message, note=True)


def _cut_in_two(table: dict[str, Parts], phoneset: PhoneSet) -> Iterator[tuple[str, str, str]]:
    """Texts of two symbols that are two other symbols as well, with other common phones: the text, and both ways."""
    long = [symbol for symbol in table if len(symbol) > 1]
    starts: dict[str, list[str]] = {}
    for symbol in long:
        for size in range(1, len(symbol)):
            starts.setdefault(symbol[:size], []).append(symbol)
    for first in long:
        for size in range(1, len(first)):
            head, shared = first[:-size], first[-size:]
            if head not in table:
                continue
            for second in starts.get(shared, ()):
                rest = second[size:]
                if rest in table and common_of(phoneset, table[first] + table[rest]) != common_of(phoneset, table[head] + table[second]):
                    yield head + second, f"{first} {rest}", f"{head} {second}"


def _phones(folder: LanguageFolder) -> Iterator[Remark]:
    """Rows that wait for review, that articulation would map otherwise, or whose kind or licence is odd."""
    path, known = f"{folder.code}/phones.tsv", folder.records.get("ipa.tsv", {})
    others = precedents({name: rows for name, rows in folder.records.items() if name != path})
    licences = {row["licence"] for row in folder.records.get("sources.tsv", {}).values()}
    for key, row in folder.rows("phones").items():
        if row["comment"].startswith(REVIEW):
            yield Remark(path, key, "comment", row["comment"], note=True)
        elif " " not in row["ipa"] and (guess := propose(row["ipa"], known)).common not in ((), tuple(row["common"].split())):
            why = guess.reason.partition(f"; {REVIEW}")[0]
            message = f"{REVIEW} {row['ipa']} maps to {row['common']} here, articulation says {' '.join(guess.common)} ({why})"
            beside = others.get(without_length(row["ipa"]))
            message += f"; {beside}" if beside and beside.common == tuple(row["common"].split()) else ""
            yield Remark(path, key, "common", message, note=True)
        letters = read_segment(row["ipa"]).letters
        if not letters:
            yield Remark(path, key, "ipa", f"{row['ipa']!r} has no letter of the IPA chart, so nothing can be said of it", note=True)
        elif row["kind"] in ("vowel", "consonant") and letters[0].vowel != (row["kind"] == "vowel"):
            other = "vowel" if letters[0].vowel else "consonant"
            yield Remark(path, key, "kind", f"{REVIEW} {row['ipa']} begins with a {other}, but the row says {row['kind']}", note=True)
        if row["licence"] not in licences:
            near = get_close_matches(row["licence"], licences, 1)
            hint = f"; did you mean {near[0]!r}?" if near else ""
            yield Remark(path, key, "licence", f"{row['licence']!r} is the licence of no source{hint}", note=True)


def _shown(parts: Parts) -> str:
    return " ".join(part for part in parts if part != SILENCE) or ("a pause" if parts else "nothing")
