"""What a character has of its own, what it would inherit instead, and how its links are edited."""

import shutil

import numpy as np
import pytest

import lipdb
from lipdb.characters.exercise import held, raised
from lipdb.characters.overrides import overrides, with_siblings
from lipdb.characters.own_links import link_rows, links_of
from lipdb.errors import InputError

CURVE = {"left": "l", "right": "ow", "pose": "W", "keys": "0:0 0.5:1 1:0", "warp": "border"}


@pytest.fixture(scope="module")
def own(as_shipped, tmp_path_factory):
    """Robin says p like f and has a curve and a link of its own; the crab has a curve, too."""
    with lipdb.open(shutil.copy(as_shipped, tmp_path_factory.mktemp("own"))) as db:
        with db.edit(author="anna") as edit:
            edit.put("characters/robin/curves/facefx.tsv", CURVE)
            edit.put("characters/robin/mapping.tsv", {"language": "en", "phone": "p", "common": "f"})
            edit.put("characters/robin/links.tsv", {"pose": "W", "shape": "W", "gain": "0.5", "combine": "sum"})
            for pose in ("mouth_oo", "mouth_open"):
                edit.put("characters/crab/curves/crab.tsv", {**CURVE, "pose": pose})
        yield db


def plain(rows):
    return [{"pose": row.row["pose"], "shape": row.row["shape"], **{n: row.row[n] for n in ("gain", "combine", "curve")}} for row in rows]


def test_every_override_says_what_it_would_be_otherwise(own):
    found = overrides(own.records, "robin", "en")
    common = own.book("facefx", language="en").find("l", "ow", "W").curve
    told = [one.to_row() for one in found]
    assert told[0] == {
        "what": "curve",
        "name": "l-ow W",
        "own": "0:0 0.5:1 1:0",
        "inherited": lipdb.curves.keys.format_keys(common.keys),
        "layer": "common",
    }
    assert told[1:] == [
        {"what": "mapping", "name": "en p", "own": "f", "inherited": "bmp", "layer": "language:en"},
        {"what": "link", "name": "W → W", "own": "gain 0.5, combine sum", "inherited": "gain 1, combine sum", "layer": "one shape a pose"},
    ]
    assert overrides(own.records, "flat", "en") == []


def test_what_a_reset_leaves_is_what_was_said_to_be_inherited(own):
    for one in overrides(own.records, "robin", "en"):
        after = own.supposing(with_siblings(own.records, [one]))
        assert one.name not in [other.name for other in overrides(after.records, "robin", "en")]
    after = own.supposing(with_siblings(own.records, overrides(own.records, "robin", "en")))
    assert overrides(after.records, "robin", "en") == []
    assert after.book("facefx", language="en", character="robin").find("l", "ow", "W").layer == "common"


def test_curves_that_win_as_a_whole_are_reset_together(own):
    crab = [one for one in overrides(own.records, "crab", "en") if one.key[2] == "mouth_oo"]
    rows = with_siblings(own.records, crab)
    taken = {key for table, key in rows if table == "characters/crab/curves/crab.tsv"}
    assert taken >= {
        ("l", "ow", "mouth_oo"),
        ("l", "ow", "mouth_open"),
    }


def test_supposing_saves_nothing(own):
    before = own.store.revision
    trial = own.supposing({("characters/robin/mapping.tsv", ("en", "p")): None})
    assert trial.phoneset("en", character="robin").mapping("p").common == ("bmp",)
    assert own.phoneset("en", character="robin").mapping("p").common == ("f",)
    assert own.store.revision == before


def test_links_that_are_not_changed_need_no_row(own):
    for name in ("robin", "crab", "flat"):
        assert link_rows(own.records, name, plain(links_of(own.records, name))) == {}


def test_edited_links_become_rows_of_the_character(own):
    links = plain(links_of(own.records, "robin"))
    gone = links.pop(0)
    links[0]["gain"] = "0.8"
    links.append({"pose": "open", "shape": "smile", "gain": "0.2", "combine": "max", "curve": "0:0 1:0.5"})
    rows = link_rows(own.records, "robin", links)
    assert rows[gone["pose"], gone["shape"]]["gain"] == "0"
    assert rows[links[0]["pose"], links[0]["shape"]]["gain"] == "0.8"
    assert rows["open", "smile"]["curve"] == "0:0 1:0.5"
    after = own.supposing({("characters/robin/links.tsv", key): row for key, row in rows.items()})
    assert sorted(map(str, plain(links_of(after.records, "robin")))) == sorted(map(str, links))
    with own.store.edit(author="anna") as edit:
        for row in rows.values():
            edit.put("characters/robin/links.tsv", row)
    assert link_rows(own.records, "robin", plain(links_of(own.records, "robin"))) == {}


def test_a_link_back_to_the_shared_value_takes_the_own_row_away(own):
    links = [{**link, "gain": "1"} if link["shape"] == "W" else link for link in plain(links_of(own.records, "robin"))]
    assert link_rows(own.records, "robin", links)["W", "W"] is None


@pytest.mark.parametrize(
    ("links", "why"),
    [
        ([], "keep one at least"),
        ([{"pose": "open", "shape": "open", "gain": "0"}], "keep one at least"),
        ([{"pose": "opne", "shape": "open", "gain": "1"}], "no such pose"),
        ([{"pose": "open", "shape": "open", "gain": "much"}], "not a number"),
        ([{"pose": "open", "shape": "open", "gain": "1", "curve": "0-0"}], "the link from open to open"),
        ([{"pose": "open", "shape": "", "gain": "1"}], "no shape"),
        ([{"pose": "open", "shape": "open", "gain": "1"}] * 2, "twice"),
    ],
)
def test_links_that_can_not_be_are_refused(own, links, why):
    with pytest.raises(InputError, match=why):
        link_rows(own.records, "robin", links)


def test_a_doubt_ends_when_the_link_is_changed(own):
    row = {"pose": "open", "shape": "jawish", "gain": "1", "combine": "sum", "curve": "", "source": "user", "comment": "jawOpen: doubtful"}
    trial = own.supposing({("characters/robin/links.tsv", ("open", "jawish")): row})
    (doubtful,) = [link for link in links_of(trial.records, "robin") if link.doubtful]
    assert doubtful.row["shape"] == "jawish"
    links = [{**link.row, "gain": "0.9"} if link.doubtful else link.row for link in links_of(trial.records, "robin")]
    assert link_rows(trial.records, "robin", links)["open", "jawish"]["comment"] == ""


def test_an_exercise_raises_one_pose_and_lowers_it_again():
    track = raised(("a", "b"), "b", seconds=1, fps=10)
    assert track.weights.shape == (11, 2)
    assert track.weights[:, 0].max() == 0
    np.testing.assert_allclose(track.weights[[0, 5, 10], 1], [0, 1, 0], atol=1e-12)
    assert held(("a", "b"), {"a": 0.5}, seconds=1, fps=10).weights.tolist() == [[0.5, 0.0]] * 11
    with pytest.raises(InputError, match="there are a, b"):
        raised(("a", "b"), "c")
