"""The winning curve: layers in order, links from facefx, targets, the nearest phone; always an answer, never in silence."""

from __future__ import annotations

from pathlib import Path

import pytest

from lipdb.curated.folder import read_folder
from lipdb.curves.curve import Curve
from lipdb.curves.generate import Targets, all_pairs
from lipdb.curves.lookup import CurveBook
from lipdb.engine import animate
from lipdb.errors import CurveError, PhonesetError
from lipdb.poses import PoseSet

SHIPPED = read_folder(Path(__file__).parent.parent / "phonesets")
TABLE = "curves/facefx.tsv"


def row(left, right, pose, keys, origin="authored"):
    return Curve(((0.0, 0.0), (0.5, keys), (1.0, 0.0)) if keys else (), origin=origin).row((left, right, pose))


def table(*rows):
    return {(r["left"], r["right"], r["pose"]): r for r in rows}


def with_curves(**tables):
    """The shipped records with other tables of curves; a name like ``cmn/curves/facefx.tsv`` is given by its parts."""
    paths = {"common": TABLE, "language": "cmn/curves/facefx.tsv", "character": "characters/robin/curves/facefx.tsv"}
    return {**SHIPPED, **{paths[name]: rows for name, rows in tables.items()}}


def found(records, left="d", right="ah", pose="open", *, line=None, pose_set="facefx"):
    return CurveBook.from_records(records, pose_set, language="cmn", character="robin", line=line).find(left, right, pose)


ALL_LAYERS = {"common": 0.1, "language": 0.2, "character": 0.3}


def test_the_most_specific_layer_wins_and_says_so():
    records = with_curves(**{name: table(row("d", "ah", "open", peak)) for name, peak in ALL_LAYERS.items()})
    line = {("d", "ah", "open"): Curve(((0.0, 0.0), (0.5, 0.4), (1.0, 0.0)))}
    assert (found(records, line=line).layer, found(records, line=line).curve.peak) == ("line", 0.4)
    for layer, peak, below in (("character:robin", 0.3, "character"), ("language:cmn", 0.2, "language"), ("common", 0.1, "common")):
        answer = found(records)
        assert (answer.layer, answer.curve.peak, answer.pose_set) == (layer, peak, "facefx")
        records = with_curves(**{name: table(row("d", "ah", "open", p)) for name, p in ALL_LAYERS.items() if p < peak}) | (
            {TABLE: {}} if below == "common" else {}
        )
    assert found(records).layer == "generated"


def test_layers_of_other_languages_and_characters_do_not_speak():
    records = {**SHIPPED, "de/curves/facefx.tsv": table(row("d", "ah", "open", 0.9)), TABLE: table(row("d", "ah", "open", 0.1))}
    assert found(records).layer == "common"


def test_an_explicit_empty_curve_means_zero_and_ends_the_search():
    records = with_curves(common=table(row("d", "ah", "open", 0.9)), language=table(row("d", "ah", "open", 0)))
    answer = found(records)
    assert (answer.curve.keys, answer.layer, answer.reason, answer.fallback) == ((), "language:cmn", "authored as zero", False)


def test_a_layer_replaces_one_pose_of_a_pair_and_leaves_the_others():
    records = with_curves(character=table(row("d", "ah", "open", 0.9)))
    assert found(records).layer == "character:robin"
    assert found(records, pose="wide").layer == "common"


def test_a_deleted_curve_comes_back_from_the_targets_and_is_reported():
    whole = SHIPPED[TABLE]
    records = {**SHIPPED, TABLE: {key: r for key, r in whole.items() if key != ("d", "ah", "open")}}
    book = CurveBook.from_records(records, "facefx")
    answer = book.find("d", "ah", "open")
    assert (answer.layer, answer.fallback) == ("generated", True)
    assert answer.curve.row(("d", "ah", "open"))["keys"] == whole["d", "ah", "open"]["keys"]
    assert [(f.left, f.right, f.poses, f.layer) for f in book.report([("d", "ah"), ("ah", "d")])] == [("d", "ah", ("open",), "generated")]


def test_without_any_curve_every_pair_is_generated_and_every_pair_is_reported():
    records = {**SHIPPED, TABLE: {}}
    book = CurveBook.from_records(records, "facefx")
    pairs = all_pairs(Targets.from_records(records, "facefx").phones)
    assert {book.find(*pair, pose).layer for pair in pairs for pose in book.poses} == {"generated"}
    assert [(f.left, f.right) for f in book.report(pairs)] == pairs


def test_a_new_common_phone_without_targets_borrows_those_of_the_nearest_phone():
    extra = {"phone": "vv", "kind": "consonant", "ipa": "ʋ", "language": "", "example": "", "source": "lipdb", "comment": ""}
    records = {**SHIPPED, "common.tsv": {**SHIPPED["common.tsv"], ("vv",): extra}}
    book = CurveBook.from_records(records, "facefx")
    answer = book.find("vv", "ah", "FV")
    assert answer.layer == "nearest"
    assert "f for vv" in answer.reason
    assert answer.curve.keys == CurveBook.from_records({**SHIPPED, TABLE: {}}, "facefx").find("f", "ah", "FV").curve.keys
    (entry,) = book.report([("vv", "ah")])
    assert (entry.layer, entry.poses) == ("nearest", book.poses)


@pytest.mark.parametrize(("kind", "neutral"), [("consonant", "d"), ("vowel", "ah")])
def test_a_new_phone_that_no_chart_knows_stands_for_a_neutral_one_of_its_kind(kind, neutral):
    extra = {"phone": "7", "kind": kind, "ipa": "", "language": "", "example": "", "source": "lipdb", "comment": ""}
    records = {**SHIPPED, "common.tsv": {**SHIPPED["common.tsv"], ("7",): extra}}
    assert f"{neutral} for 7" in found(records, "7", "bmp").reason


def test_a_partial_imported_set_is_filled_from_the_targets_pose_by_pose():
    imported = table(row("d", "ah", "open", 0.6, "imported"), row("ah", "d", "open", 0.7, "imported"))
    records = {**SHIPPED, TABLE: imported}
    book = CurveBook.from_records(records, "facefx")
    assert [book.find(*pair, "open").curve.origin for pair in (("d", "ah"), ("ah", "d"))] == ["imported", "imported"]
    assert book.find("d", "ah", "wide").layer == "generated"
    assert book.find("f", "ah", "FV").curve.peak >= 0.9
    assert [f.poses for f in book.report([("d", "ah")])] == [tuple(pose for pose in book.poses if pose != "open")]


@pytest.mark.parametrize("pose_set", ["facefx", "crab"])
def test_every_pair_and_pose_has_an_answer(pose_set):
    book = CurveBook.from_records(SHIPPED, pose_set, language="en", character="crab")
    phones = [phone for (phone,) in SHIPPED["common.tsv"]]
    answers = [book.find(left, right, pose) for left, right in all_pairs(tuple(phones)) for pose in book.poses]
    assert not any(answer.fallback for answer in answers)
    assert all(0 <= weight <= 1 for answer in answers for _, weight in answer.curve.keys)


def test_a_characters_own_pairs_win_as_a_whole_and_the_rest_comes_through_links():
    book = CurveBook.from_records(SHIPPED, "crab", language="en", character="crab")
    own = {key[:2] for key in SHIPPED["characters/crab/curves/crab.tsv"]}
    assert ("h", "ah") in own
    assert {book.find("h", "ah", pose).layer for pose in book.poses} == {"character:crab"}
    answer = book.find("f", "th", "lips_press")
    assert (answer.layer, answer.pose_set) == ("common via facefx", "crab")
    assert answer.curve.peak == pytest.approx(0.9 * CurveBook.from_records(SHIPPED, "facefx").find("f", "th", "FV").curve.peak, abs=2e-3)


def test_a_pair_of_its_own_rests_where_it_says_nothing():
    only = table({**row("h", "ah", "mouth_open", 0.8)})
    records = {**SHIPPED, "characters/crab/curves/crab.tsv": only}
    book = CurveBook.from_records(records, "crab", character="crab")
    assert (book.find("h", "ah", "smile").curve.keys, book.find("h", "ah", "smile").layer) == ((), "character:crab")


def test_a_gap_behind_links_is_reported_as_one():
    records = {**SHIPPED, TABLE: {}, "targets/crab.tsv": {}, "timing/crab.tsv": {}}
    book = CurveBook.from_records(records, "crab", language="en", character="nobody")
    assert book.find("d", "ah", "mouth_open").layer == "generated via facefx"
    assert next(f.layer for f in book.report([("d", "ah")])) == "generated via facefx"


def test_between_silence_and_silence_everything_rests():
    assert found(SHIPPED, "_", "_").curve.keys == ()


def test_an_unknown_pose_set_or_pose_is_refused():
    with pytest.raises(PhonesetError, match="no pose set 'octopus'"):
        CurveBook.from_records(SHIPPED, "octopus")
    with pytest.raises(PhonesetError, match="has no pose 'jaw'"):
        found(SHIPPED, pose="jaw")


def test_a_pose_set_with_nothing_to_make_curves_from_is_refused_with_what_to_add():
    poses = {"poses/three.tsv": {("a",): {**SHIPPED["poses/facefx.tsv"][("open",)], "pose": "a"}}}
    book = CurveBook.from_records({**SHIPPED, **poses}, "three")
    with pytest.raises(CurveError, match="targets/three.tsv"):
        book.find("d", "ah", "a")


def test_a_table_of_a_few_phones_plays_like_the_table_of_all():
    phones = ["_", "h", "ah", "l", "ow", "w", "er", "l", "d", "_"]
    edges = [n * 90_000 for n in range(len(phones) + 1)]
    book, rules = CurveBook.from_records(SHIPPED, "facefx"), PoseSet.from_records(SHIPPED, "facefx")
    everything = book.table(phone for (phone,) in SHIPPED["common.tsv"])
    few = book.table(phones)
    assert few.phones == ("_", *sorted(set(phones) - {"_"}))
    one, other = (animate(table, rules, edges, phones).weights for table in (few, everything))
    assert one.max() > 0.5
    assert one == pytest.approx(other, abs=1e-12)
