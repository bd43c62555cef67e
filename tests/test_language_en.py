"""English: the labels of vendors' voices, and the sample sentences."""

import pytest
from language_cases import check_speaks, missing_in_sample

import lipdb


@pytest.mark.parametrize(
    ("notation", "labels", "expected"),
    [
        ("azure", "f ju ɹ ɚ ɑɹ aɪɹ", "f j u r 3` A r aI r"),
        ("polly", "Θ 3' r\\ d͡ʒ i: A", "T 3` r dZ i A"),
        ("google", "ˈʧ eɪ ŋ ʤ ɑː @`", "tS eI N dZ A 3`"),
    ],
)
def test_the_labels_of_vendors_are_read(db: lipdb.Database, notation: str, labels: str, expected: str):
    symbols = db.phoneset("en").symbols
    assert " ".join(phone for label in labels.split() for phone in symbols.parts(label, notation, common=False)) == expected


def test_a_sentence_speaks_and_its_lips_close(db: lipdb.Database):
    check_speaks(db, "en", "Papa, my baby brother bumped both of his thumbs.")


def test_the_sample_sentences_have_every_phone(db: lipdb.Database):
    assert missing_in_sample(db, "en") == set()
