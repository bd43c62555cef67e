"""Japanese text to words with their kana, and pauses.

Words and readings come from Open JTalk's dictionary through pyopenjtalk-plus (MIT; its dictionary is part of the wheel, and
nothing is downloaded). Of 110 sentences of Common Voice that it and UniDic (unidic-lite) read differently, it is wrong in 8
and UniDic in 23, by eye; elsewhere both may be said. Without the package only kana are read. A table of the language
(``readings.tsv``) goes first.
"""

from __future__ import annotations

import io
import re
import threading
import unicodedata
import warnings
from collections.abc import Iterator, Mapping
from contextlib import redirect_stdout
from dataclasses import dataclass
from functools import cache, cached_property
from importlib import import_module
from itertools import chain
from typing import Any, NamedTuple

from lipdb.errors import MissingToolError
from lipdb.speech.kana import HIRAGANA, KATAKANA, to_katakana, with_long_vowels

PACKAGE = "pyopenjtalk-plus"
PUNCTUATION = {
    **dict.fromkeys("、，；;：:,…‥—―–", ","), **dict.fromkeys("。．.", "."), **dict.fromkeys("！!", "!"), **dict.fromkeys("？?", "?"),
}  # fmt: skip
_READING = threading.Lock()
_KANA_TOKEN = re.compile(rf"(?P<name>\0\0)|(?P<kana>[{HIRAGANA}{KATAKANA}ー]+)|\S")
_SPOKEN = re.compile(f"[{KATAKANA}]")
# The dictionary's library takes 8,192 bytes at most; a sentence at a time is quicker, too.
_SENTENCE = re.compile('[^。！？!?]{1,1000}(?:[。！？!?]+[」』）)”"’】]*)?|[。！？!?]+')
NAME = "田中"
"""Stands for a word of the table while the dictionary reads the words around it."""
# Particles that are said otherwise than they are written, when they stand alone.
_PARTICLES = {"は": "ワ", "へ": "エ", "を": "オ"}
# 何 is nan in front of t, d and n (何です, 何と), else nani; 何に is nani ni.
_NAN_BEFORE = tuple("タダチツテデトドナヌネノ")
_IN_NUMBERS = frozenset("0123456789.,")
_NUMBER = r"[0-9]+(?:,[0-9]{3})*(?:\.[0-9]+)?"
_CURRENCIES = {"¥": "円", "￥": "円", "$": "ドル", "€": "ユーロ", "£": "ポンド"}
_WRITTEN_OUT = tuple(
    (re.compile(pattern), spelled)
    for pattern, spelled in (
        (r"(?<![0-9])([0-9]{4})[-/.]([0-9]{1,2})[-/.]([0-9]{1,2})(?![0-9])", r"\1年\2月\3日"),
        (r"(?<![0-9:])([0-9]{1,2}):00(?![0-9:])", r"\1時"),
        (r"(?<![0-9:])([0-9]{1,2}):0?([1-9]|[1-5][0-9])(?![0-9:])", r"\1時\2分"),
        (r"(?<![0-9/])([0-9]{1,3})/([0-9]{1,3})(?![0-9/])", r"\2分の\1"),
        (rf"({_NUMBER})[〜～~](?={_NUMBER})", r"\1から"),
        (r"(?<!\w)ー+", ""),
        (rf"(?<![0-9A-Za-z])[-−]({_NUMBER})", r"マイナス\1"),
        *((rf"{re.escape(sign)}\s?({_NUMBER})([万億]?)", rf"\1\2{name}") for sign, name in _CURRENCIES.items()),
        (r"^[^\w%℃&@#+°]+", ""),  # nothing is heard of it, and the dictionary's library complains of ! and ? in front of all words
    )
)


class Word(NamedTuple):
    """A word as it is *written*, its *kana*, and whether it is *joined* to the word in front by one accent."""

    written: str
    kana: str
    joined: bool = False


class Pause(NamedTuple):
    """A mark of punctuation, one of ``, . ! ?``."""

    mark: str


Token = Word | Pause


class JapaneseText(NamedTuple):
    """The tokens of a text, and what in it nobody reads."""

    tokens: list[Token]
    unread: tuple[str, ...]


@dataclass(frozen=True)
class JapaneseReader:
    """Reads Japanese; *readings* are words of the language's table with their kana."""

    readings: Mapping[str, str]

    def read(self, text: str) -> JapaneseText:
        """The tokens of *text*. Raises `MissingToolError` where it takes more than kana and the extra is not installed."""
        for pattern, spelled in _WRITTEN_OUT:
            text = pattern.sub(spelled, text)
        unread: list[str] = []
        tokens: list[Token] = []
        for token in chain.from_iterable(map(self._tokens, _SENTENCE.findall(text))):
            if isinstance(token, Word) and not token.kana:
                unread.append(token.written)
            else:
                tokens.append(token)
        return JapaneseText(tokens, tuple(dict.fromkeys(unread)))

    def _tokens(self, sentence: str) -> Iterator[Token]:
        given = {match.span(): self.readings[match[0]] for match in self._words.finditer(sentence)}
        return _by_dictionary(sentence, given) if openjtalk() else _kana_only(sentence, given)

    @cached_property
    def _words(self) -> re.Pattern[str]:
        longest_first = sorted(self.readings, key=len, reverse=True)
        return re.compile("|".join(map(re.escape, longest_first)) or r"(?!)")


@cache
def openjtalk() -> Any:
    """The package, or None when it is not installed."""
    try:
        with redirect_stdout(io.StringIO()):  # it tells of an optional part of its own
            return import_module("pyopenjtalk")
    except ImportError:
        return None


Span = tuple[int, int]


def _with_names(text: str, given: Mapping[Span, str]) -> tuple[str, dict[Span, tuple[str, str]]]:
    """*text* with `NAME` in the place of the *given* spans, and where these now are, with what was written and its kana.

    The dictionary knows the name, so it finds the particles and endings around it.
    """
    plain, names, done = "", dict[Span, tuple[str, str]](), 0
    for (start, end), reading in given.items():
        plain += text[done:start]
        names[len(plain), len(plain) + len(NAME)] = text[start:end], reading
        plain += NAME
        done = end
    return plain + text[done:], names


def _by_dictionary(text: str, given: Mapping[Span, str]) -> Iterator[Token]:
    """The words of *text* by the dictionary; *given* spans are words with a reading of their own."""
    plain, names = _with_names(text, given)
    with _READING, warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # how pyopenjtalk asks SudachiPy
        entries = openjtalk().g2p_mapping(plain, predict_nani=False, iu_pronunciation="YuuBase")
    last, reached = None, 0
    for entry, following in zip(entries, [*entries[1:], None], strict=False):
        start, end = entry["char_span"]
        name = next((names.pop(span) for span in list(names) if span[0] < end and start < span[1]), None) if names else None
        if end <= reached and end:  # the rest of a name
            continue
        word = _word(entry, following, plain[start:end]) if name is None else Word(*name, joined=entry["chain_flag"] == 1)
        if isinstance(word, Word) and isinstance(last, Word) and not name and _one_number(last.written, word.written, reached, entry):
            last = Word(last.written + word.written, last.kana + word.kana, last.joined)
        else:
            if last:
                yield last
            last = word
        reached = max(end, reached) if name is None else end
    if last:
        yield last


def _word(entry: Mapping[str, Any], following: Mapping[str, Any] | None, written: str) -> Token | None:
    """What an *entry* of the dictionary's is: a word, without kana if nobody reads it; a pause; or nothing that is heard."""
    kana = entry["pron"].replace("・", "")
    if not _SPOKEN.search(kana):
        if written in PUNCTUATION:
            return Pause(PUNCTUATION[written])
        return Word(written, "") if any(unicodedata.category(sign)[0] in "LN" for sign in written) else None
    if written == "何" and kana == "ナニ" and following and following["pron"].startswith(_NAN_BEFORE):
        kana = "ナン"
    return Word(written, kana, entry["chain_flag"] == 1)


def _one_number(before: str, written: str, reached: int, entry: Mapping[str, Any]) -> bool:
    """Whether an *entry* goes on with the number that *before* ends in: the dictionary reads 1,234 in six words."""
    start, end = entry["char_span"]
    return start == end or (start == reached and before[-1] in _IN_NUMBERS and written[0] in _IN_NUMBERS)


def _kana_only(text: str, given: Mapping[Span, str]) -> Iterator[Token]:
    """The words of *text* by spaces and punctuation. Raises `MissingToolError` for what is not written in kana."""
    plain, names = _with_names(text, given)
    for start, end in names:
        plain = f"{plain[:start]}\0\0{plain[end:]}"
    named = iter(names.values())
    for match in _KANA_TOKEN.finditer(plain):
        written = match[0]
        if match["name"]:
            yield Word(*next(named))
        elif match["kana"]:
            yield Word(written, _PARTICLES.get(written) or with_long_vowels(to_katakana(written)))
        elif written in PUNCTUATION:
            yield Pause(PUNCTUATION[written])
        elif unicodedata.category(written)[0] in "LN":
            raise MissingToolError(f"text: {written!r} is no kana, so it takes a dictionary; run `pip install 'lipdb[ja]'`, or write kana")
