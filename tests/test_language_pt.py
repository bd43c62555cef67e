"""Brazilian Portuguese: what the voice says becomes the phones and the mouth that a phonetician expects."""

from __future__ import annotations

import pytest
from language_cases import check_speaks, common, missing_in_sample, phones

import lipdb


@pytest.mark.parametrize(
    ("word", "expected"),
    [
        ("manhã", "m ɐ̃ ɲ ɐ̃"),
        ("pão", "p ɐ̃w̃"),
        ("põe", "p õ j"),
        ("um", "ũ ŋ"),
        ("lhe", "ʎ i"),
        ("melhor", "m e l j ɔ ɾ"),
        ("rio", "x i w"),
        ("carro", "k a x u"),
        ("caro", "k a ɾ u"),
        ("mar", "m a ɾ"),
        ("porta", "p ɔ ɾ ə t ɐ"),
        ("dia", "dʒ i ɐ"),
        ("noite", "n oi̯ tʃ i"),
        ("herói", "e ɾ ɔi̯"),
        ("Brasil", "b ɾ a z i w"),
        ("mal", "m au̯"),
        ("jogo", "ʒ o ɡ u"),
        ("bem", "b e j ŋ"),
    ],
)
def test_words_have_the_phones_of_brazilian_portuguese(db: lipdb.Database, word: str, expected: str) -> None:
    assert " ".join(phones(db, "pt", word)) == expected


@pytest.mark.parametrize(
    ("word", "expected"),
    [
        ("noite", "d oy sh ih"),  # y of espeak is no ü
        ("rato", "h aa d w"),  # the strong r leaves the mouth free
        ("prato", "bmp d aa d w"),  # nor does the tap push the lips forward
        ("não", "d aw"),
        ("mesa", "bmp eh z ah"),  # the last a hardly opens
        ("fogo", "f ao kg w"),
    ],
)
def test_words_look_as_they_are_said(db: lipdb.Database, word: str, expected: str) -> None:
    assert common(db, "pt", word) == expected


def test_a_sentence_speaks_and_its_lips_close(db: lipdb.Database) -> None:
    line = check_speaks(db, "pt", "A mamãe comprou pão e um pouco de mamão, e você?")
    assert line.schedule.words == ("A", "mamãe", "comprou", "pão", "e", "um", "pouco", "de", "mamão", "e", "você")


def test_the_sample_has_every_phone_that_the_voice_can_say(db: lipdb.Database) -> None:
    assert missing_in_sample(db, "pt") == {"ẽ", "ĩ"}


@pytest.mark.parametrize(
    ("notation", "symbols", "expected"),
    [
        ("mfa", "j̃ ɟ c ẽ ɐ", "j ɡ k ẽ ɐ"),
        ("azure", "ə w̃ x g", "ɐ w x ɡ"),
        ("polly", "X a~ tS L", "x ɐ̃ tʃ ʎ"),
        ("xsampa", "6~ R r 4 J", "ɐ̃ x ɾ ɾ ɲ"),
        ("ipa", "ʁ h ɾ ɐ̃w̃", "x x ɾ ɐ̃w̃"),
    ],
)
def test_other_notations_mean_the_same_phones(db: lipdb.Database, notation: str, symbols: str, expected: str) -> None:
    read = db.phoneset("pt").symbols
    assert [read.parts(symbol, notation) for symbol in symbols.split()] == [(phone,) for phone in expected.split()]
