"""`lipdb phones --ipa` and the function behind it: every segment of the IPA has an answer, however it is typed."""

import json
import unicodedata

import pytest
from click.testing import CliRunner

from lipdb.cli import cli
from lipdb.phones.proposal import propose

CHART = """
p b t d ʈ ɖ c ɟ k ɡ q ɢ ʔ m ɱ n ɳ ɲ ŋ ɴ ʙ r ʀ ⱱ ɾ ɽ ɸ β f v θ ð s z ʃ ʒ ʂ ʐ ç ʝ x ɣ χ ʁ ħ ʕ h ɦ ɬ ɮ ʋ ɹ ɻ j ɰ l ɭ ʎ ʟ
ʘ ǀ ǃ ǂ ǁ ɓ ɗ ʄ ɠ ʛ pʼ tʼ kʼ sʼ
ʍ w ɥ ʜ ʢ ʡ ɕ ʑ ɺ ɧ k͡p ɡ͡b t͡s t͜s
i y ɨ ʉ ɯ u ɪ ʏ ʊ e ø ɘ ɵ ɤ o ə ɛ œ ɜ ɞ ʌ ɔ æ ɐ a ɶ ɑ ɒ
a̋ á ā à ȁ ǎ â a᷄ a᷅ a᷈ a˥ a˦ a˧ a˨ a˩ a˩˥ aꜜ aꜛ ↗a ↘a ˈa ˌa a.
"""
MORE = "ɚ ɝ ə˞ a˞ ᵻ ᵿ ɿ ʅ ʮ ʯ ȶ ȵ ɫ ᶑ ꞎ 𝼆 𝼄 𝼅 𝼈 𝼊"
# Diacritics that the chart shows; what stands for a letter is a circle.
UNSEEN = "◌̥ ◌̊ ◌̬ ◌ʰ ◌̤ ◌̰ ◌ʲ ◌ˠ ◌ˤ ◌̴ ◌̺ ◌̻ ◌̃ ◌ⁿ ◌ˡ ◌̚ ◌̘ ◌̙ ◌̆ ◌ː ◌ˑ"
SEEN = "◌̹ ◌̜ ◌̟ ◌̠ ◌̈ ◌̽ ◌̩ ◌̯ ◌˞ ◌̼ ◌̪ ◌ʷ ◌̝ ◌̞"
COMMON = {"aa", "ah", "ao", "aw", "ay", "bmp", "d", "eh", "er", "f", "h", "ih", "kg", "l", "ow", "oy", "r", "sh", "th", "ue", "w", "z"}


def run(lines, *options):
    text = lines if isinstance(lines, bytes) else "\n".join(lines).encode()
    return CliRunner().invoke(cli, ["phones", "--ipa", *options], input=text)


def listed(lines):
    return json.loads(run(lines, "--json").stdout)


@pytest.mark.parametrize("segment", (CHART + MORE).split())
def test_every_segment_of_the_chart_has_an_answer(segment):
    found = propose(segment)
    assert found.common
    assert set(found.common) <= COMMON
    assert 0 < found.confidence <= 1
    assert found.reason


@pytest.mark.parametrize("mark", f"{UNSEEN} {SEEN}".split())
@pytest.mark.parametrize("base", ["t", "b", "a", "u"])
def test_every_diacritic_of_the_chart_is_read_on_any_letter(base, mark):
    assert propose(mark.replace("◌", base)).common
    assert "nothing is known" not in propose(mark.replace("◌", base)).reason


@pytest.mark.parametrize("mark", UNSEEN.split())
@pytest.mark.parametrize("base", ["t", "b", "ʃ", "ŋ", "a", "u"])
def test_a_diacritic_that_the_face_does_not_show_changes_nothing(base, mark):
    assert propose(mark.replace("◌", base)).common == propose(base).common


@pytest.mark.parametrize(
    ("segment", "common"),
    [
        # Lips: rounding shows, closures win, teeth on lips.
        ("kʷ", "kg w"), ("tᶣ", "d ue"), ("ʃʷ", "sh"), ("ʷa", "w aa"), ("k͡p", "bmp"), ("ŋ͡m", "bmp"), ("t͡ʙ̥", "bmp"), ("p̪", "f"), ("m̪", "f"),
        ("ɰᵝ", "w"), ("ɯᵝ", "w"), ("t̼", "th"),
        # Prenasals, preaspirates, affricates, ejectives, implosives.
        ("ᵐb", "bmp"), ("ⁿd͡ʒ", "sh"), ("ᵑɡ", "kg"), ("ŋɡ", "kg"), ("ʰt", "d"), ("ˀb", "bmp"), ("tˢ", "z"), ("t͡ɬʼ", "l"), ("q͡χʼ", "kg"),
        ("ɗ̥", "d"), ("k͡s", "kg z"), ("p͡f", "bmp f"), ("t͡ɕ͈", "sh"),
        # Clicks with accompaniments.
        ("ɡǀʱ", "d"), ("ŋ̊ǃʰ", "d"), ("ǃ͡qʼ", "d"), ("k͡ǂʰ", "d"), ("ᵑǁ", "l"), ("k͡ʘ", "bmp"),
        # Syllabics and r.
        ("m̩", "bmp"), ("l̩", "l"), ("ɹ̩", "er"), ("r̝̊", "sh"), ("ɽ", "d"), ("ɑ˞", "aa er"), ("ɻ", "r"),
        # Diphthongs and triphthongs.
        ("aɪ̯", "ay"), ("aːj", "ay"), ("ɔʏ", "oy"), ("əʊ", "ow"), ("uj", "w ih"),
        ("iu̯", "ih w"), ("ɐ̃w̃", "aw"), ("ɯəj", "ih ah ih"), ("u̯ai̯", "w ay"),
        ("øʏ", "ue"), ("œ̃", "ue"), ("i̯ɛ", "ih eh"),
        # Consonants of single languages.
        ("ɧ", "sh"), ("ð̠˕ˠ", "th"), ("ɬ", "l"), ("ʎ", "l"), ("ɲ", "d"), ("ħ", "h"), ("ɣ", "kg"), ("β̞", "f"), ("ʋ", "f"),
        ("dʲ", "d"), ("lˠ", "l"),
    ],
)  # fmt: skip
def test_segments_of_many_languages_go_where_they_are_seen(segment, common):
    assert propose(segment).common == tuple(common.split())


@pytest.mark.parametrize(
    ("typed", "meant"),
    [
        ("g", "ɡ"), ("iː", "i:"), ("kʼ", "k'"), ("kʼ", "k’"), ("[ʁ]", "ʁ"), ("/ʁ/", "ʁ"), ("t͜s", "t͡s"), ("ts", "t͡s"),
        ("ʦ", "t͡s"), ("ʧ", "t͡ʃ"),
        ("ε", "ɛ"), ("ǝ", "ə"), ("ә", "ə"), ("!", "ǃ"), ("||", "ǁ"), ("k|", "kǀ"),
        ("φ", "ɸ"), ("ꞵ", "β"), ("t⁀ʃ", "tʃ"), ("þ", "θ"), ("š", "ʃ"), ("ɚ", "ə˞"),
        ("ma55", "ma"), ("ˈta", "ta"), (" a ɪ ", "aɪ"),
    ],
)  # fmt: skip
def test_look_alikes_brackets_and_other_spellings_are_read(typed, meant):
    assert propose(typed).common == propose(meant).common


@pytest.mark.parametrize("segment", ["ç", "ã", "õ", "ɐ̃", "ä", "t̪ʰ", "ð̠˕", "n̥̩"])
def test_composed_and_decomposed_text_are_the_same(segment):
    assert propose(unicodedata.normalize("NFC", segment)).common == propose(unicodedata.normalize("NFD", segment)).common


def test_the_command_prints_one_object_a_line_in_order_and_skips_empty_lines():
    found = listed(["t͡ɕʰ", "", "aɪ", "   ", "aɪ", "kʷ"])
    assert [(entry["ipa"], entry["common"]) for entry in found] == [("t͡ɕʰ", ["sh"]), ("aɪ", ["ay"]), ("aɪ", ["ay"]), ("kʷ", ["kg", "w"])]
    assert all(isinstance(entry["confidence"], float) and isinstance(entry["reason"], str) for entry in found)


def test_a_list_in_utf_16_is_read_as_well():
    result = CliRunner().invoke(cli, ["phones", "--ipa", "--json"], input="ʃ\nȹ\n".encode("utf-16"))
    assert [(entry["ipa"], entry["common"]) for entry in json.loads(result.stdout)] == [("ʃ", ["sh"]), ("ȹ", ["f"])]


def test_lines_that_are_no_ipa_are_listed_and_end_with_exit_code_5():
    result = run(["p", "§", "˥", "XYZ", "你", "m"], "--json")
    found = json.loads(result.stdout)
    assert [entry["common"] for entry in found] == [["bmp"], [], [], [], [], ["bmp"]]
    assert [entry["confidence"] for entry in found][1:5] == [0, 0, 0, 0]
    assert result.exception.exit_code == 5
    assert "4 of 6 lines" in str(result.exception)


def test_bytes_that_are_no_text_are_a_line_like_others():
    result = run(b"\xef\xbb\xbfp\r\n\xff\xfe\r\nm\r\n", "--json")
    assert [entry["common"] for entry in json.loads(result.stdout)] == [["bmp"], [], ["bmp"]]


def test_without_json_it_is_a_table():
    header, row = run(["θ"]).stdout.splitlines()
    assert header.split("\t")[:4] == ["ipa", "common", "confidence", "reason"]
    assert row.split("\t")[:2] == ["θ", "th"]


def test_no_input_is_an_empty_list():
    assert listed([]) == []


def test_text_and_ipa_together_are_wrong_use():
    assert CliRunner().invoke(cli, ["phones", "--ipa", "hello"]).exit_code == 2
    assert CliRunner().invoke(cli, ["phones"]).exit_code == 2


def test_a_persons_row_wins_over_the_rules():
    row = {"phone": "ʁ", "common": "h", "origin": "authored", "author": "ana", "comment": "seen in a mirror"}
    assert propose("ʁ", {("ʁ",): row}).common == ("h",)
    assert propose("ʁ", {("ʁ",): row}).reason == "seen in a mirror"
    assert propose("ʁ", {("ʁ",): row | {"origin": "generated"}}).common == ("kg",)


def test_a_mark_that_nothing_is_known_of_asks_for_review():
    found = propose("t\u0363")
    assert found.common == ("d",)
    assert found.review
    assert found.confidence < propose("t").confidence


def test_what_is_heard_and_not_seen_is_named():
    assert propose("ãː˥").reason.endswith("(nasality, length, tone: not seen)")
    assert "breath" in propose("tʰ").reason


def test_a_bar_is_a_click_that_may_be_a_pause():
    assert propose("|").common == propose("ǀ").common
    assert propose("|").review
    assert not propose("ǁ").review
