"""Hindi: what the voice says becomes the phones and the mouth that a phonetician expects."""

from __future__ import annotations

import pytest
from language_cases import check_speaks, common, missing_in_sample, phones

import lipdb


@pytest.mark.parametrize(
    ("word", "expected"),
    [
        ("ठीक", "ʈʰ iː k"),
        ("भाई", "bʱ aː iː"),
        ("ज़रूर", "z ə ɾ uː ɾ"),
        ("\u095bरूर", "z ə ɾ uː ɾ"),  # the dot in the letter, as old fonts write it
        ("बड़ा", "b ə ɽ aː"),
        ("नहीं", "n ə h ĩː"),
        ("अच्छा", "ə t͡ʃʰ aː"),
        ("क्या", "k j aː"),
        ("ज्ञान", "ɡ j aː n"),
        ("ऋषि", "ɾ ɪ ʂ ɪ"),
        ("पंजाब", "p ə ɲ d͡ʒ aː b"),
        ("डॉक्टर", "ɖ ɔː k ʈ ə ɾ"),
        ("कृष्\u200dण", "k ɾ ɪ ʂ ɳ ə"),
        ("१२", "b aː ɾ ə h"),
    ],
)
def test_words_have_the_phones_of_hindi(db: lipdb.Database, word: str, expected: str) -> None:
    assert " ".join(phones(db, "hi", word)) == expected


@pytest.mark.parametrize(
    ("word", "expected"),
    [
        ("कम", "kg ah bmp"),
        ("काम", "kg aa bmp"),  # the two vowels a differ in the jaw
        ("फूल", "bmp w l"),
        ("फ़ोन", "f ao d"),  # a dot below tells f from ph
        ("यार", "ih aa d"),
        ("वह", "f ao h"),  # a short a beside h is no schwa
        ("शहर", "sh eh h ah d"),
    ],
)
def test_words_look_as_they_are_said(db: lipdb.Database, word: str, expected: str) -> None:
    assert common(db, "hi", word) == expected


def test_f_and_z_without_their_dots_are_read_as_the_word_needs(db: lipdb.Database) -> None:
    assert common(db, "hi", "सिर्फ फिल्म") == common(db, "hi", "सिर्फ़ फ़िल्म")
    assert "bmp" not in common(db, "hi", "साफ दफ्तर").split()
    assert common(db, "hi", "फिर फल").split().count("bmp") == 2
    assert db.say("ज्यादा साफ", language="hi").schedule.words == ("ज्यादा", "साफ")


def test_a_sentence_speaks_and_its_lips_close(db: lipdb.Database) -> None:
    line = check_speaks(db, "hi", "मेरी माँ बाज़ार गई हैं। पापा भी आम लाएँगे!")
    assert line.schedule.words == ("मेरी", "माँ", "बाज़ार", "गई", "हैं", "पापा", "भी", "आम", "लाएँगे")
    assert sum(phone.silent for phone in line.schedule.phones) == 3


def test_the_sample_has_every_phone_that_the_voice_can_say(db: lipdb.Database) -> None:
    assert missing_in_sample(db, "hi") == {"ə̃", "ɪ̃", "ʊ̃", "ɽʱ"}


@pytest.mark.parametrize(
    ("notation", "symbols", "expected"),
    [
        ("mfa", "b̤ t͡ʃʰ i ɽ̥ æː", "bʱ t͡ʃʰ ɪ ɽʱ ɛː"),
        ("polly", "t̪ʰ A_o e~ r`_h d_d", "t̪ʰ aː ẽː ɽʱ d̪"),
        ("xsampa", "d`_h tS_h i: @", "ɖʱ t͡ʃʰ iː ə"),
    ],
)
def test_other_notations_mean_the_same_phones(db: lipdb.Database, notation: str, symbols: str, expected: str) -> None:
    read = db.phoneset("hi").symbols
    assert [read.parts(symbol, notation) for symbol in symbols.split()] == [(phone,) for phone in expected.split()]
