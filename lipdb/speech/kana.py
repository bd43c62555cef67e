"""Kana to the phones of Japanese, and to what espeak is given to say them.

Kana write morae. What one is said as depends on its neighbours, also across words: ん closes the lips in front of p, b
and m, っ makes the next consonant long, ー and a repeated vowel make a vowel long (okada1999).
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from typing import NamedTuple

from lipdb.speech.sounds import Sound

NASAL, STOP, LENGTH, DEVOICED = "ン", "ッ", "ー", "’"
HIRAGANA = "ぁ-ゖゝゞ"
KATAKANA = "ァ-ヺヽヾ"
_TO_KATAKANA = {code: code + 0x60 for code in range(ord("ぁ"), ord("ゖ") + 1)}
# One mora, one kana: those that sound alike in the standard language, and small ones that stand alone.
_ALIKE = str.maketrans("ヲヂヅヰヱヵヶヮ", "オジズイエカケワ")
_SMALL = dict(zip("ァィゥェォャュョ", "アイウエオヤユヨ", strict=True))
_VOWELS = "aiueo"
_LIPS = frozenset(("p", "b", "m", "v"))
_DEVOICED = {"i": "I", "u": "U"}
# A long vowel of plain kana is written う after o and い after e.
_LONG_O, _LONG_E = re.compile("(?<=[コゴソゾトドノホボポモヨロョオ])ウ"), re.compile("(?<=[ケゲセゼテデネヘベペメレェエ])イ")

# What espeak-ng's phoneme notation for Japanese writes each phone with; one sign is one label of what it plays. With a
# stress on every vowel the morae last alike; by itself espeak makes every second syllable a weak one, as in English.
_SOUNDS = {
    **{vowel: f",{vowel}" for vowel in _VOWELS},
    "N": "N\\", "Q": "?", "f": "p\\", "hy": "C", "j": "d_z\\", "ch": "t_s\\", "ts": "t_s", "r": "r`", "sh": "s\\", "v": "b", "y": "j",
    **{f"{stop}y": f"{sign};" for stop, sign in zip("kgnbpmr", [*"kgnbpm", "r`"], strict=True)},
}  # fmt: skip
# The first half of a long consonant, where it is not the consonant itself.
_CLOSURES = {"ch": "t", "ts": "t", "j": "d", "ky": "k", "gy": "g", "ny": "n", "py": "p", "by": "b", "my": "m", "ry": "r`"}
# espeak has no devoiced vowels: the breath of the consonant in front goes on.
_BREATHS = {"s": "s", "ts": "s", "sh": "s\\", "ch": "s\\", "f": "p\\", "h": "C", "hy": "C"}


class Mora(NamedTuple):
    """A mora of the word with index *word*: its consonants (may be none) and its vowel, `NASAL`, `STOP` or `LENGTH`."""

    onset: tuple[str, ...]
    core: str
    word: int
    devoiced: bool = False


def to_katakana(text: str) -> str:
    """*text* with hiragana as katakana, one kana for one mora, and repetition marks written out."""
    kana = text.translate(_TO_KATAKANA).replace("ゝ", "ヽ").replace("ゞ", "ヾ").translate(_ALIKE)
    return re.sub("(.)ヽ", r"\1\1", kana)


def with_long_vowels(kana: str) -> str:
    """Katakana *kana* as it is spelled, with ー for the う of とう and the い of せい.

    A guess where no dictionary says whether a word ends in between: 思う (omo'u) is read as if it were one.
    """
    return _LONG_E.sub(LENGTH, _LONG_O.sub(LENGTH, kana))


def morae(kana: str, syllables: Mapping[str, tuple[str, ...]], word: int) -> Iterator[Mora]:
    """The morae of *kana* by *syllables* (kana to phones). Signs that are no kana are passed over.

    A small kana behind one that it makes no listed syllable with is a glide and a vowel (クァ kwa, デュ dyu).
    """
    rest = to_katakana(kana)
    while rest:
        sign, rest = rest[0], rest[1:]
        phones = syllables.get(sign + rest[:1]) if rest[:1] in _SMALL else None
        if phones:
            rest = rest[1:]
        elif rest[:1] in _SMALL and sign not in _SMALL and (glided := _glided(syllables.get(sign, ()), rest[0])):
            phones, rest = glided, rest[1:]
        elif sign in (STOP, LENGTH, NASAL):
            yield Mora((), sign, word)
            continue
        else:
            phones = syllables.get(_SMALL.get(sign, sign), ())
        if phones:
            devoiced = rest[:1] == DEVOICED
            yield Mora(phones[:-1], phones[-1], word, devoiced)


def _glided(phones: tuple[str, ...], small: str) -> tuple[str, ...]:
    """*phones* of a full kana with the glide of the *small* one that follows; none where that only makes the vowel long."""
    vowel = _VOWELS["ァィゥェォ".index(small)] if small in "ァィゥェォ" else {"ャ": "a", "ュ": "u", "ョ": "o"}[small]
    if len(phones) < 2 or (small in "ァィゥェォ" and (phones[-1] != "u" or vowel == "u")):
        return ()
    return (*phones[:-1], "w" if small in "ァィゥェォ" else "y", vowel)


def sounds_of(spoken: Iterable[Mora]) -> list[Sound]:
    """What the morae of one breath are said as."""
    row = list(spoken)
    found: list[Sound] = []
    doubled = False
    for i, mora in enumerate(row):
        following = row[i + 1] if i + 1 < len(row) else None
        if mora.core == STOP:
            doubled = bool(following and following.onset)
            if not doubled:
                found.append(_sound("Q", mora.word))
        elif mora.core == NASAL:
            labial = following is not None and following.onset and (following.onset[0] in _LIPS or following.onset[0] in ("py", "by", "my"))
            found.append(_sound("m" if labial else "N", mora.word))
        elif _lengthens(mora, found):
            found[-1] = found[-1]._replace(long=True, phonemes=_longer(found[-1]))
        elif mora.core != LENGTH:
            found += _mora(mora, doubled=doubled)
            doubled = False
    return found


def _lengthens(mora: Mora, found: list[Sound]) -> bool:
    """Whether *mora* only makes the vowel in front last on: ー, or the same vowel within a word."""
    if not found or found[-1].phone not in (*_VOWELS, "N"):
        return False
    return mora.core == LENGTH or (not mora.onset and not mora.devoiced and (mora.core, mora.word) == (found[-1].phone, found[-1].word))


def _mora(mora: Mora, *, doubled: bool) -> Iterator[Sound]:
    for consonant in mora.onset:
        sound = _sound(consonant, mora.word)
        if doubled:
            sound = sound._replace(long=True, phonemes=(_CLOSURES.get(consonant, sound.phonemes[0]), *sound.phonemes))
        yield sound
        doubled = False
    if mora.devoiced and mora.core in _DEVOICED and mora.onset:
        breath = _BREATHS.get(mora.onset[-1], "C" if mora.core == "i" else "h")
        yield Sound(_DEVOICED[mora.core], mora.word, (breath,))
    else:
        yield _sound(mora.core, mora.word)


def _sound(phone: str, word: int) -> Sound:
    return Sound(phone, word, (_SOUNDS.get(phone, phone),))


def _longer(sound: Sound) -> tuple[str, ...]:
    """The phonemes of *sound*, a mora longer: what espeak calls long is hardly so, but followed by the vowel again it is."""
    first = sound.phonemes[0]
    if sound.phone in _VOWELS and len(sound.phonemes) == 1:
        return f"{first}:", sound.phone
    return (*sound.phonemes, first.strip(",:"))
