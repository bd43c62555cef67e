"""Shapes told by their names: which known set a face has, and what leads to it."""

from pathlib import Path

import pytest

from lipdb.characters.match import find_shapes, match, plain_names
from lipdb.curated.folder import read_folder
from lipdb.errors import InputError

ARKIT = [
    "browInnerUp",
    "jawOpen",
    "jawForward",
    "mouthFunnel",
    "mouthPucker",
    "mouthLeft",
    "mouthRollUpper",
    "mouthRollLower",
    "mouthShrugUpper",
    "mouthShrugLower",
    "mouthClose",
    "mouthSmile_L",
    "mouthSmile_R",
    "mouthUpperUp_L",
    "mouthUpperUp_R",
    "mouthLowerDown_L",
    "mouthLowerDown_R",
    "mouthPress_L",
    "mouthPress_R",
    "mouthStretch_L",
    "mouthStretch_R",
    "tongueOut",
]
OCULUS = ["sil", "PP", "FF", "TH", "DD", "kk", "CH", "SS", "nn", "RR", "aa", "E", "I", "O", "U"]


@pytest.fixture(scope="module")
def records():
    return read_folder(Path(__file__).parent.parent / "phonesets")


@pytest.mark.parametrize(
    ("shapes", "shape_set"),
    [
        (ARKIT, "arkit52"),
        ([name.replace("_L", "Left").replace("_R", "Right") for name in ARKIT], "arkit52"),
        ([f"blendShape1.{name}" for name in ARKIT], "arkit52"),
        ([f"Head:{name.upper()}" for name in ARKIT], "arkit52"),
        ([name.replace("_L", "L").replace("_R", "R") for name in ARKIT], "arkit52"),
        (OCULUS, "oculus15"),
        ([f"viseme_{name}" for name in OCULUS], "oculus15"),
        (
            [f"vrc.v_{name}" for name in ["sil", "pp", "ff", "th", "dd", "kk", "ch", "ss", "nn", "rr", "aa", "e", "ih", "oh", "ou"]],
            "oculus15",
        ),
        (list("AIUEO"), "vrm"),
        ([f"Fcl_MTH_{vowel}" for vowel in "AIUEO"], "vrm"),
        (["aa", "ih", "ou", "ee", "oh", "blink"], "vrm"),
        (list("あいうえお"), "vrm"),
        (["open", "W", "ShCh", "PBM", "FV", "wide", "tRoof", "tTeeth", "tBack", "smile", "frown"], "facefx"),
        (["AI", "E", "O", "U", "etc", "FV", "L", "MBP", "rest", "WQ"], "preston_blair"),
        (list("ABCDEFGHX"), "rhubarb"),
    ],
)
def test_known_sets_are_told_by_their_names_in_any_dress(records, shapes, shape_set):
    found = match(shapes, records)
    assert (found.shape_set, found.share) == (shape_set, 1.0)
    assert found.doubtful == found.missing == ()
    assert {p.shape for p in found.proposals} <= set(shapes)


def test_the_links_are_those_of_the_set_under_the_faces_own_names(records):
    proposals = match([f"blendShape1.{name}" for name in ARKIT], records).proposals
    shared = records["links/facefx/arkit52.tsv"]
    jaw = next(p for p in proposals if (p.pose, p.shape) == ("open", "blendShape1.jawOpen"))
    assert (jaw.gain, jaw.certainty) == (shared["open", "jawOpen"]["gain"], "sure")
    assert len(proposals) == len(shared)


def test_a_name_with_a_slip_is_doubtful_and_a_lacking_one_missing(records):
    found = match([name.replace("mouthPucker", "mouthPuckr") for name in ARKIT if name != "tongueOut"], records)
    assert found.shape_set == "arkit52"
    assert found.doubtful == ("mouthPuckr",)
    assert found.missing == ("tongueOut",)
    assert 0.8 < found.share < 1


def test_one_shape_for_both_sides_gets_one_link_a_pose(records):
    shapes = [name.removesuffix("_L") for name in ARKIT if not name.endswith("_R")]
    found = match(shapes, records)
    assert found.shape_set == "arkit52"
    keys = [(p.pose, p.shape) for p in found.proposals]
    assert len(keys) == len(set(keys))
    assert ("PBM", "mouthPress") in keys


def test_names_that_nobody_knows_are_refused_with_what_to_do(records):
    with pytest.raises(InputError, match=r"none of the known sets has shapes of these names \(Key_1, Key_2\); rename them"):
        match(["Key_1", "Key_2"], records)
    with pytest.raises(InputError):
        match([], records)


@pytest.mark.parametrize(
    ("name", "plain"),
    [
        ("jawOpen", ["jawopen"]),
        ("mouthSmile_L", ["mouthsmileleft"]),
        ("mouthSmileRight", ["mouthsmileright"]),
        ("mouth_smile.r", ["mouthsmileright"]),
        ("mesh|blendShape2.JawOpen", ["jawopen"]),
        ("viseme_aa", ["visemeaa", "aa"]),
        ("vrc.v_pp", ["vpp", "pp"]),
        ("L", ["l"]),
        ("FV", ["fv"]),
        ("___", []),
    ],
)
def test_names_are_compared_without_what_programs_add(name, plain):
    assert plain_names(name) == plain


def test_the_very_name_wins_over_one_that_is_alike():
    assert find_shapes(["aa"], ["viseme_aa", "AA", "aa"], {})["aa"] == ("aa", "sure")


def test_other_names_are_used_where_the_name_itself_is_not_there():
    assert find_shapes(["aa"], ["A"], {"aa": ["A"]})["aa"] == ("A", "sure")
    assert find_shapes(["aa"], ["B"], {"aa": ["A"]}) == {}


def test_every_other_name_in_the_table_is_for_a_pose_that_exists(records):
    for pose_set, _, pose in records["shape_names.tsv"]:
        assert (pose,) in records[f"poses/{pose_set}.tsv"]
