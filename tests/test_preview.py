"""What a player in a browser gets: times, weights and pictures as they are, large things behind links."""

import base64
import io
import wave

import numpy as np
import pytest

import lipdb
from lipdb.errors import InputError
from lipdb.preview import preview


@pytest.fixture(scope="module")
def db(tmp_path_factory):
    with lipdb.open(str(tmp_path_factory.mktemp("preview") / "lipdb.db")) as database:
        yield database


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


def unpacked(text: str, kind: str) -> np.ndarray:
    return np.frombuffer(base64.b64decode(text), kind)


def test_a_mesh_comes_with_weights_of_its_shapes_and_sound_of_the_same_length(db, line, links) -> None:
    performance = db.animate(line, character="crab")
    data = preview([performance], links)
    face = data["faces"][0]
    assert (face["kind"], face["name"]) == ("mesh", "crab")
    content, media = links.kept[int(face["url"].removeprefix("link"))]
    assert content[:4] == b"glTF"
    assert media == "model/gltf-binary"
    np.testing.assert_allclose(unpacked(face["weights"], "<f4").reshape(-1, len(face["shapes"])), performance.shapes.weights, atol=1e-6)
    np.testing.assert_allclose(unpacked(data["weights"], "<f4").reshape(-1, len(data["poses"])), performance.track.weights, atol=1e-6)
    with wave.open(io.BytesIO(links.kept[int(data["audio"].removeprefix("link"))][0])) as file:
        assert file.getnframes() == len(line.sound.samples)


def test_the_lanes_hold_words_phones_and_common_phones_in_order(db, line, links) -> None:
    data = preview([db.animate(line)], links)
    assert [text for _, _, text in data["words"]] == ["Bob", "may", "go"]
    for lane in ("words", "phones", "common"):
        times = [time for start, end, _ in data[lane] for time in (start, end)]
        assert times == sorted(times)
    assert [text for _, _, text in data["common"]][1:4] == ["bmp", "aa", "bmp"]
    assert data["words"][0][0] == pytest.approx(data["common"][1][0])


def test_the_waveform_fits_its_bytes_and_its_duration(db, line, links) -> None:
    peaks = unpacked(preview([db.animate(line)], links)["peaks"], "i1").reshape(-1, 2)
    assert len(peaks) == pytest.approx(line.sound.duration * 100, abs=2)
    assert np.abs(peaks).max() == 127
    assert (peaks[:, 0] <= 0).all()
    assert (peaks[:, 1] >= 0).all()


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
