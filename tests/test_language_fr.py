"""French: what a phonetician expects of words, liaison, and the sample sentences."""

import pytest
from language_cases import check_speaks, common, missing_in_sample, phones

import lipdb


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("bon vin blanc", "bmp ow f eh bmp l aa"),
        ("lune", "l ue d"),
        ("peu", "bmp ue"),
        ("peur", "bmp ao kg"),
        ("je", "sh ao"),
        ("fille", "f ih ih"),
        ("travail", "d kg aa f aa ih"),
        ("oui", "w ih"),
        ("moi", "bmp w aa"),
        ("rouge", "kg w sh"),
        ("beau", "bmp ow"),
        ("porte", "bmp ao kg d"),
        ("brun", "bmp kg ao"),
        ("parking", "bmp aa kg kg ih d"),
        ("le dos", "l ao d ow"),
        ("week-end", "w ih kg eh d d"),
    ],
)
def test_words_look_as_a_phonetician_expects(db: lipdb.Database, text: str, expected: str):
    assert common(db, "fr", text) == expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("huit", "ɥ i t"), ("lui", "l ɥ i"), ("nuage", "n ɥ a ʒ"), ("tu as", "t y a"), ("montagne", "m ɔ̃ t a ɲ"), ("agneau", "a n j o"),
        ("pâte", "p ɑ t"), ("patte", "p a t"), ("pays", "p ɛ i"), ("yeux", "j ø"), ("un parfum", "œ̃ p a ʁ f œ̃"),
        ("Rythme !", "ʁ i t m"), ("d’enthousiasme", "d ɑ̃ t u z j a s m"), ("l'email", "l i m ɛ l"),
    ],
)  # fmt: skip
def test_words_have_their_phones(db: lipdb.Database, text: str, expected: str):
    assert " ".join(phones(db, "fr", text)) == expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("les amis", "l e z a m i"),
        ("les copains", "l e k o p ɛ̃"),
        ("nous avons", "n u z a v ɔ̃"),
        ("un grand homme", "œ̃ ɡ ʁ ɑ̃ t ɔ m"),
    ],
)
def test_liaison_is_said_before_a_vowel_only(db: lipdb.Database, text: str, expected: str):
    assert " ".join(phones(db, "fr", text)) == expected


def test_a_sentence_speaks_and_its_lips_close(db: lipdb.Database):
    line = check_speaks(db, "fr", "Papa met un beau parapluie dans ma petite boîte.")
    assert {"ɥ", "œ̃", "w"} <= {phone.symbol for phone in line.schedule.phones}


@pytest.mark.parametrize(
    ("notation", "labels", "expected"),
    [
        ("sppas", "p eu U~ 9 o~ H R fp", "p ø ɛ̃ œ ɔ̃ ɥ ʁ ø"),
        ("mfa", "c ɟ mʲ ʎ ts ɥ", "k ɡ m l t s ɥ"),
        ("xsampa", "9~ E/ 2 J R\\", "œ̃ ɛ ø ɲ ʁ"),
        ("azure", "œ̃ z‿ ɥ g", "œ̃ z ɥ ɡ"),
        ("sapi", "un hw gn af", "œ̃ ɥ ɲ ɑ"),
        ("polly", "9~ H ʀ J", "œ̃ ɥ ʁ ɲ"),
        ("ipa", "ʀ ʧ õ aː", "ʁ tʃ ɔ̃ ɑ"),
    ],
)
def test_other_notations_are_read(db: lipdb.Database, notation: str, labels: str, expected: str):
    symbols = db.phoneset("fr").symbols
    assert " ".join(phone for label in labels.split() for phone in symbols.parts(label, notation, common=False)) == expected


def test_the_sample_sentences_have_every_phone(db: lipdb.Database):
    assert missing_in_sample(db, "fr") == set()
