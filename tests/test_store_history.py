"""Every revision is kept: it can be listed, compared, read as it was, and undone."""

from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, precondition, rule
from store_cases import CURVES, KEY, TEXT

from lipdb.errors import ConflictError, InputError
from lipdb.store import Store


def put(store: Store, keys: str, *, author: str = "anna", pose: str = "PBM") -> int | None:
    with store.edit(author=author, note=f"{pose} {keys}") as edit:
        edit.put(CURVES, {"left": "aa", "right": "bmp", "pose": pose, "keys": keys, "warp": "border"})
    return edit.revision


def keys_of(records) -> str:
    return records[CURVES][KEY]["keys"]


def test_history_lists_revisions_newest_first(store):
    put(store, "0:0 1:0.5")
    put(store, "0:0 1:1", author="bob")
    newest, middle, first = store.history()
    assert (newest.number, newest.author, newest.note, newest.rows) == (3, "bob", "PBM 0:0 1:1", 1)
    assert (middle.number, first.number) == (2, 1)
    assert (first.author, first.note, first.rows) == ("lipdb", "Fill from the shipped text", 17)
    assert [one.number for one in store.history(limit=1)] == [3]


def test_history_of_a_table_or_of_one_row_leaves_other_revisions_out(store):
    put(store, "0:0 1:1")
    with store.edit(author="bob") as edit:
        edit.put("sources.tsv", {"source": "studio", "title": "Our studio", "licence": "CC0-1.0"})
    assert [one.number for one in store.history("sources.tsv")] == [3, 1]
    assert [one.number for one in store.history("constraints/")] == [1]
    assert [one.number for one in store.history(CURVES, KEY)] == [2, 1]
    assert [(one.number, one.rows) for one in store.history(CURVES, ("aa", "bmp", "open"))] == [(1, 1)]


def test_the_changes_of_a_revision_have_both_sides(store):
    before = store.record(CURVES, KEY).row
    put(store, "0:0 1:1")
    (change,) = store.changes(2)
    assert (change.revision, change.path, change.key) == (2, CURVES, KEY)
    assert change.before == before
    assert change.after == store.record(CURVES, KEY).row


def test_the_difference_of_two_revisions_runs_both_ways_and_drops_what_came_back(store):
    put(store, "0:0 1:0.5")
    put(store, "0:0 1:1")
    put(store, "0:0 1:1", pose="FV")
    store.undo(4, author="anna")
    (forward,) = store.diff(1, 5)
    assert (forward.before["keys"], forward.after["keys"]) == ("0:0 0.5:0.9 1:1", "0:0 1:1")
    (backward,) = store.diff(5, 1)
    assert (backward.before, backward.after) == (forward.after, forward.before)
    assert store.diff(3, 5) == []
    assert store.diff(1, 5, "constraints/") == []


def test_any_old_state_can_be_read(store):
    filled = store.records()
    put(store, "0:0 1:0.5")
    with store.edit(author="anna") as edit:
        edit.delete(CURVES, KEY)
    assert store.at(0) == {}
    assert store.at(1) == filled
    assert keys_of(store.at(2)) == "0:0 1:0.5"
    assert KEY not in store.at(3)[CURVES]
    assert store.at(3) == store.records()


@pytest.mark.parametrize("number", [-1, 2])
def test_a_revision_that_does_not_exist_is_an_error(store, number):
    for ask in (store.at, store.changes, lambda n: store.diff(n, 1), lambda n: store.undo(n, author="anna")):
        with pytest.raises(InputError, match=f"no revision {number}; the newest is 1"):
            ask(number)


class TestUndo:
    """Undo is a new revision."""

    def test_undo_brings_back_changed_added_and_deleted_rows(self, store):
        filled = store.records()
        with store.edit(author="anna", note="A bad day") as edit:
            edit.put(CURVES, {"left": "aa", "right": "bmp", "pose": "PBM", "keys": "", "warp": "border"})
            edit.put(CURVES, {"left": "aa", "right": "bmp", "pose": "FV", "keys": "", "warp": "border"})
            edit.delete(CURVES, ("aa", "_", "open"))
        assert store.undo(2, author="bob") == 3
        assert store.records() == filled
        newest = store.history(limit=1)[0]
        assert (newest.author, newest.note, newest.rows) == ("bob", "Undo revision 2", 3)

    def test_an_undo_can_be_undone(self, store):
        put(store, "0:0 1:1")
        edited = store.records()
        store.undo(store.undo(2, author="anna"), author="anna")
        assert store.records() == edited

    def test_an_older_revision_can_be_undone_when_newer_ones_touched_other_rows(self, store):
        put(store, "0:0 1:1")
        put(store, "0:0 1:1", pose="FV")
        store.undo(2, author="anna")
        assert keys_of(store.records()) == "0:0 0.5:0.9 1:1"
        assert ("aa", "bmp", "FV") in store.records()[CURVES]

    def test_undo_is_refused_when_a_later_revision_changed_the_same_row(self, store):
        put(store, "0:0 1:0.5")
        put(store, "0:0 1:1", author="bob")
        with pytest.raises(ConflictError, match="revision 2 not undone: bob changed the same in revision 3") as caught:
            store.undo(2, author="anna")
        assert caught.value.mine["keys"] == "0:0 0.5:0.9 1:1"
        assert caught.value.theirs["keys"] == "0:0 1:1"
        assert store.revision == 3

    def test_revisions_can_be_undone_one_after_the_other_from_the_newest_back(self, store):
        filled = store.records()
        numbers = [put(store, f"0:0 1:0.{i}") for i in range(1, 5)]
        for number in reversed(numbers):
            store.undo(number, author="anna")
        assert store.records() == filled

    def test_undoing_twice_does_nothing_the_second_time(self, store):
        put(store, "0:0 1:1")
        assert store.undo(2, author="anna") == 3
        assert store.undo(2, author="anna") is None
        assert store.revision == 3

    def test_the_fill_can_not_be_undone(self, store):
        with pytest.raises(InputError, match="nothing comes before revision 1"):
            store.undo(1, author="anna")


class AnyEdits(RuleBasedStateMachine):
    """Whatever is edited, loaded and undone, every old state stays as it was."""

    def __init__(self):
        super().__init__()
        self.folder = TemporaryDirectory()
        self.store = Store.open(Path(self.folder.name) / "a.db", TEXT)
        self.states = [{}, self.store.records()]

    def remember(self):
        while len(self.states) <= self.store.revision:
            self.states.append(self.store.records())

    @rule(pose=st.sampled_from(["PBM", "open", "W"]), keys=st.sampled_from(["", "0:0 1:1", "0:1 1:0"]))
    def put(self, pose, keys):
        put(self.store, keys, pose=pose)
        self.remember()

    @rule(pose=st.sampled_from(["PBM", "open", "W"]))
    def delete(self, pose):
        with self.store.edit(author="bob") as edit:
            edit.delete(CURVES, ("aa", "bmp", pose))
        self.remember()

    @precondition(lambda self: len(self.states) > 2)
    @rule(data=st.data())
    def undo(self, data):
        number = data.draw(st.integers(2, len(self.states) - 1))
        try:
            self.store.undo(number, author="anna")
        except ConflictError:
            assert number < self.store.revision
        self.remember()

    @invariant()
    def every_state_can_be_read(self):
        assert [self.store.at(number) for number in range(len(self.states))] == self.states
        assert self.store.records() == self.states[-1]
        assert self.store.check() == []

    def teardown(self):
        self.store.close()
        self.folder.cleanup()


AnyEdits.TestCase.settings = settings(max_examples=10, stateful_step_count=10)
TestAnyEdits = AnyEdits.TestCase
