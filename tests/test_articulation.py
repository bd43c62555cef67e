"""IPA segments are classified, and compared, by what lips, jaw and tongue visibly do."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lipdb.curated.folder import read_folder
from lipdb.paths import data_dir
from lipdb.phones.articulation import NEUTRAL, classify
from lipdb.phones.letters import LETTERS
from lipdb.phones.likeness import distance, nearest
from lipdb.phones.segments import read_segment

ENGLISH = {
    "æ": "ah", "ʌ": "ah", "ə": "ah", "ɑ": "aa", "ɔ": "ao", "eɪ": "eh", "ɛ": "eh", "ɝ": "er", "ɪ": "ih", "i": "ih", "w": "w", "u": "w",
    "ʊ": "w", "oʊ": "ow", "aʊ": "aw", "ɔɪ": "oy", "aɪ": "ay", "h": "h", "ɹ": "r", "l": "l", "s": "z", "z": "z", "ʃ": "sh", "tʃ": "sh",
    "dʒ": "sh", "ʒ": "sh", "j": "sh", "θ": "th", "ð": "th", "f": "f", "v": "f", "d": "d", "t": "d", "n": "d", "ŋ": "d", "k": "kg",
    "ɡ": "kg", "p": "bmp", "b": "bmp", "m": "bmp",
}  # fmt: skip
PAPER = set(ENGLISH.values())


@pytest.mark.parametrize(("segment", "common"), ENGLISH.items())
def test_the_rules_place_each_english_phone_as_the_paper_does(segment, common):
    assert classify(segment).common == (common,)


@pytest.mark.parametrize(
    ("segment", "common"),
    [
        ("y", "ue"),
        ("ø", "ue"),
        ("ɥ", "ue"),
        ("ɕ", "sh"),
        ("x", "kg"),
        ("ʎ", "l"),
        ("ɲ", "d"),
        ("ɓ", "bmp"),
        ("ʋ", "f"),
        ("ħ", "h"),
        ("ʉ", "w"),
    ],
)
def test_sounds_that_english_lacks_go_to_the_class_that_looks_like_them(segment, common):
    assert classify(segment).common == (common,)


@pytest.mark.parametrize(
    ("segment", "common"),
    [("aɪə", "ay ah"), ("ʊə", "w ah"), ("ɑːɹ", "aa r"), ("əl", "ah l"), ("ks", "kg z"), ("iou", "ih ow"), ("ɑ˞", "aa er"), ("p͡f", "bmp f")],
)
def test_a_segment_without_a_class_of_its_own_becomes_several_common_phones(segment, common):
    assert classify(segment).common == tuple(common.split())


@pytest.mark.parametrize(
    ("segment", "like"), [("t͡sʰ", "s"), ("tɕ", "ɕ"), ("ʈ͡ʂ", "ʂ"), ("tˤ", "t"), ("n̪", "n"), ("iː", "i"), ("ɛ̃", "ɛ"), ("g", "ɡ"), ("ʧ", "tʃ")]
)
def test_length_secondary_articulation_and_spelling_do_not_change_the_class(segment, like):
    assert classify(segment).common == classify(like).common


def test_of_two_closures_at_once_the_lips_are_seen():
    assert classify("k͡p").common == classify("ŋm").common == ("bmp",)


def test_a_classification_says_how_sure_it_is_and_why():
    sure, unsure = classify("p"), classify("β")
    assert sure.confidence == 1.0
    assert unsure.confidence < sure.confidence
    assert sure.reason == "the lips close"


def test_a_text_without_ipa_letters_has_no_class():
    assert classify("§") is None
    assert classify("") is None
    assert nearest("§", {"ah": "ʌ"}) is None


@given(st.text(st.sampled_from([*LETTERS, "ː", "\u0361", "˞", "\u0329", "ʰ", "§", "4", " "]), max_size=5))
def test_any_text_is_classified_into_known_classes_or_not_at_all(text):
    found = classify(text)
    assert (found is None) == (not read_segment(text).letters)
    if found:
        assert found.common
        assert set(found.common) <= PAPER | {"ue"}
        assert 0 < found.confidence <= 1
        assert found.reason


def test_the_neutral_vowel_is_a_class_of_the_paper():
    assert NEUTRAL in PAPER


def test_the_generated_rows_of_the_ipa_table_are_what_the_rules_propose():
    rows = read_folder(data_dir("phonesets"))["ipa.tsv"].values()
    wrong = {
        r["phone"]: r["common"] for r in rows if r["origin"] == "generated" and tuple(r["common"].split()) != classify(r["phone"]).common
    }
    assert wrong == {}


def test_the_ipa_table_has_every_letter_of_the_chart():
    rows = read_folder(data_dir("phonesets"))["ipa.tsv"]
    assert set(LETTERS) <= {phone for (phone,) in rows}


@given(st.sampled_from(sorted(LETTERS)), st.sampled_from(sorted(LETTERS)))
def test_distance_is_symmetric_and_zero_to_itself(one, other):
    assert distance(one, other) == distance(other, one) >= 0
    assert distance(one, one) == 0


@pytest.mark.parametrize(
    ("segment", "name"),
    [("m", "bmp"), ("β", "f"), ("ʑ", "sh"), ("t͡ɕ", "sh"), ("t͡s", "z"), ("ɯ", "ih"), ("ɣ", "kg"), ("ʏ", "ue"), ("ɛː", "eh"), ("w", "u")],
)
def test_the_nearest_phone_looks_alike(segment, name):
    typical = {"bmp": "p", "f": "f", "sh": "ʃ", "z": "s", "ih": "i", "kg": "k", "ue": "y", "eh": "ɛ", "aa": "ɑ", "ow": "oʊ", "u": "u"}
    assert nearest(segment, typical)[0] == name


def test_of_equally_near_phones_the_first_is_taken():
    assert nearest("d", {"one": "t", "two": "t"}) == ("one", 0.0)
