"""Chinese characters and pinyin to timed initials and finals."""

from __future__ import annotations

import pytest

from lipdb.curated.tsv import Records
from lipdb.errors import InputError
from lipdb.schedule import Phone
from lipdb.speech.mandarin import PinyinVoice, pinyin_voice, split_ipa
from lipdb.speech.pinyin import Foreign, Pause, Syllable

SYLLABLES = """
a:a an:an ba:b+a bei:b+ei dian:d+ian er:er ge:g+e guo:g+uo hao:h+ao hua:h+ua hui:h+uei jing:j+ing ji:j+i ju:j+ü nüe:n+üe
kai:k+ai le:l+e ling:l+ing lü:l+ü lüan:l+üan m:m ma:m+a men:m+en nian:n+ian ni:n+i nü:n+ü qi:q+i ren:r+en san:s+an
shi:sh+-i(zh) shou:sh+ou si:s+-i(z) wo:uo xi:x+i xian:x+ian xiong:x+iong yi:i yong:iong zhong:zh+ong zi:z+-i(z) bai:b+ai
fen:f+en zhi:zh+-i(zh) wu:u shu:sh+u na:n+a kan:k+an
"""
ERHUA = ("ua+r", "ian+r", "uei+r", "a+r")
READINGS = {"花儿": "huar1", "一点儿": "yi4 dianr3", "哪儿": "nar3", "wechat": "wo3 ge4"}
SEGMENTS = ["aɪ", "f", "əʊ", "n", "ɒ", "b", "k", "a", "i", "s", "ə", "ɪ", "eɪ"]


def _records() -> Records:
    rows = {}
    for entry in SYLLABLES.split():
        syllable, parts = entry.split(":")
        initial, _, final = parts.rpartition("+")
        rows[(syllable,)] = {"syllable": syllable, "initial": initial, "final": final}
    finals = {row["final"] for row in rows.values()} | {row["initial"] for row in rows.values()} | set(ERHUA)
    return {
        "cmn/language.tsv": {("cmn",): {"voice": "cmn-latn-pinyin", "script": "Hans"}},
        "cmn/phones.tsv": {(name,): {} for name in finals},
        "cmn/syllables.tsv": rows,
        "cmn/readings.tsv": {(word,): {"reading": reading} for word, reading in READINGS.items()},
        "ipa.tsv": {(segment,): {} for segment in SEGMENTS},
    }


VOICE = pinyin_voice(_records(), "cmn")


def _read(text: str) -> list[str]:
    """Syllables with tones, punctuation, and foreign words in brackets."""
    shown = []
    for token in VOICE.reader.read(text).tokens:
        match token:
            case Syllable():
                shown.append(f"{token.plain}{token.tone}")
            case Pause(mark):
                shown.append(mark)
            case Foreign(word):
                shown.append(f"<{word}>")
    return shown


def _symbols(text: str) -> list[str]:
    return [phone.symbol for phone in VOICE.speak(text).schedule.phones]


def test_characters_become_initials_and_finals_with_the_tone_on_the_final():
    spoken = VOICE.speak("你好，中国。")
    schedule = spoken.schedule
    assert schedule.words == ("你", "好", "中", "国")
    assert [p.symbol for p in schedule.phones] == ["_", "n", "i", "h", "ao", "_", "zh", "ong", "g", "uo", "_"]
    assert [p.tone for p in schedule.phones] == [0, 0, 2, 0, 3, 0, 0, 1, 0, 2, 0]
    assert [p.word for p in schedule.phones] == [-1, 0, 0, 1, 1, -1, 2, 2, 3, 3, -1]
    assert (schedule.notation, schedule.language) == ("pinyin", "cmn")
    assert schedule.duration == pytest.approx(spoken.sound.duration, abs=1e-6)


@pytest.mark.parametrize(
    ("text", "read"),
    [
        ("ni3 hao3", ["ni3", "hao3"]),
        ("Ni3hao3!", ["ni3", "hao3", "!"]),
        ("nǐ hǎo, nǚ", ["ni3", "hao3", ",", "nü3"]),
        ("nǐhǎo", ["ni3", "hao3"]),
        ("Xī'ān xiān", ["xi1", "an1", "xian1"]),
        ("nü3 nv3 nu:3 lvan4", ["nü3", "nü3", "nü3", "lüan4"]),
        ("huar1 dianr3", ["huar1", "dianr3"]),
        ("nǚér", ["nü3", "er2"]),
        ("ma ma0 ma5", ["ma5", "ma5", "ma5"]),
        ("ni3,hao3", ["ni3", ",", "hao3"]),
        ("nue4 jü1 m̀", ["nüe4", "ju1", "m4"]),
    ],
)
def test_pinyin_with_numbers_or_marks(text: str, read: list[str]):
    assert _read(text) == read


def test_sandhi_of_characters_is_said_and_typed_tones_stay():
    assert _read("你好") == ["ni2", "hao3"]
    assert _read("一个人") == ["yi2", "ge4", "ren2"]
    assert _read("ni3 hao3") == ["ni3", "hao3"]


def test_a_reading_of_the_table_makes_er_part_of_the_syllable_in_front():
    assert _read("花儿开") == ["huar1", "kai1"]
    assert _read("女儿") == ["nü3", "er2"]
    assert _read("花儿子") == ["hua1", "er2", "zi5"]
    assert _symbols("花儿")[1:-1] == ["h", "ua+r"]


def test_third_tones_that_meet_at_a_reading_change_too():
    assert _read("你哪儿") == ["ni2", "nar3"]


def test_a_coloured_final_lasts_to_the_end_of_its_r():
    plain, coloured = (VOICE.speak(text).schedule for text in ("hua1", "huar1"))
    assert coloured.edges[3] - coloured.edges[2] > plain.edges[3] - plain.edges[2] + 30_000


@pytest.mark.parametrize("syllable", ["xiong1", "lüan4", "m2"])
def test_syllables_that_espeak_has_no_rule_for_are_said_in_mandarin(syllable: str):
    symbols = _symbols(syllable)[1:-1]
    assert tuple(symbols) == VOICE.reader.syllables.phones[syllable[:-1]]


def test_numbers_are_read_in_chinese():
    assert _read("3.5个") == ["san1", "dian3", "wu3", "ge4"]
    assert _read("50%") == ["bai3", "fen1", "zhi1", "wu3", "shi2"]
    assert _read("ni3 3") == ["ni3", "san1"]


def test_latin_words_among_characters_are_read_as_english_with_a_note():
    spoken = VOICE.speak("我用iPhone手机")
    assert "iPhone" in spoken.schedule.words
    word = spoken.schedule.words.index("iPhone")
    assert [p.symbol for p in spoken.schedule.phones if p.word == word] == ["[aɪ]", "[f]", "[əʊ]", "[n]"]
    assert spoken.notes == ("text: iPhone read as English",)
    assert VOICE.phrases("我用iPhone")[0][2] == ("[aɪ]", "[f]", "[əʊ]", "[n]")


def test_a_single_letter_among_characters_is_said_by_its_name():
    assert _symbols("我A4")[2] == "[eɪ]"
    assert VOICE.phrases("我A4")[0][1] == ("[eɪ]",)


def test_signs_that_nobody_reads_are_noted():
    assert VOICE.speak("你²好%").notes == ("text: ² % can't be read and is left out",)


def test_a_repetition_mark_repeats():
    assert _read("人々") == ["ren2", "ren2"]


def test_words_that_look_like_pinyin_without_tones_are_english_among_characters():
    assert _read("我kan手") == ["wo3", "<kan>", "shou3"]
    assert _read("我kàn手") == ["wo3", "kan4", "shou3"]
    assert _read("A4") == ["a4"]
    assert _read("我A4") == ["wo3", "<A>", "si4"]


def test_a_reading_of_the_table_wins_over_english():
    assert _read("我WeChat") == ["wo3", "wo3", "ge4"]


def test_punctuation_gives_a_pause_and_quotes_do_not():
    assert _symbols("你，好").count("_") == 3
    assert _symbols("你。好！好；好").count("_") == 5
    assert _symbols("你“好”").count("_") == 2


def test_a_text_without_punctuation_breathes_and_no_syllable_is_lost():
    schedule = VOICE.speak("你好中国" * 100).schedule
    assert len(schedule.words) == 400
    assert {phone.word for phone in schedule.phones} == set(range(-1, 400))
    assert sum(phone.silent for phone in schedule.phones) == 2 + 400 // 60


def test_phones_without_sound_are_those_that_are_spoken():
    for text in ("你好，中国。", "huar1 xiong1", "我用iPhone手机", "一点儿"):
        spoken = VOICE.speak(text).schedule
        assert [s for phrase in VOICE.phrases(text) for word in phrase for s in word] == [p.symbol for p in spoken.phones if not p.silent]


def test_every_syllable_of_the_table_is_said_whole_in_every_tone():
    for tone in range(1, 6):
        spelled = [f"{syllable}{tone}" for syllable in VOICE.reader.syllables.phones]
        schedule = VOICE.speak(" ".join(spelled)).schedule
        said = [tuple(p.symbol for p in schedule.phones if p.word == word) for word in range(len(spelled))]
        assert said == list(VOICE.reader.syllables.phones.values())


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "nothing in '' can be spoken"),
        ("。。。", "nothing in"),
        ("ong1", "'ong' is neither Chinese nor pinyin"),
        ("fiao4", "neither Chinese nor pinyin"),
        ("Hello world", "'Hello' is neither Chinese nor pinyin"),
        ("Привет", "Cyrillic letters"),
        ("こんにちは", "Hiragana letters"),
        ("𠮷", "nobody knows how to read '𠮷'"),
        ("龙", "'龙' is read 'long', which is no syllable"),
        ("%", "no words"),
    ],
)
def test_bad_text_is_refused_in_one_line(text: str, message: str):
    with pytest.raises(InputError) as caught:
        VOICE.speak(text)
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


def test_espeak_phonemes_in_a_text_are_plain_text():
    assert _symbols("你[[a]]好") == _symbols("你 a 好")


def test_the_version_changes_with_the_tables():
    changed = pinyin_voice({**_records(), "cmn/readings.tsv": {}}, "cmn")
    assert isinstance(VOICE, PinyinVoice)
    assert changed.version != VOICE.version
    assert pinyin_voice(_records(), "cmn").version == VOICE.version


def test_a_foreign_label_is_cut_into_segments_that_the_common_layer_knows():
    known = {"ɑ", "ɹ", "aɪ", "əʊ", "iː"}
    assert split_ipa("ˈɑːɹ1", known) == ["ɑ", "ɹ"]
    assert split_ipa("aɪ22", known) == ["aɪ"]
    assert split_ipa("əʊəʊ", known) == ["əʊ"]
    assert split_ipa("ɒɜ", {"ɒ", "ɜ"}) == ["ɒ"]
    assert split_ipa("ɜː", {"ɜ"}) == ["ɜ"]
    assert split_ipa("iː", known) == ["iː"]
    assert split_ipa("ʘɹ", known) == ["ʘ", "ɹ"]


def test_silence_is_no_word():
    assert VOICE.speak("你").schedule.phones[0] == Phone("_")
