"""Look at a text before a voice reads it: leave out what can't be spoken, refuse what is of another script."""

from __future__ import annotations

import re
import unicodedata
from typing import NamedTuple

from lipdb.errors import InputError
from lipdb.words import counted

LONGEST_WORD = 60
PIECE = 20

# First words of the Unicode names of the letters that each script (ISO 15924) uses.
SCRIPTS: dict[str, tuple[str, ...]] = {
    "Arab": ("ARABIC",),
    "Armn": ("ARMENIAN",),
    "Beng": ("BENGALI",),
    "Cher": ("CHEROKEE",),
    "Cyrl": ("CYRILLIC",),
    "Deva": ("DEVANAGARI",),
    "Ethi": ("ETHIOPIC",),
    "Geor": ("GEORGIAN",),
    "Grek": ("GREEK",),
    "Gujr": ("GUJARATI",),
    "Guru": ("GURMUKHI",),
    "Hans": ("CJK", "LATIN"),
    "Hant": ("CJK", "LATIN"),
    "Hebr": ("HEBREW",),
    "Jpan": ("CJK", "HIRAGANA", "KATAKANA", "KATAKANA-HIRAGANA", "LATIN"),
    "Khmr": ("KHMER",),
    "Knda": ("KANNADA",),
    "Kore": ("HANGUL", "CJK", "LATIN"),
    "Laoo": ("LAO",),
    "Latn": ("LATIN",),
    "Mlym": ("MALAYALAM",),
    "Mymr": ("MYANMAR",),
    "Orya": ("ORIYA",),
    "Sinh": ("SINHALA",),
    "Taml": ("TAMIL",),
    "Telu": ("TELUGU",),
    "Thai": ("THAI",),
}
# Letters that belong to no script or that every voice reads by their name.
NEUTRAL = ("MICRO", "OHM", "KELVIN", "ANGSTROM", "MASCULINE", "FEMININE", "MODIFIER", "IDEOGRAPHIC")
TERMINAL = re.compile(r"\x1b\[[0-9;]*[A-Za-z]")
FOLDED = ("<wide>", "<narrow>", "<font>", "<circle>", "<initial>", "<medial>", "<final>", "<isolated>")
KASHIDA = "\u0640"
# NFC sorts an Arabic short vowel in front of the shadda; espeak knows them only as they are typed, shadda first, and drops the vowel.
SHADDA_LAST = re.compile("([\u064b-\u0650])\u0651")
_SHADDA = "\u0651"
# Chinese and Japanese put no spaces between words, and their voices find the words themselves.
_LONG = re.compile(rf"[^\W\d_ぁ-ヿ㐀-䶿一-鿿]{{{LONGEST_WORD + 1},}}")
_PLAIN: set[str] = set()
_ALLOWED: dict[str, set[str]] = {}
_ORDINARY: dict[str, set[str]] = {}
WRITING = {"CJK": "Chinese characters", "LATIN": "Latin letters"}


class Text(NamedTuple):
    """A text that can be spoken, and a note for everything that was left out of it."""

    text: str
    notes: tuple[str, ...]


class Cleaned(NamedTuple):
    """A *text* as a voice gets it, and what is no longer in it: *emoji*, *broken* characters, *long* words as they were."""

    text: str
    emoji: int = 0
    broken: int = 0
    long: bool = False


def clean(text: str) -> Text:
    """*text* without emoji, control characters and broken Unicode, its full-width, styled and joined letters made plain.

    Raises `InputError` when nothing in it is a letter or a digit.
    """
    cleaned = cleaned_up(text)
    notes = []
    if cleaned.emoji:
        notes.append(f"text: {counted(cleaned.emoji, 'emoji or pictogram is', 'emoji or pictograms are')} not read")
    if cleaned.broken:
        one, several = "character that is no text (control code", "characters that are no text (control codes"
        what = counted(cleaned.broken, f"{one} or broken Unicode) is", f"{several} or broken Unicode) are")
        notes.append(f"text: {what} left out")
    if cleaned.long:
        notes.append(f"text: words of more than {LONGEST_WORD} letters are read in pieces")
    return Text(cleaned.text, tuple(notes))


def cleaned_up(text: str) -> Cleaned:
    """As `clean`, with numbers in place of notes."""
    plain = is_plain(text)
    emoji, broken, kept = (0, 0, text) if plain else _spoken_signs(text)
    if ".." in kept:
        kept = re.sub(r"(?<!\.)\.\.(?!\.)", ".", kept)  # espeak reads the second of two full stops as "dot"
    words = kept.split()
    long = len(kept) > LONGEST_WORD and max(map(len, words), default=0) > LONGEST_WORD
    pieces = _LONG.sub(lambda m: " ".join(re.findall(f".{{1,{PIECE}}}", m[0])), kept) if long else kept
    if not any(c.isalnum() or _is_named(c) for c in pieces):
        raise InputError(f"text: nothing in {_shown(text)} can be spoken; write at least one word")
    return Cleaned(" ".join(pieces.split() if pieces != kept else words), emoji, broken, pieces != kept)


def is_ordinary(text: str, script: str) -> bool:
    """Whether *text* is nothing but words of *script* and signs that have no name: `clean` and `check_script` leave it as it is.

    False may only mean that they have to look. Each character is looked at once, as in `is_plain`.
    """
    ordinary = _ORDINARY.setdefault(script, {" "})
    if not ordinary.issuperset(text):
        ordinary.update(c for c in set(text) if _is_ordinary(c, script))
        if not ordinary.issuperset(text):
            return False
    return (
        any(map(str.isalpha, text))
        and text[0] != " "
        and text[-1] != " "
        and "  " not in text
        and ".." not in text
        and (len(text) <= LONGEST_WORD or max(map(len, text.split(" "))) <= LONGEST_WORD)
        and (text.isascii() or unicodedata.is_normalized("NFC", text))
    )


def _is_ordinary(character: str, script: str) -> bool:
    named = unicodedata.category(character)[0] == "N" or _is_named(character)
    return not (named or character.isspace()) and is_plain(character) and (script not in SCRIPTS or _is_within(character, script))


def is_plain(text: str) -> bool:
    """Whether a voice gets *text* just as it is: nothing is left out, nothing made plain.

    Each character is looked at once in the life of a process, so a text costs no more than the set of its characters.
    """
    if text.isascii() and text.isprintable():
        return True
    new = set(text) - _PLAIN
    if new:
        _PLAIN.update(c for c in new if c.isspace() or (c not in _SHADDA and _fold(c) == _spoken(c) == c))
        if not new <= _PLAIN:
            return False
    return unicodedata.is_normalized("NFC", text)


def _spoken_signs(text: str) -> tuple[int, int, str]:
    """How many emoji and broken characters *text* has, and what is spoken of it."""
    folded = "".join(_fold(c) for c in unicodedata.normalize("NFC", TERMINAL.sub("", text)))
    emoji = sum(_is_emoji(c) for c in folded)
    broken = sum(unicodedata.category(c) in ("Cc", "Cs", "Co", "Cn") and not c.isspace() for c in folded)
    return emoji, broken, SHADDA_LAST.sub("\u0651\\1", "".join(_spoken(c) for c in folded))


def check_script(text: str, script: str, *, language: str) -> None:
    """Refuse letters of another script than the language's *script* (ISO 15924; an unknown one allows all).

    Single Greek letters pass: they are symbols. Raises `InputError` with the first letters that do not belong.
    """
    allowed = SCRIPTS.get(script)
    if allowed is None or _is_within(text, script):
        return
    for found in re.finditer(r"[^\W\d_]+", text):
        kinds = [_kind(c) for c in found[0]]
        lone = [a != "GREEK" and c != "GREEK" for a, c in zip(["", *kinds], [*kinds[1:], ""], strict=False)]
        foreign = [i for i, kind in enumerate(kinds) if kind not in (*allowed, *NEUTRAL, "") and not (kind == "GREEK" and lone[i])]
        if not foreign:
            continue
        kind = kinds[foreign[0]]
        writing = WRITING.get(kind, f"{kind.title()} letters")
        raise InputError(
            f"text: {_shown(found[0])} at character {found.start() + foreign[0] + 1} is written in {writing}, which language {language!r} "
            "can't read; give the --language of the text, or write it out"
        )


def _is_within(text: str, script: str) -> bool:
    """Whether every character of *text* belongs to *script* wherever it stands; each is looked at once, as in `is_plain`."""
    if text.isascii() and "LATIN" in SCRIPTS[script]:
        return True
    within = _ALLOWED.setdefault(script, set())
    new = set(text) - within
    within.update(c for c in new if _kind(c) in (*SCRIPTS[script], *NEUTRAL, ""))
    return new <= within


def _kind(character: str) -> str:
    """The first word of a letter's Unicode name; empty for a sign that is no letter, such as ½."""
    return unicodedata.name(character, "?").split()[0] if unicodedata.category(character)[0] == "L" else ""


def _fold(character: str) -> str:
    kind = unicodedata.decomposition(character).split(" ")[0]
    ligature = kind == "<compat>" and unicodedata.category(character) in ("Ll", "Nl")
    plain = unicodedata.normalize("NFKC", character) if kind in FOLDED or ligature else character
    return f" {plain} " if kind == "<circle>" else plain


def _is_named(character: str) -> bool:
    """Whether voices read this symbol by its name: currency, per cent, plus."""
    return unicodedata.category(character) in ("Sc", "Sm") or character in "%&@#"


def _is_emoji(character: str) -> bool:
    return ord(character) > 0x2190 and unicodedata.category(character) == "So"


def _spoken(character: str) -> str:
    """The character; a space for one that only separates; nothing for one that only joins or styles."""
    category = unicodedata.category(character)
    if category == "Cf" or character == KASHIDA or "\ufe00" <= character <= "\ufe0f" or "\U0001f3fb" <= character <= "\U0001f3ff":
        return ""
    return " " if category in ("Cc", "Cs", "Co", "Cn", "Zl", "Zp") or _is_emoji(character) else character


def _shown(text: str) -> str:
    return repr(text if len(text) <= 24 else text[:23] + "…")
