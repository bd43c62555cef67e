"""Italian: what the voice says becomes the phones and the mouth that a phonetician expects."""

from __future__ import annotations

import pytest
from language_cases import check_speaks, common, missing_in_sample, phones

import lipdb


@pytest.mark.parametrize(
    ("word", "expected"),
    [
        ("gnocchi", "ɲ o k i"),
        ("sciare", "ʃ i a r e"),
        ("scienza", "ʃ ɛ n ts a"),
        ("figlio", "f i ʎ o"),
        ("fatto", "f a t o"),
        ("palla", "p a l l a"),
        ("rosso", "r o s o"),
        ("pizza", "p i ts a"),
        ("mezzo", "m ɛ dz o"),
        ("oggi", "ɔ dʒ i"),
        ("città", "tʃ i t a"),
        ("uomo", "w ɔ m o"),
        ("ieri", "j ɛ r i"),
        ("cosa", "k ɔ z a"),
        ("lungo", "l u n ɡ o"),
        ("garage", "ɡ a r a ʒ"),
    ],
)
def test_words_have_the_phones_of_italian(db: lipdb.Database, word: str, expected: str) -> None:
    assert " ".join(phones(db, "it", word)) == expected


@pytest.mark.parametrize(
    ("word", "expected"),
    [
        ("ferro", "f eh d d ao"),  # the trill keeps the lips out of it, and o does not close
        ("mai", "bmp aa ih"),
        ("guai", "kg w aa ih"),
        ("gente", "sh eh d d eh"),
        ("mamma", "bmp aa bmp bmp aa"),
        ("più", "bmp ih w"),  # no hush
    ],
)
def test_words_look_as_they_are_said(db: lipdb.Database, word: str, expected: str) -> None:
    assert common(db, "it", word) == expected


def test_a_sentence_speaks_and_its_lips_close(db: lipdb.Database) -> None:
    line = check_speaks(db, "it", "La mamma compra il pane e poi prepara la pappa al bimbo.")
    assert len(line.schedule.words) == 12


def test_a_long_consonant_is_one_long_phone(db: lipdb.Database) -> None:
    lengths = {}
    for word in ("fato", "fatto"):
        schedule = db.say(word, language="it").schedule
        at = next(i for i, phone in enumerate(schedule.phones) if phone.symbol == "t")
        assert schedule.phones[at].long == (word == "fatto")
        lengths[word] = schedule.edges[at + 1] - schedule.edges[at]
    assert lengths["fatto"] > 1.3 * lengths["fato"]


def test_the_sample_has_every_phone(db: lipdb.Database) -> None:
    assert missing_in_sample(db, "it") == set()


@pytest.mark.parametrize(
    ("notation", "symbols", "expected"),
    [
        ("mfa", "t͡ʃː d͡ʒ ɡː sː", "tʃ dʒ ɡ s"),
        ("azure", "ʧ tʃː ʤː ʣ ɾ g", "tʃ tʃ dʒ dz r ɡ"),
        ("polly", "J L E dz t͡s", "ɲ ʎ ɛ dz ts"),
        ("xsampa", "ttS LL O dZ kk", "tʃ ʎ ɔ dʒ k"),
        ("ipa", "t͡sː ttʃ ɾ ŋ", "ts tʃ r n"),
    ],
)
def test_other_notations_mean_the_same_phones(db: lipdb.Database, notation: str, symbols: str, expected: str) -> None:
    read = db.phoneset("it").symbols
    assert [read.parts(symbol, notation) for symbol in symbols.split()] == [(phone,) for phone in expected.split()]
