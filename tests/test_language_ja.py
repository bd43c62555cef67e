"""Japanese: what the voice says becomes the phones and the mouth that a phonetician expects."""

from __future__ import annotations

import pytest
from language_cases import check_speaks, common, missing_in_sample, phones

import lipdb


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("東京", "t o ky o"),
        ("先生", "s e N s e"),
        ("新聞", "sh i m b u N"),
        ("さんぽ", "s a m p o"),
        ("一杯", "i p a i"),
        ("切手", "k i t e"),
        ("富士山", "f u j i s a N"),
        ("続く", "ts U z u k u"),
        ("人は好きです", "h I t o w a s U k i d e s U"),
        ("本を読む", "h o N o y o m u"),
        ("百", "hy a k u"),
    ],
)
def test_words_have_the_phones_of_tokyo(db: lipdb.Database, text: str, expected: str) -> None:
    found = " ".join(phones(db, "ja", text))
    assert found in (expected, expected.replace("ts U", "ts u"))


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("冬", "w w ih w"),  # no teeth on the lip for f
        ("さんぽ", "z aa bmp bmp ao"),  # the lips close for ん already
        ("客", "kg ih aa kg w"),
        ("山", "ih aa bmp aa"),
    ],
)
def test_what_is_seen(db: lipdb.Database, text: str, expected: str) -> None:
    assert common(db, "ja", text) == expected


@pytest.mark.parametrize(
    ("notation", "symbol", "expected"),
    [
        ("openjtalk", "cl", ("Q",)),
        ("openjtalk", "dy", ("d", "y")),
        ("julius", "o:", ("o",)),
        ("julius", "silB", ("_",)),
        ("mfa", "tɕː", ("ch",)),
        ("mfa", "ɨ̥", ("U",)),
        ("espeak", "ɯᵝ", ("u",)),
        ("ipa", "t͡ɕ", ("ch",)),
        ("xsampa", "s\\", ("sh",)),
        ("romaji", "ō", ("o",)),
        ("romaji", "キャ", ("ky", "a")),
        ("romaji", "t:", ("t",)),
    ],
)
def test_labels_of_other_tools_are_known(db: lipdb.Database, notation: str, symbol: str, expected: tuple[str, ...]) -> None:
    assert db.phoneset("ja").symbols.parts(symbol, notation) == expected


def test_a_sentence_speaks_and_the_lips_close(db: lipdb.Database) -> None:
    line = check_speaks(db, "ja", "母は豚肉とパンを一杯食べました。")
    assert line.schedule.words[:3] == ("母", "は", "豚肉")
    assert [phone.long for phone in line.schedule.phones if phone.symbol == "p"] == [False, True]


def test_the_sample_sentences_have_every_phone(db: lipdb.Database) -> None:
    assert missing_in_sample(db, "ja") == set()
