"""A face with poses that nobody thought of speaks: a set of three poses is nine rows of data, no code."""

import shutil
from pathlib import Path

import pytest

import lipdb
from lipdb.errors import CurveError

SOURCE = {"source": "user", "comment": ""}
SET = {"pose_set": "toy", "window": "0.18", "threshold": "2", "title": "A toy with three poses"}
POSES = [
    {"pose": "gape", "position": "1", "priority": "1", "speed": "15", "must_reach": "no", "description": "The lid opens"},
    {"pose": "ring", "position": "2", "priority": "2", "speed": "15", "must_reach": "no", "description": "The rim is a ring"},
    {"pose": "shut", "position": "3", "priority": "3", "speed": "15", "must_reach": "yes", "description": "The lid is shut"},
]
LINKS = [("open", "gape"), ("W", "ring"), ("PBM", "shut")]
CHARACTER = {"character": "toy", "pose_set": "toy", "shapes": "toy", "drawing": "built:flat", "title": "Toy"}


@pytest.fixture(scope="module")
def toys(as_shipped: Path, own_places: Path):
    with lipdb.open(shutil.copy(as_shipped, own_places / "toys.db")) as database:
        with database.edit(author="ann", note="A toy") as edit:
            edit.put("poses/sets.tsv", {**SET, **SOURCE})
            for pose in POSES:
                edit.put("poses/toy.tsv", {**pose, **SOURCE})
            for pose, shape in LINKS:
                edit.put("links/facefx/toy.tsv", {"pose": pose, "shape": shape, "gain": "1", "combine": "max", "curve": "", **SOURCE})
            edit.put("constraints/toy.tsv", {"pose": "gape", "other": "shut", "threshold": "0.5", **SOURCE})
            edit.put("characters/toy/character.tsv", {**CHARACTER, **SOURCE})
        yield database


def test_the_shared_curves_reach_it_through_links(toys: lipdb.Database) -> None:
    line = toys.say("Who can open a pumpkin?")
    take = toys.animate(line, character="toy")
    assert take.track.poses == take.shapes.poses == ("gape", "ring", "shut")
    weights = take.track.weights
    assert (weights.max(0) > (0.25, 0.5, 0.88)).all()
    assert (weights[:, 0] <= (0.5 - weights[:, 2]).clip(0) + 1e-9).all()
    assert {found.layer for use in toys.pairs(line, character="toy") for found in use.curves.values()} <= {"common", "common via facefx"}


def test_a_curve_drawn_for_it_wins(toys: lipdb.Database) -> None:
    line = toys.say("Who?")
    before = toys.animate(line, character="toy").track.pose("gape").max()
    row = {"left": "h", "right": "w", "pose": "gape", "keys": "0:0 0.5:0.48 1:0", "warp": "border", "licence": "Apache-2.0"}
    with toys.edit(author="ann") as edit:
        edit.put("curves/toy.tsv", {**row, **SOURCE})
    assert toys.animate(line, character="toy").track.pose("gape").max() > before + 0.1


def test_a_set_with_nothing_to_make_curves_from_says_so(toys: lipdb.Database) -> None:
    with toys.edit(author="ann") as edit:
        edit.put("poses/sets.tsv", {**SET, "pose_set": "bare", **SOURCE})
        edit.put("poses/bare.tsv", {**POSES[0], **SOURCE})
        edit.put("characters/bare/character.tsv", {**CHARACTER, "character": "bare", "pose_set": "bare", "shapes": "bare", **SOURCE})
    with pytest.raises(CurveError, match="targets/bare.tsv"):
        toys.animate(toys.say("Who?"), character="bare")
