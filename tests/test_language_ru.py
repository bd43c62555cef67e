"""Russian: what the voice says becomes the phones and the mouth that a phonetician expects."""

from __future__ import annotations

import pytest
from language_cases import check_speaks, common, missing_in_sample, phones

import lipdb


@pytest.mark.parametrize(
    ("word", "expected"),
    [
        ("жизнь", "ʐ ɨ zʲ n"),
        ("щи", "ɕː ɪ"),
        ("ты", "t ɨ"),
        ("ёлка", "j ɵ ɫ k ɐ"),
        ("объявление", "ə b j j ə v lʲ e nʲ i j ɪ"),
        ("люблю", "lʲ ʉ b lʲ ʉ"),
        ("друг", "d r u k"),
        ("отец", "ə tʲ e t͡s"),
        ("чашка", "t͡ɕ a ʂ k ɐ"),
        ("борьба", "b ə r ɪ b a"),
        ("он", "o n"),
        ("она", "ə n a"),
        ("я", "j a"),  # espeak writes one label for я, stressed or not
        ("новая", "n o v ə j ə"),
        ("январь", "j ə n v a r ɪ"),
    ],
)
def test_words_have_the_phones_of_russian(db: lipdb.Database, word: str, expected: str) -> None:
    assert " ".join(phones(db, "ru", word)) == expected


@pytest.mark.parametrize(
    ("word", "expected"),
    [
        ("ты", "d ih"),  # y of espeak is no ü
        ("вода", "f ah d aa"),  # unstressed o hardly opens
        ("дом", "d ao bmp"),
        ("юг", "ih w kg"),  # the lips of j are not those of sh
        ("рыба", "d ih bmp ah"),  # nor does r push them forward
        ("шум", "sh w bmp"),
    ],
)
def test_words_look_as_they_are_said(db: lipdb.Database, word: str, expected: str) -> None:
    assert common(db, "ru", word) == expected


def test_a_label_that_sounds_otherwise_without_stress_is_told_by_it_in_every_way_of_asking(db: lipdb.Database) -> None:
    text, voice = "Моя новая статья", db.voice("ru")
    spoken = [phone.symbol for phone in voice.speak(text).schedule.phones if not phone.silent]
    said = [symbol for phrase in voice.phrases(text) for word in phrase for symbol in word]
    assert spoken == said == [symbol for phrase in voice.raw().phrases(text) for word in phrase for symbol in word]
    assert [symbol for symbol in said if "ja" in symbol] == ["ja", "ja", "ˈja"]
    assert [phone.stress for phone in db.say(text, language="ru").schedule.phones if phone.symbol == "a"][-1] == 1


def test_a_sentence_speaks_and_its_lips_close(db: lipdb.Database) -> None:
    line = check_speaks(db, "ru", "Мама мыла раму, а папа пел. бабушка ещё спала.")
    assert line.schedule.words == ("Мама", "мыла", "раму", "а", "папа", "пел", "бабушка", "ещё", "спала")


def test_e_without_its_dots_is_read_as_the_word_needs_and_shown_as_it_was_written(db: lipdb.Database) -> None:
    assert phones(db, "ru", "Петр, идем еще!") == phones(db, "ru", "Пётр, идём ещё!")
    assert db.say("Петр, идем еще!", language="ru").schedule.words == ("Петр", "идем", "еще")


def test_a_full_stop_ends_a_sentence_in_front_of_a_small_letter_but_no_abbreviation(db: lipdb.Database) -> None:
    def pauses(text: str) -> int:
        return sum(phone.silent for phone in db.say(text, language="ru").schedule.phones)

    assert pauses("Он пришёл. она ушла.") == 3
    assert pauses("Цена пять тыс. рублей.") == 2


def test_the_sample_has_every_phone_that_the_voice_can_say(db: lipdb.Database) -> None:
    assert missing_in_sample(db, "ru") == {"xʲ", "æ", "ʊ", "ʑː"}


@pytest.mark.parametrize(
    ("notation", "symbols", "expected"),
    [
        ("mfa", "t̪ ɟ ɲː t̪s̪ ɫ", "t ɡʲ nʲ t͡s ɫ"),
        ("azure", "ʌ ɔ ɕː g", "ɐ o ɕː ɡ"),
        ("polly", "s\\: 1 n' ts\\", "ɕː ɨ nʲ t͡ɕ"),
        ("xsampa", "1 5 t' t_j S", "ɨ ɫ tʲ tʲ ʂ"),
    ],
)
def test_other_notations_mean_the_same_phones(db: lipdb.Database, notation: str, symbols: str, expected: str) -> None:
    read = db.phoneset("ru").symbols
    assert [read.parts(symbol, notation) for symbol in symbols.split()] == [(phone,) for phone in expected.split()]
