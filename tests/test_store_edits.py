"""Every edit is one transaction with author, time and revision, and never loses anybody's work."""

import sqlite3

import pytest
from store_cases import CURVES, KEY, TEXT

from lipdb.errors import ConflictError, InputError, PhonesetError
from lipdb.store import Store


def curve(**cells: str) -> dict[str, str]:
    return {"left": "aa", "right": "bmp", "pose": "PBM", "keys": "0:0 1:1", "warp": "border", **cells}


def test_an_edit_is_read_back_and_makes_one_revision(store):
    with store.edit(author="anna", note="Softer") as edit:
        edit.put(CURVES, curve(keys="0:0 0.5:0.7 1:1"))
        edit.put(CURVES, curve(pose="FV"))
        edit.delete(CURVES, ("aa", "_", "open"))
    rows = store.records(CURVES)[CURVES]
    assert edit.revision == store.revision == 2
    assert rows[KEY]["keys"] == "0:0 0.5:0.7 1:1"
    assert ("aa", "bmp", "FV") in rows
    assert ("aa", "_", "open") not in rows
    assert store.record(CURVES, KEY).revision == 2
    assert store.record(CURVES, ("bmp", "aa", "PBM")).revision == 1
    assert store.record(CURVES, ("aa", "_", "open")) is None


def test_rows_are_stored_in_canonical_form(store):
    with store.edit(author=" anna  b ") as edit:
        edit.put(CURVES, curve(keys="0:0.0  1:1.0000", comment=" two\twords "))
    row = store.record(CURVES, KEY).row
    assert (row["keys"], row["comment"], row["author"]) == ("0:0 1:1", "two words", "anna b")


def test_an_edit_that_changes_nothing_makes_no_revision(store):
    seen = store.records(CURVES)[CURVES][KEY]
    with store.edit(author="anna") as edit:
        edit.put(CURVES, seen)
        edit.delete(CURVES, ("no", "such", "row"))
    assert edit.revision is None
    assert store.revision == 1
    assert store.records(CURVES)[CURVES][KEY] == seen


def test_what_a_person_accepts_becomes_authored_by_them_and_keeps_its_source(store):
    seen = store.records(CURVES)[CURVES]["bmp", "aa", "PBM"]
    assert seen["origin"] == "generated"
    with store.edit(author="anna") as edit:
        edit.put(CURVES, seen, expected_revision=1, accepted=True)
    accepted = store.records(CURVES)[CURVES]["bmp", "aa", "PBM"]
    assert (accepted["origin"], accepted["author"], accepted["time"]) == ("authored", "anna", edit.time)
    assert {**accepted, **{name: seen[name] for name in ("origin", "author", "time")}} == seen
    with store.edit(author="bob") as edit:  # who accepts what Anna has accepted already takes nothing from her, and is in nobody's way
        edit.put(CURVES, seen, expected_revision=1, accepted=True)
    assert edit.revision is None
    store.undo(2, author="anna")
    assert store.records(CURVES)[CURVES]["bmp", "aa", "PBM"] == seen


def test_an_error_inside_the_block_saves_nothing(store):
    with pytest.raises(RuntimeError), store.edit(author="anna") as edit:
        edit.put(CURVES, curve())
        raise RuntimeError
    assert store.revision == 1


def test_bytes_that_are_no_text_do_no_harm_in_a_note(store):
    with store.edit(author="anna\udcff", note="a\udcffb\nc") as edit:
        edit.put(CURVES, curve())
    newest = store.history(limit=1)[0]
    assert (newest.author, newest.note) == ("anna?", "a?b c")


def test_an_edit_needs_an_author(store):
    with pytest.raises(InputError, match="no author"), store.edit(author="  "):
        pass


@pytest.mark.parametrize(
    ("path", "cells", "message"),
    [
        ("nonsense.tsv", {}, "nonsense.tsv: no table has this name"),
        ("../sources.tsv", {}, "no table has this name"),
        (CURVES, {"keys": "0:2"}, "weight 2 is not between 0 and 1"),
        (CURVES, {"left": ""}, "column left is empty"),
        (CURVES, {"colour": "red"}, "no such column: colour"),
        (CURVES, {"comment": "\ud800"}, "surrogates not allowed"),
    ],
)
def test_a_row_that_does_not_fit_its_table_is_refused(store, path, cells, message):
    with pytest.raises(PhonesetError, match=message), store.edit(author="anna") as edit:
        edit.put(path, curve(**cells))
    assert store.revision == 1


def test_a_key_of_the_wrong_length_is_refused(store):
    with pytest.raises(PhonesetError, match="a row is named by left, right, pose"), store.edit(author="anna") as edit:
        edit.delete(CURVES, ("aa", "bmp"))


def test_saving_over_a_newer_revision_is_refused_with_both_versions(store):
    _, seen = store.snapshot()
    with store.edit(author="bob") as edit:
        edit.put(CURVES, curve(keys="0:0 1:0.5"), expected_revision=seen)
    with (
        pytest.raises(ConflictError, match=r"bob changed the same in revision 2.*keys 0:0 1:0\.5.*keys 0:0 1:0\.75") as caught,
        store.edit(author="anna") as edit,
    ):
        edit.put(CURVES, curve(keys="0:0 1:0.75"), expected_revision=seen)
        edit.put(CURVES, curve(pose="FV"), expected_revision=seen)
    error = caught.value
    assert "\n" not in str(error)
    assert error.mine["keys"] == "0:0 1:0.75"
    assert error.theirs == store.record(CURVES, KEY).row
    assert error.revision == 2
    assert [(one.path, one.key) for one in error.conflicts] == [(CURVES, KEY)]
    assert store.revision == 2, "no row of a refused edit is saved"


def test_a_row_that_somebody_else_deleted_is_not_brought_back_unseen(store):
    with store.edit(author="bob") as edit:
        edit.delete(CURVES, KEY)
    with pytest.raises(ConflictError, match="theirs not there") as caught, store.edit(author="anna") as edit:
        edit.put(CURVES, curve(), expected_revision=1)
    assert caught.value.theirs is None


def test_deleting_a_row_that_somebody_else_changed_is_refused(store):
    with store.edit(author="bob") as edit:
        edit.put(CURVES, curve())
    with pytest.raises(ConflictError, match="yours not there") as caught, store.edit(author="anna") as edit:
        edit.delete(CURVES, KEY, expected_revision=1)
    assert caught.value.mine is None


def test_a_change_of_another_row_is_no_conflict(store):
    with store.edit(author="bob") as edit:
        edit.put(CURVES, curve())
    with store.edit(author="anna") as edit:
        edit.put(CURVES, curve(left="bmp", right="aa"), expected_revision=1)
    assert store.revision == 3


def test_two_people_who_save_the_same_are_no_conflict(store):
    given = {**store.record(CURVES, KEY).row, "comment": "good"}
    for author in ("bob", "anna"):
        with store.edit(author=author) as edit:
            edit.put(CURVES, given, expected_revision=1)
    assert store.revision == 2


class TestProvenance:
    """What an edit writes into origin, source, licence, author and time."""

    def test_a_person_who_edits_a_generated_curve_makes_it_authored(self, store):
        row = store.record(CURVES, KEY).row
        assert row["origin"] == "generated"
        with store.edit(author="anna") as edit:
            edit.put(CURVES, {**row, "keys": "0:0 1:1"})
        after = store.record(CURVES, KEY).row
        assert (after["origin"], after["source"], after["licence"], after["author"]) == ("authored", "user", "LicenseRef-user", "anna")
        assert after["time"] > row["time"]

    def test_a_source_that_the_editor_names_stays(self, store):
        with store.edit(author="anna") as edit:
            edit.put(CURVES, curve(source="studio", licence="CC0-1.0"))
        row = store.record(CURVES, KEY).row
        assert (row["origin"], row["source"], row["licence"]) == ("authored", "studio", "CC0-1.0")

    def test_an_authored_curve_keeps_its_source_when_another_person_edits_it(self, store):
        with store.edit(author="anna") as edit:
            edit.put(CURVES, curve(source="studio", licence="CC0-1.0"))
        with store.edit(author="bob") as edit:
            edit.put(CURVES, {**store.record(CURVES, KEY).row, "keys": ""})
        row = store.record(CURVES, KEY).row
        assert (row["keys"], row["source"], row["licence"], row["author"]) == ("", "studio", "CC0-1.0", "bob")

    def test_a_comment_alone_leaves_a_generated_curve_generated(self, store):
        row = store.record(CURVES, KEY).row
        with store.edit(author="anna") as edit:
            edit.put(CURVES, {**row, "comment": "too late?"})
        assert store.record(CURVES, KEY).row == {**row, "comment": "too late?"}

    def test_a_program_stores_rows_with_their_own_provenance(self, store):
        given = {**store.record(CURVES, KEY).row, "keys": "0:0 1:1", "time": "2026-11-20T00:00:00Z"}
        with store.edit(author="generator", by_hand=False) as edit:
            edit.put(CURVES, given)
        assert store.record(CURVES, KEY).row == given

    def test_a_table_without_origin_gets_the_users_source_only(self, store):
        with store.edit(author="anna") as edit:
            edit.put("en/aliases.tsv", {"notation": "mine", "symbol": "@", "phones": "ah"})
            edit.put("sources.tsv", {"source": "studio", "title": "Our studio", "licence": "CC0-1.0"})
        assert store.record("en/aliases.tsv", ("mine", "@")).row["source"] == "user"
        assert store.record("sources.tsv", ("studio",)).row["licence"] == "CC0-1.0"

    def test_a_source_without_a_licence_is_refused(self, store):
        with pytest.raises(PhonesetError, match="column licence is empty"), store.edit(author="anna") as edit:
            edit.put("sources.tsv", {"source": "studio", "title": "Our studio"})


def test_records_can_be_read_by_the_beginning_of_their_path(store):
    assert set(store.records("constraints/")) == {"constraints/facefx.tsv"}
    assert store.records("c_nstraints/") == {}
    assert store.records("%") == {}


def test_the_log_is_only_ever_added_to(store, tmp_path):
    def log() -> list[tuple[object, ...]]:
        with sqlite3.connect(tmp_path / "a.db") as connection:
            rows = connection.execute("SELECT * FROM change ORDER BY id").fetchall()
        connection.close()
        return rows

    before = log()
    with store.edit(author="anna") as edit:
        edit.put(CURVES, curve())
    store.undo(2, author="anna")
    after = log()
    assert after[: len(before)] == before
    assert len(after) == len(before) + 2


def test_two_stores_on_one_file_see_each_others_edits(store, tmp_path):
    other = Store.open(tmp_path / "a.db", TEXT)
    with other.edit(author="bob") as edit:
        edit.put(CURVES, curve())
    assert store.revision == 2
    assert store.record(CURVES, KEY).row["author"] == "bob"
    other.close()
