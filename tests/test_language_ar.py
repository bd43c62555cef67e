"""Arabic: what the voice says becomes the phones and the mouth that a phonetician expects."""

from __future__ import annotations

import unicodedata

import pytest
from language_cases import check_speaks, common, missing_in_sample, phones

import lipdb


@pytest.mark.parametrize(
    ("word", "expected"),
    [
        ("قَلْب", "q a l b"),
        ("ضَوْء", "dˤ ɑ u ʔ"),
        ("شَمْس", "ʃ a m s"),
        ("طَالِب", "tˤ ɑː l i b"),
        ("حُبّ", "ħ u b"),
        ("خُبْز", "x u b z"),
        ("عَيْن", "ʕ a i n"),
        ("جَبَل", "d͡ʒ a b a l"),
        ("ثَلْج", "θ a l d͡ʒ"),
        ("كتاب", "k i t aː b"),
        ("٣", "θ a l aː θ a"),
        ("٣٫٥", "θ a l aː θ a f aː sˤ i l x a m s a"),
        ("٣٪", "θ a l aː θ a b i l m i ʔ a t"),
        ("ڤيديو", "f iː d j uː"),
    ],
)
def test_words_have_the_phones_of_arabic(db: lipdb.Database, word: str, expected: str) -> None:
    assert " ".join(phones(db, "ar", word)) == expected


@pytest.mark.parametrize(
    ("word", "expected"),
    [
        ("بَاب", "bmp aa bmp"),
        ("كَلْب", "kg ah l bmp"),  # a short a opens less than a long one
        ("يَوْم", "ih ah w bmp"),
        ("نُور", "d w d"),
        ("فِيل", "f ih l"),
        ("هَذَا", "h aa th aa"),  # its first a is long and never written
    ],
)
def test_words_look_as_they_are_said(db: lipdb.Database, word: str, expected: str) -> None:
    assert common(db, "ar", word) == expected


@pytest.mark.parametrize(
    ("word", "expected"),
    [
        ("ثُمَّ", "θ u m m a"),  # a vowel over a shadda, in either order
        ("السُّوق", "ʔ a s s uː q"),  # two s, not three
        ("بِالْبَيْت", "b i l b a i t"),  # an alif that is written but not said
        ("بِالشَّمْس", "b i ʃ ʃ a m s"),
        ("وَارْفَعْ", "w a r f a ʕ"),
        ("وَالَّذِي", "w a l l a ð iː"),
        ("وَاسِع", "w aː s i ʕ"),
        ("شَكَرُوا", "ʃ a k a r uː"),
    ],
)
def test_every_vowel_sign_is_said_and_no_silent_letter_is(db: lipdb.Database, word: str, expected: str) -> None:
    for form in ("NFC", "NFD"):
        assert " ".join(phones(db, "ar", unicodedata.normalize(form, word))) == expected
    assert " ".join(phones(db, "ar", word.replace("\u064e\u0651", "\u0651\u064e"))) == expected


@pytest.mark.parametrize(
    ("word", "expected"),
    [
        ("أن", "ʔ a n"),
        ("كم", "k a m"),  # not the kilometre
        ("الى", "ʔ i l aː"),  # not the names of its letters
        ("يمكن", "j u m k i n u"),
        ("والله", "w a l l aː h i"),
    ],
)
def test_the_commonest_words_have_their_vowels_without_signs(db: lipdb.Database, word: str, expected: str) -> None:
    assert " ".join(phones(db, "ar", word)) == expected


def test_words_are_shown_as_they_were_written(db: lipdb.Database) -> None:
    assert db.say("شَكَرُوا، وَارْفَعْ بِالْبَيْتِ.", language="ar").schedule.words == ("شَكَرُوا", "وَارْفَعْ", "بِالْبَيْتِ")


def test_a_sentence_speaks_and_its_lips_close(db: lipdb.Database) -> None:
    line = check_speaks(db, "ar", "بَابُ الْمَدِينَةِ كَبِيرٌ، هَلْ تَعْرِفُ؟ مرحبا بكم!")
    assert line.schedule.words == ("بَابُ", "الْمَدِينَةِ", "كَبِيرٌ", "هَلْ", "تَعْرِفُ", "مرحبا", "بكم")
    assert sum(phone.silent for phone in line.schedule.phones) == 4


def test_the_sample_has_every_phone_that_the_voice_can_say(db: lipdb.Database) -> None:
    # eː is in names of Latin letters only, the others the voice writes as their neighbours.
    assert missing_in_sample(db, "ar") == {"v", "ɫ", "ðˤ", "eː"}


def test_half_of_the_sample_has_vowel_signs(db: lipdb.Database) -> None:
    sentences = [row["sentence"] for row in db.records["ar/sentences.tsv"].values()]
    signed = sum(sum("\u064b" <= c <= "\u0652" for c in sentence) > len(sentence) / 5 for sentence in sentences)
    assert 0.4 < signed / len(sentences) < 0.6


@pytest.mark.parametrize(
    ("notation", "symbols", "expected"),
    [
        ("mfa", "æ ɪ χː ðˤ dʒː", "a i x ðˤ d͡ʒ"),
        ("azure", "tˤ ħ ʕ aː", "tˤ ħ ʕ aː"),
        ("polly", "?\\ X\\ s_?\\ A_?\\: lˠ", "ʕ ħ sˤ ɑː ɫ"),
        ("xsampa", "t_?\\ G D a:", "tˤ ɣ ð aː"),
    ],
)
def test_other_notations_mean_the_same_phones(db: lipdb.Database, notation: str, symbols: str, expected: str) -> None:
    read = db.phoneset("ar").symbols
    assert [read.parts(symbol, notation) for symbol in symbols.split()] == [(phone,) for phone in expected.split()]
