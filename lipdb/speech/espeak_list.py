"""Which voices espeak-ng has, and which script each of them reads."""

from __future__ import annotations

import unicodedata
from collections.abc import Mapping
from difflib import get_close_matches
from functools import cache
from itertools import islice

from lipdb.errors import InputError
from lipdb.speech.phonemes import SWITCH, load, phrases
from lipdb.speech.text import SCRIPTS

LETTERS = 80
"""How many letters of a script are looked at: the modern ones stand in front of the historic ones."""
PROBES = 35
LONGEST_NAME = 12
"""Phones."""
# Hiragana are enough for Japanese.
_KINDS = {"Jpan": "HIRAGANA"}


@cache
def espeak_voices() -> Mapping[str, str]:
    """Every voice of espeak-ng: what it is called → the language's English name. Raises `MissingToolError`."""
    return {voice.language: " ".join(voice.name.split()) for voice in load().available_voices()}


def known_voice(voice: str) -> str:
    """*voice*, if espeak-ng has it. Raises `InputError` with those nearest."""
    there = espeak_voices()
    if voice in there:
        return voice
    near = get_close_matches(voice, there, 3, 0.5) or [name for name in there if name.startswith(voice[:2])][:5]
    hint = f"did you mean {', '.join(near)}?" if near else f"it has {', '.join(sorted(there))}"
    raise InputError(f"espeak-ng has no voice {voice!r}; {hint}")


@cache
def script_of(voice: str) -> str:
    """The script (ISO 15924) of which *voice* reads most letters by its own rules, each in another way; of equals ``Latn``."""
    return max(("Latn", *SCRIPTS), key=lambda script: _readings(voice, letters_of(script)[:PROBES]))


def _readings(voice: str, letters: tuple[str, ...]) -> int:
    """How many different readings *voice* has for *letters*.

    What it does not know it spells in English, or by the name of the script, at length or all in the same way.
    """
    said = {" ".join(phrases(letter, voice)) for letter in letters}
    return sum(bool(one) and not SWITCH.search(one) and one.count("_") < LONGEST_NAME for one in said)


@cache
def letters_of(script: str) -> tuple[str, ...]:
    """Small letters, letters without case, or syllables of *script* (ISO 15924), the basic ones first; at most `LETTERS`.

    None where nothing is known of the script.
    """
    if script not in SCRIPTS:
        return ()
    kind = _KINDS.get(script, SCRIPTS[script][0])
    kinds = tuple(f"{kind} {what}" for what in ("SMALL LETTER", "LETTER", "SYLLABLE", "CHARACTER", "UNIFIED"))
    letters = (chr(number) for number in range(0x20000) if unicodedata.category(chr(number)) in ("Ll", "Lo"))
    return tuple(islice((letter for letter in letters if unicodedata.name(letter, "").startswith(kinds)), LETTERS))
