"""An explanation names the pair, the curve, its layer and the stage behind every weight."""

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

import lipdb
from lipdb.cli import cli
from lipdb.errors import InputError


def test_every_weight_of_every_stage_is_told_and_the_last_is_the_tracks(db: lipdb.Database) -> None:
    line = db.say("Hello Bob")
    track = db.animate(line).track
    for frame in (10, 25, 40, 55):
        causes = db.explain(line, at=frame / 60)
        assert [cause.pose for cause in causes] == list(track.poses)
        for cause in causes:
            assert cause.weights["final"] == pytest.approx(track.weights[frame, track.poses.index(cause.pose)], abs=1e-6)
            drawn = max((weight for _, _, weight, _ in cause.curves), default=0.0)
            assert cause.weights["curve"] == pytest.approx(drawn, abs=1e-6)


def test_a_closed_lip_says_that_the_jaw_yields_to_it(db: lipdb.Database) -> None:
    line = db.say("Bob")
    closed = db.animate(line).track.pose("PBM")
    causes = {cause.pose: cause for cause in db.explain(line, at=float(closed.argmax()) / 60)}
    assert causes["PBM"].weights["final"] > 0.88
    assert any("bmp" in (left, right) for left, right, _, _ in causes["PBM"].curves)
    assert causes["open"].weights["final"] == 0


def test_the_curve_that_is_named_is_the_one_in_the_data(db: lipdb.Database) -> None:
    named = {(left, right, cause.pose): found for cause in db.explain(db.say("Hello"), at=0.4) for left, right, _, found in cause.curves}
    assert len(named) > 1
    for key, found in named.items():
        assert found.curve.row(key) == db.records["curves/facefx.tsv"][key]
        assert found.layer == "common"


def test_a_time_outside_the_track_is_refused(db: lipdb.Database) -> None:
    with pytest.raises(InputError, match="lasts from 0 to"):
        db.explain(db.say("Hello"), at=100)


def test_the_command_uses_the_character_that_the_file_was_made_for(own_places: Path, tmp_path: Path) -> None:
    place = ["--db", str(own_places / "shipped.db")]
    assert CliRunner().invoke(cli, [*place, "say", "Hello", "-c", "crab", "-o", str(tmp_path / "a.json")]).exit_code == 0
    own = CliRunner().invoke(cli, [*place, "explain", str(tmp_path / "a.json"), "--at", "0.4", "--json"])
    other = CliRunner().invoke(cli, [*place, "explain", str(tmp_path / "a.json"), "--at", "0.4", "-c", "robin", "--json"])
    assert next(row["pose"] for row in json.loads(own.stdout)) == "mouth_open"
    assert next(row["pose"] for row in json.loads(other.stdout)) == "open"
