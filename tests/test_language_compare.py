"""Two versions of a language: rows added, removed and changed, conflicts, and what comes out of a person's choices."""

import pytest
from shared_tables import copy_shared_tables

from lipdb.curated.folder import read_folder, write_folder
from lipdb.errors import ConflictError, PhonesetError
from lipdb.languages.compare import LEFT, RIGHT, applied, changed_rows, chosen_rows, completed, differences
from lipdb.languages.keep import save_merged

PHONES = "qpa/phones.tsv"


def phone(name: str, common: str, **cells: str) -> dict[str, str]:
    row = {"phone": name, "kind": "consonant", "ipa": name, "common": common, "example": name, "origin": "authored"}
    return {**row, "source": "user", "licence": "LicenseRef-user", "author": "anna", "time": "2026-11-22T09:00:00Z", "comment": "", **cells}


def version(*rows: dict[str, str]) -> dict:
    return {PHONES: {(row["phone"],): row for row in rows}}


BASE = version(phone("p", "bmp"), phone("t", "d"), phone("k", "kg"), phone("f", "f"))
LEFT_ONE = version(phone("p", "bmp"), phone("t", "th"), phone("k", "d"), phone("f", "f"))
RIGHT_ONE = version(phone("p", "f"), phone("t", "d"), phone("k", "h"), phone("s", "z"))


def test_rows_are_added_removed_and_changed() -> None:
    found = {one.key[0]: one.kind for one in differences(LEFT_ONE, RIGHT_ONE)}
    assert found == {"p": "changed", "t": "changed", "k": "changed", "f": "removed", "s": "added"}


def test_a_listing_shows_the_cells_that_differ_only() -> None:
    row = next(one.to_row() for one in differences(LEFT_ONE, RIGHT_ONE) if one.key == ("p",))
    assert (row["what"], row["row"], row["left"], row["right"]) == ("changed", "p", "common bmp", "common f")


def test_with_an_ancestor_each_side_keeps_what_only_it_changed_and_conflicts_come_first() -> None:
    found = differences(LEFT_ONE, RIGHT_ONE, BASE)
    assert [(one.key[0], one.taken, one.conflict) for one in found] == [
        ("k", LEFT, True), ("f", RIGHT, False), ("p", RIGHT, False), ("s", RIGHT, False), ("t", LEFT, False),
    ]  # fmt: skip


def test_choices_decide_row_by_row() -> None:
    found = differences(LEFT_ONE, RIGHT_ONE, BASE)
    chosen = chosen_rows(found, {(PHONES, ("k",)): RIGHT, (PHONES, ("f",)): LEFT})
    merged = applied(LEFT_ONE, changed_rows(LEFT_ONE, chosen))
    assert {key[0]: row["common"] for key, row in merged[PHONES].items()} == {"p": "f", "t": "th", "k": "h", "f": "f", "s": "z"}


def test_nothing_chosen_keeps_the_left_side() -> None:
    assert changed_rows(LEFT_ONE, chosen_rows(differences(LEFT_ONE, RIGHT_ONE), {})) == {}


def test_a_language_s_folder_is_compared_with_that_language_only() -> None:
    whole = {**BASE, "sources.tsv": {("x",): {"source": "x"}}, "common.tsv": {("f",): {"phone": "f"}}, "en/phones.tsv": BASE[PHONES]}
    sent = {**RIGHT_ONE, "common.tsv": {("ph",): {"phone": "ph"}}}
    found = differences(whole, completed(sent, whole))
    assert {(one.path, one.key[0]) for one in found} == {(PHONES, name) for name in "pkfs"} | {("common.tsv", "ph")}


@pytest.fixture
def folder(tmp_path):
    root = copy_shared_tables(tmp_path / "phonesets")
    row = {"language": "qpa", "name": "Palu", "notation": "ipa", "speech": "written", "voice": "none", "script": "Latn"}
    write_folder({**LEFT_ONE, "qpa/language.tsv": {("qpa",): {**row, "source": "user", "comment": ""}}}, root)
    return root


def test_a_merge_is_saved_to_the_workspace_as_one_changed_line_a_row(folder) -> None:
    seen = read_folder(folder)
    text = (folder / PHONES).read_text().splitlines()
    files = save_merged({(PHONES, ("t",)): phone("t", "d")}, folder, seen=seen)
    assert files == [folder / PHONES]
    assert sum(a != b for a, b in zip(text, (folder / PHONES).read_text().splitlines(), strict=True)) == 1


def test_what_somebody_changed_in_the_meantime_is_not_overwritten(folder) -> None:
    seen = read_folder(folder)
    save_merged({(PHONES, ("t",)): phone("t", "d")}, folder, seen=seen)
    with pytest.raises(ConflictError, match="somebody changed t in the meantime"):
        save_merged({(PHONES, ("t",)): phone("t", "z")}, folder, seen=seen)
    assert read_folder(folder)[PHONES]["t",]["common"] == "d"


def test_a_merge_that_would_be_wrong_is_refused(folder) -> None:
    seen = read_folder(folder)
    with pytest.raises(PhonesetError, match="'nix' does not exist"):
        save_merged({(PHONES, ("t",)): phone("t", "nix")}, folder, seen=seen)
    assert read_folder(folder) == seen


def test_a_table_that_loses_its_last_row_goes(folder) -> None:
    write_folder({"qpa/sentences.tsv": {("Pa.",): {"sentence": "Pa.", "source": "user", "comment": ""}}}, folder)
    save_merged({("qpa/sentences.tsv", ("Pa.",)): None}, folder, seen=read_folder(folder))
    assert not (folder / "qpa/sentences.tsv").exists()
