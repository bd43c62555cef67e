"""The curated data that ships is sound, canonical, and has the paper's numbers."""

from itertools import product

import pytest

from lipdb.curated.check import check
from lipdb.curated.folder import read_folder
from lipdb.curated.schema import table_of
from lipdb.curated.tsv import format_rows, parse_rows
from lipdb.paths import data_dir

FOLDER = data_dir("phonesets")
FILES = sorted(path.relative_to(FOLDER).as_posix() for path in FOLDER.rglob("*.tsv"))

# Xu et al. 2013, Table 1, in the paper's own spelling (SAPI): English phonemes, common phone, examples.
TABLE_1 = """
ae ah ax     | ah  | cat cut ago
aa           | aa  | father
ao           | ao  | dog
ey eh        | eh  | ate pet
er           | er  | fur
ih iy        | ih  | fill feel
w uw uh      | w   | with too book
ow           | ow  | go
aw           | aw  | foul
oy           | oy  | toy
ay           | ay  | bite
h            | h   | help
r            | r   | red
l            | l   | lid
s z          | z   | sit zap
sh ch jh zh y | sh | she chin joy pleasure yard
th dh        | th  | thin then
f v          | f   | fork vat
d t n ng     | d   | dig talk no sing
k g          | kg  | cut gut
p b m        | bmp | put big mat
"""
ROWS = [tuple(cell.split() for cell in line.split("|")) for line in TABLE_1.strip().splitlines()]
COMMON = {common for _, (common,), _ in ROWS}


@pytest.fixture(scope="module")
def records():
    return read_folder(FOLDER)


def test_nothing_is_wrong_between_the_tables(records):
    assert [str(finding) for finding in check(records)] == []


@pytest.mark.parametrize("path", FILES)
def test_every_file_is_canonical_byte_for_byte(path):
    data = (FOLDER / path).read_bytes()
    table = table_of(path)
    rows, findings = parse_rows(table, data.decode(), file=path)
    assert findings == []
    assert format_rows(table, rows).encode() == data


def test_every_row_names_its_source_and_every_source_its_licence(records):
    assert all(row["source"] for path, rows in records.items() if "source" in table_of(path).names for row in rows.values())
    assert all(row["licence"] for row in records["sources.tsv"].values())


def test_english_has_40_phones(records):
    assert len(records["en/phones.tsv"]) == 40


def test_there_are_21_common_phones_and_441_pairs_of_them(records):
    common = {row["phone"] for row in records["common.tsv"].values() if row["source"] == "xu2013" and not row["language"]}
    assert common == COMMON
    assert len(common) == 21
    assert len(list(product(common, repeat=2))) == 441


def test_mandarin_adds_one_phone_and_43_pairs_and_silence_44_more_which_makes_528(records):
    language = {row["phone"]: row["language"] for row in records["common.tsv"].values()}
    shared = {phone for phone, of in language.items() if not of} - {"_"}
    mandarin = {phone for phone, of in language.items() if of == "cmn"}
    speech = shared | mandarin
    assert mandarin == {"ue"}
    assert len(speech) ** 2 - len(shared) ** 2 == 43
    with_silence = set(product(language, repeat=2)) - {("_", "_")}
    assert len(with_silence) - len(speech) ** 2 == 44
    assert len(with_silence) == 528


@pytest.mark.parametrize(("sapi", "common", "examples"), ROWS)
def test_english_is_mapped_as_in_table_1(records, sapi, common, examples):
    phone = {row["symbol"]: row["phones"] for row in records["en/aliases.tsv"].values() if row["notation"] == "sapi"}
    rows = [records["en/phones.tsv"][phone[symbol],] for symbol in sapi]
    assert [row["common"] for row in rows] == common * len(sapi)
    assert sorted(row["example"] for row in rows) == sorted(examples)


def test_table_1_is_complete(records):
    symbols = [symbol for sapi, _, _ in ROWS for symbol in sapi]
    assert len(set(symbols)) == len(symbols) == 40
    aliases = {row["phones"]: row["symbol"] for row in records["en/aliases.tsv"].values() if row["notation"] == "sapi"}
    assert set(aliases) == {phone for (phone,) in records["en/phones.tsv"]}
    assert set(aliases.values()) == set(symbols)


def test_facefx_has_the_papers_priorities_speed_limit_and_thresholds(records):
    poses = {row["pose"]: row for row in records["poses/facefx.tsv"].values()}
    ranked = sorted((int(row["priority"]), pose) for pose, row in poses.items() if row["priority"])
    assert [pose for _, pose in ranked] == ["open", "W", "wide", "ShCh", "FV", "PBM"]
    assert set(poses) - {pose for _, pose in ranked} == {"tBack", "tRoof", "tTeeth"}
    assert {row["speed"] for row in poses.values()} == {"15"}
    assert {pose for pose, row in poses.items() if row["must_reach"] == "yes"} == {"PBM", "FV"}
    assert {pair: row["threshold"] for pair, row in records["constraints/facefx.tsv"].items()} == {
        ("open", "FV"): "0.5",
        ("open", "PBM"): "0.5",
        ("open", "ShCh"): "0.5",
    }
    assert records["poses/sets.tsv"]["facefx",]["threshold"] == "2"
    assert records["poses/sets.tsv"]["facefx",]["window"] == "0.18"


@pytest.mark.parametrize(
    ("pose_set", "count"),
    [("facefx", 9), ("arkit52", 52), ("oculus15", 15), ("vrm", 5), ("preston_blair", 10), ("rhubarb", 9), ("crab", 9)],
)
def test_every_pose_set_has_its_poses_in_order(records, pose_set, count):
    positions = sorted(int(row["position"]) for row in records[f"poses/{pose_set}.tsv"].values())
    assert positions == list(range(count))


@pytest.mark.parametrize("pose_set", ["arkit52", "oculus15", "vrm", "preston_blair", "rhubarb", "crab"])
def test_links_lead_from_every_pose_of_lips_and_jaw_to_every_other_set(records, pose_set):
    links = records[f"links/facefx/{pose_set}.tsv"]
    assert {pose for pose, _ in links} >= {"open", "W", "ShCh", "PBM", "FV", "wide", "tTeeth", "tRoof"}
