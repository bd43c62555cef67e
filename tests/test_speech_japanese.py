"""Japanese text to words, kana and timed phones with length."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from lipdb.curated.folder import read_folder
from lipdb.errors import InputError, MissingToolError
from lipdb.speech import japanese_words
from lipdb.speech.japanese import KanaVoice, kana_voice
from lipdb.speech.japanese_words import JapaneseReader, Pause
from lipdb.speech.kana import morae, sounds_of, to_katakana, with_long_vowels

RECORDS = read_folder(Path(__file__).parents[1] / "phonesets")
VOICE = kana_voice(RECORDS, "ja")


def _said(text: str, voice: KanaVoice = VOICE) -> str:
    """Phones as they are spoken, with ``:`` for length."""
    return " ".join(f"{phone.symbol}{':' * phone.long}" for phone in voice.speak(text).schedule.phones)


def _phones(kana: str) -> str:
    return " ".join(f"{sound.phone}{':' * sound.long}" for sound in sounds_of(morae(kana, VOICE.syllables.phones, 0)))


def _read(text: str) -> list[str]:
    """Words as ``written/kana``, pauses as their marks."""
    return [token.mark if isinstance(token, Pause) else f"{token.written}/{token.kana}" for token in VOICE.reader.read(text).tokens]


@pytest.fixture
def kana_only(monkeypatch: pytest.MonkeyPatch) -> None:
    """The extra is not installed."""
    monkeypatch.setattr(japanese_words, "openjtalk", lambda: None)


@pytest.mark.parametrize(
    ("kana", "phones"),
    [
        ("カサ", "k a s a"),
        ("きっぷ", "k i p: u"),
        ("マッチャ", "m a ch: a"),
        ("ザッシ", "z a sh: i"),
        ("あっ", "a Q"),
        ("ッテ", "t: e"),
        ("シンブン", "sh i m b u N"),
        ("サンマ", "s a m m a"),
        ("ピョンピョン", "py o m py o N"),
        ("ホンヤ", "h o N y a"),
        ("コーヒー", "k o: h i:"),
        ("イイエ", "i: e"),
        ("キャアアア", "ky a:"),
        ("ねぇ", "n e:"),
        ("デス’", "d e s U"),
        ("シ’タ", "sh I t a"),
        ("クォーター", "k w o: t a:"),
        ("デュオ", "d y u o"),
        ("フュージョン", "f y u: j o N"),
        ("ファティマ", "f a t i m a"),
        ("ヴァン", "v a N"),
        ("ヂヅヲヱ", "j i z u o e"),
        ("ンー", "N:"),
        ("ゃ", "y a"),
        ("カ☆キ", "k a k i"),
    ],
)
def test_kana_become_phones(kana: str, phones: str) -> None:
    assert _phones(kana) == phones


def test_spelled_long_vowels_and_repetition_marks() -> None:
    assert with_long_vowels(to_katakana("とうきょうのせんせい")) == "トーキョーノセンセー"
    assert to_katakana("いすゞ") == "イスズ" or to_katakana("いすゝ") == "イスス"


def test_words_are_those_of_the_dictionary_and_particles_are_said_as_they_sound() -> None:
    spoken = VOICE.speak("私は学校へ行った。")
    assert spoken.schedule.words == ("私", "は", "学校", "へ", "行っ", "た")
    assert _said("私は学校へ行った。") == "_ w a t a sh i w a g a k: o: e i t: a _"
    assert (spoken.schedule.notation, spoken.schedule.language) == ("romaji", "ja")
    assert spoken.schedule.duration == pytest.approx(spoken.sound.duration, abs=1e-6)
    assert {phone.word for phone in spoken.schedule.phones} == set(range(-1, 6))


@pytest.mark.parametrize(
    ("text", "read"),
    [
        ("今日は雨。", ["今日/キョー", "は/ワ", "雨/アメ", "."]),
        ("何ですか？何が", ["何/ナン", "です/デス’", "か/カ", "?", "何/ナニ", "が/ガ"]),
        ("そういう", ["そういう/ソーユー"]),
        ("1,234円", ["1,234/センニヒャクサンジューヨ", "円/エン"]),
        ("10:05に", ["10/ジュー", "時/ジ", "5/ゴ", "分/フン", "に/ニ"]),
        ("3〜5人", ["3/サン", "から/カラ", "5/ゴ", "人/ニン"]),
        ("$5", ["5/ゴ", "ドル/ドル"]),
        ("気温は-5度", ["気温/キオン", "は/ワ", "マイナス/マイナス", "5/ゴ", "度/ド"]),
        ("1/2", ["2/ニ", "分/ブン", "の/ノ", "1/イチ"]),
        ("AIとNHK", ["AI/エーアイ", "と/ト", "NHK/エヌエイチケイ"]),
        ("K と w", ["K/ケイ", "と/ト", "w/ダブリュー"]),
        ("「え？」と", ["え/エ", "?", "と/ト"]),
    ],
)
def test_text_is_read_as_people_say_it(text: str, read: list[str]) -> None:
    assert _read(text) == read


def test_a_reading_of_the_table_wins_and_the_words_around_it_are_read_as_ever() -> None:
    voice = replace(VOICE, reader=JapaneseReader({"魔導城": "マドウジョー", "碧": "アオイ"}))
    assert voice.speak("碧は魔導城へ行く。").schedule.words == ("碧", "は", "魔導城", "へ", "行く")
    assert _said("碧は魔導城へ", voice) == "_ a o i w a m a d o u j o: e _"


def test_punctuation_pauses_and_quotes_do_not() -> None:
    assert _said("はい、「そう」です！").count("_") == 3
    assert [len(phrase) for phrase in VOICE.phrases("はい、「そう」です！")] == [1, 2]


def test_a_sentence_without_punctuation_breathes() -> None:
    phrases = VOICE.phrases("あかさたな" * 30)
    assert len(phrases) == 2 or len(phrases) == 3
    assert VOICE.speak("さくらがさく" * 20).schedule.words


@pytest.mark.parametrize(
    "text",
    [
        "今日はいい天気ですね。",
        "きゃあああっ！えーっと、ん？",
        "クォーターとデュオ、一杯。",
        "足して、引く。",
        "すっすっすっ",
        "おおおかみ",
    ],
)
def test_phones_without_sound_are_those_that_are_spoken(text: str) -> None:
    spoken = [phone.symbol for phone in VOICE.speak(text).schedule.phones if not phone.silent]
    assert [symbol for phrase in VOICE.phrases(text) for word in phrase for symbol in word] == spoken


def _seconds(text: str, symbol: str) -> float:
    schedule = VOICE.speak(text).schedule
    at = [phone.symbol for phone in schedule.phones].index(symbol)
    return (schedule.edges[at + 1] - schedule.edges[at]) / 1e6


def test_every_mora_has_its_time() -> None:
    assert _seconds("おばさんだ", "s") < _seconds("おばっさんだ", "s") - 0.05
    assert _seconds("ここだよ", "o") < _seconds("こうこだよ", "o") - 0.03
    assert _seconds("かんたんだ", "N") > 0.06
    assert _seconds("いぱい", "p") < _seconds("いっぱい", "p") - 0.03


def test_every_kana_is_said_whole() -> None:
    syllables = [kana for kana in VOICE.syllables.phones if kana not in "ンッ"]
    for start in range(0, len(syllables), 40):
        part = syllables[start : start + 40]
        voice = replace(VOICE, reader=JapaneseReader({}))
        schedule = voice.speak("、".join(part)).schedule
        assert sum(not phone.silent for phone in schedule.phones) >= sum(len(VOICE.syllables.phones[kana]) for kana in part) - 4


def test_a_text_of_any_length_is_read() -> None:
    words = sum(len(phrase) for phrase in VOICE.phrases("私は今日も学校へ行きます" * 300))
    assert words == 8 * 300


def test_kana_are_read_without_the_extra(kana_only: None) -> None:
    assert _said("とうきょう は いい！") == "_ t o: ky o: w a i: _"
    assert VOICE.reader.read("がっこう へ、").tokens[1:] == [japanese_words.Word("へ", "エ"), Pause(",")]


@pytest.mark.parametrize("text", ["学校", "3じ", "Tシャツ"])
def test_more_than_kana_takes_the_extra_and_says_so_in_one_line(kana_only: None, text: str) -> None:
    with pytest.raises(MissingToolError, match=r"pip install 'lipdb\[ja\]'") as caught:
        VOICE.phrases(text)
    assert "\n" not in str(caught.value)


def test_signs_in_front_of_all_words_say_nothing(capfd: pytest.CaptureFixture[str]) -> None:
    assert _read("「！？ーえ」") == ["え/エ"]
    assert capfd.readouterr() == ("", "")


def test_names_of_the_table_are_read_without_the_extra(kana_only: None) -> None:
    voice = replace(VOICE, reader=JapaneseReader({"碧": "アオイ"}))
    assert voice.speak("碧 は きた").schedule.words == ("碧", "は", "きた")


@pytest.mark.parametrize(
    ("text", "message"),
    [("", "nothing in"), ("。。。", "nothing in"), ("ー", "no words"), ("Привет", "Cyrillic"), ("안녕", "Hangul"), ("😀", "nothing in")],
)
def test_bad_text_is_refused_in_one_line(text: str, message: str) -> None:
    with pytest.raises(InputError, match=message) as caught:
        VOICE.phrases(text)
    assert "\n" not in str(caught.value)


def test_the_version_changes_with_the_tables() -> None:
    changed = kana_voice({**RECORDS, "ja/readings.tsv": {("碧",): {"word": "碧", "reading": "アオイ"}}}, "ja")
    assert changed.version != VOICE.version
    assert kana_voice(RECORDS, "ja").version == VOICE.version
    assert VOICE.raw() is VOICE
