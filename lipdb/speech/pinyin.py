"""Chinese text, or pinyin, to a list of syllables, pauses and foreign words.

Readings come from pypinyin with its tone sandhi; a table of the language (``readings.tsv``) goes first, with words that
pypinyin can't tell, such as 花儿 (huār, one syllable) against 女儿 (nǚ'ér, two).
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Container, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import NamedTuple

from lipdb.errors import InputError
from lipdb.phones.syllables import Syllables
from lipdb.speech.chinese_numbers import spell_numbers

NEUTRAL = 5
PUNCTUATION = {"，": ",", "、": ",", "；": ";", "：": ":", "。": ".", "！": "!", "？": "?", "…": ".", "—": ",", "～": ","}
PAUSES = ",.!?;:"
_VOWELLESS = re.compile("h?m|h?ng?|n")
TONE_MARKS = {"\u0304": 1, "\u0301": 2, "\u030c": 3, "\u0300": 4}

_HAN = "\u3007\u3400-\u4dbf\u4e00-\u9fff\uf900-\ufaff\U00020000-\U0003ffff"
_TONE_DIGITS = "⁰¹²³⁴⁵"
_LETTER = rf"(?:[^\W\d_⁰-⁹¹²³¼½¾Ⅰ-ↈ{_HAN}]|[\u0300-\u030c])"
_TOKEN = re.compile(rf"(?P<han>[{_HAN}]+)|(?P<latin>{_LETTER}(?:{_LETTER}|['’-](?={_LETTER}))*[{_TONE_DIGITS}]?)|(?P<other>.)")
# From the first letter of a run only, and never back: a long run would be read again from each of its letters.
_NUMBERED = re.compile(rf"(?<!{_LETTER})(?<!{_LETTER}['’-])({_LETTER}(?:{_LETTER}|['’-](?={_LETTER}))*+)([0-5])(?!\d|[.,]\d|%)")
_REPEATED = re.compile(f"([{_HAN}])々")
_U_DIAERESIS = re.compile(r"(?<=[lnLN])[uU]:")
# 儿 in front of these begins a word of its own: 这儿子 is 这 + 儿子.
_OWN_WORD = "子女童孙媳歌科"


class Syllable(NamedTuple):
    """One syllable: as it was written, in plain pinyin with ü, its tone 1 to 5, its initial (may be none) and final."""

    written: str
    plain: str
    tone: int
    phones: tuple[str, ...]


class Pause(NamedTuple):
    """A mark of punctuation, one of ``, . ! ? ; :``."""

    mark: str


class Foreign(NamedTuple):
    """A word in Latin letters that is no pinyin."""

    written: str


Token = Syllable | Pause | Foreign


class Reading(NamedTuple):
    """The tokens of a text, and the signs in it that nobody reads."""

    tokens: list[Token]
    unread: tuple[str, ...]


@dataclass(frozen=True)
class PinyinReader:
    """Reads Chinese by a language's tables: legal *syllables*, known *phones* and *readings* of words."""

    syllables: Syllables
    phones: Container[str]
    readings: Mapping[str, str]

    def read(self, text: str) -> Reading:
        """The tokens of *text*.

        Raises `InputError` for text without any Chinese, and for characters and syllables that nobody knows.
        """
        chinese = has_characters(text)
        # Tone digits go out of the way of numbers: ni3 keeps its 3, iPhone 3 does not.
        raised = _NUMBERED.sub(lambda m: self._raise_tone(m, chinese=chinese), _U_DIAERESIS.sub("ü", text))
        spelled = _REPEATED.sub(r"\1\1", spell_numbers(raised))
        tokens: list[Token] = []
        unread: list[str] = []
        for match in _TOKEN.finditer(spelled):
            if match["han"]:
                tokens += self._read_characters(match["han"])
            elif match["latin"]:
                tokens += self._read_latin(match["latin"], chinese=chinese)
            elif (mark := PUNCTUATION.get(match["other"], match["other"])) in PAUSES:
                tokens.append(Pause(mark))
            elif unicodedata.category(mark)[0] in "NSL" or mark in "%&@#":
                unread.append(mark)
        return Reading(tokens, tuple(dict.fromkeys(unread)))

    @cached_property
    def _words(self) -> re.Pattern[str]:
        longest_first = sorted((word for word in self.readings if re.match(f"[{_HAN}]", word)), key=len, reverse=True)
        return re.compile(f"({'|'.join(map(re.escape, longest_first))})(?![{_OWN_WORD}])" if longest_first else r"(?!)()")

    def _read_characters(self, text: str) -> Iterator[Token]:
        last: list[Syllable] = []
        for part in filter(None, self._words.split(text)):
            if part in self.readings:
                syllables = [self._known(part, plain, tone) for plain, tone in split_numbered(self.readings[part])]
            else:
                syllables = [self._known(written, plain, tone) for written, plain, tone in _read_han(part)]
            if last and syllables and last[-1].tone == syllables[0].tone == 3:
                last[-1] = last[-1]._replace(tone=2)  # sandhi across the edge, which pypinyin can't see
            yield from last
            last = syllables
        yield from last

    def _read_latin(self, word: str, *, chinese: bool) -> Iterator[Token]:
        if (reading := self.readings.get(word.lower())) is not None:
            yield from (self._known(word, plain, tone) for plain, tone in split_numbered(reading))
        elif syllables := self._split_pinyin(word, chinese=chinese):
            yield from syllables
        elif chinese:
            yield Foreign(word)
        else:
            raise InputError(
                f"text: {word!r} is neither Chinese nor pinyin (write pinyin as ni3 hao3 or nǐ hǎo); give the --language of the text"
            )

    def _raise_tone(self, match: re.Match[str], *, chinese: bool) -> str:
        word, digit = match.groups()
        numbered = f"{word}{_TONE_DIGITS[int(digit)]}"
        return numbered if self._split_pinyin(numbered, chinese=chinese) else match[0]

    def _split_pinyin(self, word: str, *, chinese: bool) -> list[Syllable]:
        """The syllables of a word of pinyin; none if it is something else.

        Among Chinese characters a word without tones, or all in capitals, is foreign: "can", "A4".
        """
        letters = word.rstrip(_TONE_DIGITS)
        tone = _TONE_DIGITS.index(word[-1]) or NEUTRAL if letters != word else 0
        found: list[Syllable] = []
        for part in re.split("['’-]", letters):
            pieces = self._cut(_with_tones(part))
            if not pieces or (len(pieces) > 1 and any(_VOWELLESS.fullmatch(piece.plain) for piece in pieces)):
                return []
            found += pieces
        if tone:
            found[-1] = found[-1]._replace(tone=tone)
        if chinese and (letters.isupper() or not any(s.tone for s in found)):
            return []
        return [s._replace(written=f"{s.plain}{s.tone or NEUTRAL}", tone=s.tone or NEUTRAL) for s in found]

    def _cut(self, letters: list[tuple[str, int]]) -> list[Syllable]:
        """*letters* with their tones cut into legal syllables, the longest first; empty when it can't be done."""
        if not letters:
            return []
        for length in range(min(7, len(letters)), 0, -1):
            plain = spelling("".join(letter for letter, _ in letters[:length]))
            tones = [tone for _, tone in letters[:length] if tone]
            phones = self.syllables.split(plain, self.phones)
            if not phones or len(tones) > 1:
                continue
            rest = self._cut(letters[length:])
            if rest or length == len(letters):
                return [Syllable(plain, plain, tones[0] if tones else 0, phones), *rest]
        return []

    def _known(self, written: str, plain: str, tone: int) -> Syllable:
        plain = spelling(plain)
        phones = self.syllables.split(plain, self.phones)
        if not phones:
            raise InputError(
                f"text: {written!r} is read {plain!r}, which is no syllable in syllables.tsv; add it there, or write another word"
            )
        return Syllable(written, plain, tone, phones)


def spelling(plain: str) -> str:
    """A syllable as the table spells it: v is ü, ü after j q x y is u, and lue, nue are lüe, nüe."""
    plain = plain.lower().replace("v", "ü")
    if plain[:1] in ("j", "q", "x", "y"):
        return plain.replace("ü", "u")
    return {"lue": "lüe", "nue": "nüe"}.get(plain, plain)


def has_characters(text: str) -> bool:
    """Whether there is a Chinese character in *text*."""
    return re.search(f"[{_HAN}]", text) is not None


def split_numbered(reading: str) -> list[tuple[str, int]]:
    """``hua1 huar5`` as pairs of syllable and tone; a syllable without a number has the neutral tone."""
    return [(part.rstrip("12345"), int(part[-1]) if part[-1].isdecimal() else NEUTRAL) for part in reading.split()]


def _read_han(text: str) -> Iterator[tuple[str, str, int]]:
    """Written character, plain pinyin and tone of each character of *text*."""
    from pypinyin.core import Pinyin

    for word in Pinyin().seg(text):
        yield from _read_word(word)


@lru_cache(maxsize=1 << 16)
def _read_word(word: str) -> list[tuple[str, str, int]]:
    """As `_read_han`. pypinyin reads each word of its own as if it stood alone, and most come again and again."""
    from pypinyin import Style, lazy_pinyin

    unread: list[str] = []

    def refuse(part: str) -> str:
        unread.append(part)
        return part

    readings = lazy_pinyin([word], style=Style.TONE3, neutral_tone_with_five=True, tone_sandhi=True, errors=refuse)
    if unread:
        raise InputError(f"text: nobody knows how to read {unread[0]!r}; write its pinyin (for example ni3) instead")
    return [(written, reading[:-1], int(reading[-1])) for written, reading in zip(word, readings, strict=True)]


def _with_tones(word: str) -> list[tuple[str, int]]:
    """The letters of *word* without tone marks, each with the tone that its mark says, 0 for none."""
    letters: list[tuple[str, int]] = []
    for sign in unicodedata.normalize("NFD", word):
        if sign in TONE_MARKS and letters:
            letters[-1] = (letters[-1][0], TONE_MARKS[sign])
        elif unicodedata.combining(sign) and letters:
            letters[-1] = (unicodedata.normalize("NFC", letters[-1][0] + sign), letters[-1][1])
        else:
            letters.append((sign, 0))
    return letters
