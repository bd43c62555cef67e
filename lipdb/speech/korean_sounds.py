"""Hangul as it is said to the phones of Korean, and to what espeak is given to say them."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

from lipdb.speech.hangul import Syllable, spoken_syllables
from lipdb.speech.sounds import Sound

# Tense consonants carry ͈ (U+0348), aspirated ones ʰ.
_ONSETS = dict(
    zip(
        "ㄱㄲㄴㄷㄸㄹㅁㅂㅃㅅㅆㅇㅈㅉㅊㅋㅌㅍㅎ",
        ["k", "k͈", "n", "t", "t͈", "ɾ", "m", "p", "p͈", "s", "s͈", "", "tɕ", "tɕ͈", "tɕʰ", "kʰ", "tʰ", "pʰ", "h"],
        strict=True,
    )
)
_VOWELS = {
    "ㅏ": "a", "ㅐ": "ɛ", "ㅑ": "j a", "ㅒ": "j ɛ", "ㅓ": "ʌ", "ㅔ": "e", "ㅕ": "j ʌ", "ㅖ": "j e", "ㅗ": "o", "ㅘ": "w a", "ㅙ": "w ɛ",
    "ㅚ": "w e", "ㅛ": "j o", "ㅜ": "u", "ㅝ": "w ʌ", "ㅞ": "w e", "ㅟ": "w i", "ㅠ": "j u", "ㅡ": "ɯ", "ㅢ": "ɰ i", "ㅣ": "i",
}  # fmt: skip
_CODAS = {"": "", "ㄱ": "k", "ㄴ": "n", "ㄷ": "t", "ㄹ": "l", "ㅁ": "m", "ㅂ": "p", "ㅇ": "ŋ"}
# ㅅ and ㅆ in front of these are hushes (lee1999).
_HUSHED = {"s": "ɕ", "s͈": "ɕ͈"}
_HUSHED_BEFORE = frozenset("ㅣㅑㅒㅕㅖㅛㅠㅟ")
# espeak's phonemes for Korean; each is one label of what it plays.
_PHONEMES = {
    "tɕ": ("tS;",), "tɕʰ": ("tS;", "h"), "tɕ͈": ("tS;-",), "tʰ": ("t", "h"), "k͈": ("k-",), "t͈": ("t-",), "p͈": ("p-",), "kʰ": ("kh",),
    "pʰ": ("ph",), "s͈": ("s-",), "ɕ": ("S;",), "ɕ͈": ("S;-",), "ŋ": ("N",), "ɾ": ("*",), "ɰ": ("u-",), "a": (",a",), "ɛ": (",E",),
    "ʌ": (",@",), "e": (",e",), "o": (",o",), "u": (",u",), "ɯ": (",u-",), "i": (",i",),
}  # fmt: skip
# Lax stops are voiced between voiced sounds: the same phone, another sound.
_VOICED = {"k": ("g",), "t": ("d",), "p": ("b",), "tɕ": ("dZ;",)}
_OBSTRUENTS = frozenset(("ㄱ", "ㄷ", "ㅂ"))


def sounds_of(hangul: str, word: int) -> list[Sound]:
    """What *hangul*, one word or part of it in precomposed blocks, is said as; the sounds belong to the word with index *word*."""
    return list(_sounds(spoken_syllables(hangul), word))


def _sounds(row: list[Syllable], word: int) -> Iterator[Sound]:
    for before, syllable in pairwise([None, *row]):
        assert syllable is not None
        onset = _ONSETS[syllable.onset]
        if before and before.coda == syllable.onset == "ㄹ":
            onset = "l"
        elif syllable.vowel in _HUSHED_BEFORE:
            onset = _HUSHED.get(onset, onset)
        if onset:
            voiced = before is not None and before.coda not in _OBSTRUENTS
            yield _sound(onset, word, _VOICED.get(onset, ()) if voiced else ())
        for phone in _VOWELS[syllable.vowel].split():
            yield _sound(phone, word)
        if syllable.coda:
            yield _sound(_CODAS[syllable.coda], word)


def _sound(phone: str, word: int, phonemes: tuple[str, ...] = ()) -> Sound:
    return Sound(phone, word, phonemes or _PHONEMES.get(phone, (phone,)))
