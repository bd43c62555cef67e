"""Performances as files: what is in them, that they read back, and that the same performance gives the same bytes."""

from __future__ import annotations

import csv
import json
import os
import resource
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from export_cases import flat_performance, mesh_performance
from hypothesis import given, settings
from hypothesis import strategies as st

from lipdb import plugins
from lipdb.errors import InputError, OutputError
from lipdb.export.json import read_line, read_track, track_from_json, track_to_json, write_json
from lipdb.export.keys import TOLERANCE
from lipdb.performance import Performance
from lipdb.sound import read_wav
from lipdb.track import Track


@pytest.fixture(scope="module")
def take() -> Performance:
    return mesh_performance()


def test_csv_has_a_row_a_frame_and_a_column_a_shape(take: Performance, tmp_path: Path) -> None:
    take.save(tmp_path / "a.csv")
    with (tmp_path / "a.csv").open(newline="") as file:
        header, *rows = csv.reader(file)
    assert header == ["frame", "time", *take.shapes.poses]
    table = np.array(rows, float)
    assert np.array_equal(table[:, 0], np.arange(len(take.track.weights)))
    assert np.abs(table[:, 1] - take.shapes.times).max() <= 5e-7
    assert np.abs(table[:, 2:] - take.shapes.weights).max() <= 5.001e-5
    assert b"\r" not in (tmp_path / "a.csv").read_bytes()
    assert "-0.0000" not in (tmp_path / "a.csv").read_text()


def test_parquet_holds_the_same_table_and_says_what_it_is(take: Performance, tmp_path: Path) -> None:
    import pyarrow.parquet as pq

    take.save(tmp_path / "a.parquet")
    table = pq.read_table(tmp_path / "a.parquet")
    assert table.column_names == ["frame", "time", *take.shapes.poses]
    assert np.abs(np.column_stack([table[name] for name in take.shapes.poses]) - take.shapes.weights).max() < 1e-7
    assert np.array_equal(table["time"].to_numpy(), take.shapes.times)
    assert {key.decode(): value.decode() for key, value in table.schema.metadata.items()} == {
        "fps": "60", "character": take.character.name, "language": "en", "text": "Bob",
    }  # fmt: skip


def test_json_reads_back_as_the_same_line_and_the_same_track(take: Performance, tmp_path: Path) -> None:
    take.save(tmp_path / "a.json")
    track = read_track(tmp_path / "a.json")
    assert (track.poses, track.fps, track.weights.shape) == (take.track.poses, take.track.fps, take.track.weights.shape)
    assert np.abs(track.weights - take.track.weights).max() <= TOLERANCE
    line = read_line(tmp_path / "a.json", sound=take.sound)
    assert take.line is not None
    assert (line.schedule, line.text, line.mapping, line.sound) == (take.line.schedule, "Bob", take.line.mapping, take.sound)


def test_json_is_for_people_too_with_a_key_a_line(take: Performance, tmp_path: Path) -> None:
    take = replace(take, line=replace(take.line, text="[\\n 1,\\n 2\\n]\n[\n 1,\n 2\n]"))
    take.save(tmp_path / "a.json")
    text = (tmp_path / "a.json").read_text()
    assert "[0, 0.0]" in text
    assert read_line(tmp_path / "a.json").text == take.line.text
    assert json.loads(text)["character"] == take.character.name


def test_a_line_of_its_own_reads_as_well(take: Performance, tmp_path: Path) -> None:
    assert take.line is not None
    (tmp_path / "line.json").write_text(json.dumps(take.line.to_json()))
    assert read_line(tmp_path / "line.json").schedule == take.line.schedule


@pytest.mark.parametrize(
    "text",
    ["", "{", "[]", "null", "1", '{"format": "other"}', '{"format": "lipdb performance 1"}', '{"format": "lipdb performance 1", "line": 3}',
     '{"format": "lipdb line 1"}', "[" * 100_000, "\ud800"],
)  # fmt: skip
def test_other_json_is_refused_in_one_line_that_names_the_file(tmp_path: Path, text: str) -> None:
    file = tmp_path / "a.json"
    file.write_bytes(text.encode("utf-8", "surrogatepass"))
    for read in (read_line, read_track):
        with pytest.raises(InputError) as caught:
            read(file)
        assert str(caught.value).startswith(f"{file}: ")
        assert "\n" not in str(caught.value)


JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=5), inner, max_size=3),
    max_leaves=4,
)


def _places(value: object, at: tuple[str | int, ...] = ()) -> Iterator[tuple[str | int, ...]]:
    """Where each value of a JSON document stands."""
    yield at
    entries = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, inner in entries:
        yield from _places(inner, (*at, key))


@settings(max_examples=200)
@given(data=st.data())
def test_json_with_one_value_changed_reads_or_is_refused_in_one_line(
    take: Performance, data: st.DataObject, tmp_path_factory: pytest.TempPathFactory
) -> None:
    file = tmp_path_factory.getbasetemp() / "damaged.json"
    write_json(take, file)
    document = json.loads(file.read_text())
    where = data.draw(st.sampled_from(list(_places(document))[1:]))
    holder = document
    for key in where[:-1]:
        holder = holder[key]
    holder[where[-1]] = data.draw(JSON)
    file.write_text(json.dumps(document))
    for read in (read_line, read_track):
        try:
            read(file)
        except InputError as error:
            assert "\n" not in str(error)


@pytest.mark.parametrize(
    "damage",
    [{"fps": 0}, {"fps": float("nan")}, {"fps": "x"}, {"frames": -1}, {"frames": 10**15}, {"frames": None}, {"keys": []},
     {"keys": {"open": [[0, 2.0]]}}, {"keys": {"open": [[99999, 0.5]]}}, {"keys": {"open": [[0, float("nan")]]}}, {"keys": {"open": [7]}}],
)  # fmt: skip
def test_a_damaged_track_is_refused(take: Performance, damage: dict[str, object]) -> None:
    with pytest.raises(InputError, match="track"):
        track_from_json(track_to_json(take.track) | damage)


def test_an_empty_track_reads_back() -> None:
    empty = track_from_json(track_to_json(Track(np.zeros((0, 2)), ("open", "W"), 24.0)))
    assert (empty.weights.shape, empty.poses) == ((0, 2), ("open", "W"))


def test_wave_holds_the_sound_and_without_sound_there_is_nothing_to_write(take: Performance, tmp_path: Path) -> None:
    take.save(tmp_path / "a.wav")
    assert take.sound is not None
    assert np.array_equal(read_wav(tmp_path / "a.wav").samples, take.sound.samples)
    with pytest.raises(InputError, match="no sound"):
        replace(take, sound=None).save(tmp_path / "b.wav")
    assert not (tmp_path / "b.wav").exists()


def test_cue_files_are_rhubarbs(tmp_path: Path) -> None:
    take = flat_performance(tmp_path)
    take.save(tmp_path / "a.tsv")
    take.save(tmp_path / "a.cues.json")
    rows = [line.split("\t") for line in (tmp_path / "a.tsv").read_text().splitlines()]
    cues = json.loads((tmp_path / "a.cues.json").read_text())
    end = f"{len(take.track.weights) / take.track.fps:.2f}"
    assert rows[0][0] == "0.00"
    assert rows[-1] == [end, "X"]
    assert [(float(time), shape) for time, shape in rows[:-1]] == [(cue["start"], cue["value"]) for cue in cues["mouthCues"]]
    assert [cue["end"] for cue in cues["mouthCues"][:-1]] == [cue["start"] for cue in cues["mouthCues"][1:]]
    assert cues["metadata"]["duration"] == float(end)
    assert "A" in {shape for _, shape in rows}


def test_glb_holds_the_mesh_and_an_animation_of_its_shapes(take: Performance, tmp_path: Path) -> None:
    take.save(tmp_path / "a.glb")
    raw = (tmp_path / "a.glb").read_bytes()
    size = int.from_bytes(raw[12:16], "little")
    document, data = json.loads(raw[20 : 20 + size]), raw[20 + size + 8 :]

    def numbers(accessor: int) -> np.ndarray:
        entry = document["accessors"][accessor]
        return np.frombuffer(data, "<f4", entry["count"], document["bufferViews"][entry["bufferView"]]["byteOffset"])

    names = document["meshes"][0]["extras"]["targetNames"]
    (sampler,) = document["animations"][0]["samplers"]
    weights = numbers(sampler["output"]).reshape(-1, len(names))
    assert names == ["W", "open"]
    assert np.allclose(numbers(sampler["input"]), take.track.times)
    assert np.allclose(weights, np.stack([take.shapes.pose(name) for name in names], axis=1))


def test_a_character_of_pictures_has_no_glb(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"'flat' has pictures and no mesh; write \.tsv"):
        flat_performance(tmp_path).save(tmp_path / "a.glb")


def test_silence_is_shown_by_the_rest_shape_that_the_character_has(take: Performance, tmp_path: Path) -> None:
    flat = flat_performance(tmp_path)
    assert (take.rest, flat.rest) == ("X", "X")
    (tmp_path / "flat" / "pictures" / "X.svg").rename(tmp_path / "flat" / "pictures" / "rest.svg")
    blair = replace(flat, character=replace(flat.character))
    assert blair.rest == "rest"
    assert replace(blair, track=Track(np.zeros((30, 1)), ("open",), 60.0)).cues() == [(0.0, 0.5, "rest")]


def test_every_format_gives_the_same_bytes_again(take: Performance, tmp_path: Path) -> None:
    for suffix in sorted(set(plugins.exporters()) - {".mp4", ".webp"}):
        take.save(tmp_path / f"one{suffix}")
        mesh_performance().save(tmp_path / f"two{suffix}")
        assert (tmp_path / f"one{suffix}").read_bytes() == (tmp_path / f"two{suffix}").read_bytes(), suffix


def test_an_unknown_suffix_names_the_known_ones(take: Performance, tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"\.csv .*\.mp4 "):
        take.save(tmp_path / "a.usda")
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_takes_no_files_is_an_error_and_leaves_nothing(take: Performance, tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="does not exist"):
        take.save(tmp_path / "none" / "a.csv")
    with pytest.raises(OutputError, match="this is a folder"):
        (tmp_path / "a.csv").mkdir()
        take.save(tmp_path / "a.csv")
    assert [path.name for path in tmp_path.iterdir()] == ["a.csv"]


@pytest.fixture
def full_disk() -> Iterator[None]:
    """No file may grow beyond 32 bytes."""
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (32, hard))
    yield
    resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))


@pytest.mark.parametrize("suffix", sorted(plugins.exporters()))
def test_a_full_disk_is_an_output_error_and_the_old_file_stays(suffix: str, tmp_path: Path, full_disk: None) -> None:
    file = tmp_path / f"a{suffix}"
    file.write_text("old")
    with pytest.raises(OutputError, match="free some space") as caught:
        mesh_performance().save(file)
    assert "\n" not in str(caught.value)
    assert file.read_text() == "old"
    assert [path.name for path in tmp_path.iterdir()] == [file.name]


def test_a_file_is_replaced_only_when_the_new_one_is_whole(take: Performance, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "a.csv").write_text("old")

    def breaks(performance: Performance, path: Path) -> None:
        path.write_text("half")
        raise OSError(28, os.strerror(28))

    monkeypatch.setattr(plugins, "exporters", lambda: {".csv": breaks})
    with pytest.raises(OutputError, match="No space left"):
        take.save(tmp_path / "a.csv")
    assert (tmp_path / "a.csv").read_text() == "old"
    assert [path.name for path in tmp_path.iterdir()] == ["a.csv"]
