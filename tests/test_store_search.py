"""Finding revisions by who made them and what they are about, and what one did to the curves of a pair."""

import shutil

import pytest

import lipdb
from lipdb.curves.changed import changed_pairs
from lipdb.store.search import Wanted, changes_named

PAIR = ("l", "ow")
CURVE = {"left": "l", "right": "ow", "pose": "W", "keys": "0:0 0.5:1 1:0", "warp": "border"}


@pytest.fixture(scope="module")
def db(as_shipped, tmp_path_factory):
    """Five revisions after the first: two curves, a mapping, a phone, and an undo."""
    with lipdb.open(shutil.copy(as_shipped, tmp_path_factory.mktemp("found"))) as db:
        with db.edit(author="anna", note="Rounder low") as edit:  # 2
            edit.put("curves/facefx.tsv", CURVE)
        with db.edit(author="bob", note="50% for Robin") as edit:  # 3
            edit.put("characters/robin/curves/facefx.tsv", CURVE)
            edit.put("characters/robin/curves/facefx.tsv", {**CURVE, "left": "ow", "right": "l"})
        with db.edit(author="anna") as edit:  # 4
            edit.put("characters/robin/mapping.tsv", {"language": "en", "phone": "p", "common": "f"})
        with db.edit(author="carl", note="Look again") as edit:  # 5
            edit.put("en/phones.tsv", {**db.records["en/phones.tsv"]["p",], "comment": "Look again"})
        db.store.undo(3, author="anna")  # 6
        yield db


@pytest.mark.parametrize(
    ("wanted", "numbers"),
    [
        (Wanted(), [6, 5, 4, 3, 2, 1]),
        (Wanted(author="anna"), [6, 4, 2]),
        (Wanted(words="ROUNDER"), [2]),
        (Wanted(words="%"), [3]),
        (Wanted(kind="curves"), [6, 3, 2, 1]),
        (Wanted(kind="mapping"), [4]),
        (Wanted(language="en"), [5, 4, 1]),
        (Wanted(language="en", kind="phones"), [5, 1]),
        (Wanted(language="xx"), []),
        (Wanted(character="robin"), [6, 4, 3, 1]),
        (Wanted(character="robin", language="en"), [4]),
        (Wanted(pair=PAIR), [6, 3, 2, 1]),
        (Wanted(pair=PAIR, character="robin", author="bob"), [3]),
        (Wanted(pair=("l", "o")), []),
    ],
)
def test_revisions_are_found_by_author_note_kind_language_character_and_pair(db, wanted, numbers):
    found = db.store.find(wanted)
    assert [one.number for one in found] == numbers
    assert [len(changes_named(wanted, db.store.changes(one.number))) for one in found] == [one.rows for one in found]
    assert [one.number for one in db.store.find(wanted, limit=2)] == numbers[:2]


def test_a_found_revision_counts_the_rows_that_were_asked_for(db):
    assert [one.rows for one in db.store.find(Wanted(author="bob"))] == [2]
    assert [one.rows for one in db.store.find(Wanted(author="bob", pair=PAIR))] == [1]


def test_what_there_is_to_choose_from(db):
    assert db.store.authors() == ["anna", "bob", "carl", "lipdb"]
    assert {"curves", "links", "mapping", "phones", "poses", "sets", "frequencies"} <= set(db.store.kinds())


def test_an_override_is_shown_against_what_counted_before(db):
    low, _ = pairs = changed_pairs(db.store.changes(3))
    assert [(one.layer, one.pair, one.pose_set) for one in pairs] == [
        ("character:robin", "l-ow", "facefx"),
        ("character:robin", "ow-l", "facefx"),
    ]
    assert low.inherits
    assert low.poses["W"][0] is None
    before, after = low.filled(db.at(2).records, db.at(3).records)["W"]
    assert before.keys == after.keys == ((0, 0), (0.5, 1), (1, 0))
    (back,) = [one for one in changed_pairs(db.store.changes(6)) if one.pair == "l-ow"]
    assert back.poses["W"][1] is None


def test_a_changed_curve_has_both_versions(db):
    (low,) = changed_pairs(db.store.changes(2))
    before, after = low.poses["W"]
    assert (low.layer, low.inherits) == ("common", False)
    assert before.origin == "generated"
    assert (after.origin, after.author) == ("authored", "anna")


def test_other_rows_are_no_curves(db):
    assert changed_pairs(db.store.changes(5)) == []
