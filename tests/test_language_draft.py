"""A new language on its way: begun from a voice or from typed phones, corrected, tried, checked, and kept."""

import io
import shutil
import zipfile

import pytest
from shared_tables import copy_workspace

import lipdb
from lipdb.curated.folder import read_folder
from lipdb.curated.zipped import read_zip
from lipdb.errors import InputError, LipdbError, OutputError, PhonesetError
from lipdb.languages.begin import draft_of_phones, draft_of_voice, typed_entries
from lipdb.languages.conformance import check_language
from lipdb.languages.draft import Draft
from lipdb.languages.keep import ready_workspace, save_rows, save_text, zipped
from lipdb.languages.trial import Trial, check_records, cost, perform
from lipdb.store import EditConflictError
from lipdb.store.cells import flat

PHONES = "p m k l a i u ʃ=sh ɸ=f"
TEXT = "Palu miku! Shapa lafi, mapu. Ki ama kulifa. Fafu shisha."


@pytest.fixture(scope="module")
def workspace(tmp_path_factory):
    return copy_workspace(tmp_path_factory.mktemp("draft") / "phonesets")


@pytest.fixture(scope="module")
def records(workspace):
    return read_folder(workspace)


@pytest.fixture
def palu(records) -> Draft:
    return draft_of_phones("qpa", records=records, name="Palu", ipa=PHONES, text=TEXT)


@pytest.fixture(scope="module")
def filled(tmp_path_factory, workspace):
    """A database filled from the workspace, to be copied."""
    file = tmp_path_factory.mktemp("filled") / "lipdb.db"
    lipdb.open(file, phonesets=workspace).close()
    return file


@pytest.fixture
def db(tmp_path, filled, workspace):
    with lipdb.open(shutil.copy(filled, tmp_path), phonesets=workspace) as opened:
        yield opened


def test_typed_phones_are_mapped_and_the_doubtful_ones_come_first(palu) -> None:
    first, *rest = palu.in_order()
    assert (first.phone.ipa, first.common, first.phone.proposal.second, first.doubtful) == ("ɸ", ("f",), ("bmp",), True)
    assert first.phone.review == "by PanPhon's features ɸ is nearest to bmp"
    assert not any(one.doubtful for one in rest)
    assert {one.phone.ipa: one.common for one in rest}["ʃ"] == ("sh",)


def test_typed_phones_get_their_examples_from_the_text_by_their_spelling(palu) -> None:
    assert palu.entries["ʃ"].example in ("Shapa", "shisha")
    assert palu.entries["ɸ"].example in ("lafi", "kulifa", "Fafu")


def test_pasted_words_in_ipa_give_their_phones(records) -> None:
    assert [one.phone.ipa for one in typed_entries("/ˈpalu tʃi/", records)] == ["p", "a", "l", "u", "tʃ", "i"]


@pytest.mark.parametrize(
    ("typed", "told"),
    [("p § 7", r"no IPA: '§', '7'; write phones"), ("", "there is no phone; write phones"), ("p " * 3 + "X", "no IPA: 'X'")],
)
def test_symbols_that_are_no_ipa_are_named(records, typed, told) -> None:
    with pytest.raises(InputError, match=told):
        typed_entries(typed, records)


@pytest.mark.parametrize(
    ("code", "name", "told"), [("EN!", "x", "is no code"), ("en", "x", "'en' is there already"), ("qpa", " ", "give the language a name")]
)
def test_a_language_needs_a_code_of_its_own_and_a_name(records, code, name, told) -> None:
    with pytest.raises(InputError, match=told):
        draft_of_phones(code, records=records, name=name, ipa=PHONES, text=None)


@pytest.mark.parametrize(
    ("voice", "text", "told"),
    [
        ("xx", "Ala ma kota", "no voice 'xx'"),
        ("pl", "你好", "can read none"),
        ("pl", " \n", "no word in it"),
        ("pl", "?!", "no word"),
    ],
)
def test_a_voice_or_a_text_that_can_t_be_is_said_in_one_line(records, voice, text, told) -> None:
    with pytest.raises(InputError, match=told) as error:
        draft_of_voice("pl", records=records, voice=voice, name="", text=text)
    assert "\n" not in str(error.value)


def test_a_decision_is_signed_and_what_nobody_looked_at_stays_the_rules_own(palu, records) -> None:
    palu.decide("ɸ", common=["bmp"], example="Fafu", spelt="f", note="the lips meet")
    rows = palu.tables(records, author="anna")["qpa/phones.tsv"]
    decided, left = rows["ɸ",], rows["p",]
    assert [decided[name] for name in ("common", "origin", "source", "licence", "author")] == [
        "bmp",
        "authored",
        "user",
        "LicenseRef-user",
        "anna",
    ]
    assert decided["comment"].startswith("the lips meet. Proposed f. The lips come close")
    assert [left[name] for name in ("common", "origin", "source")] == ["bmp", "generated", "lipdb"]
    assert palu.next_doubtful == ""


@pytest.mark.parametrize(
    ("common", "example", "told"),
    [([], "x", "at least one"), (["_"], "x", "can't be silent"), (["f"], " ", "give a word")],
)
def test_a_decision_that_can_t_be_changes_nothing(palu, common, example, told) -> None:
    with pytest.raises(InputError, match=told):
        palu.decide("p", common=common, example=example)
    assert (palu.entries["p"].common, palu.entries["p"].decided) == (("bmp",), False)


def test_phones_can_be_added_and_left_out(palu, records) -> None:
    assert palu.add(typed_entries("p θ", records)) == ["θ"]
    palu.leave_out("k")
    rows = palu.tables(records, author="anna")["qpa/phones.tsv"]
    assert ("θ",) in rows
    assert ("k",) not in rows


def test_a_common_phone_of_its_own_costs_pairs_that_begin_with_the_coarser_ones_curves(palu, records, db) -> None:
    before = cost(Trial(db, palu.tables(records, author="anna")).records, "qpa")
    assert (before.own, before.part.new) == ((), ())
    palu.add_common("ph", kind="consonant", ipa="ɸ", kind_of="f", example="fafu", comment="blown", records=records)
    palu.decide("ɸ", common=["ph"], example="Fafu", spelt="f")
    after = cost(Trial(db, palu.tables(records, author="anna")).records, "qpa")
    (ph,) = after.own
    assert (ph.phone, ph.pairs, ph.inherited) == ("ph", 17, 17)
    assert len(after.part.new) == after.part.inherited == 15
    palu.drop_common("ph")
    assert palu.entries["ɸ"].common == ("f",)


@pytest.mark.parametrize(
    ("name", "ipa", "kind_of", "told"),
    [("bmp", "ɸ", "", "already"), ("P H", "ɸ", "", "no name"), ("ph", "§", "", "no letter"), ("ph", "ɸ", "fff", "no common phone 'fff'")],
)
def test_a_common_phone_that_can_t_be_is_refused(palu, records, name, ipa, kind_of, told) -> None:
    with pytest.raises(InputError, match=told):
        palu.add_common(name, kind="consonant", ipa=ipa, kind_of=kind_of, example="", comment="", records=records)


def test_a_draft_speaks_and_is_checked_before_it_is_anywhere(palu, db) -> None:
    trial = Trial(db, palu.tables(db.records, author="anna"))
    assert perform(trial, "Palu", language="qpa", character="robin").track.weights.max() > 0.3
    checked = check_records("qpa", trial.records)
    assert checked.errors == 0
    assert ("phones.tsv", "ɸ") in {(one.table, one.row) for one in checked.findings}
    with pytest.raises(InputError, match="no language 'qpa'"):
        db.say("Palu", language="qpa")


def test_what_is_wrong_is_told_with_its_row(palu, db) -> None:
    palu.leave_out("k")
    checked = check_records("qpa", Trial(db, palu.tables(db.records, author="anna")).records)
    assert checked.errors
    assert "'k' in 'miku' is no phone of qpa" in " ".join(one.finding.message for one in checked.findings)


def test_it_is_kept_as_text_that_passes_the_kit_and_only_adds_lines(palu, db, tmp_path, workspace) -> None:
    palu.add_common("ph", kind="consonant", ipa="ɸ", kind_of="f", example="fafu", comment="", records=db.records)
    palu.decide("ɸ", common=["ph"], example="Fafu", spelt="f")
    own = palu.tables(db.records, author="anna")
    folder = copy_workspace(tmp_path / "text")
    before = (folder / "common.tsv").read_text().splitlines()
    files = save_text("qpa", own, folder)
    assert sorted(file.relative_to(folder).as_posix() for file in files) == sorted(own)
    after = (folder / "common.tsv").read_text().splitlines()
    assert [line for line in after if line not in before] == ["ph\tconsonant\tɸ\tqpa\tfafu\tf\tuser\t"]
    assert [line for line in before if line not in after] == []
    report = check_language("qpa", folder, base=folder)
    assert report.errors == ()
    assert not list(folder.glob(".lipdb-*"))


def test_text_is_never_overwritten_nor_left_half_written(palu, db, tmp_path) -> None:
    own = palu.tables(db.records, author="anna")
    folder = copy_workspace(tmp_path / "text")
    broken = {**own, "qpa/phones.tsv": {key: {**row, "common": "nix"} for key, row in own["qpa/phones.tsv"].items()}}
    with pytest.raises(PhonesetError, match="'nix' does not exist"):
        save_text("qpa", broken, folder)
    assert not (folder / "qpa").exists()
    (folder / "qpa").mkdir()
    with pytest.raises(InputError, match="never overwritten"):
        save_text("qpa", own, folder)
    assert list((folder / "qpa").iterdir()) == []


def test_when_the_shared_table_can_t_be_written_the_language_is_not_there_either(palu, db, tmp_path, monkeypatch) -> None:
    palu.add_common("ph", kind="consonant", ipa="ɸ", kind_of="f", example="fafu", comment="", records=db.records)
    folder = copy_workspace(tmp_path / "text")
    before = read_folder(folder)

    def full(path):
        raise OutputError(f"{path}: can't be written (No space left on device)")

    monkeypatch.setattr("lipdb.languages.keep.whole_file", full)
    with pytest.raises(OutputError, match="No space left"):
        save_text("qpa", palu.tables(db.records, author="anna"), folder)
    assert read_folder(folder) == before


def test_a_workspace_that_is_no_folder_is_said(palu, db, tmp_path) -> None:
    with pytest.raises(PhonesetError, match="no such folder"):
        save_text("qpa", palu.tables(db.records, author="anna"), tmp_path / "no" / "where")


def test_a_workspace_that_is_not_there_is_made_from_the_database(db, tmp_path) -> None:
    folder = tmp_path / "mine"
    assert ready_workspace(folder, db.store) == db.store.revision
    assert read_folder(folder) == db.records
    assert ready_workspace(folder, db.store) is None


def test_saved_to_the_database_it_speaks_at_once_with_each_row_as_it_was_made(palu, db) -> None:
    palu.decide("ɸ", common=["bmp"], example="Fafu", spelt="f")
    own = palu.tables(db.records, author="anna")
    seen = db.store.revision
    number = save_rows(flat(own), db.store, author="anna", note="Add Palu", seen=seen)
    assert db.store.history(limit=1)[0].to_json()["note"] == "Add Palu"
    assert [db.records["qpa/phones.tsv"][phone,]["origin"] for phone in "pɸ"] == ["generated", "authored"]
    assert [one.symbol for one in db.say("palu", language="qpa").schedule.phones] == ["_", "p", "a", "l", "u", "_"]
    other = {**own, "qpa/phones.tsv": {key: {**row, "common": "aa"} for key, row in own["qpa/phones.tsv"].items()}}
    with pytest.raises(EditConflictError):
        save_rows(flat(other), db.store, author="bob", note="Mine", seen=seen)
    assert db.store.revision == number


def test_kept_as_text_and_in_the_database_the_rows_are_the_same(palu, db, tmp_path, monkeypatch) -> None:
    palu.decide("ɸ", common=["bmp"], example="Fafu", spelt="f")
    folder = copy_workspace(tmp_path / "text")
    save_text("qpa", palu.tables(db.records, author="anna"), folder)
    monkeypatch.setattr("lipdb.languages.draft._now", lambda: "2030-01-01T00:00:00Z")
    save_rows(flat(palu.tables(db.records, author="anna")), db.store, author="anna", note="", seen=db.store.revision)
    assert read_folder(folder) == db.records


def test_a_viewer_can_t_save(palu, db) -> None:
    with pytest.raises(LipdbError, match="for looking only"):
        save_rows(flat(palu.tables(db.records, author="")), db.read_only().store, author="anna", note="", seen=db.store.revision)


def test_a_zip_is_the_same_text_and_reads_back(palu, records) -> None:
    own = palu.tables(records, author="anna")
    assert read_zip(zipped(own)) == own
    assert zipped(own) == zipped(own)


def test_a_zip_may_have_folders_around_and_other_files(palu, records) -> None:
    own = palu.tables(records, author="anna")
    buffer = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(zipped(own))) as inner, zipfile.ZipFile(buffer, "w") as outer:
        outer.writestr("review/README.md", "hello")
        for one in inner.infolist():
            outer.writestr(f"review/phonesets/{one.filename}", inner.read(one))
    assert read_zip(buffer.getvalue()) == own


def zip_of(**files: bytes) -> bytes:
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        for name, content in files.items():
            archive.writestr(name, content)
    return buffer.getvalue()


@pytest.mark.parametrize(
    ("data", "told"),
    [
        (b"not a zip", "no zip"),
        (zip_of(**{"readme.txt": b"x"}), "no table in the zip"),
        (zip_of(**{"../../../etc/passwd.tsv": b"x"}), "no table in the zip"),
        (zip_of(**{"pl/phones.tsv": b"\xff\xfe"}), "no UTF-8"),
        (zip_of(**{"pl/phones.tsv": b"wrong header"}), "header must be"),
        (zip_of(**{"pl/phones.tsv": b"x"})[:-30], "no zip"),
    ],
    ids=["text", "no_table", "outside", "no_text", "header", "cut_off"],  # a zip holds the time, a name must not
)
def test_an_upload_that_is_no_language_is_refused(data, told) -> None:
    with pytest.raises(LipdbError, match=told):
        read_zip(data)
