"""The page History without a browser: what it finds, what it shows of a revision, and how one is taken back."""

from __future__ import annotations

import json
import shutil

import pytest
from page_cases import behind_pages, page

CURVE = {"left": "l", "right": "ow", "pose": "W", "keys": "0:0 0.5:1 1:0", "warp": "border"}
TABLE = "curves/facefx.tsv"


@pytest.fixture
def db(as_shipped, tmp_path, monkeypatch):
    with behind_pages(shutil.copy(as_shipped, tmp_path), monkeypatch) as db:
        with db.edit(author="anna", note="Rounder low") as edit:  # 2
            edit.put(TABLE, CURVE)
        with db.edit(author="bob", note="Robin's own low") as edit:  # 3
            edit.put(f"characters/robin/{TABLE}", CURVE)
        yield db


def revisions(shown):
    return [row["revision"] for row in shown.dataframe[0].value.to_dict("records")]


def texts(shown):
    assert not shown.exception
    return [one.value for kind in ("error", "success", "info", "caption", "subheader") for one in shown.get(kind)]


def drawn(shown, version):
    """The keys of *version* in the first chart."""
    chart = json.loads(shown.get("vega_lite_chart")[0].proto.spec or "{}")
    assert chart["height"]
    return [one for one in chart["encoding"]["color"]["scale"]["domain"] if one == version]


def test_the_newest_revision_is_shown_with_its_curves_before_and_after(db) -> None:
    shown = page("history")
    assert revisions(shown) == [3, 2, 1]
    assert shown.subheader[0].value == "Revision 3: Robin's own low"
    assert any("takes from the layers below" in text for text in texts(shown))
    assert drawn(shown, "before") == ["before"]
    (row,) = shown.dataframe[1].value.to_dict("records")
    assert row["row"] == f"characters/robin/{TABLE} l ow W"
    assert (row[""], row["before"]) == ("added", "not there")
    assert "keys 0:0 0.5:1 1:0" in row["after"]


def test_a_link_opens_a_revision_and_leads_to_the_pair_in_curves(db) -> None:
    shown = page("history", query={"revision": "3", "character": "robin"})
    opened = shown.button(key="history_open_3").click().run()
    assert not opened.exception
    assert (opened.selectbox(key="curves_left").value, opened.selectbox(key="curves_right").value) == ("l", "ow")
    assert opened.query_params["pair"] == "l-ow"
    assert opened.query_params["kind"] == "character"
    assert page("history", query={"revision": "2"}).subheader[0].value == "Revision 2: Rounder low"
    assert page("history", query={"revision": "nonsense"}).subheader[0].value.startswith("Revision 3")


def test_revisions_are_found_by_person_kind_character_pair_and_note(db) -> None:
    assert revisions(page("history", history_person="bob")) == [3]
    assert revisions(page("history", history_table="curves")) == [3, 2, 1]
    assert revisions(page("history", history_character="robin")) == [3, 1]
    assert revisions(page("history", history_pair="l-ow", history_words="rounder")) == [2]
    assert any("No change is like this" in text for text in texts(page("history", history_words="xyz")))
    assert any("a pair is two common phones" in text for text in texts(page("history", history_pair="low")))


def test_undo_makes_a_revision_under_the_visitors_name_and_can_be_undone(db) -> None:
    shown = page("history")
    shown.text_input(key="history_why_3").set_value("Bob changed his mind")
    shown = shown.button(key="history_undo_3").click().run()
    assert "Revision 4 takes revision 3 back. It can be undone too." in texts(shown)
    newest = db.store.history(limit=1)[0]
    assert (newest.number, newest.author, newest.note) == (4, "anna", "Bob changed his mind")
    assert f"characters/robin/{TABLE}" not in db.records
    shown.button(key="history_undo_4").click().run()
    assert ("l", "ow", "W") in db.records[f"characters/robin/{TABLE}"]


def test_undo_is_refused_when_the_row_changed_since(db) -> None:
    with db.edit(author="carl") as edit:
        edit.put(TABLE, {**CURVE, "keys": "0:0 0.5:0.5 1:0"})
    shown = page("history", query={"revision": "2"})
    shown = shown.button(key="history_undo_2").click().run()
    assert any("revision 2 not undone: carl changed the same in revision 4" in text for text in texts(shown))
    assert db.store.revision == 4


def test_who_gives_no_name_undoes_nothing(db) -> None:
    shown = page("history", visitor="").button(key="history_undo_3").click().run()
    assert any("Give your name" in text for text in texts(shown))
    assert db.store.revision == 3


def test_the_first_revision_is_shown_in_part_and_can_not_be_undone(db) -> None:
    shown = page("history", query={"revision": "1"})
    assert any("The first 1,000 of" in text for text in texts(shown))
    assert not [one for one in shown.button if one.label == "Undo"]


def test_of_a_large_revision_those_rows_are_shown_that_were_looked_for(db) -> None:
    shown = page("history", query={"revision": "1"}, history_table="sentences", history_language="en")
    rows = shown.dataframe[1].value["row"].tolist()
    assert len(rows) == len(db.records["en/sentences.tsv"]) == shown.dataframe[0].value["rows"][0]
    assert all(row.startswith("en/sentences.tsv ") for row in rows)
    assert any("rows are as chosen above; only these are shown" in text for text in texts(shown))


def test_names_and_notes_are_shown_as_they_were_typed(db) -> None:
    with db.edit(author="**carl**", note="<b>[low](x)</b> $1$") as edit:
        edit.put(TABLE, {**CURVE, "keys": "0:0 0.5:0.5 1:0"})
    shown = page("history")
    assert shown.subheader[0].value == r"Revision 4: \<b\>\[low\](x)\</b\> \$1\$"
    assert any(caption.value.startswith(r"\*\*carl\*\*, ") for caption in shown.caption)
