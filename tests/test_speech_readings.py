"""The shipped readings are legal pinyin, one syllable less than characters where 儿 only colours the one in front."""

from __future__ import annotations

import pytest

from lipdb.curated.folder import read_folder
from lipdb.paths import data_dir
from lipdb.speech.mandarin import PinyinVoice, pinyin_voice
from lipdb.speech.pinyin import split_numbered


@pytest.fixture(scope="module")
def voice() -> PinyinVoice:
    return pinyin_voice(read_folder(data_dir("phonesets")), "cmn")


def test_every_reading_is_made_of_legal_syllables(voice: PinyinVoice):
    reader = voice.reader
    assert len(reader.readings) > 50
    plains = {plain for reading in reader.readings.values() for plain, _ in split_numbered(reading)}
    assert [plain for plain in plains if not reader.syllables.split(plain, reader.phones)] == []


def test_a_word_with_er_has_one_syllable_less_than_characters(voice: PinyinVoice):
    counts = {word: (len(reading.split()), len(word) - word.count("儿")) for word, reading in voice.reader.readings.items()}
    assert [word for word, (said, expected) in counts.items() if said != expected] == []


def test_every_shipped_syllable_and_erhua_is_spoken_in_every_tone(voice: PinyinVoice):
    table = voice.reader.syllables
    candidates = [f"{s}r" for s in table.phones if s not in {"e", "er"} and f"{s}r" not in table.phones]
    coloured = [s for s in candidates if table.split(s, voice.reader.phones)]
    assert len(coloured) > 300
    for tone in range(1, 6):
        spelled = [f"{syllable}{tone}" for syllable in [*table.phones, *coloured]]
        schedule = voice.speak(" ".join(spelled)).schedule
        said: list[list[str]] = [[] for _ in spelled]
        for phone in schedule.phones:
            if not phone.silent:
                said[phone.word].append(phone.symbol)
        assert [tuple(symbols) for symbols in said] == [table.split(s[:-1], voice.reader.phones) for s in spelled]
        assert not any(phone.symbol.startswith("[") for phone in schedule.phones)
