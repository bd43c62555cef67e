"""Meshes, their normals, and the measure of a mouth."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lipdb.characters.mesh import Mesh, Part, vertex_normals
from lipdb.characters.mouth import LEFT, LOWER, RIGHT, UPPER, measure
from lipdb.errors import MeshError

GREY = np.full((4, 3), 0.5)
SQUARE = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
FACES = np.array([[0, 1, 2], [0, 2, 3]])


def part(**changes):
    return Part(**{"name": "square", "positions": SQUARE, "faces": FACES, "colours": GREY, **changes})


def test_a_shape_moves_its_vertices_by_its_weight():
    lifted = np.array([[0.0, 0, 0], [0, 0, 0], [0, 2, 0], [0, 0, 0]])
    mesh = Mesh("m", (part(shapes={"up": lifted}), part(name="still")))
    first, second = mesh.morphed({"up": 0.5, "unknown": 1.0})
    assert first[2].tolist() == [1, 2, 0]
    assert (second == SQUARE).all()
    assert mesh.shape_names == ("up",)
    assert mesh.vertices == 8


def test_normals_are_units_that_point_outwards():
    corners = np.array([[x, y, z] for x in (-1.0, 1) for y in (-1.0, 1) for z in (-1.0, 1)])
    sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    faces = np.array([tri for a, b, c, d in sides for tri in ((a, b, c), (a, c, d))])
    normals = vertex_normals(corners, faces)
    assert np.allclose(np.linalg.norm(normals, axis=1), 1)
    assert ((normals * corners).sum(axis=1) > 0.8).all()


def test_a_vertex_without_a_face_still_has_a_normal():
    assert vertex_normals(SQUARE, np.zeros((0, 3), dtype=np.int64)).tolist() == [[0, 0, 1]] * 4


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"faces": np.array([[0, 1, 4]])}, "a face names vertex 4, but there are 4"),
        ({"faces": np.array([[0, -1, 2]])}, "a face names vertex"),
        ({"faces": np.array([[0, 1]])}, "faces must be triangles"),
        ({"shapes": {"open": np.zeros((3, 3))}}, "shape 'open' has 3 vertices, the mesh 4"),
        ({"colours": np.zeros((2, 3))}, "must be 4 rows of 3 numbers"),
    ],
)
def test_a_part_whose_arrays_do_not_fit_together_is_refused(changes, message):
    with pytest.raises(MeshError, match=message):
        part(**changes)


def mouth():
    lips = np.array([[0.0, 1, 0], [0, 0.5, 0], [2, 0, 0], [-2, 0, 0]])
    wide = np.array([[0.0, 0, 0], [0, 0, 0], [1, 0, 0], [-1, 0, 0]])
    opened = np.array([[0.0, 0, 0], [0, -3, 0], [0, 0, 0], [0, 0, 0]])
    press = np.array([[0.0, -2, 0], [0, 0, 0], [0, 0, 0], [0, 0, 0]])
    landmarks = {UPPER: (0, 0), LOWER: (0, 1), RIGHT: (0, 2), LEFT: (0, 3)}
    return Mesh("lips", (Part("lips", lips, FACES, GREY, shapes={"open": opened, "wide": wide, "press": press}),), landmarks)


@given(st.lists(st.tuples(*[st.floats(0, 1)] * 3), min_size=1, max_size=20))
def test_the_measured_mouth_is_linear_in_the_weights_and_never_below_closed(rows):
    weights = np.array(rows)
    opening, width = measure(mouth(), weights, ("open", "wide", "press"))
    assert np.allclose(opening, np.maximum(0, 0.5 + 3 * weights[:, 0] - 2 * weights[:, 2]))
    assert np.allclose(width, 4 + 2 * weights[:, 1])


def test_the_measure_agrees_with_the_morphed_mesh():
    opening, width = measure(mouth(), np.array([[0.3, 0.6]]), ("open", "wide"))
    (points,) = mouth().morphed({"open": 0.3, "wide": 0.6})
    assert opening[0] == pytest.approx(points[0, 1] - points[1, 1])
    assert width[0] == pytest.approx(points[2, 0] - points[3, 0])


def test_a_mesh_without_landmarks_can_not_be_measured():
    with pytest.raises(MeshError, match="no landmark 'inner_lip_upper'"):
        measure(Mesh("bob", (part(),)), np.zeros((1, 0)), ())
