"""A label that stands for two sounds is told apart by its neighbour in the word."""

import pytest

from lipdb.speech.context import in_context
from lipdb.speech.espeak import EspeakVoice

SYMBOLS = frozenset({"ɾ", "ɾ/V_", "y", "y/_V"})


@pytest.mark.parametrize(
    ("symbol", "before", "after", "written"),
    [
        ("ɾ", "ˈɛ", "", "ɾ/V_"), ("ɾ", "ɑ̃", "", "ɾ/V_"), ("ɾ", "uː", "n", "ɾ/V_"), ("ɾ", "b", "ˈoː", "ɾ"), ("ɾ", "əl", "", "ɾ"),
        ("y", "n", "ˈi", "y/_V"), ("y", "t", "", "y"), ("y", "l", "n", "y"), ("t", "a", "a", "t"),
    ],
)  # fmt: skip
def test_a_label_is_placed_after_or_before_a_vowel_where_the_table_says_so(symbol, before, after, written):
    assert in_context(symbol, before, after, SYMBOLS) == written


def test_speech_and_phones_without_sound_place_labels_alike_and_only_within_words():
    voice = EspeakVoice("de", "de", "Latn", SYMBOLS)
    (words,) = voice.phrases("Der alte Brotkorb.")
    assert words[0][-1] == "ɾ/V_"
    assert [s for s in words[2] if s.startswith("ɾ")] == ["ɾ", "ɾ/V_"]
    spoken = voice.speak("Der alte Brotkorb.").schedule
    assert [p.symbol for p in spoken.phones if not p.silent] == [s for word in words for s in word]
    tu, as_, *_, nuit = EspeakVoice("fr-fr", "fr", "Latn", SYMBOLS).phrases("Tu as lu la nuit")[0]
    assert (tu, as_, nuit) == (("t", "y"), ("a",), ("n", "y/_V", "i"))
