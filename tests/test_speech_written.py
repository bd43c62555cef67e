"""A language that no program speaks is read letter by letter, as its own phones, in silence."""

import pytest

from lipdb.errors import InputError
from lipdb.phones.phoneset import PhoneSet
from lipdb.plugins import voices

LANGUAGE = {"language": "qaa", "name": "Palu", "notation": "ipa", "speech": "written", "voice": "none", "script": "Latn"}


def phone(name: str, kind: str, common: str) -> dict[str, str]:
    return {"phone": name, "kind": kind, "ipa": name, "common": common, "example": name}


RECORDS = {
    "common.tsv": {(name,): {"phone": name, "kind": "", "ipa": "", "kind_of": ""} for name in ("_", "aa", "bmp", "w", "sh", "l")},
    "qaa/language.tsv": {("qaa",): LANGUAGE},
    "qaa/phones.tsv": {
        (row["phone"],): row
        for row in (phone("p", "consonant", "bmp"), phone("a", "vowel", "aa"), phone("u", "vowel", "w"), phone("ʃ", "consonant", "sh"))
    },
    "qaa/aliases.tsv": {("ipa", "sh"): {"notation": "ipa", "symbol": "sh", "phones": "ʃ"}},
    "qaa/readings.tsv": {("mr",): {"word": "mr", "reading": "pu"}},
}


@pytest.fixture
def voice():
    return voices()["written"](RECORDS, "qaa")


def test_the_longest_spelling_is_read_and_phrases_end_at_punctuation(voice) -> None:
    assert voice.phrases("Pasha, u!") == ((("p", "a", "ʃ", "a"),), (("u",),))


def test_length_stress_and_capitals_are_no_phones(voice) -> None:
    assert voice.phrases("ˈpaːSH") == ((("p", "a", "ʃ"),),)


def test_a_reading_says_how_a_word_is_spelt(voice) -> None:
    assert voice.phrases("Mr Pa") == ((("p", "u"), ("p", "a")),)


def test_it_speaks_in_silence_with_pauses_around(voice) -> None:
    said = voice.speak("papa u")
    assert [one.symbol for one in said.schedule.phones] == ["_", "p", "a", "p", "a", "u", "_"]
    assert said.schedule.words == ("papa", "u")
    assert said.sound.duration == pytest.approx(said.schedule.edges[-1] / 1e6)
    assert not said.sound.samples.any()
    resolved, unknown = PhoneSet.from_records(RECORDS, "qaa").resolve(said.schedule)
    assert not unknown
    assert resolved.common()[1] == ("_", "bmp", "aa", "bmp", "aa", "w", "_")


@pytest.mark.parametrize(("text", "what"), [("paxa", "'x' in 'paxa' is no phone of qaa"), ("!?", "nothing in"), ("", "nothing in")])
def test_what_can_t_be_read_is_said_in_one_line(voice, text: str, what: str) -> None:
    with pytest.raises(InputError, match=what) as error:
        voice.phrases(text)
    assert "\n" not in str(error.value)
