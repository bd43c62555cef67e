"""Make the folder of a new language from a voice of espeak-ng and a text: every row a proposal, none of it hidden."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING

from lipdb.curated.check import check
from lipdb.curated.folder import write_folder
from lipdb.curated.schema import TIME_FORMAT
from lipdb.curated.tsv import Records, Row
from lipdb.errors import InputError, PhonesetError
from lipdb.files import whole_folder
from lipdb.languages.folder import require_code
from lipdb.languages.propose import NOTATION, Phone, Proposed, alias_rows, phone_rows, propose_phones, table
from lipdb.languages.sample import symbols_of
from lipdb.languages.text import chosen, examples_for, script_in, sentences_of, words_of
from lipdb.progress import steps

if TYPE_CHECKING:
    from lipdb.speech.espeak import EspeakVoice
    from lipdb.speech.voice import Phrases

SCRIPT = re.compile(r"[A-Z][a-z]{3}")
SENTENCES = 200
NUMBERS = (*range(101), 200, 300, 400, 500, 600, 700, 800, 900, 1000, 1_000_000)
LANGUAGE_COMMENT = "Proposed by rule from what espeak says; to be reviewed"


@dataclass(frozen=True, slots=True)
class Heard:
    """A language as a voice was heard to speak it: its *row*, what is *proposed*, the *sentences* that are kept, and *notes*."""

    row: Row
    proposed: Proposed
    sentences: tuple[str, ...]
    notes: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class NewLanguage:
    """The *folder* that was made, its *phones*, how many *sentences* it has, and *notes* for the person in a line each."""

    language: str
    folder: Path
    phones: tuple[Phone, ...]
    sentences: int
    notes: tuple[str, ...]


def new_language(
    code: str,
    folder: Path,
    *,
    records: Records,
    voice: str,
    author: str,
    name: str = "",
    script: str = "",
    text: str | None = None,
    source: str = "",
) -> NewLanguage:
    """Make ``folder/code`` with every phone that espeak's *voice* was heard to say in *text*.

    *source* names the row of sources.tsv that says whose text it is. Without a text the voice reads numbers and letters, and
    there are no sentences. *records* are the curated data that the language joins. Nothing is written unless all is well.
    Raises `InputError`, `MissingToolError`, `OutputError`, and `PhonesetError` when *records* lack what the rows mention.
    """
    require_free(code, folder, records)
    heard = hear_language(code, records=records, voice=voice, name=name, script=script, text=text, source=source)
    tables = {
        "language": [heard.row],
        "phones": phone_rows(heard.proposed, author=author, time=datetime.now(UTC).strftime(TIME_FORMAT)),
        "aliases": alias_rows(heard.proposed, records),
        "sentences": [{"sentence": sentence, "source": source} for sentence in heard.sentences],
    }
    _write({f"{code}/{kind}.tsv": table(f"{code}/{kind}.tsv", cells) for kind, cells in tables.items() if cells}, folder, code, records)
    return NewLanguage(code, folder / code, heard.proposed.phones, len(heard.sentences), heard.notes)


def hear_language(
    code: str, *, records: Records, voice: str, name: str = "", script: str = "", text: str | None = None, source: str = ""
) -> Heard:
    """What `new_language` writes, to be looked at and changed first. Raises `InputError` and `MissingToolError`."""
    from lipdb.speech.espeak import EspeakVoice
    from lipdb.speech.espeak_list import espeak_voices, known_voice, letters_of, script_of

    if script and not SCRIPT.fullmatch(script):
        raise InputError(f"{script!r} is no script; give its four letters (ISO 15924), such as Latn or Cyrl")
    known_voice(voice)
    sentences = () if text is None else require_sentences(text, source, records)
    script = script or script_in(text or "") or script_of(voice)
    spoken = EspeakVoice(voice, code, script)
    said, notes = _hear(spoken, sentences or _numbers_and_letters(letters_of(script)))
    if not said:
        why = notes[0] if notes else "it stays silent; espeak-ng may lack the dictionary of this voice"
        raise InputError(f"text: the voice {voice} can read none of it; {why}")
    proposed = _propose(spoken, said, records)
    kept = (chosen(said, SENTENCES) if len(said) > SENTENCES else list(said)) if sentences else []
    row = {"language": code, "name": name or espeak_voices()[voice], "notation": NOTATION, "speech": "espeak", "voice": voice}
    notes += [f"label {label!r} of espeak is no IPA segment; give it a row in {code}/aliases.tsv" for label in proposed.strange]
    if not sentences:
        notes.append("no text: the voice read numbers and letters only; give a --text for phones that these lack, and for sentences")
    return Heard(row | {"script": script, "source": "lipdb", "comment": LANGUAGE_COMMENT}, proposed, tuple(kept), tuple(notes))


def _propose(voice: EspeakVoice, said: Mapping[str, Phrases], records: Records) -> Proposed:
    """The phones of what *voice* *said*, each with a word that it was asked for by itself."""
    words, _ = _hear(voice, words_of(said))
    heard = Counter(symbol for phrases in said.values() for symbol in symbols_of(phrases))
    return propose_phones(heard, examples_for(heard, list(words.items()), said), records)


def require_sentences(text: str, source: str, records: Records) -> tuple[str, ...]:
    """The sentences of *text*. Raises `InputError` unless there is one, and its source is known."""
    sentences = sentences_of(text)
    if not sentences:
        raise InputError("text: there is no word in it; give a text of the language, a few hundred sentences if you can")
    if (source,) not in records.get("sources.tsv", {}):
        raise InputError(f"no source {source!r}; name the row of sources.tsv that says whose text it is (user: your own work)")
    return sentences


def require_free(code: str, folder: Path, records: Records) -> None:
    """Raise `InputError` unless *code* can be a further language's, in *folder* and in *records*."""
    require_code(code)
    if (folder / code).exists():
        raise InputError(f"{folder / code} is there already; edit it, or choose another code")
    require_new(code, records)


def require_new(code: str, records: Records) -> None:
    """Raise `InputError` unless *code* can be a further language's in *records*."""
    require_code(code)
    if f"{code}/language.tsv" in records:
        raise InputError(f"language {code!r} is there already; edit it, or choose another code")


def _hear(voice: EspeakVoice, sentences: Sequence[str]) -> tuple[dict[str, Phrases], list[str]]:
    """What *voice* makes of each sentence that it reads by its own rules, and notes on those left out."""
    said: dict[str, Phrases] = {}
    refused: list[str] = []
    foreign = 0
    for sentence in steps(sentences, total=len(sentences), what="listening"):
        try:
            reading = voice.read(sentence)
        except InputError as error:
            refused.append(str(error).removeprefix("text: "))
            continue
        if reading.foreign:
            foreign += 1
        elif reading.phrases:
            said[sentence] = reading.phrases
    notes = [f"{len(refused)} of {len(sentences)} sentences are left out: {refused[0]}"] if refused else []
    if foreign:
        notes.append(f"{foreign} of {len(sentences)} sentences are left out: the voice reads words in them by another language's rules")
    return said, notes


def _numbers_and_letters(letters: tuple[str, ...]) -> tuple[str, ...]:
    """What every voice of espeak can read: numbers and the letters of its script."""
    return (*map(str, NUMBERS), *letters)


def _write(own: Records, folder: Path, code: str, records: Records) -> None:
    """Write the tables, all of them or nothing. Raises `PhonesetError` when the rows mention what *records* lack."""
    wrong = [one for one in check({**records, **own}) if one.file in own]
    if wrong:
        raise PhonesetError(f"the curated data lack what {code} needs: {wrong[0]}")
    with whole_folder(folder / code, otherwise="choose another folder with -o") as temporary:
        write_folder(own, temporary.parent)
