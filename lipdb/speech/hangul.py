"""Hangul as it is written to Hangul as it is said, by the rules of standard pronunciation.

The rules are those of the Standard Language Regulations (Pyojun pareumbeop, 1988): palatalisation (art. 17), ㅎ (12),
linking (13 to 15), neutral codas (8 to 11), nasal and lateral assimilation (18 to 20), tense consonants (23 to 25),
vowels (5). They apply within a word between spaces. What no rule tells (꽃잎, 신다) is in the language's ``readings.tsv``.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

ONSETS = "ㄱㄲㄴㄷㄸㄹㅁㅂㅃㅅㅆㅇㅈㅉㅊㅋㅌㅍㅎ"
VOWELS = "ㅏㅐㅑㅒㅓㅔㅕㅖㅗㅘㅙㅚㅛㅜㅝㅞㅟㅠㅡㅢㅣ"
CODAS = ("", *"ㄱㄲㄳㄴㄵㄶㄷㄹㄺㄻㄼㄽㄾㄿㅀㅁㅂㅄㅅㅆㅇㅈㅊㅋㅌㅍㅎ")
SYLLABLES = re.compile("[가-힣]+")
_FIRST = ord("가")

_NEUTRAL = {
    **dict.fromkeys("ㄱㄲㅋㄳㄺ", "ㄱ"), **dict.fromkeys("ㄷㅅㅆㅈㅊㅌㅎ", "ㄷ"), **dict.fromkeys("ㅂㅍㅄㄿ", "ㅂ"),
    **dict.fromkeys("ㄴㄵㄶ", "ㄴ"), **dict.fromkeys("ㄹㄼㄽㄾㅀ", "ㄹ"), **dict.fromkeys("ㅁㄻ", "ㅁ"), "ㅇ": "ㅇ", "": "",
}  # fmt: skip
# What stays and what moves to a following vowel.
_LINKED = {
    "ㄳ": "ㄱㅆ", "ㄵ": "ㄴㅈ", "ㄺ": "ㄹㄱ", "ㄻ": "ㄹㅁ", "ㄼ": "ㄹㅂ", "ㄽ": "ㄹㅆ", "ㄾ": "ㄹㅌ", "ㄿ": "ㄹㅍ", "ㅄ": "ㅂㅆ",
}  # fmt: skip
# ㅎ in a coda: what stays of it in front of a vowel moves on.
_H_CODAS = {"ㅎ": "", "ㄶ": "ㄴ", "ㅀ": "ㄹ"}
_ASPIRATED = {"ㄱ": "ㅋ", "ㄷ": "ㅌ", "ㅂ": "ㅍ", "ㅈ": "ㅊ"}
# What stays of a coda in front of ㅎ, and what the two become.
_WITH_H = {
    **dict.fromkeys("ㄱㄲㅋㄳ", ("", "ㅋ")), "ㄺ": ("ㄹ", "ㅋ"), **dict.fromkeys("ㄷㅅㅆㅊㅌ", ("", "ㅌ")), "ㅈ": ("", "ㅊ"),
    "ㄵ": ("ㄴ", "ㅊ"), "ㄾ": ("ㄹ", "ㅌ"), **dict.fromkeys("ㅂㅍㅄ", ("", "ㅍ")), "ㄼ": ("ㄹ", "ㅍ"), "ㄿ": ("ㄹ", "ㅍ"),
}  # fmt: skip
_PALATAL = {"ㄷ": ("", "ㅈ"), "ㅌ": ("", "ㅊ"), "ㄾ": ("ㄹ", "ㅊ")}
_TENSE = dict(zip("ㄱㄷㅂㅅㅈ", "ㄲㄸㅃㅆㅉ", strict=True))
_NASAL = {"ㄱ": "ㅇ", "ㄷ": "ㄴ", "ㅂ": "ㅁ"}
# Stems in these make the ending tense (앉다, 넓다, 핥다); a stem in ㄻ only in front of an ending.
_TENSING = frozenset("ㄵㄼㄾ")
_ENDINGS = frozenset("고다지게거기더던구")
_STEMS_KEEP_R = frozenset("고게거기구")  # 맑게 malkke, against 닭과 dakkwa
_SMOOTHED = {"ㅑ": "ㅏ", "ㅒ": "ㅐ", "ㅕ": "ㅓ", "ㅖ": "ㅔ", "ㅛ": "ㅗ", "ㅠ": "ㅜ"}


@dataclass(slots=True)
class Syllable:
    """A block of Hangul: its onset (ㅇ: none), vowel and coda (may be empty)."""

    onset: str
    vowel: str
    coda: str

    @classmethod
    def of(cls, block: str) -> Syllable:
        """The parts of *block*, one precomposed character."""
        number = ord(block) - _FIRST
        return cls(ONSETS[number // 588], VOWELS[number % 588 // 28], CODAS[number % 28])

    def __str__(self) -> str:
        return chr(_FIRST + ONSETS.index(self.onset) * 588 + VOWELS.index(self.vowel) * 28 + CODAS.index(self.coda))


def pronounced(text: str) -> str:
    """*text* with all Hangul in it as it is said, block by block: 국물 is 궁물."""
    return SYLLABLES.sub(lambda match: "".join(map(str, spoken_syllables(match[0]))), text)


def spoken_syllables(word: str) -> list[Syllable]:
    """The syllables of *word*, precomposed blocks, as they are said: their codas are among ㄱ ㄴ ㄷ ㄹ ㅁ ㅂ ㅇ."""
    row = [Syllable.of(block) for block in word]
    for number, (syllable, following) in enumerate(_pairs(row)):
        if following is None:
            syllable.coda = _NEUTRAL[syllable.coda]
        else:
            _meet(syllable, following, word[number : number + 2])
    for syllable, block in zip(row, word, strict=True):
        if syllable.vowel == "ㅢ" and Syllable.of(block).onset != "ㅇ":
            syllable.vowel = "ㅣ"
        elif syllable.onset in "ㅈㅉㅊ":
            syllable.vowel = _SMOOTHED.get(syllable.vowel, syllable.vowel)
    return row


def _pairs(row: Sequence[Syllable]) -> Iterator[tuple[Syllable, Syllable | None]]:
    return zip(row, [*row[1:], None], strict=False)


def _meet(left: Syllable, right: Syllable, written: str) -> None:
    """Change the coda of *left* and the onset of *right* as they are said together; *written* are the two blocks."""
    coda = left.coda
    if right.onset == "ㅇ":
        left.coda, right.onset = _linked(coda, right)
    elif right.onset == "ㅎ" and coda in _WITH_H:
        left.coda, right.onset = _WITH_H[coda]
        if right.onset == "ㅌ" and coda in _PALATAL and _as_i(right):
            right.onset = "ㅊ"
    elif coda in _H_CODAS and right.onset in (*_ASPIRATED, "ㅅ", "ㄴ"):
        left.coda = _H_CODAS[coda]
        right.onset = {**_ASPIRATED, "ㅅ": "ㅆ", "ㄴ": "ㄴ"}[right.onset]
        if right.onset == "ㄴ":
            left.coda = left.coda or "ㄴ"
            right.onset = left.coda
    else:
        _assimilate(left, right, written)


def _as_i(syllable: Syllable) -> bool:
    """Whether *syllable* is a suffix in 이 or 여 (닫히다, 닫혀, 붙였다), no word of its own (맏형)."""
    return syllable.vowel == "ㅣ" or (syllable.vowel == "ㅕ" and syllable.coda in ("", "ㅆ"))


def _linked(coda: str, following: Syllable) -> tuple[str, str]:
    """What *coda* leaves and what it gives to the vowel of the *following* syllable."""
    if coda in _PALATAL and _as_i(following):
        return _PALATAL[coda]
    if coda in ("", "ㅇ"):
        return coda, "ㅇ"
    if coda in _H_CODAS:
        return "", _H_CODAS[coda] or "ㅇ"
    return (_LINKED[coda][0], _LINKED[coda][1]) if coda in _LINKED else ("", coda)


def _assimilate(left: Syllable, right: Syllable, written: str) -> None:
    coda, kept = left.coda, _neutral(left.coda, written)
    tense = kept in _NASAL or coda in _TENSING or (coda == "ㄻ" and written[1] in _ENDINGS) or (coda == "ㄺ" and kept == "ㄹ")
    if tense:
        right.onset = _TENSE.get(right.onset, right.onset)
    if kept in _NASAL and right.onset in "ㄴㅁㄹ":
        kept = _NASAL[kept]
        right.onset = "ㅁ" if right.onset == "ㅁ" else "ㄴ"
    elif kept in "ㅁㅇ" and kept and right.onset == "ㄹ":
        right.onset = "ㄴ"
    elif (kept, right.onset) in (("ㄴ", "ㄹ"), ("ㄹ", "ㄴ")):
        kept = right.onset = "ㄹ"
    left.coda = kept


def _neutral(coda: str, written: str) -> str:
    """The coda that is left of *coda* in front of a consonant: of two, which one depends on the word."""
    if coda == "ㄺ" and written[1] in _STEMS_KEEP_R:
        return "ㄹ"
    if coda == "ㄼ" and (written[0] == "밟" or written in ("넓죽", "넓둥", "넓적")):
        return "ㅂ"
    return _NEUTRAL[coda]
