"""Arabic spelt so that espeak-ng reads every sign of it.

What is written stays the same word; habits of espeak-ng 1.52 are met, each observed by running it.
"""

from __future__ import annotations

import re

from lipdb.speech.text import SHADDA_LAST

# Letters of other languages that Arabic borrows or that keyboards put in, and the signs within numbers; espeak says nothing for
# some and the name of the letter for others. V becomes f, which looks alike.
_LETTERS = str.maketrans({"ڤ": "ف", "چ": "تش", "ک": "ك", "ی": "ي", "ھ": "ه", "ہ": "ه", "٫": ".", "٬": ","})
_PER_CENT = re.compile("(?<=\\d)[%٪]")
SHORT_VOWELS = "\u064b-\u0650"
_SUN = "[تثدذرزسشصضطظلن]"
# Behind the article espeak doubles a sun letter by itself; with the shadda that is written there it would be threefold.
_SUN_LETTER = re.compile(f"(?<!\\S)(ال{_SUN})\u0651")
# Behind the preposition bi, on the other hand, it knows no article.
_SILENT_ARTICLE = re.compile(f"(?<=\u0650)ال(?={_SUN}\u0651)")
# An alif behind i, or behind wa and fa in front of a closed consonant, is silent (hamzat al-wasl); espeak would say a long a.
_SILENT_ALIF = re.compile("(?<=\u0650)ا|(?<=[وف]\u064e)ا(?=[\u0621-\u064a]\u0652|[لت]\u0651)")
# So is the alif that closes a plural verb, as in katabū.
_CLOSING_ALIF = re.compile(f"(?<=\u064f\u0648)\u0652?ا(?![\\w{SHORT_VOWELS}\u0651\u0652])")


def spelt_for_espeak(text: str) -> str:
    """*text* with the shadda in front of its vowel, one less behind the article, silent alifs marked or left out, plain letters."""
    text = _PER_CENT.sub("بِٱلْمِئَة", text.translate(_LETTERS))
    text = SHADDA_LAST.sub("\u0651\\1", text)
    text = _SILENT_ARTICLE.sub("", _SUN_LETTER.sub("\\1", text))
    return _CLOSING_ALIF.sub("", _SILENT_ALIF.sub("ٱ", text))
