"""German: what a phonetician expects of words, and the sample sentences."""

import pytest
from language_cases import check_speaks, common, missing_in_sample, phones

import lipdb


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("Pfeffer", "bmp f eh f ah"),
        ("ich", "ih kg"),
        ("ach", "aa kg"),
        ("schön", "sh ue d"),
        ("über", "ue bmp ah"),
        ("können", "kg ao d ah d"),
        ("zwölf", "z f ao l f"),
        ("Deutsch", "d oy d sh"),
        ("Leute", "l oy d ah"),
        ("jung", "ih w d"),
        ("Schatz", "sh aa z"),
        ("Qualm", "kg f aa l bmp"),
        ("Mädchen", "bmp eh d kg ah d"),
        ("Chance", "sh aa z ah"),
        ("Journalist", "sh w ah d aa l ih z d"),
        ("die Orange", "d ih ow kg aa d sh ah"),
        ("Clown,", "kg l aw d"),
    ],
)
def test_words_look_as_a_phonetician_expects(db: lipdb.Database, text: str, expected: str):
    assert common(db, "de", text) == expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("der", "d ɛ ɐ̯"), ("Uhr", "uː ɐ̯"), ("wird", "v ɪ ɐ̯ t"), ("durch", "d ʊ ɐ̯ ç"), ("Vater", "f aː t ɐ"), ("verirrt", "f ɛ ɐ̯ ɪ ɐ̯ t"),
        ("rot", "ʁ oː t"), ("Brot", "b ʁ oː t"), ("Lehrer", "l eː ʁ ɐ"), ("Frau", "f ʁ aʊ"), ("der alte", "d ɛ ɐ̯ a l t ə"),
    ],
)  # fmt: skip
def test_r_is_a_vowel_after_a_vowel_and_a_consonant_before_one(db: lipdb.Database, text: str, expected: str):
    assert " ".join(phones(db, "de", text)) == expected


def test_kirche_and_kirsche_look_different(db: lipdb.Database):
    assert common(db, "de", "Kirche") == "kg ih ah kg ah"
    assert common(db, "de", "Kirsche") == "kg ih ah sh ah"


def test_english_words_keep_the_sounds_that_the_voice_gives_them(db: lipdb.Database):
    assert common(db, "de", "Website") == "w eh bmp z ay d"
    assert phones(db, "de", "Thriller")[:2] == ["θ", "ɹ"]


def test_a_sentence_speaks_and_its_lips_close(db: lipdb.Database):
    line = check_speaks(db, "de", "Papa möchte bitte ein Pfund Pflaumen, aber keine Bananen.")
    assert [phone.symbol for phone in line.schedule.phones].count("pf") == 2
    assert next(phone for phone in line.schedule.phones if phone.symbol == "pf").common == ("bmp", "f")


@pytest.mark.parametrize(
    ("notation", "labels", "expected"),
    [
        ("mfa", "cʰ aj n pʰ f eː ɐ t", "k aɪ n p f eː ɐ t"),
        ("xsampa", "h 2: 6_^ t y:6", "h øː ɐ̯ t yː ɐ̯"),
        ("azure", "ʔ ɔʏ̯ ʀ ç", "h ɔʏ ʁ ç"),
        ("sapi", "^ uy eu ts ch", "h ʏ øː ts tʃ"),
        ("polly", "OY Ts p͡f 6_^", "ɔʏ ts pf ɐ̯"),
        ("ipa", "t͡s aɪ̯ χ ʀ n̩", "ts aɪ x ʁ n"),
    ],
)
def test_other_notations_are_read(db: lipdb.Database, notation: str, labels: str, expected: str):
    symbols = db.phoneset("de").symbols
    assert " ".join(phone for label in labels.split() for phone in symbols.parts(label, notation, common=False)) == expected


def test_the_sample_sentences_have_every_phone(db: lipdb.Database):
    assert missing_in_sample(db, "de") == set()
