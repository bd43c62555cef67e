"""With the shipped curves the lips of the shipped meshes really close on p, b and m, between any two phones."""

from itertools import product
from pathlib import Path

import numpy as np
import pytest

from lipdb.characters.crab import crab
from lipdb.characters.human import robin
from lipdb.characters.mouth import measure
from lipdb.curated.folder import read_folder
from lipdb.curves.lookup import CurveBook
from lipdb.engine import animate
from lipdb.poses import PoseSet

CLOSURE, AROUND, PAUSE = 80_000, 90_000, 300_000
FPS = 60


@pytest.fixture(scope="module")
def records():
    return read_folder(Path(__file__).parent.parent / "phonesets")


@pytest.mark.parametrize(("pose_set", "character", "mesh"), [("facefx", "robin", robin), ("crab", "crab", crab)])
def test_the_gap_falls_below_a_twentieth_of_the_widest(records, pose_set, character, mesh):
    others = [key[0] for key in sorted(records["common.tsv"]) if key[0] not in {"_", "bmp"}]
    triples = list(product(others, repeat=2))
    phones = ["_", *(phone for left, right in triples for phone in (left, "bmp", right)), "_"]
    edges = np.concatenate([[0], np.cumsum([PAUSE, *[AROUND, CLOSURE, AROUND] * len(triples), PAUSE])])
    poses = PoseSet.from_records(records, pose_set)
    book = CurveBook.from_records(records, pose_set, language="en", character=character)
    track = animate(book.table(tuple(dict.fromkeys(phones))), poses, edges, phones, fps=FPS)
    opening, _ = measure(mesh(), track.weights, track.poses)
    widest = measure(mesh(), np.eye(len(track.poses)), track.poses)[0].max()
    half = 1 / (2 * FPS)
    wide_open = []
    for index, phone in enumerate(phones):
        if phone == "bmp":
            during = (track.times >= edges[index] / 1e6 - half) & (track.times <= edges[index + 1] / 1e6 + half)
            if opening[during].min() >= 0.05 * widest:
                wide_open.append((phones[index - 1], phones[index + 1], opening[during].min() / widest))
    assert wide_open == []
