"""Sentences that need a pair, and the pairs of what somebody typed."""

import pytest

from lipdb.languages.examples import Examples, pairs_in_order
from lipdb.languages.reuse_text import heard
from lipdb.languages.sample import Sample


@pytest.fixture(scope="module")
def english(db) -> Examples:
    return Examples(db, "en", "robin")


def test_the_sentences_that_hold_a_pair_come_shortest_first(db, english) -> None:
    found = english.containing("l", "ow")
    assert found == sorted(found, key=len)
    assert 5 < len(found) < len(english.pairs)
    for sentence in found[:3]:
        assert ("l", "ow") in pairs_in_order(db.say(sentence))
    assert english.containing("oy", "oy") == []


def test_labels_are_read_in_the_voice_s_notation_however_few_they_are(db) -> None:
    # espeak's Russian "a" is the reduced vowel of the first syllable; in IPA it is the open one.
    frequency, _ = heard(Sample({"на": ((("n", "a"),),)}), db.phoneset("ru"), "espeak")
    assert set(frequency.pairs) == {("_", "d"), ("d", "ah"), ("ah", "_")}


def test_the_pairs_of_a_word_are_in_the_order_of_speech(db) -> None:
    assert pairs_in_order(db.say("low")) == [("_", "l"), ("l", "ow"), ("ow", "_")]
    assert pairs_in_order(db.say("papa"))[1:3] == [("bmp", "aa"), ("aa", "bmp")]
    assert ("ue", "_") in pairs_in_order(db.say("绿", language="cmn"))
