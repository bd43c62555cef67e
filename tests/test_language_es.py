"""Spanish: what the voice says becomes the phones and the mouth that a phonetician expects."""

from __future__ import annotations

import pytest
from language_cases import check_speaks, common, missing_in_sample, phones

import lipdb


@pytest.mark.parametrize(
    ("word", "expected"),
    [
        ("llave", "ʎ a β e"),
        ("yo", "ʝ o"),
        ("perro", "p e r o"),
        ("pero", "p e ɾ o"),
        ("gente", "x e n t e"),
        ("guerra", "ɡ e r a"),
        ("zapato", "θ a p a t o"),
        ("nada", "n a ð a"),
        ("un vaso", "u m b a s o"),
        ("niño", "n i ɲ o"),
        ("rey", "r e j"),
        ("cuando", "k w a n d o"),
        ("mismo", "m i s m o"),
        ("septiembre", "s e p t j e m b ɾ e"),
        ("show", "ʃ o w"),
        ("noche", "n o tʃ e"),
        ("agua", "a ɣ w a"),
    ],
)
def test_words_have_the_phones_of_castilian(db: lipdb.Database, word: str, expected: str) -> None:
    assert " ".join(phones(db, "es", word)) == expected


@pytest.mark.parametrize(
    ("word", "expected"),
    [
        ("perro", "bmp eh d ao"),  # the trill keeps the lips out of it, and o does not close
        ("lobo", "l ao bmp ao"),  # an approximant of the lips, no f
        ("yo", "ih ao"),  # no hush
        ("hay", "ay"),
        ("causa", "kg aw z aa"),
        ("tiene", "d ih eh d eh"),
        ("zorro", "th ao d ao"),
    ],
)
def test_words_look_as_they_are_said(db: lipdb.Database, word: str, expected: str) -> None:
    assert common(db, "es", word) == expected


def test_a_sentence_speaks_and_its_lips_close(db: lipdb.Database) -> None:
    line = check_speaks(db, "es", "Mi mamá compra pan y un poco de jamón, ¿y tú?")
    assert line.schedule.words == ("Mi", "mamá", "compra", "pan", "y", "un", "poco", "de", "jamón", "y", "tú")


def test_the_sample_has_every_phone(db: lipdb.Database) -> None:
    assert missing_in_sample(db, "es") == set()


@pytest.mark.parametrize(
    ("notation", "symbols", "expected"),
    [
        ("mfa", "t̪ ɟ ɟʝ ç v", "t ɡ ʝ x f"),
        ("sapi", "ch jj ll nj r rr th", "tʃ ʝ ʎ ɲ ɾ r θ"),
        ("azure", "t͡ʃ j͡j g", "tʃ ʝ ɡ"),
        ("polly", "4 B J j\\ ŋ", "ɾ β ɲ ʝ n"),
        ("xsampa", "r 4 T tS J", "r ɾ θ tʃ ɲ"),
        ("sampa", "r rr jj J", "ɾ r ʝ ɲ"),
    ],
)
def test_other_notations_mean_the_same_phones(db: lipdb.Database, notation: str, symbols: str, expected: str) -> None:
    read = db.phoneset("es").symbols
    assert [read.parts(symbol, notation) for symbol in symbols.split()] == [(phone,) for phone in expected.split()]
