"""The checks across tables find every name that does not exist and every symbol that would mean two things."""

import pytest

from lipdb.curated.check import check
from lipdb.curated.schema import table_of
from lipdb.curated.tsv import canonical_row, key_of

SOURCED = {"source": "me"}
OWN = {"origin": "authored", "source": "me", "licence": "CC0-1.0", "author": "me", "time": "2026-11-22T00:00:00Z"}
GOOD = {
    "sources.tsv": [{"source": "me", "title": "My head", "licence": "CC0-1.0"}],
    "common.tsv": [
        {"phone": "_", "kind": "silence", **SOURCED},
        {"phone": "bmp", "kind": "consonant", "ipa": "p", **SOURCED},
        {"phone": "aa", "kind": "vowel", "ipa": "ɑ", **SOURCED},
        {"phone": "ue", "kind": "vowel", "ipa": "y", "language": "xx", **SOURCED},
    ],
    "ipa.tsv": [{"phone": "p", "xsampa": "p", "common": "bmp", **OWN}, {"phone": "ɑ", "xsampa": "A", "common": "aa", **OWN}],
    "marks.tsv": [{"mark": "sil", "meaning": "pause", **SOURCED}],
    "poses/sets.tsv": [{"pose_set": "face", "window": "0.1", "threshold": "2", "title": "A face", **SOURCED}],
    "poses/face.tsv": [
        {"pose": "open", "position": "0", "priority": "1", "speed": "15", "must_reach": "no", "description": "open", **SOURCED},
        {"pose": "shut", "position": "1", "priority": "2", "speed": "15", "must_reach": "yes", "description": "shut", **SOURCED},
    ],
    "shape_names.tsv": [{"pose_set": "face", "name": "jaw", "pose": "open", **SOURCED}],
    "constraints/face.tsv": [{"pose": "open", "other": "shut", "threshold": "0.5", **SOURCED}],
    "links/face/face.tsv": [{"pose": "open", "shape": "open", "gain": "1", "combine": "sum", **SOURCED}],
    "curves/face.tsv": [{"left": "_", "right": "aa", "pose": "open", "keys": "0:0 1:0.8", "warp": "border", **OWN}],
    "xx/language.tsv": [
        {"language": "xx", "name": "X", "notation": "mine", "speech": "espeak", "voice": "x", "script": "Latn", **SOURCED}
    ],
    "xx/phones.tsv": [{"phone": phone, "kind": kind, "ipa": ipa, "common": common, "example": "x", **OWN} for phone, kind, ipa, common in (
        ("P", "initial", "p", "bmp"), ("A", "final", "ɑ", "aa"),
    )],
    "xx/aliases.tsv": [
        {"notation": "other", "symbol": "pah", "phones": "P A", **SOURCED},
        {"notation": "mine", "symbol": "sil", "phones": "_", **SOURCED},
    ],
    "xx/syllables.tsv": [
        {"syllable": "pa", "initial": "P", "final": "A", "ipa": "p ɑ", "xsampa": "p A", "characters": "0", "status": "core", **SOURCED}
    ],
    "characters/ann/character.tsv": [{"character": "ann", "pose_set": "face", "drawing": "built:ann", "title": "Ann", **SOURCED}],
    "characters/ann/links.tsv": [{"pose": "open", "shape": "jaw", "gain": "1", "combine": "sum", **SOURCED}],
    "characters/ann/mapping.tsv": [{"language": "xx", "phone": "A", "common": "ue", **OWN}],
}  # fmt: skip


def records_of(tables):
    records = {}
    for path, rows in tables.items():
        table = table_of(path)
        cells = [canonical_row(table, row) for row in rows]
        records[path] = {key_of(table, row): row for row in cells}
    return records


def with_row(path, **cells):
    """The good tables, with *cells* changed in the first row of *path*."""
    first, *others = GOOD[path]
    return records_of({**GOOD, path: [{**first, **cells}, *others]})


def messages(records):
    return [str(finding) for finding in check(records)]


def test_good_tables_have_no_findings():
    assert messages(records_of(GOOD)) == []


@pytest.mark.parametrize(
    ("path", "cells", "finding"),
    [
        ("xx/phones.tsv", {"common": "bpm"}, "xx/phones.tsv:3:13: common phone 'bpm' does not exist; did you mean 'bmp'?"),
        ("xx/phones.tsv", {"source": "them"}, "xx/phones.tsv:3:28: source 'them' does not exist; there are me"),
        ("xx/phones.tsv", {"common": "_"}, "xx/phones.tsv:3:13: a phone of xx can't be silence; labels of pauses belong in marks.tsv"),
        ("ipa.tsv", {"common": "bmp oo"}, "ipa.tsv:2:5: common phone 'oo' does not exist; there are _, aa, bmp, ue"),
        ("xx/aliases.tsv", {"phones": "P a"}, "xx/aliases.tsv:3:11: phone 'a' does not exist; there are A, P, _"),
        (
            "xx/aliases.tsv",
            {"symbol": "SIL"},
            "xx/aliases.tsv:3:7: 'SIL' is a mark of a pause or a noise (marks.tsv), so it would mean two things",
        ),
        (
            "xx/aliases.tsv",
            {"notation": "mine", "symbol": "A"},
            "xx/aliases.tsv:2:6: 'A' is a phone of this notation itself, so it would mean two things",
        ),
        (
            "xx/aliases.tsv",
            {"symbol": "a\u0303"},
            "xx/aliases.tsv:3:7: 'a\u0303' is not in Unicode's composed form (NFC), so it would never be found",
        ),
        ("xx/syllables.tsv", {"initial": "B"}, "xx/syllables.tsv:2:4: phone 'B' does not exist; there are A, P"),
        ("xx/syllables.tsv", {"final": "O"}, "xx/syllables.tsv:2:6: phone 'O' does not exist; there are A, P"),
        ("constraints/face.tsv", {"other": "shud"}, "constraints/face.tsv:2:6: pose 'shud' does not exist; did you mean 'shut'?"),
        ("constraints/face.tsv", {"other": "open"}, "constraints/face.tsv:2:6: a pose can't constrain itself"),
        (
            "links/face/face.tsv",
            {"shape": "opne"},
            "links/face/face.tsv:2:6: pose of the other set 'opne' does not exist; did you mean 'open'?",
        ),
        ("shape_names.tsv", {"pose": "opn"}, "shape_names.tsv:2:10: pose 'opn' does not exist; did you mean 'open'?"),
        ("curves/face.tsv", {"left": "p"}, "curves/face.tsv:2:1: common phone 'p' does not exist; did you mean 'bmp'?"),
        ("curves/face.tsv", {"pose": "wide"}, "curves/face.tsv:2:6: pose 'wide' does not exist; there are open, shut"),
        ("curves/face.tsv", {"right": "_"}, "curves/face.tsv:2:3: two silences never meet; a pause is one phone"),
        ("curves/face.tsv", {"keys": "0:0.2 1:0.8"}, "curves/face.tsv:2:11: a curve out of silence must begin with weight 0"),
        ("curves/face.tsv", {"left": "aa", "right": "_"}, "curves/face.tsv:2:11: a curve into silence must end with weight 0"),
        ("common.tsv", {"language": "yy"}, "common.tsv:2:12: language 'yy' does not exist; there are xx"),
        (
            "characters/ann/character.tsv",
            {"pose_set": "faec"},
            "characters/ann/character.tsv:2:5: pose set 'faec' does not exist; did you mean 'face'?",
        ),
        ("characters/ann/character.tsv", {"character": "bob"}, "characters/ann/character.tsv:2:1: 'bob' stands in the folder of 'ann'"),
        (
            "characters/ann/character.tsv",
            {"shapes": "xyz"},
            "characters/ann/character.tsv:2:10: pose set 'xyz' does not exist; there are face",
        ),
        (
            "characters/ann/character.tsv",
            {"shapes": "xyz"},
            "characters/ann/character.tsv:2:10: no links lead there; add links/face/xyz.tsv",
        ),
        ("characters/ann/links.tsv", {"pose": "opn"}, "characters/ann/links.tsv:2:1: pose 'opn' does not exist; did you mean 'open'?"),
        ("characters/ann/mapping.tsv", {"phone": "AA"}, "characters/ann/mapping.tsv:2:4: phone 'AA' does not exist; did you mean 'A'?"),
        ("poses/face.tsv", {"position": "1"}, "poses/face.tsv:3:6: position '1' stands for 'open' already"),
        ("ipa.tsv", {"xsampa": "p A"}, "ipa.tsv:3:3: X-SAMPA 'A' stands for 'p' already"),
        ("xx/language.tsv", {"language": "zz"}, "xx/language.tsv:2:1: 'zz' stands in the folder of 'xx'"),
    ],
)  # fmt: skip
def test_each_mistake_is_found_where_it_stands(path, cells, finding):
    assert finding in messages(with_row(path, **cells))


@pytest.mark.parametrize(
    ("path", "finding"),
    [
        ("sources.tsv", "sources.tsv:1:1: this table must be there and have rows"),
        ("xx/phones.tsv", "xx/phones.tsv:1:1: language 'xx' is not complete without this table"),
        ("xx/language.tsv", "xx/language.tsv:1:1: language 'xx' is not complete without this table"),
        ("poses/face.tsv", "poses/sets.tsv:2:1: there is no poses/face.tsv with its poses"),
        ("characters/ann/character.tsv", "characters/ann/links.tsv:1:1: this character has no character.tsv"),
    ],
)
def test_a_table_that_lacks_is_found(path, finding):
    assert finding in messages(records_of({name: rows for name, rows in GOOD.items() if name != path}))


def test_a_pose_set_without_its_row_is_found():
    others = [{"pose_set": "other", "window": "0.1", "threshold": "2", "title": "Other", **SOURCED}]
    assert "poses/face.tsv:1:1: pose set 'face' has no row in poses/sets.tsv" in messages(records_of({**GOOD, "poses/sets.tsv": others}))


def test_a_constraint_written_both_ways_is_found():
    again = [*GOOD["constraints/face.tsv"], {"pose": "shut", "other": "open", "threshold": "0.7", **SOURCED}]
    finding = "constraints/face.tsv:3:6: the same two poses stand in another row the other way round"
    assert messages(records_of({**GOOD, "constraints/face.tsv": again})) == [finding]


def test_a_table_that_nobody_knows_is_found():
    records = {**records_of(GOOD), "poems.tsv": {("a",): {"a": "a"}}}
    assert messages(records) == ["poems.tsv:1:1: no table has this name; see docs/data.md for the layout"]


def test_all_findings_come_at_once_sorted_by_place():
    records = records_of({**GOOD, "ipa.tsv": [{"phone": "b", "common": "x", **OWN}, {"phone": "a", "common": "y", **OWN}]})
    assert [finding.line for finding in check(records)] == [2, 3]
