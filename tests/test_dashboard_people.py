"""Several people at once: what is not saved stays with whom it belongs to, and pages say so when lipdb is upgraded under them."""

from __future__ import annotations

import shutil
import socket
import sqlite3
from contextlib import closing

import pytest
from browser import free_port, serving, settled, tab
from page_cases import behind_pages, page

CURVE = {"left": "l", "right": "ow", "pose": "W", "keys": "0:0 0.5:1 1:0", "warp": "border"}


@pytest.fixture
def db(as_shipped, tmp_path, monkeypatch):
    with behind_pages(shutil.copy(as_shipped, tmp_path), monkeypatch) as db:
        with db.edit(author="anna", note="Rounder low") as edit:
            edit.put("curves/facefx.tsv", CURVE)
        yield db


def words(shown) -> str:
    assert not shown.exception
    return " ".join(one.value for kind in ("warning", "error", "subheader") for one in shown.get(kind))


def test_a_page_says_so_when_the_database_was_upgraded_and_saves_nothing(db) -> None:
    shown = page("history")
    assert words(shown) == "Revision 2: Rounder low"
    with closing(sqlite3.connect(db.store.where)) as newer:
        newer.execute("UPDATE alembic_version SET version_num = '9999'")
        newer.commit()
    shown = shown.button(key="history_undo_2").click().run()
    assert words(shown).startswith("The database was upgraded while this page was open. Nothing is saved any more")
    assert not shown.subheader
    assert db.store.revision == 2


def test_a_page_says_so_when_the_database_was_damaged_under_it(db, tmp_path) -> None:
    (file,) = tmp_path.glob("*.db")
    for left in tmp_path.glob(f"{file.name}-*"):
        left.unlink()
    file.write_bytes(b"garbage " * 1000)
    assert words(page("history")).endswith("this file is not a database; give another one with --db, or move it away and a new one is made")


def test_a_page_says_so_when_a_newer_lipdb_was_installed(db, monkeypatch) -> None:
    shown = page("history")
    import parts.upgrade

    monkeypatch.setattr(parts.upgrade, "version", lambda name: "99.1")
    assert "lipdb 99.1 was installed while this page was open" in words(shown.run())


def test_the_dashboard_listens_on_localhost_only(app) -> None:
    port = int(app.url.rpartition(":")[2])
    with socket.create_connection(("localhost", port), timeout=5):
        pass
    others = [address[4][0] for address in socket.getaddrinfo(socket.gethostname(), port, type=socket.SOCK_STREAM)]
    for address in {one for one in others if not one.startswith("127.") and one != "::1"}:
        with pytest.raises(OSError), socket.create_connection((address, port), timeout=2):
            pass
    with socket.socket() as probe:
        # Another address of the loopback net stands for the network: a server on all addresses would answer there.
        assert probe.connect_ex(("127.0.0.2", port)) != 0


@pytest.fixture
def visitors(chromium):
    with tab(chromium) as anna, tab(chromium) as bob:
        yield anna, bob


def test_two_visitors_do_not_see_what_the_other_has_not_saved(app, visitors) -> None:
    anna, bob = visitors
    for visitor in visitors:
        visitor.goto(f"{app.url}/history")
        visitor.get_by_text("Revision 1:").wait_for()
    write(anna, "Words in the note", "nothing is like this")
    anna.get_by_text("No change is like this").wait_for()
    write(bob, "Your name", "Bob")
    settled(bob)
    assert bob.get_by_text("Revision 1:").is_visible()
    assert bob.get_by_label("Words in the note", exact=True).input_value() == ""
    write(anna, "Words in the note", "")
    anna.get_by_text("Revision 1:").wait_for()
    assert anna.get_by_label("Your name", exact=True).input_value() == ""


def write(page, label: str, text: str) -> None:
    page.get_by_label(label, exact=True).fill(text)
    page.get_by_label(label, exact=True).press("Enter")


def test_a_tab_that_is_older_than_the_server_says_so(tmp_path, page) -> None:
    port = free_port()
    banner = page.get_by_role("alert").filter(has_text="This page was loaded from lipdb")
    with serving(tmp_path, port=port) as app:
        page.goto(f"{app.url}/history")
        page.get_by_text("Revision 1:").wait_for()
        settled(page)  # nothing is under way that would be asked for again
        assert banner.count() == 0
    newer = tmp_path / "newer" / "lipdb-99.1.dist-info"
    newer.mkdir(parents=True)
    (newer / "METADATA").write_text("Metadata-Version: 2.1\nName: lipdb\nVersion: 99.1\n")
    with serving(tmp_path, port=port, PYTHONPATH=str(newer.parent)):
        banner.wait_for()
        assert "the dashboard runs 99.1 now" in banner.inner_text()
        banner.get_by_role("button", name="Reload").click()
        page.get_by_text("Revision 1:").wait_for()
        settled(page)
        assert not banner.is_visible()
