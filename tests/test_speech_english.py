"""English text to timed phones."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from lipdb.curated.tsv import Records
from lipdb.errors import InputError, PhonesetError
from lipdb.speech.espeak import EspeakVoice, espeak_voice, words_of
from lipdb.speech.libespeak import Mark
from lipdb.speech.voice import Spoken

VOICE = EspeakVoice("en-us", "en", "Latn", frozenset({"iː", "ɑː", "ɔː", "ɜː", "uː"}))


def _phones(spoken: Spoken, word: str) -> list[str]:
    index = spoken.schedule.words.index(word)
    return [phone.symbol for phone in spoken.schedule.phones if phone.word == index]


def _level(spoken: Spoken, start: float, end: float) -> float:
    part = spoken.sound.samples[round(start * spoken.sound.rate) : round(end * spoken.sound.rate)].astype(float)
    return float(np.sqrt((part**2).mean()))


def test_a_sentence_gives_the_phones_of_its_words():
    spoken = VOICE.speak("Hello world.")
    assert spoken.schedule.words == ("Hello", "world")
    assert _phones(spoken, "Hello") == ["h", "ə", "l", "oʊ"]
    assert _phones(spoken, "world") == ["w", "ɜː", "l", "d"]
    assert spoken.schedule.notation == "espeak"
    assert spoken.schedule.language == "en"
    assert spoken.notes == ()


def test_schedule_and_sound_are_equally_long_and_begin_and_end_with_silence():
    spoken = VOICE.speak("Bob")
    assert spoken.schedule.edges[0] == 0
    assert spoken.schedule.duration == pytest.approx(spoken.sound.duration, abs=1e-6)
    assert spoken.schedule.phones[0].silent
    assert spoken.schedule.phones[-1].silent


def test_stress_is_an_attribute_and_no_part_of_the_symbol():
    spoken = VOICE.speak("banana education")
    assert not {c for phone in spoken.schedule.phones for c in phone.symbol} & set("ˈˌ")
    stress = {phone.symbol: phone.stress for phone in spoken.schedule.phones}
    assert stress["eɪ"] == 1
    assert stress["b"] == 0


def test_length_stays_in_the_label_if_the_alias_table_has_it_so_and_is_an_attribute_too():
    see = next(p for p in VOICE.speak("see").schedule.phones if p.symbol.startswith("i"))
    assert (see.symbol, see.long) == ("iː", True)
    plain = EspeakVoice("en-us", "en", "Latn", frozenset({"i"}))
    see = next(p for p in plain.speak("see").schedule.phones if p.symbol.startswith("i"))
    assert (see.symbol, see.long) == ("i", True)


def test_a_vowel_that_espeak_writes_twice_is_one_long_vowel():
    voice = EspeakVoice("en-us", "en", "Latn", frozenset({"ɐ", "æ"}))
    phones = voice.speak("aaaaaa").schedule.phones
    assert {phone.symbol for phone in phones} == {"_", "ɐ", "æ"}
    assert all(phone.long for phone in phones if not phone.silent)


def test_a_comma_gives_a_pause_of_silence():
    schedule = VOICE.speak("Yes, no").schedule
    pauses = [i for i, phone in enumerate(schedule.phones) if phone.silent]
    assert len(pauses) == 3
    assert schedule.edges[pauses[1] + 1] - schedule.edges[pauses[1]] > 60_000


def test_a_full_stop_is_one_in_front_of_a_small_letter_too():
    schedule = VOICE.speak("i have a dog. it is nice").schedule
    assert schedule.words[3:5] == ("dog", "it")
    assert sum(phone.silent for phone in schedule.phones) == 3
    assert sum(phone.silent for phone in VOICE.speak("cats etc. are nice").schedule.phones) == 2


def test_a_p_between_vowels_is_silent_from_its_start():
    spoken = VOICE.speak("A happy baby.")
    schedule = spoken.schedule
    at = next(i for i, phone in enumerate(schedule.phones) if phone.symbol == "p")
    start, end = schedule.edges[at] / 1e6, schedule.edges[at + 1] / 1e6
    assert end - start > 0.06
    assert _level(spoken, start, start + 0.025) < 0.02 * _level(spoken, 0, spoken.sound.duration)


def test_vowels_are_loud_and_pauses_are_still():
    spoken = VOICE.speak("Father saw two bees, maybe more.")
    schedule = spoken.schedule
    whole = _level(spoken, 0, spoken.sound.duration)
    levels = [
        (phone, _level(spoken, start / 1e6, end / 1e6))
        for phone, (start, end) in zip(schedule.phones, pairwise(schedule.edges), strict=True)
    ]
    vowels = [level for phone, level in levels if phone.symbol in {"ɑː", "ɔː", "uː", "iː"}]
    pauses = [level for phone, level in levels if phone.silent]
    assert len(vowels) >= 3
    assert min(vowels) > 0.8 * whole
    assert len(pauses) == 3
    assert max(pauses) < 0.2 * whole


def test_a_swallowed_l_gets_time():
    schedule = VOICE.speak("myself").schedule
    at = [phone.symbol for phone in schedule.phones].index("l")
    assert schedule.edges[at + 1] - schedule.edges[at] >= 30_000


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("It's $3.50, 50% off!", ["It's", "$3.50", "50%", "off"]),
        ('He said "hi" (quietly).', ["He", "said", "hi", "quietly"]),
        ("Of the people", ["Of the", "people"]),
        ("Call 1,234,567.89 now", ["Call", "1,234,567.89", "now"]),
    ],
)
def test_words_are_the_written_words(text: str, words: list[str]):
    assert list(VOICE.speak(text).schedule.words) == words


def test_every_phone_belongs_to_a_word_and_pauses_to_none():
    schedule = VOICE.speak("I have 24 cats, 3.5 dogs & one emu.").schedule
    used = [phone.word for phone in schedule.phones if not phone.silent]
    assert used == sorted(used)
    assert set(used) == set(range(len(schedule.words)))
    assert {phone.word for phone in schedule.phones if phone.silent} == {-1}


def test_word_positions_that_jump_back_within_a_number_do_not_split_it():
    marks = (Mark("", 0, 1, -1), Mark("w", 1, 2, 0), Mark("t", 2, 3, 9), Mark("p", 3, 4, 4), Mark("c", 4, 5, 14))
    assert words_of("pay 1,234.50 cats", marks) == (("pay", "1,234.50", "cats"), [-1, 0, 1, 1, 2])


@pytest.mark.parametrize(
    "text",
    [
        "The birch canoe slid on the smooth planks.",
        "She was, however, really troubled, sir.",
        "It's $3.50, 50% off; 24/7!",
        "Dr. Smith's e-mail: bob_smith@example.com",
        "Bob said “hi” and mama papa baby",
        "wait.. what... no",
    ],
)
def test_phonemizer_and_the_synthesis_agree_on_the_phones(text: str):
    spoken = tuple(phone.symbol for phone in VOICE.speak(text).schedule.phones if not phone.silent)
    assert tuple(symbol for phrase in VOICE.phrases(text) for word in phrase for symbol in word) == spoken


def test_phones_of_a_text_do_not_depend_on_the_text_before():
    VOICE.phrases("Shut and locked..")
    assert VOICE.phrases("Simmons") == ((("s", "ɪ", "m", "ə", "n", "z"),),)


@pytest.mark.parametrize("text", ["<b>bold</b>", "<speak><break time='9s'/>hi</speak>", "&lt;hi&gt;", "[[h@l'oU]]"])
def test_markup_is_plain_text(text: str):
    spoken = VOICE.speak(text)
    assert spoken.sound.duration < 6
    assert not any(set(phone.symbol) & set("<>[]&;'@") for phone in spoken.schedule.phones)
    said = tuple(symbol for phrase in VOICE.phrases(text) for word in phrase for symbol in word)
    assert said == tuple(p.symbol for p in spoken.schedule.phones if not p.silent)


def test_a_long_text_keeps_its_words_in_order_and_its_times():
    text = " ".join(f"Sentence number {n} is here." for n in range(300))
    spoken = VOICE.speak(text)
    assert spoken.schedule.words[-1] == "here"
    assert len(spoken.schedule.words) == 300 * 5
    assert spoken.schedule.duration == pytest.approx(spoken.sound.duration, abs=1e-6)


def test_text_in_another_script_is_refused():
    with pytest.raises(InputError, match="Chinese characters"):
        VOICE.speak("你好")
    with pytest.raises(InputError, match="Cyrillic"):
        VOICE.phrases("Привет")


def test_the_voice_comes_from_the_curated_data():
    records: Records = {
        "en/language.tsv": {("en",): {"language": "en", "voice": "en-us", "script": "Latn"}},
        "en/aliases.tsv": {("espeak", "iː"): {}, ("sapi", "iy"): {}},
    }
    voice = espeak_voice(records, "en")
    assert voice == EspeakVoice("en-us", "en", "Latn", frozenset({"iː"}))
    assert "espeak-ng 1." in voice.version


def test_a_language_without_a_row_is_an_error_in_the_data():
    with pytest.raises(PhonesetError, match=r"xx/language\.tsv"):
        espeak_voice({}, "xx")
