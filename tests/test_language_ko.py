"""Korean: what the voice says becomes the phones and the mouth that a phonetician expects."""

from __future__ import annotations

import pytest
from language_cases import check_speaks, common, missing_in_sample, phones

import lipdb
from lipdb.errors import InputError


@pytest.mark.parametrize(
    ("word", "expected"),
    [
        ("국물", "k u ŋ m u l"),
        ("좋아요", "tɕ o a j o"),
        ("값이", "k a p ɕ͈ i"),
        ("같이", "k a tɕʰ i"),
        ("신라", "ɕ i l l a"),
        ("읽다", "i k t͈ a"),
        ("감사합니다", "k a m s a h a m n i t a"),
        ("첫인상", "tɕʰ ʌ t i n s a ŋ"),
        ("꽃잎", "k͈ o n n i p"),
        ("외국", "w e k u k"),
        ("쥐", "tɕ w i"),
        ("의자", "ɰ i tɕ a"),
        ("TV도", "tʰ i p ɯ i t o"),
    ],
)
def test_words_have_the_phones_of_standard_korean(db: lipdb.Database, word: str, expected: str) -> None:
    assert " ".join(phones(db, "ko", word)) == expected


@pytest.mark.parametrize(
    ("word", "expected"),
    [
        ("빵", "bmp aa d"),
        ("시장", "sh ih sh aa d"),
        ("그림", "kg ih d ih bmp"),
        ("라면", "d aa bmp ih ah d"),
        ("물론", "bmp w l l ow d"),
    ],
)
def test_what_is_seen(db: lipdb.Database, word: str, expected: str) -> None:
    assert common(db, "ko", word) == expected


@pytest.mark.parametrize(
    ("notation", "symbol", "expected"),
    [
        ("espeak", "kh", ("kʰ",)),
        ("espeak", "q", ("k",)),
        ("mfa", "tɕʷ", ("tɕ", "w")),
        ("mfa", "k̚", ("k",)),
        ("mfa", "ɐ", ("a",)),
        ("xsampa", "ts\\_h", ("tɕʰ",)),
        ("jamo", "ㅘ", ("w", "a")),
        ("ipa", "t͡ɕʰ", ("tɕʰ",)),
        ("ipa", "p͈", ("p͈",)),
    ],
)
def test_labels_of_other_tools_are_known(db: lipdb.Database, notation: str, symbol: str, expected: tuple[str, ...]) -> None:
    assert db.phoneset("ko").symbols.parts(symbol, notation) == expected


def test_a_sentence_speaks_and_the_lips_close(db: lipdb.Database) -> None:
    line = check_speaks(db, "ko", "엄마, 밥 먹고 포도랑 빵도 먹었어요.")
    assert line.schedule.words == ("엄마", "밥", "먹고", "포도랑", "빵도", "먹었어요")
    assert sum(phone.silent for phone in line.schedule.phones) == 3


@pytest.mark.parametrize("text", ["국물이 뜨거워요, 조심하세요!", "AI와 iPhone을 3명이 샀다", "네,그래요", "가" * 200, "첫째… 둘째"])
def test_phones_without_sound_are_those_that_are_spoken(db: lipdb.Database, text: str) -> None:
    voice = db.voice("ko")
    schedule = voice.speak(text).schedule
    spoken = [phone.symbol for phone in schedule.phones if not phone.silent]
    assert [symbol for phrase in voice.phrases(text) for word in phrase for symbol in word] == spoken
    assert {phone.word for phone in schedule.phones} == set(range(-1, len(schedule.words)))


def test_words_are_the_written_words_and_foreign_ones_are_noted(db: lipdb.Database) -> None:
    spoken = db.voice("ko").speak("“iPhone을 3명이” 한국(韓國)에서!")
    assert spoken.schedule.words == ("iPhone", "을", "3명이", "한국(韓國)에서")
    assert spoken.notes == ("text: iPhone read as English", "text: 韓 國 can't be read and is left out")


@pytest.mark.parametrize(
    ("text", "message"), [("Hello", "no Korean"), ("大韓", "no Korean"), ("", "nothing in"), ("Привет", "Cyrillic"), ("ㅋㅋ", "no Korean")]
)
def test_bad_text_is_refused_in_one_line(db: lipdb.Database, text: str, message: str) -> None:
    with pytest.raises(InputError, match=message) as caught:
        db.voice("ko").phrases(text)
    assert "\n" not in str(caught.value)


def test_the_sample_sentences_have_every_phone(db: lipdb.Database) -> None:
    assert missing_in_sample(db, "ko") == set()
