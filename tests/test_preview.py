"""What a player in a browser gets: times, weights and pictures as they are, large things behind links."""

import io
import json
import wave
from dataclasses import replace

import numpy as np
import pytest

from lipdb.errors import InputError
from lipdb.preview import mesh_bytes, preview
from lipdb.sound import Sound


@pytest.fixture(scope="module")
def line(db):
    return db.say("Bob may go.")


@pytest.fixture
def links():
    kept: list[tuple[bytes, str]] = []

    def link(content: bytes, media: str) -> str:
        kept.append((content, media))
        return f"link{len(kept) - 1}"

    link.kept = kept
    return link


def linked(links, url: str) -> bytes:
    return links.kept[int(url.removeprefix("link"))][0]


def floats(links, url: str, columns: int) -> np.ndarray:
    return np.frombuffer(linked(links, url), "<f4").reshape(-1, columns)


def test_a_mesh_comes_with_weights_of_its_shapes_and_sound_of_the_same_length(db, line, links) -> None:
    performance = db.animate(line, character="crab")
    data = preview([performance], links)
    face = data["faces"][0]
    assert (face["kind"], face["name"]) == ("mesh", "crab")
    content, media = links.kept[int(face["url"].removeprefix("link"))]
    assert content[:4] == b"glTF"
    assert media == "model/gltf-binary"
    np.testing.assert_allclose(floats(links, face["weights"], len(face["shapes"])), performance.shapes.weights, atol=1e-6)
    np.testing.assert_allclose(floats(links, face["track"], len(face["poses"])), performance.track.weights, atol=1e-6)
    with wave.open(io.BytesIO(linked(links, data["audio"]))) as file:
        assert file.getnframes() == len(line.sound.samples)


def test_what_is_sent_with_every_run_of_the_page_is_small(db, links) -> None:
    line = db.say("Hello! Bob may find five blue whales. " * 8)
    assert line.sound.duration > 20
    sent = json.dumps(preview([db.animate(line), db.animate(line, character="crab")], links))
    assert len(sent) < 16_000 + 100 * len(line.schedule.phones)


def test_a_character_s_mesh_is_encoded_once(db, line) -> None:
    assert mesh_bytes(db.character("crab")) is mesh_bytes(db.character("crab"))


def test_the_lanes_hold_words_phones_and_common_phones_in_order(db, line, links) -> None:
    data = preview([db.animate(line)], links)
    assert [text for _, _, text in data["words"]] == ["Bob", "may", "go"]
    for lane in ("words", "phones", "common"):
        times = [time for start, end, _ in data[lane] for time in (start, end)]
        assert times == sorted(times)
    assert [text for _, _, text in data["common"]][1:4] == ["bmp", "aa", "bmp"]
    assert data["words"][0][0] == pytest.approx(data["common"][1][0])


def test_the_waveform_fits_its_bytes_and_its_duration(db, line, links) -> None:
    data = preview([db.animate(line)], links)
    peaks = np.frombuffer(linked(links, data["peaks"]), "i1").reshape(-1, 2)
    assert len(peaks) / data["peak_rate"] == pytest.approx(line.sound.duration, abs=0.02)
    assert np.abs(peaks).max() == 127
    assert (peaks[:, 0] <= 0).all()
    assert (peaks[:, 1] >= 0).all()


def test_a_recording_that_is_longer_than_its_phones_keeps_its_own_time(db, line, links) -> None:
    longer = Sound(np.tile(line.sound.samples, 3), line.sound.rate)
    data = preview([replace(db.animate(line), sound=longer)], links)
    assert len(linked(links, data["peaks"])) / 2 / data["peak_rate"] == pytest.approx(longer.duration, abs=0.02)


def test_a_line_without_sound_has_none(db, line, links) -> None:
    data = preview([replace(db.animate(line), sound=None)], links)
    assert (data["audio"], data["peaks"]) == (None, None)


def test_a_flat_mouth_comes_as_pictures_and_cues(db, line, links) -> None:
    face = preview([db.animate(line, character="flat")], links)["faces"][0]
    assert face["kind"] == "pictures"
    assert {shape for _, _, shape in face["cues"]} <= set(face["pictures"])
    assert links.kept[int(face["pictures"]["A"].removeprefix("link"))][1] == "image/svg+xml"


def test_the_id_follows_what_is_shown(db, line, links) -> None:
    robin, crab = db.animate(line), db.animate(line, character="crab")
    ids = [preview(shown, lambda content, media: str(hash(content)))["id"] for shown in ([robin], [robin], [crab], [robin, crab])]
    assert ids[0] == ids[1]
    assert len(set(ids)) == 3


def test_performances_of_different_lines_are_refused(db, line, links) -> None:
    with pytest.raises(InputError, match="differ in length"):
        preview([db.animate(line), db.animate(db.say("Go."))], links)
