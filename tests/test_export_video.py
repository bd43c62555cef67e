"""Video: frames and sound of the right length, the same bytes in another process, and a way out without PyAV."""

from __future__ import annotations

import hashlib
import subprocess
import sys
import threading
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from export_cases import flat_performance, mesh_performance
from PIL import Image

from lipdb.errors import MissingToolError
from lipdb.performance import Performance
from lipdb.progress import reported
from lipdb.render.film import film, frame_count, sampled, stills
from lipdb.sound import Sound
from lipdb.track import Track

SAVE = """
import sys
from pathlib import Path
sys.path.insert(0, sys.argv[1])
from export_cases import flat_performance, mesh_performance
folder = Path(sys.argv[2])
mesh_performance().save(folder / "mesh.mp4")
mesh_performance().save(folder / "mesh.webp")
flat_performance(folder).save(folder / "flat.mp4")
"""


def _decoded(path: Path) -> tuple[list[np.ndarray], np.ndarray, int]:
    """Pictures, samples and rate."""
    import av

    with av.open(str(path)) as file:
        pictures = [frame.to_ndarray(format="rgb24") for frame in file.decode(video=0)]
        file.seek(0)
        rate = file.streams.audio[0].rate
        samples = np.concatenate([frame.to_ndarray()[0] for frame in file.decode(audio=0)])
    return pictures, samples, rate


def test_mp4_holds_every_frame_and_all_of_the_sound_in_time(tmp_path: Path) -> None:
    take = mesh_performance()
    take.save(tmp_path / "a.mp4")
    pictures, samples, rate = _decoded(tmp_path / "a.mp4")
    assert take.sound is not None
    assert (len(pictures), pictures[0].shape, rate) == (30, (512, 512, 3), 16000)
    assert abs(len(samples) / rate - take.sound.duration) < 0.1
    # The encoder's delay is known to players through the file; what is left must be the same tone at the same place.
    original = take.sound.samples / 32768
    shift = np.argmax(np.correlate(samples[:8000], original[:6000], "valid"))
    assert shift / rate < 0.07
    for drawn, shown in zip(film(take), pictures, strict=True):
        assert np.abs(drawn.astype(int) - shown).mean() < 2


@pytest.mark.parametrize("suffix", [".mp4", ".webp"])
def test_who_asks_hears_in_their_own_thread_of_every_frame(tmp_path: Path, suffix: str) -> None:
    heard: list[tuple[int, int, bool]] = []
    here = threading.get_ident()
    with reported(lambda _, done, total: heard.append((done, total, threading.get_ident() == here))):
        flat_performance(tmp_path).save(tmp_path / f"a{suffix}")
    assert heard == [(done, len(heard), True) for done in range(1, len(heard) + 1)]
    assert len(heard) > 20


def test_two_processes_write_the_same_bytes(tmp_path: Path) -> None:
    hashes = []
    for name in ("one", "two"):
        folder = tmp_path / name
        folder.mkdir()
        subprocess.run([sys.executable, "-c", SAVE, str(Path(__file__).parent), str(folder)], check=True, timeout=300)
        hashes.append({file.name: hashlib.sha256(file.read_bytes()).hexdigest() for file in sorted(folder.iterdir()) if file.is_file()})
    assert hashes[0] == hashes[1]
    assert {"mesh.mp4", "mesh.webp", "flat.mp4"} <= set(hashes[0])


def test_a_film_lasts_until_track_and_sound_have_both_ended() -> None:
    take = mesh_performance()
    assert frame_count(replace(take, sound=None), 30) == 30
    assert frame_count(replace(take, sound=Sound(np.zeros(32000, np.int16), 16000)), 30) == 60
    assert frame_count(replace(take, sound=Sound(np.zeros(160, np.int16), 16000)), 30) == 30


def test_a_film_without_sound_has_no_sound_track(tmp_path: Path) -> None:
    import av

    replace(mesh_performance(), sound=None).save(tmp_path / "a.mp4")
    with av.open(str(tmp_path / "a.mp4")) as file:
        assert [stream.type for stream in file.streams] == ["video"]


def test_pictures_at_half_the_rate_are_every_second_frame_and_others_lie_between_their_neighbours() -> None:
    track = mesh_performance().track
    assert np.array_equal(sampled(track, np.arange(30) / 30), track.weights[::2])
    between = sampled(track, np.array([10.25 / 60]))
    assert between == pytest.approx(0.75 * track.weights[10:11] + 0.25 * track.weights[11:12])
    assert np.array_equal(sampled(track, np.array([5.0])), track.weights[-1:])


def test_the_mouth_in_the_film_is_open_when_the_track_says_so() -> None:
    take = mesh_performance()
    shut, wide = stills(take, np.array([0.0, 10 / 60]), size=(80, 80))
    dark = [int((picture.max(axis=2) < 110).sum()) for picture in (shut, wide)]
    assert dark[1] > 1.3 * dark[0] > 0


def test_a_flat_mouth_shows_the_picture_of_each_cue(tmp_path: Path) -> None:
    take = flat_performance(tmp_path)
    for start, end, shape in take.cues():
        (picture,) = stills(take, np.array([(start + end) / 2]), size=(64, 64))
        height = int((picture.max(axis=2) < 20).any(axis=1).sum())
        expected = {"A": 2, "X": 6, "D": 40}[shape] * 2 * 0.88 * 0.64
        assert height == pytest.approx(expected, abs=2), shape


def test_webp_has_every_frame(tmp_path: Path) -> None:
    mesh_performance().save(tmp_path / "a.webp")
    with Image.open(tmp_path / "a.webp") as image:
        assert (image.size, image.is_animated) == ((480, 480), True)
        # Frames that look alike are joined; the time they stand is not lost.
        durations = 0
        for index in range(image.n_frames):
            image.seek(index)
            image.load()
            durations += image.info["duration"]
    assert durations == 1000


def test_without_pyav_mp4_says_what_to_do(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "av", None)
    with pytest.raises(MissingToolError, match=r"pip install av`, or write \.webp"):
        mesh_performance().save(tmp_path / "a.mp4")
    assert list(tmp_path.iterdir()) == []


def test_the_contact_sheet_has_a_picture_a_phone(tmp_path: Path) -> None:
    take = mesh_performance()
    take.save(tmp_path / "a.png")
    with Image.open(tmp_path / "a.png") as image:
        assert image.size == (4 * 240, 240)
    replace(take, line=None).save(tmp_path / "b.png")
    with Image.open(tmp_path / "b.png") as image:
        assert image.size == (4 * 240, 240)


def test_a_short_performance_is_a_film_of_one_picture() -> None:
    take = mesh_performance()
    short = Performance(Track(take.track.weights[:1], take.track.poses, 60.0), take.character)
    assert len(list(film(short, size=(32, 32)))) == 1
