"""A recording and its TextGrid in a real browser: the face does on the page what `lipdb sync` does with the same files."""

from __future__ import annotations

from itertools import groupby

import pandas as pd
import pytest
from browser import seek, settled, stage_state, until

import lipdb
from lipdb.schedule import Schedule

SENTENCE = "Bob may find five blue whales."


def textgrid(schedule: Schedule) -> str:
    """*schedule* as an aligner writes it: a tier of words and one of phones."""
    rows = schedule.to_json()["phones"]
    words = [[*some] for _, some in groupby(rows, key=lambda row: row["word"])]
    intervals = {
        "words": [(some[0]["start"], some[-1]["end"], schedule.words[some[0]["word"]] if some[0]["word"] >= 0 else "") for some in words],
        "phones": [(row["start"], row["end"], row["symbol"]) for row in rows],
    }
    whole = f"0 {rows[-1]['end']}"
    tiers = [
        f'"IntervalTier" "{name}" {whole} {len(some)} ' + " ".join(f'{start} {end} "{text}"' for start, end, text in some)
        for name, some in intervals.items()
    ]
    return f'File type = "ooTextFile"\nObject class = "TextGrid"\n\n{whole} <exists> 2\n' + "\n".join(tiers)


@pytest.fixture
def recording(app, tmp_path):
    """A TextGrid, its sound, and the weights that the command line makes of them."""
    with lipdb.open(app.database) as db:
        line = db.say(SENTENCE)
        grid, sound = tmp_path / "take 7.TextGrid", tmp_path / "take 7.wav"
        grid.write_text(textgrid(line.schedule), encoding="utf-8")
        db.animate(line).save(sound)
    app.lipdb("sync", str(grid), "--audio", str(sound), "-o", str(tmp_path / "weights.csv"))
    return grid, sound, pd.read_csv(tmp_path / "weights.csv", comment="#")


def test_an_uploaded_recording_moves_the_face_as_the_command_line_does(app, page, recording) -> None:
    grid, sound, weights = recording
    page.goto(app.url)
    page.locator(".stage canvas").first.wait_for()
    settled(page)
    page.get_by_text("Recording", exact=True).click()
    for place, file in enumerate((grid, sound)):
        page.get_by_test_id("stFileUploader").nth(place).locator("input[type=file]").set_input_files(file)
        page.get_by_text(file.name).first.wait_for()
        settled(page)
    end = weights.time.iloc[-1]
    until(page, "Math.abs(stage.lipdb.clock.duration - argument) < 0.05 && stage.lipdb.state.faces[0]?.moving > 0", end)
    until(page, "stage.querySelector('audio').duration > argument - 0.05", end)
    poses = [name for name in weights.columns if name in stage_state(page)["poses"]]
    assert len(poses) == len(stage_state(page)["poses"]) > 0
    for frame in range(0, len(weights), 20):
        seek(page, weights.time[frame])
        shown = stage_state(page)["poses"]
        assert [shown[pose] for pose in poses] == pytest.approx(weights.loc[frame, poses].tolist(), abs=2e-4)  # the file has four decimals
    assert weights[poses].to_numpy().max() > 0.5
