"""The shipped links from FaceFX's poses to other sets keep lips shut and show each pose by the shape that looks like it."""

from itertools import product

import numpy as np
import pytest

from lipdb.characters.links import through_links
from lipdb.curated.folder import read_folder
from lipdb.curves.through import link_from_row
from lipdb.paths import data_dir
from lipdb.track import Track

POSES = ("open", "W", "ShCh", "PBM", "FV", "wide", "tBack", "tRoof", "tTeeth")
SETS = ("arkit52", "oculus15", "vrm", "preston_blair", "rhubarb", "crab")
# Shapes that part the lips or press them, by set.
OPENERS = {
    "arkit52": ("jawOpen", "mouthUpperUpLeft", "mouthUpperUpRight", "mouthLowerDownLeft", "mouthLowerDownRight"),
    "oculus15": ("aa", "E", "I", "O", "U", "CH", "RR"),
    "vrm": ("aa", "ih", "ou", "ee", "oh"),
    "crab": ("mouth_open",),
}
CLOSERS = {"arkit52": ("mouthPressLeft", "mouthPressRight"), "oculus15": ("PP",), "crab": ("lips_press",)}


@pytest.fixture(scope="module")
def records():
    return read_folder(data_dir("phonesets"))


def shown(records, pose_set, **weights):
    """Weights of the shapes of *pose_set* for weights of FaceFX's poses."""
    links = [link_from_row(row) for row in records[f"links/facefx/{pose_set}.tsv"].values()]
    track = Track(np.array([[weights.get(pose, 0.0) for pose in POSES]]), POSES, 60.0)
    through = through_links(track, links)
    return dict(zip(through.poses, through.weights[0], strict=True))


# The engine leaves no open where PBM is above a half; all else may be there with it.
BESIDE = [dict(zip(("W", "wide", "tRoof"), weights, strict=True)) for weights in product((0.0, 0.6, 1.0), repeat=3)]


@pytest.mark.parametrize("pose_set", OPENERS)
def test_pressed_lips_stay_shut_whatever_else_is_asked_for(records, pose_set):
    for beside in BESIDE:
        shapes = shown(records, pose_set, PBM=1.0, **beside)
        assert {name: shapes[name] for name in OPENERS[pose_set] if shapes.get(name, 0.0) > 0} == {}


@pytest.mark.parametrize("pose_set", CLOSERS)
def test_pressed_lips_show_in_the_shapes_that_press(records, pose_set):
    shapes = shown(records, pose_set, PBM=1.0, W=1.0)
    assert all(shapes[name] >= 0.6 for name in CLOSERS[pose_set])


@pytest.mark.parametrize(("pose_set", "closed", "bitten"), [("preston_blair", "MBP", "FV"), ("rhubarb", "A", "G")])
def test_of_drawn_mouths_closures_win_over_everything(records, pose_set, closed, bitten):
    for beside in BESIDE:
        for pose, shape in (("PBM", closed), ("FV", bitten)):
            shapes = shown(records, pose_set, **{pose: 0.95}, **beside)
            assert max(shapes, key=shapes.__getitem__) == shape


LOOKS = {
    "oculus15": {"open": "aa", "W": "U", "ShCh": "CH", "PBM": "PP", "FV": "FF", "wide": "I", "tBack": "kk", "tRoof": "DD", "tTeeth": "TH"},
    "vrm": {"open": "aa", "W": "ou", "ShCh": "ou", "wide": "ih"},
    "preston_blair": {
        "open": "AI", "W": "WQ", "ShCh": "etc", "PBM": "MBP", "FV": "FV", "wide": "E", "tBack": "etc", "tRoof": "L", "tTeeth": "etc",
    },
    "rhubarb": {"open": "D", "W": "F", "ShCh": "B", "PBM": "A", "FV": "G", "wide": "B", "tBack": "B", "tRoof": "H", "tTeeth": "B"},
    "crab": {
        "open": "mouth_open", "W": "mouth_oo", "ShCh": "bare_teeth", "PBM": "lips_press", "FV": "lips_press", "wide": "smile",
        "tBack": "tongue_back", "tRoof": "tongue_up", "tTeeth": "tongue_teeth",
    },
    "arkit52": {"open": "jawOpen", "W": "mouthPucker", "ShCh": "mouthFunnel", "FV": "mouthRollLower", "tTeeth": "tongueOut"},
}  # fmt: skip


@pytest.mark.parametrize(
    ("pose_set", "pose", "shape"), [(name, pose, shape) for name, looks in LOOKS.items() for pose, shape in looks.items()]
)
def test_each_pose_is_shown_most_by_the_shape_that_looks_like_it(records, pose_set, pose, shape):
    shapes = shown(records, pose_set, **{pose: 1.0})
    assert max(shapes, key=shapes.__getitem__) == shape


@pytest.mark.parametrize("pose_set", SETS)
def test_a_face_at_rest_shows_nothing(records, pose_set):
    assert set(shown(records, pose_set).values()) == {0.0}


def test_arkit_shapes_are_the_same_on_both_sides(records):
    links = {key: (row["gain"], row["combine"], row["curve"]) for key, row in records["links/facefx/arkit52.tsv"].items()}
    left = {(pose, shape): link for (pose, shape), link in links.items() if shape.endswith("Left")}
    assert left
    assert all(links[pose, shape.replace("Left", "Right")] == link for (pose, shape), link in left.items())


@pytest.mark.parametrize(("pose_set", "shape"), [("oculus15", "O"), ("vrm", "oh"), ("preston_blair", "O"), ("rhubarb", "E")])
def test_half_round_lips_are_the_o_of_each_set(records, pose_set, shape):
    shapes = shown(records, pose_set, W=0.45, open=0.5)
    assert max(shapes, key=shapes.__getitem__) == shape
