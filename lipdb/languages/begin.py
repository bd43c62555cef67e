"""Begin a new language: from what a voice says of a text, or from phones that a person types."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator

from lipdb.curated.schema import USER_SOURCE
from lipdb.curated.tsv import Records
from lipdb.errors import InputError
from lipdb.languages.draft import WRITTEN, Draft, Entry, with_rows
from lipdb.languages.labels import read_espeak
from lipdb.languages.new import hear_language, require_new, require_sentences
from lipdb.languages.precedent import judged, precedents
from lipdb.languages.propose import NOTATION, Phone, Proposed
from lipdb.languages.sample import listen, symbols_of
from lipdb.languages.text import examples_for, script_in, words_of
from lipdb.phones.phoneset import shortened
from lipdb.phones.segments import read_segment
from lipdb.speech.written import NAME, written_voice

MOST_PHONES = 200
TYPING = "write phones as in the IPA chart with spaces between them, such as p a ʃ tʃ, or ʃ=sh with its spelling"
_SEPARATORS = re.compile(r"[\s,;/\[\]|]+")


def draft_of_voice(code: str, *, records: Records, voice: str, name: str, text: str | None, source: str = USER_SOURCE) -> Draft:
    """A draft of what espeak-ng's *voice* says of *text*. Raises `InputError` and `MissingToolError`."""
    require_new(code, records)
    heard = hear_language(code, records=records, voice=voice, name=name, text=text, source=source)
    if not heard.proposed.phones:
        raise InputError(f"text: the voice {voice} says nothing that is a phone; give another text or another voice")
    entries = {phone.ipa: Entry(phone, phone.proposal.common, phone.example) for phone in heard.proposed.phones}
    return Draft(heard.row, entries, heard.proposed, heard.sentences, source, notes=heard.notes)


def draft_of_phones(code: str, *, records: Records, name: str, ipa: str, text: str | None, source: str = USER_SOURCE) -> Draft:
    """A draft of the phones that a person typed in *ipa*, for a language that no program speaks. Raises `InputError`.

    Each phone may have its spelling in *text* behind it: ``ʃ=sh``.
    """
    require_new(code, records)
    if not name.strip():
        raise InputError("give the language a name")
    entries = {one.phone.ipa: one for one in typed_entries(ipa, records)}
    sentences = require_sentences(text, source, records) if text else ()
    row = {"language": code, "name": " ".join(name.split()), "notation": NOTATION, "speech": WRITTEN, "voice": NAME}
    row |= {"script": script_in(text or "") or "Latn", "source": source, "comment": "No program speaks it"}
    draft = Draft(row, entries, Proposed((), (), ()), sentences, source)
    draft.notes = tuple(_find_examples(draft, records))
    return draft


def typed_entries(text: str, records: Records) -> list[Entry]:
    """The phones typed in *text* as IPA, separated by spaces, each with what it may map to. Raises `InputError`."""
    entries: dict[str, Entry] = {}
    wrong: list[str] = []
    known, common = precedents(records), records.get("common.tsv", {})
    for token in filter(None, _SEPARATORS.split(unicodedata.normalize("NFC", text))):
        ipa, _, spelt = token.partition("=")
        segments = read_espeak(ipa, tonal=False).segments if not read_segment(ipa).foreign else ()
        for segment in segments:
            proposal = judged(segment, records, known)
            usable = tuple(name for name in proposal.common if (name,) in common)
            phone = Phone(segment, (segment,), alone=True, count=0, rare=False, example="", proposal=proposal)
            shown = spelt if len(segments) == 1 else ""
            if usable:
                entries.setdefault(segment, Entry(phone, usable, shown or segment, shown))
        if not segments:
            wrong.append(ipa)
    if wrong:
        shown = ", ".join(repr(shortened(one)) for one in dict.fromkeys(wrong[:5]))
        raise InputError(f"no IPA: {shown}; {TYPING}")
    if not entries:
        raise InputError(f"there is no phone; {TYPING}")
    if len(entries) > MOST_PHONES:
        raise InputError(f"these are {len(entries)} phones, which no language has; give {MOST_PHONES} at most")
    return list(entries.values())


def _find_examples(draft: Draft, records: Records) -> Iterator[str]:
    """Give the phones of *draft* examples from its sentences; notes on those that can't be read."""
    voice = written_voice(with_rows(records, draft.tables(records, author="")), draft.code)
    sample = listen(voice, draft.sentences)
    words = listen(voice, words_of(sample.said)).said
    there = {symbol for phrases in sample.said.values() for symbol in symbols_of(phrases)}
    for name, example in examples_for(sorted(there), list(words.items()), sample.said).items():
        draft.entries[name].example = example
    if sample.refused:
        first = next(iter(sample.refused.values()))
        yield f"{len(sample.refused)} of {len(draft.sentences)} sentences can't be read yet: {first}"
