"""Flat mouths: SVG and PNG over the wall, and files that are no pictures."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from lipdb.errors import MeshError
from lipdb.render.flat import Pictures, read_picture

SVG = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 50"><rect x="10" y="10" width="80" height="30" fill="#ff0000"/></svg>'


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "A.svg").write_text(SVG)
    pixels = np.zeros((40, 40, 4), np.uint8)
    pixels[10:30, 10:30] = [0, 0, 255, 255]
    Image.fromarray(pixels).save(tmp_path / "B.png")
    return tmp_path


def test_svg_and_png_stand_in_the_middle_of_the_picture_and_the_wall_shows_round_them(folder: Path) -> None:
    pictures = Pictures({"A": folder / "A.svg", "B": folder / "B.png"}, size=(120, 90))
    for shape, colour in (("A", [255, 0, 0]), ("B", [0, 0, 255])):
        picture = pictures.draw(shape)
        assert picture.shape == (90, 120, 3)
        assert picture[45, 60].tolist() == colour
        assert picture[0, 0].tolist() not in ([255, 0, 0], [0, 0, 255], [0, 0, 0])


def test_a_shape_without_a_picture_shows_the_wall(folder: Path) -> None:
    pictures = Pictures({"A": folder / "A.svg"}, size=(60, 60))
    assert (pictures.draw("X") != pictures.draw("A")).any()
    assert (pictures.draw("X")[:, 0] == pictures.draw("X")[:, 30]).all()


def test_pictures_are_scaled_to_fit_without_being_distorted(folder: Path) -> None:
    assert read_picture(folder / "A.svg", 200, 200).shape == (100, 200, 4)
    assert read_picture(folder / "A.svg", 200, 20).shape == (20, 40, 4)
    assert read_picture(folder / "B.png", 100, 60).shape == (60, 60, 4)


@pytest.mark.parametrize(
    ("name", "data", "words"),
    [
        ("a.svg", b"", "not an SVG"),
        ("a.svg", b"<svg", "not an SVG"),
        ("a.svg", b"\xff\xfe\x00", "not an SVG"),
        ("a.svg", SVG.replace("<rect", '<image href="/etc/hostname"/><rect').encode(), "something outside"),
        ("a.svg", SVG.replace("<rect", '<style>@import "x.css";</style><rect').encode(), "refers to something outside"),
        ("a.png", b"\x89PNG\r\n\x1a\n" + b"\x00" * 40, "not a PNG"),
        ("a.png", b"hello", "not a PNG"),
        ("a.gif", b"GIF89a" + b"\x00" * 40, "not a PNG"),
    ],
)
def test_a_file_that_is_no_picture_is_named_with_what_is_wrong(tmp_path: Path, name: str, data: bytes, words: str) -> None:
    (tmp_path / name).write_bytes(data)
    with pytest.raises(MeshError, match=words) as caught:
        read_picture(tmp_path / name, 50, 50)
    assert str(caught.value).startswith(str(tmp_path / name))
    assert "\n" not in str(caught.value)


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(MeshError, match=r"none\.svg: can't be read"):
        read_picture(tmp_path / "none.svg", 50, 50)
