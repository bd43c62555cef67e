"""Phrases without sound: they end where the voice really pauses."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import pytest

from lipdb.curated.folder import read_folder
from lipdb.paths import data_dir
from lipdb.schedule import Schedule
from lipdb.speech.espeak import EspeakVoice, espeak_voice
from lipdb.speech.mandarin import pinyin_voice
from lipdb.speech.voice import Voice

RECORDS = read_folder(Path(data_dir("phonesets")))
ENGLISH, MANDARIN = espeak_voice(RECORDS, "en"), pinyin_voice(RECORDS, "cmn")


def paused(schedule: Schedule) -> list[int]:
    """How many phones come before each pause, the one at the end left out."""
    ends, sounding = [], 0
    for one, following in pairwise(schedule.phones):
        sounding += not one.silent
        if following.silent and not one.silent:
            ends.append(sounding)
    return ends[:-1]


def divided(voice: Voice, text: str) -> list[int]:
    ends, sounding = [], 0
    for phrase in voice.phrases(text):
        sounding += sum(map(len, phrase))
        ends.append(sounding)
    return ends[:-1]


@pytest.mark.parametrize(
    "text",
    [
        "Well, I think so; he, that is Bob, came late. But why?",
        "He said hello and then left because he was tired.",
        "We are determining who we should take on and what we do",
        "I met Mr. Smith and Dr. Jones, who live with Mrs. Ann Brown.",
        "There will be 12 people at 10:30 tomorrow.",
        "“Yes,” he said - no… maybe (later) never",
        "One. two. three and Bob. Five",
    ],
)
def test_an_english_phrase_ends_where_the_voice_pauses(text: str):
    assert divided(ENGLISH, text) == paused(ENGLISH.speak(text).schedule)


@pytest.mark.parametrize("text", ["你好，中国。我们，去、那里！好吗？是", "你好中国" * 40, "我用iPhone，好"])
def test_a_mandarin_phrase_ends_where_the_voice_pauses(text: str):
    assert divided(MANDARIN, text) == paused(MANDARIN.speak(text).schedule)


@pytest.mark.parametrize(("language", "text"), [("it", "La stazione è vicina, una lezione."), ("pt", "Boa viagem, fique quieto.")])
def test_a_break_between_two_vowels_of_a_word_is_no_pause(language: str, text: str):
    voice = espeak_voice(RECORDS, language)
    pauses = sum(phone.silent for phone in voice.speak(text).schedule.phones)
    assert pauses == len(voice.phrases(text)) + 1


def test_a_phrase_is_made_of_words_of_symbols():
    assert ENGLISH.phrases("Bob, go") == ((("b", "ɑː", "b"),), (("ɡ", "oʊ"),))


def test_words_of_another_language_are_read_without_the_mark_and_counted():
    german = EspeakVoice("de", "de", "Latn")
    reading = german.read("Das Team ist da.")
    assert reading.foreign == 1
    assert ("t", "iː", "m") in reading.phrases[0]


def test_raw_labels_do_not_depend_on_the_alias_table():
    voice = EspeakVoice("de", "de", "Latn", frozenset({"aː", "ɜ", "ɾ/V_", "ɾ", "ɾː"}))
    assert voice.raw().symbols == {"ɾ/V_", "ɾ", "ɾː"}


def test_a_modifier_that_espeak_writes_by_itself_is_no_label() -> None:
    voice = EspeakVoice("si", "si", "Sinh")
    said = [label for phrase in voice.phrases("අම්මා ගෙදර, අඹ ගහ") for word in phrase for label in word]
    assert "ᵐ" not in said
    assert said == [phone.symbol for phone in voice.speak("අම්මා ගෙදර, අඹ ගහ").schedule.phones if not phone.silent]
