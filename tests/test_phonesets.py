"""English and Mandarin as they ship: what labels of common tools mean, and what syllables are made of."""

import pytest

from lipdb.curated.folder import read_folder
from lipdb.paths import data_dir
from lipdb.phones.phoneset import PhoneSet
from lipdb.schedule import SILENCE, Schedule

# Labels that SPPAS writes into its PhonAlign tier for English, and for Mandarin.
SPPAS_ENGLISH = "@ n t l i: s # m z r k E d p i w { aI 3:r u A D f v O: b eI 4 I N @U g h V j aU T U dZ S tS Z +"
SPPAS_MANDARIN = "a i u S n N t o s` ss i` e tss l x t_h ts k_h ts` y m ts_hs ts_h` p k s f i_d z` @` ts_h p_h #"
# What eSpeak NG 1.52 writes for English in nine voices, beside the stress marks.
ESPEAK = """
t n s ə ð d l k ɹ z ɪ p w f m b ɛ æ eɪ aɪ v iː h ɐ oʊ ʌ ɚ ɡ uː ɑː ŋ ʃ ɜː tʃ i ɔː ɔːɹ ɑːɹ aʊ θ dʒ j ɔ ᵻ ɾ ʊ əl ɛɹ ɔɪ ɪɹ aɪɚ ʊɹ ʔ
n̩ iə ʒ a ɒ əʊ eə aɪə ʊə r eː oː ʉː ʌʉ aː a: ʉ o ʌɹ əɹ ʍ e ɜ ʲ ʉɹ ɑə oə aa ɔə t̪ æʊ ei ʌʊ əu oɪ ɛə əɪ x ɬ ɑ̃ ɔ̃ l̩ m̩
"""


@pytest.fixture(scope="module")
def records():
    return read_folder(data_dir("phonesets"))


@pytest.fixture(scope="module")
def english(records):
    return PhoneSet.from_records(records, "en")


@pytest.fixture(scope="module")
def mandarin(records):
    return PhoneSet.from_records(records, "cmn")


def resolve(phoneset, labels, notation):
    raw = Schedule.from_intervals([(i / 10, (i + 1) / 10, label) for i, label in enumerate(labels)], notation=notation)
    return phoneset.resolve(raw)[0].phones


def common(phoneset, label, notation):
    return " ".join(name for phone in resolve(phoneset, [label], notation) for name in phone.common)


# English


def test_every_label_of_sppas_is_an_english_phone_or_a_pause(english):
    phones = resolve(english, SPPAS_ENGLISH.split(), "sppas")
    assert {phone.layer for phone in phones if not phone.silent} == {"language:en"}
    assert [phone.silent for phone in phones] == [label in "#+" for label in SPPAS_ENGLISH.split()]


@pytest.mark.parametrize("stress", ["", "ˈ", "ˌ"])
def test_every_label_of_espeak_is_made_of_english_phones(english, stress):
    phones = resolve(english, [stress + label for label in ESPEAK.split()], "espeak")
    assert {phone.layer for phone in phones} == {"language:en"}


@pytest.mark.parametrize(
    ("label", "phones"),
    [
        ("ɑːɹ", "A r"),
        ("aɪɚ", "aI 3`"),
        ("əl", "@ l"),
        ("ɔːɹ", "O r"),
        ("ɪɹ", "I r"),
        ("ʊɹ", "U r"),
        ("ɛɹ", "E r"),
        ("iə", "i @"),
        ("n̩", "n"),
        ("ʔ", "t"),
    ],
)
def test_composites_of_espeak_are_split(english, label, phones):
    assert [phone.symbol for phone in resolve(english, [label], "espeak")] == phones.split()


NOTATIONS = {
    "sampa": "{ V @ A O eI E 3` I i w u U oU aU OI aI h r l s z S tS dZ Z j T D f v d t n N k g p b m",
    "arpabet": "AE AH AX AA AO EY EH ER IH IY W UW UH OW AW OY AY HH R L S Z SH CH JH ZH Y TH DH F V D T N NG K G P B M",
    "cmudict": "AE1 AH1 AH0 AA2 AO1 EY1 EH1 ER0 IH1 IY0 W UW1 UH1 OW1 AW1 OY1 AY1 HH R L S Z SH CH JH ZH Y TH DH F V D T N NG K G P B M",
    "sapi": "ae ah ax aa ao ey eh er ih iy w uw uh ow aw oy ay h r l s z sh ch jh zh y th dh f v d t n ng k g p b m",
    "timit": "ae ah ax aa ao ey eh er ih iy w uw uh ow aw oy ay hh r l s z sh ch jh zh y th dh f v d t n ng k g p b m",
    "ipa": "æ ʌ ə ɑ ɔ eɪ ɛ ɝ ɪ i w u ʊ oʊ aʊ ɔɪ aɪ h ɹ l s z ʃ tʃ dʒ ʒ j θ ð f v d t n ŋ k ɡ p b m",
    "mfa": "æ ɐ ə ɑː ɒː ej ɛ ɝ ɪ iː w ʉː ʊ ow aw ɔj aj h ɹ l s z ʃ tʃ dʒ ʒ j θ ð f v d t n ŋ k ɡ p b m",
    "kirshenbaum": "& V @ A O eI E R I i w u U oU aU OI aI h r l s z S tS dZ Z j T D f v d t n N k g p b m",
    "worldbet": "@ ^ & A > ei E 3r I i: w u U oU aU >i aI h 9r l s z S tS dZ Z j T D f v d t n N k g p b m",
    "cereproc": "ae ah ax aa ao ey eh er ih iy w uw uh ow aw oy ay hh r l s z sh ch jh zh y th dh f v d t n ng k g p b m",
    "sampa_gb": "{ V @ A: O: eI e 3: I i: w u: U @U aU OI aI h r l s z S tS dZ Z j T D f v d t n N k g p b m",
}


@pytest.mark.parametrize("notation", NOTATIONS)
def test_all_notations_write_the_same_40_phones(records, english, notation):
    own = NOTATIONS["sampa"].split()
    assert sorted(own) == sorted(phone for (phone,) in records["en/phones.tsv"])
    assert [phone.symbol for phone in resolve(english, NOTATIONS[notation].split(), notation)] == own


@pytest.mark.parametrize(
    "mark", ["sil", "sp", "spn", "<eps>", "SIL", "SPN", "", "#", "+", "*", "@@", "dummy", "laugh", "noise", "gb", "pau", "h#"]
)
def test_marks_of_aligners_are_pauses(english, mandarin, mark):
    for phoneset, notation in ((english, "arpabet"), (english, "sppas"), (mandarin, "sppas")):
        assert common(phoneset, mark, notation) == SILENCE


def test_a_filled_pause_opens_the_mouth(english, mandarin):
    assert common(english, "fp", "sppas") == common(mandarin, "fp", "sppas") == "ah"


# Mandarin


def test_every_label_of_sppas_is_a_mandarin_phone_or_a_pause(mandarin):
    phones = resolve(mandarin, SPPAS_MANDARIN.split(), "sppas")
    assert {phone.layer for phone in phones if not phone.silent} == {"language:cmn"}


@pytest.mark.parametrize(
    ("label", "mapped"),
    [
        ("t-S", "d ah"),
        ("p-a", "bmp aa"),
        ("u-o", "w ao"),
        ("s`-i`", "sh ih"),
        ("ts_h`-u-ts_hs-y", "sh w sh ue"),
        ("t_h-i-S-N", "d ih ah d"),
    ],
)
def test_joined_labels_of_sppas_are_split(mandarin, label, mapped):
    assert common(mandarin, label, "sppas") == mapped


def test_all_422_syllables_and_their_tones_are_read(records, mandarin):
    syllables = [syllable for (syllable,) in records["cmn/syllables.tsv"]]
    assert len(syllables) == 422
    for tone in range(1, 6):
        phones = resolve(mandarin, [f"{syllable}{tone}" for syllable in syllables], "pinyin")
        assert {phone.tone for phone in phones} == {0, tone}
        assert {phone.layer for phone in phones} == {"language:cmn"}


def plain(ipa):
    """*ipa* without the marks of syllabic nasals, and with one letter for h: grunts such as hm are breathed."""
    return ipa.replace("m\u0329", "m").replace("n\u0329", "n").replace("\u030d", "").replace("h", "x")


def test_the_table_of_syllables_says_what_their_phones_say(records):
    phones = records["cmn/phones.tsv"]
    for row in records["cmn/syllables.tsv"].values():
        segments = " ".join(phones[part,]["ipa"] for part in (row["initial"], row["final"]) if part)
        assert plain(row["ipa"]) == plain(segments)


def test_all_37_finals_that_an_r_can_colour_are_there(records):
    coloured = [row for row in records["cmn/phones.tsv"].values() if row["kind"] == "erhua"]
    assert len(coloured) == 37
    assert all(row["common"].endswith("er") for row in coloured)


@pytest.mark.parametrize(
    ("syllable", "mapped"),
    [
        ("de5", "d ah"), ("shi4", "sh ih"), ("si4", "z ih"), ("er4", "er"), ("bo1", "bmp w ao"), ("wo3", "w ao"), ("nü3", "d ue"),
        ("ju2", "sh ue"), ("yue4", "ue eh"), ("quan2", "sh ue eh d"), ("yun2", "ue d"), ("xiong2", "sh ue w d"), ("yan2", "ih eh d"),
        ("wan3", "w aa d"), ("huar1", "h w aa er"), ("shir4", "sh er"), ("hao3", "h aw"), ("gui4", "kg w eh"), ("liu4", "l ih ow"),
        ("m2", "bmp"), ("lüe4", "l ue eh"), ("lue4", "l ue eh"), ("nve4", "d ue eh"),
    ],
)  # fmt: skip
def test_syllables_have_the_lips_that_they_are_said_with(mandarin, syllable, mapped):
    assert common(mandarin, syllable, "pinyin") == mapped


def test_only_finals_with_u_dots_ask_for_the_class_that_mandarin_adds(records):
    round_front = {row["phone"] for row in records["cmn/phones.tsv"].values() if "ue" in row["common"].split()}
    assert round_front == {"ü", "üe", "üan", "ün", "iong", "ü+r", "üe+r", "üan+r", "ün+r", "iong+r"}


def test_every_ipa_spelling_of_mandarin_resolves_in_the_language(records, mandarin):
    segments = sorted({segment for row in records["cmn/syllables.tsv"].values() for segment in row["ipa"].split()})
    assert {phone.layer for phone in resolve(mandarin, segments, "ipa")} == {"language:cmn"}
