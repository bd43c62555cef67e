"""What of a text is spoken, what is left out with a note, and what is refused."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lipdb.errors import InputError
from lipdb.speech.text import check_script, clean, is_ordinary


@pytest.mark.parametrize("text", ["", " \n\t", "...", "?!", "😀😀", "\x00\x07", "—", "_", "\ud800", "\u200b"])
def test_a_text_with_nothing_to_say_is_refused(text: str):
    with pytest.raises(InputError, match=r"^text: nothing in .* can be spoken; write at least one word$"):
        clean(text)


def test_emoji_are_left_out_with_a_note():
    cleaned = clean("Hello 😀👍🏽 world ❤️")
    assert cleaned.text == "Hello world"
    assert cleaned.notes == ("text: 3 emoji or pictograms are not read",)


def test_control_characters_separate_and_are_noted():
    cleaned = clean("a\x00b\x1b c\ud800")
    assert cleaned.text == "a b c"
    assert "3 characters" in cleaned.notes[0]


def test_line_ends_and_tabs_are_plain_spaces_without_a_note():
    assert clean("one\r\ntwo\tthree") == ("one two three", ())


def test_invisible_joiners_vanish():
    assert clean("so\u00adft \u200bword\ufeff").text == "soft word"


def test_full_width_styled_and_ligature_letters_become_plain():
    assert clean("ｈｅｌｌｏ 𝐛𝐨𝐥𝐝 ﬁne Ⅷ").text == "hello bold fine VIII"


def test_arabic_is_read_however_it_was_typed():
    assert clean("\ufedb\ufe98\ufe8e\ufe8f").text == "كتاب"
    assert clean("الســـلام").text == "السلام"
    for typed in ("\u0651\u064e", "\u064e\u0651"):
        assert clean(f"ثم{typed}").text == "ثم\u0651\u064e"


def test_signs_of_devanagari_stay_and_its_joiners_vanish():
    assert clean("क्\u200dया हुआ?").text == "क्या हुआ?"
    assert clean("ज़िंदगी १२ हूँ।").text == "ज़िंदगी १२ हूँ।"


def test_powers_and_fractions_keep_their_meaning():
    assert clean("x² ½ 20 °C").text == "x² ½ 20 °C"


def test_two_full_stops_are_one_and_three_stay():
    assert clean("Wait.. what... no").text == "Wait. what... no"


def test_a_word_too_long_for_the_voice_is_cut_in_pieces_with_a_note():
    cleaned = clean("x" * 130)
    assert [len(word) for word in cleaned.text.split()] == [20] * 6 + [10]
    assert "in pieces" in cleaned.notes[0]
    assert clean("pneumonoultramicroscopicsilicovolcanoconiosis").notes == ()


def test_writing_without_spaces_is_left_whole():
    for text in ("私は今日も学校へ行きます" * 10, "我们今天去学校" * 20):
        assert clean(text) == (text, ())


def test_colours_of_a_terminal_are_no_text():
    assert clean("\x1b[31mred\x1b[0m") == ("red", ())


def test_circled_numbers_stand_apart():
    assert clean("①②").text == "1 2"


def test_currency_alone_can_be_spoken():
    assert clean("%").text == "%"


@pytest.mark.parametrize(
    ("text", "script", "what"),
    [
        ("I say 你好 now", "Latn", "'你好' at character 7 is written in Chinese characters"),
        ("Привет", "Latn", "'Привет' at character 1 is written in Cyrillic letters"),
        ("Hellо", "Latn", "'Hellо' at character 5 is written in Cyrillic letters"),
        ("Привет", "Hans", "'Привет' at character 1 is written in Cyrillic letters"),
        ("hello", "Cyrl", "'hello' at character 1 is written in Latin letters"),
        ("λόγος", "Latn", "Greek letters"),
    ],
)
def test_another_script_is_refused_with_what_and_where(text: str, script: str, what: str):
    with pytest.raises(InputError) as caught:
        check_script(text, script, language="xx")
    assert what in str(caught.value)
    assert "\n" not in str(caught.value)
    assert "--language" in str(caught.value)


@pytest.mark.parametrize("text", ["naïve café, Łódź", "5 µm of α", "$3.50 — 24/7!", "1ª 2º", "3½ cups of H₂O", "Henry Ⅷ", "β-test"])
def test_letters_of_the_script_and_symbols_pass(text: str):
    check_script(text, "Latn", language="en")


@pytest.mark.parametrize(
    ("text", "script"),
    [
        ("Её объём — 5 кг!", "Cyrl"),
        ("मैं १२ किताबें पढ़ूँगा, ठीक है? ॐ", "Deva"),
        ("هَلْ قَرَأْتَ ٢٥ كِتَابًا؟ ﷲ", "Arab"),
    ],
)
def test_vowel_signs_and_digits_of_other_scripts_pass(text: str, script: str):
    check_script(clean(text).text, script, language="xx")


def test_an_unknown_script_allows_all():
    check_script("你好 hello", "Zzzz", language="xx")


@given(st.text(st.characters()))
def test_any_text_is_cleaned_or_refused(text: str):
    try:
        cleaned = clean(text)
    except InputError as error:
        assert "\n" not in str(error)
        return
    cleaned.text.encode("utf-8")
    assert cleaned.text == clean(cleaned.text).text
    assert not any(ord(c) < 32 for c in cleaned.text)


@pytest.mark.parametrize(
    ("text", "script"),
    [("“Well, I'm off,” he said.", "Latn"), ("Übung, café", "Latn"), ("Привет, мир!", "Cyrl"), ("नमस्ते", "Deva"), ("你好", "Hans")],
)
def test_words_and_signs_without_a_name_are_ordinary(text: str, script: str):
    assert is_ordinary(text, script)


@pytest.mark.parametrize(
    "text",
    ["", "...", " a", "a ", "a  b", "a..b", "a\tb", "a5", "a & b", "1", "50 %", "😀 a", "cafe\u0301", "ﬁne", "a привет", "x" * 61, "a\0b"],
)
def test_what_has_to_be_looked_at_is_not_ordinary(text: str):
    assert not is_ordinary(text, "Latn")


@given(st.text(st.sampled_from("abc é\u0301'.,-5%ｈﬁж你\u0651\u200d😀\t\x07")), st.sampled_from(["Latn", "Cyrl", "Hans", "Xxxx"]))
def test_ordinary_text_is_left_as_it_is(text: str, script: str):
    if is_ordinary(text, script):
        assert clean(text) == (text, ())
        check_script(text, script, language="xx")
