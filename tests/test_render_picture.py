"""Pictures of a mesh: what they show, that they repeat, and that OpenGL and numpy agree."""

from __future__ import annotations

import numpy as np
import pytest

from lipdb.characters.mesh import Mesh, Part
from lipdb.errors import InputError, MeshError
from lipdb.render.gl import backend
from lipdb.render.renderer import Renderer

SIZE = (96, 80)


def _disc(name: str, centre: tuple[float, float, float], radius: float, colour: tuple[float, float, float], bulge: float) -> Part:
    """A dome of rings that faces +z."""
    rings, spokes = np.meshgrid(np.linspace(0, 1, 9), np.linspace(0, 2 * np.pi, 24, endpoint=False), indexing="ij")
    flat = np.stack([rings * np.cos(spokes), rings * np.sin(spokes)], -1) * radius
    positions = np.concatenate([flat, bulge * (1 - rings[..., None] ** 2)], -1).reshape(-1, 3) + centre
    ring, spoke = np.meshgrid(np.arange(8), np.arange(24), indexing="ij")
    a, b, c, d = (((ring + i) * 24 + (spoke + j) % 24).ravel() for i, j in ((0, 0), (1, 0), (1, 1), (0, 1)))
    return Part(name, positions, np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)]), np.tile(colour, (len(positions), 1)))


@pytest.fixture(scope="module")
def face() -> Mesh:
    """A pale dome with a dark mouth that *open* makes taller and *shut* flattens."""
    head = _disc("head", (0, 0, 0), 1.0, (0.9, 0.7, 0.6), 0.5)
    mouth = _disc("mouth", (0, -0.4, 0.5), 0.2, (0.2, 0.02, 0.02), 0.02)
    taller = np.zeros_like(mouth.positions)
    taller[:, 1] = (mouth.positions[:, 1] + 0.4) * 0.8
    shapes = {"open": taller, "shut": -taller * 1.2}
    jaw = np.zeros_like(head.positions)
    jaw[:, 1] = np.where(head.positions[:, 1] < -0.5, -0.1, 0)
    crown = np.zeros_like(head.positions)
    crown[:, 1] = np.where(head.positions[:, 1] > 0.5, 0.05, 0)
    head = Part(head.name, head.positions, head.faces, head.colours, shapes={"open": jaw, "brow": crown})
    return Mesh("dome", (head, Part(mouth.name, mouth.positions, mouth.faces, mouth.colours, shapes=shapes)))


def _dark(picture: np.ndarray) -> int:
    """How many pixels are the mouth's."""
    return int((picture.max(axis=2) < 110).sum())


@pytest.fixture(params=["numpy", "gl"])
def painter(request: pytest.FixtureRequest) -> str:
    """Each painter of this machine; without OpenGL that is a failure when LIPDB_REQUIRE_GL is 1, and numpy twice otherwise."""
    return "numpy" if request.param == "numpy" else backend()


def test_an_open_mouth_is_larger_and_a_shut_one_smaller(face: Mesh, painter: str) -> None:
    with Renderer(face, size=SIZE, painter=painter) as renderer:
        shut, rest, wide = (_dark(renderer.draw(weights)) for weights in ({"shut": 0.8}, {}, {"open": 1.0}))
    assert 0 < shut < 0.5 * rest < rest < 0.75 * wide


def test_the_same_weights_give_the_same_bytes_whatever_was_drawn_before(face: Mesh, painter: str) -> None:
    with Renderer(face, size=SIZE, painter=painter) as renderer:
        first = renderer.draw({"open": 0.4})
        renderer.draw({"open": 1.0, "shut": 0.2})
        again = renderer.draw({"open": 0.4})
    with Renderer(face, size=SIZE, painter=painter) as other:
        assert first.tobytes() == again.tobytes() == other.draw({"open": 0.4}).tobytes()


def test_two_renderers_live_side_by_side_and_survive_each_other(face: Mesh, painter: str) -> None:
    small, large = Renderer(face, size=SIZE, painter=painter), Renderer(face, size=(160, 120), painter=painter)
    before = small.draw({"open": 0.5})
    assert large.draw({}).shape == (120, 160, 3)
    large.close()
    assert small.draw({"open": 0.5}).tobytes() == before.tobytes()
    small.close()


@pytest.mark.parametrize("view", ["front", "three-quarter", "side"])
def test_opengl_and_numpy_draw_the_same_picture(face: Mesh, view: str) -> None:
    pictures = []
    for painter in ("numpy", backend()):
        with Renderer(face, size=SIZE, view=view, painter=painter) as renderer:
            pictures.append(renderer.draw({"open": 0.6}).astype(int))
    difference = np.abs(pictures[0] - pictures[1])
    assert difference.mean() < 1.0
    assert np.percentile(difference, 95) <= 4


def test_the_wall_is_lighter_above_than_below_and_fills_the_corners(face: Mesh, painter: str) -> None:
    with Renderer(face, size=SIZE, painter=painter) as renderer:
        picture = renderer.draw({}).astype(int)
    assert (picture[0, [0, -1]] > picture[-1, [0, -1]] + 30).all()
    assert np.abs(picture[0, 0] - picture[0, -1]).max() <= 1


def test_every_view_shows_the_face_inside_the_picture(face: Mesh, painter: str) -> None:
    for view in ("front", "three-quarter", "side"):
        with Renderer(face, size=SIZE, view=view, painter=painter) as renderer:
            picture = renderer.draw({}).astype(int)
        skin = picture[..., 0] - picture[..., 2] > 15
        assert skin.mean() > 0.04
        assert not skin[0].any()
        assert not skin[:, 0].any()


def test_a_face_of_another_size_and_place_is_drawn_alike(face: Mesh, painter: str) -> None:
    moved = tuple(
        Part(p.name, p.positions * 0.01 + [3, 1.5, -2], p.faces, p.colours, shapes={n: d * 0.01 for n, d in p.shapes.items()})
        for p in face.parts
    )
    pictures = []
    for mesh in (face, Mesh("far", moved)):
        with Renderer(mesh, size=SIZE, painter=painter) as renderer:
            pictures.append(renderer.draw({"open": 0.3}).astype(int))
    assert np.abs(pictures[0] - pictures[1]).mean() < 0.5


def test_shapes_that_the_mesh_lacks_move_nothing(face: Mesh, painter: str) -> None:
    with Renderer(face, size=SIZE, painter=painter) as renderer:
        assert renderer.draw({"tail": 1.0}).tobytes() == renderer.draw({}).tobytes()


def test_a_mesh_without_triangles_a_wrong_size_and_a_wrong_view_are_refused(face: Mesh) -> None:
    part = face.parts[0]
    empty = Mesh("empty", (Part("dust", part.positions, np.empty((0, 3), int), part.colours),))
    with pytest.raises(MeshError, match="no triangles"):
        Renderer(empty)
    with pytest.raises(InputError, match="0x80"):
        Renderer(face, size=(0, 80))
    with pytest.raises(InputError, match="front, three-quarter, side"):
        Renderer(face, view="above")
