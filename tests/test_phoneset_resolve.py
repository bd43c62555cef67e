"""Labels of any notation become phones of the language with common phones, attributes and layers."""

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lipdb.curated.schema import table_of
from lipdb.curated.tsv import canonical_row, key_of
from lipdb.errors import InputError, PhonesetError, ScheduleError, UnknownSymbolError
from lipdb.phones.phoneset import PhoneSet
from lipdb.schedule import SILENCE, Phone, Schedule

SOURCED = {"source": "me"}
OWN = {"origin": "authored", "source": "me", "licence": "CC0-1.0", "author": "me", "time": "2026-11-22T00:00:00Z"}
COMMON = {"_": "silence", "bmp": "consonant", "d": "consonant", "sh": "consonant", "r": "consonant", "kg": "consonant",
          "aa": "vowel", "ah": "vowel", "ih": "vowel", "ay": "vowel", "er": "vowel", "w": "vowel"}  # fmt: skip
PHONES = {"P": ("consonant", "p", "bmp"), "T": ("consonant", "t", "d"), "S": ("consonant", "ʃ", "sh"), "R": ("consonant", "ɹ", "r"),
          "A": ("vowel", "ɑ", "aa"), "I": ("vowel", "ɪ", "ih"), "Y": ("vowel", "aɪ", "ay"), "q": ("consonant", "t͡ʒ", "sh")}  # fmt: skip
TONAL = {"n": ("initial", "n", "d"), "i": ("final", "i", "ih"), "ua": ("final", "w ä", "w aa"), "ua+r": ("erhua", "w ä ɻ", "w aa er"),
         "b": ("initial", "p", "bmp"), "ü": ("final", "y", "w"), "er": ("final", "ɑ ɻ", "er")}  # fmt: skip
ALIASES = [
    ("espeak", "p", "P"), ("espeak", "ɑː", "A"), ("espeak", "ɑːɹ", "A R"), ("espeak", "ɪ", "I"), ("espeak", "ɹ", "R"), ("espeak", "t", "T"),
    ("espeak", "i", "I"),
    ("arpabet", "P", "P"), ("arpabet", "AA", "A"), ("arpabet", "IH", "I"), ("arpabet", "R", "R"), ("arpabet", "AY", "Y"),
    ("sppas", "3:r", "A R"), ("sppas", "4", "T"), ("sppas", "p", "P"), ("sppas", "i", "I"),
    ("ipa", "ʃ", "S"), ("ipa", "i", "P"), ("other", "p", "T"), ("other", "hush", "_"),
]  # fmt: skip


def language(code, notation):
    return {"language": code, "name": code, "notation": notation, "speech": "espeak", "voice": "x", "script": "Latn", **SOURCED}


def phones(table):
    return [{"phone": p, "kind": k, "ipa": i, "common": c, "example": "x", **OWN} for p, (k, i, c) in table.items()]


TABLES = {
    "common.tsv": [{"phone": phone, "kind": kind, **SOURCED} for phone, kind in COMMON.items()],
    "ipa.tsv": [{"phone": p, "xsampa": x, "common": c, **OWN} for p, x, c in (("x", "x", "kg"), ("q", "q", "kg"), ("ʁ", "R", "kg"))],
    "marks.tsv": [{"mark": mark, "meaning": "pause", **SOURCED} for mark in ("sil", "#", "<eps>")],
    "xx/language.tsv": [language("xx", "mine")],
    "xx/phones.tsv": phones(PHONES),
    "xx/aliases.tsv": [{"notation": n, "symbol": s, "phones": p, **SOURCED} for n, s, p in ALIASES],
    "yy/language.tsv": [language("yy", "pinyin")],
    "yy/phones.tsv": phones(TONAL),
    "yy/aliases.tsv": [{"notation": "ipa", "symbol": "i", "phones": "i", **SOURCED}],
    "yy/syllables.tsv": [
        {"syllable": s, "initial": i, "final": f, "ipa": "x", "xsampa": "x", "characters": "0", "status": "core", **SOURCED}
        for s, i, f in (("ni", "n", "i"), ("bua", "b", "ua"), ("nü", "n", "ü"), ("er", "", "er"))
    ],
    "characters/ann/mapping.tsv": [{"language": "xx", "phone": "S", "common": "r", **OWN}],
}
RECORDS = {path: {key_of(table_of(path), r): canonical_row(table_of(path), r) for r in rows} for path, rows in TABLES.items()}
XX, YY = PhoneSet.from_records(RECORDS, "xx"), PhoneSet.from_records(RECORDS, "yy")


def said(labels, notation="", **options):
    """A schedule of *labels*, each 100 ms."""
    return Schedule.from_intervals([(i / 10, (i + 1) / 10, label) for i, label in enumerate(labels)], notation=notation, **options)


def resolved(labels, notation="", phoneset=XX, **options):
    return phoneset.resolve(said(labels, notation), **options)[0].phones


def symbols(labels, notation="", phoneset=XX, **options):
    return [phone.symbol for phone in resolved(labels, notation, phoneset, **options)]


# Symbols


def test_own_symbols_stay_and_get_their_common_phones():
    phone, _ = resolved(["P", "A"], "mine")
    assert (phone.symbol, phone.common, phone.layer) == ("P", ("bmp",), "language:xx")


def test_aliases_of_a_notation_become_own_phones():
    assert symbols(["p", "ɑː", "t"], "espeak") == ["P", "A", "T"]


def test_the_result_is_in_the_languages_own_notation():
    schedule, unknown = XX.resolve(said(["p", "ɪ"], "espeak"))
    assert (schedule.notation, schedule.language, unknown) == ("mine", "xx", ())


@pytest.mark.parametrize("label", ["", "_", "sil", "SIL", "#", "<eps>", " "])
@pytest.mark.parametrize("notation", ["mine", "espeak", "arpabet"])
def test_marks_of_pauses_are_silence_in_every_notation(label, notation):
    (phone,) = resolved([label], notation)
    assert phone.silent
    assert phone.common == (SILENCE,)


def test_an_alias_of_one_notation_may_be_a_pause():
    assert symbols(["hush"], "other") == [SILENCE]


# Attributes


@pytest.mark.parametrize(
    ("label", "notation", "stress", "long"),
    [
        ("ˈɑː", "espeak", 1, True), ("ˌɪ", "espeak", 2, False), ("ˈpː", "espeak", 1, True), ("AA1", "arpabet", 1, False),
        ("IH2", "arpabet", 2, False), ("AA0", "arpabet", 0, False), ('"i', "sppas", 1, False), ("%i", "sppas", 2, False),
        ("aa1_B", "arpabet", 1, False), ("ay_S", "arpabet", 0, False), ("i:", "sppas", 0, True), ("'I", "mine", 1, False),
    ],
)  # fmt: skip
def test_stress_and_length_become_attributes(label, notation, stress, long):
    (phone,) = resolved([label], notation)
    assert phone.symbol in PHONES
    assert (phone.stress, phone.long) == (stress, long)


def test_a_digit_that_is_a_symbol_is_not_taken_for_stress():
    (tap,) = resolved(["4"], "sppas")
    assert (tap.symbol, tap.stress, tap.tone) == ("T", 0, 0)


@pytest.mark.parametrize(("label", "tone"), [("ni3", 3), ("nǐ", 3), ("nī", 1), ("ní", 2), ("nì", 4), ("ni5", 5), ("ni0", 5), ("ni", 0)])
def test_pinyin_is_read_with_digits_and_with_accents(label, tone):
    initial, final = resolved([label], "pinyin", YY)
    assert (initial.symbol, final.symbol) == ("n", "i")
    assert (initial.tone, final.tone) == (0, tone)


@pytest.mark.parametrize(("label", "tone"), [("i˥˥", 1), ("i˧˥", 2), ("i˨˩˦", 3), ("i˥˩", 4), ("i˧", 5), ("i⁴", 4)])
def test_tone_letters_of_the_ipa_are_tones(label, tone):
    (phone,) = resolved([label], "ipa", YY)
    assert (phone.symbol, phone.tone) == ("i", tone)


@pytest.mark.parametrize("label", ["nü3", "nv3", "nu:3", "NV3", "nǚ"])
def test_every_spelling_of_u_with_dots_is_read(label):
    assert symbols([label], "pinyin", YY) == ["n", "ü"]


def test_a_final_r_colours_the_final_but_er_is_a_syllable():
    assert symbols(["buar1"], "pinyin", YY) == ["b", "ua+r"]
    assert symbols(["er2"], "pinyin", YY) == ["er"]


def test_attributes_that_the_voice_took_off_are_kept():
    schedule = said([Phone("P", word=0), Phone("A", word=0, tone=3, stress=1, long=True)], "mine", words=["pa"])
    again, _ = XX.resolve(schedule)
    assert again.phones[1] == replace(schedule.phones[1], common=("aa",), layer="language:xx")
    assert again.words == ("pa",)


# Composites


def test_a_composite_is_split_and_its_parts_share_its_time_and_word():
    schedule, _ = XX.resolve(said([Phone("ˈɑːɹ", word=0)], "espeak", words=["are"]))
    assert [(p.symbol, p.word, p.stress, p.long) for p in schedule.phones] == [("A", 0, 1, True), ("R", 0, 0, False)]
    assert schedule.edges == (0, 50_000, 100_000)


def test_parts_get_time_by_the_number_of_their_common_phones():
    schedule, _ = YY.resolve(said(["bua1"], "pinyin"))
    assert [p.symbol for p in schedule.phones] == ["b", "ua"]
    assert schedule.edges == (0, 33_333, 100_000)


@pytest.mark.parametrize("label", ["p-i", "p i", "p.i", "p|i", "p-i-", "p‿i"])
def test_joined_labels_are_split(label):
    assert symbols([label], "sppas") == ["P", "I"]


def test_joined_labels_with_an_unknown_part_are_unknown_as_a_whole():
    with pytest.raises(UnknownSymbolError, match=r"'p-zzz' \(1x"):
        XX.resolve(said(["p-zzz"], "sppas"))


def test_ipa_symbols_in_a_row_are_split_longest_first():
    assert symbols(["tɑːɹ"], "espeak") == ["T", "A", "R"]
    with pytest.raises(UnknownSymbolError):
        XX.resolve(said(["AAR"], "arpabet"))


def test_plain_words_are_not_taken_for_ipa_symbols_in_a_row():
    with pytest.raises(UnknownSymbolError, match="'pit'"):
        XX.resolve(said(["pit"], "espeak"))


def test_a_phone_too_short_to_share_says_so():
    with pytest.raises(ScheduleError, match="too short"):
        XX.resolve(Schedule((0, 1), (Phone("ɑːɹ"),), notation="espeak"))


# Which notation


def test_a_language_without_aliases_is_read_in_every_notation_of_ipa_and_sampa():
    own = {**RECORDS["yy/language.tsv"]["yy",], "language": "zz", "notation": "ipa"}
    rows = {(phone,): {**RECORDS["xx/phones.tsv"]["A",], "phone": phone, "common": common} for phone, common in (("ɑ", "aa"), ("ts", "d"))}
    zz = PhoneSet.from_records({**RECORDS, "zz/language.tsv": {("zz",): own}, "zz/phones.tsv": rows}, "zz")
    assert symbols(["ts", "ˈɑː", "ʁ"], "espeak", zz) == ["ts", "ɑ", "[ʁ]"]
    assert symbols(["R", "x"], "xsampa", zz) == ["[ʁ]", "[x]"]


def test_what_a_tool_writes_goes_before_what_the_ipa_says():
    assert symbols(["p", "i"], "espeak") == ["P", "I"]
    assert symbols(["ʃ"], "mfa") == ["S"]


def test_without_a_notation_the_one_that_knows_most_is_taken():
    assert symbols(["p", "3:r", "4", "#"]) == ["P", "A", "R", "T", SILENCE]
    assert XX.notation_of(said(["P", "AA1", "R"])) == "arpabet"
    assert XX.notation_of(said(["ˈp", "ɑː", "zzz"])) == "espeak"


def test_of_notations_that_know_as_much_the_own_goes_first_and_then_the_alphabet():
    assert XX.notation_of(said(["P", "R"])) == "mine"
    assert XX.notation_of(said(["ʃ"])) == "espeak"


def test_a_notation_that_the_language_does_not_read_is_refused_with_the_nearest():
    with pytest.raises(InputError, match="did you mean 'arpabet'"):
        XX.resolve(said(["AA1"], "arpabets"))


# Layers


def test_a_character_says_a_phone_its_own_way():
    ann = PhoneSet.from_records(RECORDS, "xx", character="ann")
    assert [(p.common, p.layer) for p in resolved(["S", "P"], "mine", ann)] == [(("r",), "character:ann"), (("bmp",), "language:xx")]
    assert resolved(["S"], "mine")[0].common == ("sh",)


def test_the_lines_own_mapping_wins_over_the_character():
    ann = PhoneSet.from_records(RECORDS, "xx", character="ann")
    (phone,) = resolved(["S"], "mine", ann, line={"S": ("bmp", "aa")})
    assert (phone.common, phone.layer) == (("bmp", "aa"), "line")


@pytest.mark.parametrize(
    ("line", "message"),
    [({"S": ("bpm",)}, "did you mean 'bmp'"), ({"S": ()}, "there is no common phone"), ({"s": ("bmp",)}, "did you mean 'S'|no phone 's'")],
)
def test_a_mapping_of_the_line_that_can_not_be_is_refused(line, message):
    with pytest.raises(InputError, match=message):
        XX.resolve(said(["P"], "mine"), line)


def test_an_ipa_segment_that_the_language_lacks_is_known_to_the_common_layer():
    (phone,) = resolved(["ˈʁ"], "espeak")
    assert (phone.symbol, phone.common, phone.layer, phone.stress) == ("[ʁ]", ("kg",), "common", 1)


@pytest.mark.parametrize(
    ("label", "notation"), [("R", "sppas"), ("R_d", "xsampa"), ("R~", "sppas"), ("ʁ̃", "ipa"), ("ʁʷː", "mfa"), ("ˈʁ̥", "espeak")]
)
def test_diacritics_that_do_not_show_and_x_sampa_lead_to_the_same_segment(label, notation):
    assert symbols([label], notation) == ["[ʁ]"]


def test_a_segment_is_never_taken_for_a_phone_that_is_written_alike():
    (segment,) = resolved(["q"], "espeak")
    (phone,) = resolved(["q"], "mine")
    assert (segment.symbol, segment.common) == ("[q]", ("kg",))
    assert (phone.symbol, phone.common) == ("q", ("sh",))


def test_a_diacritic_that_does_not_show_does_not_make_another_phone():
    assert symbols(["pʰ", "ɪ̃", "ˈt̪ʷ"], "espeak") == ["P", "I", "T"]
    assert symbols(["p_h", "i~"], "sppas") == ["P", "I"]


# Unknown symbols


def test_unknown_symbols_are_all_counted_with_the_nearest_phone_and_why():
    with pytest.raises(UnknownSymbolError) as caught:
        XX.resolve(said(["ʒ", "p", "ʒ", "§"], "espeak"))
    text = str(caught.value)
    assert "\n" not in text
    assert "2 unknown symbols in notation espeak" in text
    assert "'ʒ' (2x, nearest 'S', by articulation it is sh:" in text
    assert "'§' (1x, nothing is known of it" in text


def test_of_many_unknown_symbols_each_is_named_and_none_explained():
    with pytest.raises(UnknownSymbolError) as caught:
        XX.resolve(said(["these", "are", "words", "are", "no", "phones", "§"], "espeak"))
    assert "6 unknown symbols" in str(caught.value)
    assert "'are' (2x, nearest '" in str(caught.value)
    assert "'§' (1x)" in str(caught.value)
    assert "by articulation it is" not in str(caught.value)


def test_a_misspelt_symbol_is_met_with_the_one_written_alike():
    with pytest.raises(UnknownSymbolError, match=r"'AYY' \(1x, nearest 'Y', written nearly as 'AY'"):
        XX.resolve(said(["AYY"], "arpabet"))
    with pytest.raises(UnknownSymbolError, match=r"'bia3' \(1x, nearest 'b ua', written nearly as 'bua'"):
        YY.resolve(said(["bia3"], "pinyin"))


def test_on_demand_unknown_symbols_are_mapped_by_articulation_and_still_reported():
    schedule, unknown = XX.resolve(said(["ʒ", "p", "ʒ"], "espeak"), allow_unknown=True)
    assert [(p.common, p.layer) for p in schedule.phones] == [
        (("sh",), "articulation"),
        (("bmp",), "language:xx"),
        (("sh",), "articulation"),
    ]
    assert [(u.symbol, u.count, u.proposal) for u in unknown] == [("ʒ", 2, "S")]


def test_a_symbol_of_which_nothing_is_known_becomes_a_neutral_vowel_never_silence():
    (phone,) = resolved(["§"], "espeak", allow_unknown=True)
    assert (phone.common, phone.layer, phone.silent) == (("ah",), "articulation", False)


@given(
    st.lists(st.text(st.sampled_from("pɑːɹɪtʃˈ˞4AI§-# q"), min_size=1, max_size=4), min_size=1, max_size=6),
    st.sampled_from(["", *XX.symbols.notations]),
)
def test_any_labels_resolve_to_known_common_phones_and_nothing_else_falls_silent(labels, notation):
    raw = said(labels, notation)
    schedule, unknown = XX.resolve(raw, allow_unknown=True)
    assert {name for phone in schedule.phones for name in phone.common} <= set(COMMON)
    assert (schedule.edges[0], schedule.edges[-1]) == (raw.edges[0], raw.edges[-1])
    assert all(p.silent == (p.common == (SILENCE,)) for p in schedule.phones)
    silent = sum(p.silent for p in schedule.phones)
    assert silent <= sum(label.count("#") + (not label.strip(" -")) for label in labels)
    if not unknown:
        assert XX.resolve(raw) == (schedule, ())


@given(st.lists(st.sampled_from(["p", "ɑːɹ", "ˈɪ", "", "ʁ", "§", "ʃ", "tɪ"]), min_size=1, max_size=6))
def test_resolving_again_changes_nothing(labels):
    once, _ = XX.resolve(said(labels, "espeak"), allow_unknown=True)
    assert XX.resolve(once, allow_unknown=True)[0] == once


# Listing


def test_the_phones_of_a_language_are_listed_with_layer_and_provenance():
    ann = PhoneSet.from_records(RECORDS, "xx", character="ann")
    rows = {mapped.phone: mapped.to_row() for mapped in ann}
    assert list(rows) == sorted(PHONES)
    assert rows["S"]["layer"] == "character:ann"
    assert rows["S"]["ipa"] == "ʃ"
    assert rows["P"] == {
        "phone": "P", "common": "bmp", "layer": "language:xx", "kind": "consonant", "ipa": "p", "example": "x", "origin": "authored",
        "source": "me", "licence": "CC0-1.0", "author": "me", "time": "2026-11-22T00:00:00Z", "comment": "",
    }  # fmt: skip


def test_a_phone_that_the_language_lacks_has_no_mapping():
    with pytest.raises(PhonesetError, match="xx has no phone 'PP'; did you mean 'P'"):
        XX.mapping("PP")


def test_a_language_that_is_not_there_is_refused_with_those_that_are():
    with pytest.raises(PhonesetError, match="no language 'zz'; there are xx, yy"):
        PhoneSet.from_records(RECORDS, "zz")
