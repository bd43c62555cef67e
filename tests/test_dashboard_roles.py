"""Sign-in and roles: a viewer cannot write by any way, and who is not let in sees nothing."""

from __future__ import annotations

import re
import shutil
from pathlib import Path
from types import SimpleNamespace

import pytest
from browser import free_port, serving, settled, tab
from oidc_cases import provider, secrets
from page_cases import DASHBOARD, behind_pages, listen_on, page
from streamlit.testing.v1 import AppTest

import lipdb

CURVE = {"left": "l", "right": "ow", "pose": "W", "keys": "0:0 0.5:1 1:0", "warp": "border"}
TABLE = "curves/facefx.tsv"

# Every way by which code of a page could write. What comes of each is written on the page.
WAYS = f"""
import tempfile
from pathlib import Path
import streamlit as st
from parts.session import Edited, database, save, undo, writable
from lipdb.errors import LipdbError

def edit(db):
    with db.edit(author="eve") as edit:
        edit.delete({TABLE!r}, ("l", "ow", "W"))

ways = {{
    "save": lambda: save([Edited({TABLE!r}, ("l", "ow", "W"), None)], note="", seen=2),
    "undo": lambda: undo(2),
    "writable": writable,
    "edit": lambda: edit(database()),
    "edit of the past": lambda: edit(database().at(2)),
    "edit of the store": lambda: edit(database().store),
    "undo of the store": lambda: database().store.undo(2, author="eve"),
    "load": lambda: database().store.load(Path("."), author="eve"),
    "upgrade": lambda: database().store.upgrade(),
    "scan": lambda: database().store.add_scan(None),
    "character": lambda: database().add_character(Path("."), name="eve", author="eve"),
}}
for name, way in ways.items():
    try:
        way()
    except LipdbError as error:
        st.write(f"{{name}}: refused, {{error}}")
    else:
        st.write(f"{{name}}: done")
"""


@pytest.fixture
def db(as_shipped, tmp_path, monkeypatch):
    with behind_pages(shutil.copy(as_shipped, tmp_path), monkeypatch) as db:
        with db.edit(author="anna", note="Rounder low") as edit:
            edit.put(TABLE, CURVE)
        yield db


def visited(script: str, user: dict[str, object], **roles: object) -> AppTest:
    test = AppTest.from_string(script, default_timeout=60)
    test.secrets["auth"] = {"client_id": "lipdb"}
    test.secrets["lipdb"] = roles
    test.user = user
    return test.run()


def signed_in(address: str, **claims: object) -> dict[str, object]:
    return {"is_logged_in": True, "email": address, **claims}


@pytest.mark.parametrize(
    "user",
    [
        {"is_logged_in": False},
        signed_in("eve@example.org"),
        signed_in("nna@example.org"),
        signed_in("anna@example.org", email_verified=False),
        signed_in(""),
    ],
)
def test_no_way_to_write_is_open_to_who_is_no_editor(db, user) -> None:
    for editors in (["anna@example.org"], "anna@example.org"):
        shown = visited(WAYS, user, editors=editors)
        assert not shown.exception
        results = [one.value for one in shown.markdown]
        assert len(results) == 11
        assert [one for one in results if ": refused, " not in one] == []
    assert db.store.revision == 2
    assert not db.store.characters_folder.exists()


def test_who_edits_saves_under_the_address_of_the_sign_in_and_by_the_gate_only(db) -> None:
    shown = visited(WAYS, signed_in("Anna@Example.org", email_verified=True), editors=["anna@example.org"])
    done = [one.value for one in shown.markdown if one.value.endswith(": done")]
    assert done == ["save: done", "writable: done"]
    assert any(one.value.startswith("undo: refused, revision 2 not undone") for one in shown.markdown)
    newest = db.store.history(limit=1)[0]
    assert (newest.number, newest.author) == (3, "Anna@Example.org")


APP = """
from parts.session import database, greet, visitor
import streamlit as st
greet()
st.write(f"{visitor().name} looks at revision {database().store.revision}")
"""


def words(shown: AppTest) -> str:
    assert not shown.exception
    return " ".join(one.value for kind in ("title", "markdown", "text", "error") for one in shown.get(kind))


def test_who_is_not_signed_in_sees_a_button_and_nothing_else(db) -> None:
    shown = visited(APP, {"is_logged_in": False}, editors=[])
    assert [one.label for one in shown.button] == ["Sign in"]
    assert "looks at" not in words(shown)


def test_everybody_who_is_signed_in_may_look_unless_viewers_are_named(db) -> None:
    assert "eve@example.org looks at revision 2" in words(visited(APP, signed_in("eve@example.org")))
    assert "(viewer)" in words(visited(APP, signed_in("eve@example.org"), viewers=["eve@example.org"]))
    named = visited(APP, signed_in("eve@example.org"), viewers=["bob@example.org"], editors=["anna@example.org"])
    assert "You may not look at this" in words(named)
    assert "looks at" not in words(named)
    assert "looks at" not in words(visited(APP, signed_in("bob@example.org", email_verified=False), viewers=["bob@example.org"]))
    assert "(editor)" in words(visited(APP, signed_in("anna@example.org"), viewers=[], editors=["anna@example.org"]))


def test_a_page_that_is_reached_without_the_app_shows_nothing_to_who_is_not_signed_in(db) -> None:
    shown = visited((DASHBOARD / "pages" / "history.py").read_text(), {"is_logged_in": False})
    assert [one.value for one in shown.error] == ["sign in to see this; with another address, if yours is not let in"]
    assert not shown.dataframe


def test_a_viewer_and_an_editor_sign_in_at_a_provider(as_shipped, tmp_path, chromium) -> None:
    port = free_port()
    (tmp_path / ".streamlit").mkdir()
    with provider() as known:
        (tmp_path / ".streamlit" / "secrets.toml").write_text(secrets(known, port, editors=["anna@example.org"]))
        with lipdb.open(shutil.copy(as_shipped, tmp_path)) as db, db.edit(author="anna", note="Rounder low") as edit:
            edit.put(TABLE, CURVE)
        with serving(tmp_path, port=port) as app:
            # By a link to a page, on a server that has seen nobody yet.
            with tab(chromium) as page:
                page.goto(f"{app.url}/history")
                page.get_by_role("button", name="Sign in").wait_for()
                assert page.get_by_text("Rounder low").count() == 0
                known.claims = {"email": "eve@example.org", "email_verified": True}
                page.get_by_role("button", name="Sign in").click()
                page.get_by_text("eve@example.org (viewer)").wait_for()
                page.goto(f"{app.url}/history")
                page.get_by_text("Revision 2: Rounder low").wait_for()
                settled(page)
                assert page.get_by_role("button", name="Undo").count() == 0
            with tab(chromium) as page:
                page.goto(f"{app.url}/history")
                known.claims = {"email": "anna@example.org", "email_verified": True}
                page.get_by_role("button", name="Sign in").click()
                page.get_by_text("anna@example.org (editor)").wait_for()
                page.goto(f"{app.url}/history")
                page.get_by_role("button", name="Undo").click()
                page.get_by_text("Revision 3 takes revision 2 back").wait_for()
                page.get_by_role("button", name="Sign out").click()
                page.get_by_role("button", name="Sign in").wait_for()
            assert "anna@example.org" in app.lipdb("db", "history")


def folders_offered() -> bool:
    shown = page("languages", languages_view="Compare and merge")
    assert not shown.exception
    return "Another folder" in shown.selectbox(key="languages_left_kind").options


def test_folders_of_this_machine_are_offered_to_its_own_people_only(db, monkeypatch) -> None:
    assert folders_offered()
    listen_on("0.0.0.0")
    assert not folders_offered()
    listen_on("localhost")
    assert folders_offered()
    behind_a_proxy = SimpleNamespace(headers={"X-Forwarded-For": "203.0.113.7"}, cookies={})
    monkeypatch.setattr("streamlit.context", behind_a_proxy)
    assert not folders_offered()


def test_only_the_gate_opens_the_database() -> None:
    """A page that opened it anew, or took the writable one, would go round the roles."""
    sources = {file.relative_to(DASHBOARD): file.read_text() for folder in ("pages", "parts") for file in (DASHBOARD / folder).glob("*.py")}
    round_the_gate = [
        str(file) for file, text in sources.items() if re.search(r"\b_writable\b|lipdb\.open\(|Store\.(?:open|locate)\(", text)
    ]
    assert round_the_gate == [str(Path("parts") / "session.py")]
