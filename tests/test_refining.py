"""A common phone is split by editing text only: its kinds inherit its curves until somebody draws better ones."""

from pathlib import Path

import numpy as np
import pytest

import lipdb
from lipdb import engine
from lipdb.curated.check import check
from lipdb.curated.folder import read_folder, write_folder
from lipdb.curves.lookup import CurveBook
from lipdb.languages.inventory import inventory
from lipdb.languages.reuse import reuse
from lipdb.paths import data_dir
from lipdb.phones.phoneset import PhoneSet
from lipdb.phones.refined import Kinds
from lipdb.poses import PoseSet
from lipdb.schedule import Schedule

SPLIT = {"p": "bp", "b": "bp", "m": "m"}
LANGUAGES = ("en", "cmn")


def common_rows(text: str) -> str:
    """The text of common.tsv with bp and m."""
    header, *rows = text.splitlines()
    names = header.split("\t")
    for phone in ("bp", "m"):
        cells = {"phone": phone, "kind": "consonant", "ipa": phone[-1], "kind_of": "bmp", "source": "lipdb", "language": "en"}
        rows.append("\t".join(cells.get(name, "") for name in names))
    return "\n".join([header, *sorted(rows)]) + "\n"


def phone_rows(text: str) -> str:
    """The text of en/phones.tsv with p and b as bp, m as m."""
    header, *rows = text.splitlines()
    at = header.split("\t").index("common")
    done = []
    for row in rows:
        cells = row.split("\t")
        if cells[0] in SPLIT:
            cells[at] = SPLIT[cells[0]]
        done.append("\t".join(cells))
    return "\n".join([header, *done]) + "\n"


def curve(left, right, pose, keys, origin="authored"):
    provenance = {"origin": origin, "source": "lipdb", "licence": "CC0-1.0", "author": "ana", "time": "2026-11-22T10:00:00Z", "comment": ""}
    return {"left": left, "right": right, "pose": pose, "keys": keys, "warp": "border", **provenance}


@pytest.fixture(scope="module")
def whole(tmp_path_factory) -> Path:
    """The shipped text of English and Mandarin, and all that they need."""
    folder = tmp_path_factory.mktemp("whole")
    records = read_folder(data_dir("phonesets"))
    others = {path.split("/")[0] for path in records if path.endswith("/language.tsv")} - set(LANGUAGES)
    write_folder({path: rows for path, rows in records.items() if path.split("/")[0] not in others}, folder)
    return folder


@pytest.fixture(scope="module")
def split(whole, tmp_path_factory) -> Path:
    """The same with bmp split for English: two edited files, nothing else."""
    folder = tmp_path_factory.mktemp("split")
    for file in whole.rglob("*.tsv"):
        target = folder / file.relative_to(whole)
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(file.read_bytes())
    for name, edit in (("common.tsv", common_rows), ("en/phones.tsv", phone_rows)):
        (folder / name).write_text(edit((folder / name).read_text("utf-8")), "utf-8")
    return folder


@pytest.fixture(scope="module")
def before(whole):
    return read_folder(whole)


@pytest.fixture(scope="module")
def after(split):
    return read_folder(split)


def weights(records, language, labels, notation):
    times = np.arange(len(labels) + 1) * 0.09
    spans = [(float(a), float(b), label) for a, b, label in zip(times, times[1:], labels, strict=False)]
    schedule, unknown = PhoneSet.from_records(records, language).resolve(Schedule.from_intervals(spans, notation=notation))
    assert not unknown
    edges, phones = schedule.common()
    book = CurveBook.from_records(records, "facefx", language=language)
    return engine.animate(book.table(phones), PoseSet.from_records(records, "facefx"), edges, phones, fps=60.0).weights, phones


WORDS = ["_", "b", "A", "p", "A", "m", "b", "{", "m", "p", "s", "w", "i", "m", "_", "m", "V", "m", "_"]


def test_the_edit_is_valid_text(after):
    assert check(after) == []


def test_english_moves_as_before_to_the_last_digit(before, after):
    old, _ = weights(before, "en", WORDS, "sampa")
    new, phones = weights(after, "en", WORDS, "sampa")
    assert {"bp", "m"} <= set(phones)
    assert "bmp" not in phones
    np.testing.assert_array_equal(new, old)


def test_both_kinds_still_close_the_lips(after):
    book = CurveBook.from_records(after, "facefx", language="en")
    table = book.table(["bp", "m", "ah", "d"])
    closing = table.closing[table.poses.index("PBM")]
    assert {name for name, shuts in zip(table.phones, closing, strict=True) if shuts} == {"bp", "m"}


def test_other_languages_stay_as_they_were(before, after):
    labels = ["_", "b", "a", "m", "a", "_"]
    old, before_phones = weights(before, "cmn", labels, "pinyin")
    new, phones = weights(after, "cmn", labels, "pinyin")
    assert phones == before_phones
    assert "bmp" in phones
    np.testing.assert_array_equal(new, old)


def test_an_inherited_curve_says_where_it_comes_from(after):
    book = CurveBook.from_records(after, "facefx", language="en")
    found = book.find("m", "ah", "PBM")
    assert found.curve == book.find("bmp", "ah", "PBM").curve
    assert (found.layer, found.inherited) == ("common", ("bmp", "ah"))
    assert found.reason.startswith("inherited from bmp-ah: ")
    assert found.where == "common (from bmp-ah)"
    assert not found.fallback
    assert book.find("bp", "m", "open").inherited == ("bmp", "bmp")
    assert book.find("ah", "d", "open").inherited == ()


def test_a_curve_that_somebody_draws_ends_it_for_its_pair_and_pose_alone(after):
    rows = after["curves/facefx.tsv"] | {("m", "ah", "open"): curve("m", "ah", "open", "0:0 0.5:0.3 1:0")}
    book = CurveBook.from_records(after | {"curves/facefx.tsv": rows}, "facefx", language="en")
    assert book.find("m", "ah", "open").inherited == ()
    assert book.find("m", "ah", "open").curve.origin == "authored"
    assert book.find("m", "ah", "PBM").inherited == ("bmp", "ah")
    assert book.find("bp", "ah", "open").inherited == ("bmp", "ah")


def test_a_layer_goes_before_the_phone(after):
    """What was drawn for a character's bmp speaks for its m, whatever the common layer has for m."""
    drawn = {
        "curves/facefx.tsv": after["curves/facefx.tsv"] | {("m", "ah", "open"): curve("m", "ah", "open", "0:0 0.5:0.3 1:0")},
        "en/curves/facefx.tsv": {("bmp", "ah", "open"): curve("bmp", "ah", "open", "0:0 0.5:0.2 1:0")},
    }
    found = CurveBook.from_records(after | drawn, "facefx", language="en").find("m", "ah", "open")
    assert (found.layer, found.inherited) == ("language:en", ("bmp", "ah"))
    assert CurveBook.from_records(after | drawn, "facefx", language="cmn").find("m", "ah", "open").inherited == ()


def test_without_any_curve_the_targets_of_the_coarser_phone_are_used(after):
    book = CurveBook.from_records(after | {"curves/facefx.tsv": {}}, "facefx")
    found = book.find("m", "ah", "PBM")
    assert found.layer == "generated"
    assert found.inherited == ("bmp", "ah")
    assert found.curve.keys == book.find("bmp", "ah", "PBM").curve.keys != ()


def test_a_pose_set_that_is_reached_through_links_inherits_too(before, after):
    old = CurveBook.from_records(before, "crab", language="en", character="crab")
    new = CurveBook.from_records(after, "crab", language="en", character="crab")
    for pose in new.poses:
        assert new.find("m", "ah", pose).curve.keys == old.find("bmp", "ah", pose).curve.keys
    assert {new.find("m", "ah", pose).inherited for pose in new.poses} >= {("bmp", "ah")}


def test_the_cost_in_pairs_is_shown(before, after):
    def own(records, donor):
        return next(part for part in reuse(records, "en", [donor], {}).parts if part.name == "own phones")

    assert (own(before, "cmn").pairs, own(after, "cmn").pairs) == (441, 484)
    assert own(after, "cmn").inherited == 2 * 2 * 18 + 2 * 2  # bp and m with the 18 phones that both have, and with each other
    found = {phone.phone: phone for phone in inventory(after)}
    assert (found["m"].kind_of, found["m"].languages, found["m"].pairs, found["m"].own) == ("bmp", ("en",), 45, 0)
    assert found["m"].inherited == 45
    assert found["bmp"].languages == ("cmn",)
    assert {phone.phone for phone in inventory(before)} == set(found) - {"bp", "m"}


def test_merging_back_is_the_same_edit_the_other_way(whole, split, before, tmp_path):
    with lipdb.open(tmp_path / "a.db", phonesets=whole) as db:
        for folder in (split, whole):
            db.store.load(folder, author="ana")
            assert db.records == read_folder(folder)
        db.store.dump(tmp_path / "dump")
    for file in whole.rglob("*.tsv"):
        assert (tmp_path / "dump" / file.relative_to(whole)).read_bytes() == file.read_bytes()


def test_pairs_and_explain_name_what_is_inherited(split, tmp_path):
    with lipdb.open(tmp_path / "a.db", phonesets=split) as db:
        line = db.say("Bob met mama")
        uses = {use.pair: use.to_row() for use in db.pairs(line)}
        assert uses["m", "eh"]["inherited"] == ["bmp-eh"]
        assert uses["eh", "d"]["inherited"] == []
        causes = db.explain(line, at=line.schedule.edges[1] / 1e6 + 0.03)
        assert any("from " in layer for cause in causes for layer in cause.to_row()["layer"])
        assert any(entry["inherited"] for cause in causes for entry in cause.to_json()["curves"])


class TestMistakes:
    """What `lipdb db check` says of kinds that can't be."""

    def messages(self, records, phone, kind_of):
        common = {key: dict(row) for key, row in records["common.tsv"].items()}
        common[phone,]["kind_of"] = kind_of
        return [finding.message for finding in check(records | {"common.tsv": common})]

    def test_a_phone_is_no_kind_of_a_phone_that_there_is_not(self, after):
        assert self.messages(after, "m", "qqqq") == ["common phone 'qqqq' does not exist"]

    def test_a_phone_is_no_kind_of_itself(self, after):
        found = self.messages(after, "bmp", "m")
        assert any("'bmp' would be a kind of itself: bmp > m > bmp" in message for message in found)

    def test_silence_has_no_kinds(self, after):
        assert self.messages(after, "m", "_") == ["silence has no kinds"]


def test_kinds_of_kinds_are_asked_for_nearest_first():
    kinds = Kinds({"m1": "m", "m": "bmp", "l2": "l"})
    assert list(kinds.coarser_pairs("m1", "l2")) == [("m1", "l"), ("m", "l2"), ("m", "l"), ("bmp", "l2"), ("bmp", "l")]
    assert list(kinds.coarser_pairs("d", "l")) == []
    assert Kinds({"a": "b", "b": "a"}).line("a") == ("a", "b")
