"""Labels that stand for different sounds in different places: the neighbour within the word tells which.

espeak-ng writes one label where a phonetician hears two: German ``ɾ`` is a vowel in *der* and a consonant in *Brot*, French
``y`` is a glide in *nuit*. The alias table of a language may have such a label a second time, with its place written as in
phonological rules: ``ɾ/V_`` is ``ɾ`` after a vowel, ``y/_V`` is ``y`` before one.
"""

from __future__ import annotations

import re
from collections.abc import Collection

AFTER_VOWEL, BEFORE_VOWEL = "/V_", "/_V"
_VOWELS = "aeiouyæøœɐɑɒɔɘəɚɛɜɝɞɤɨɪɯɵɶʉʊʌʏᵻᵿ"
_ENDS_IN_VOWEL = re.compile(rf"[{_VOWELS}][\u0303ː:-]*$")
_BEGINS_WITH_VOWEL = re.compile(rf"[ˈˌ]?[{_VOWELS}]")


def in_context(symbol: str, before: str, after: str, symbols: Collection[str]) -> str:
    """*symbol*, or its form for this place where *symbols* has one.

    *before* and *after* are the labels beside it in the same word, empty at the edges of the word.
    """
    if symbol + AFTER_VOWEL in symbols and _ENDS_IN_VOWEL.search(before):
        return symbol + AFTER_VOWEL
    if symbol + BEFORE_VOWEL in symbols and _BEGINS_WITH_VOWEL.match(after):
        return symbol + BEFORE_VOWEL
    return symbol
