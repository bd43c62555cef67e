"""GLB files that lipdb writes: what is in them, and that they read back."""

import json
import struct

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lipdb.characters.crab import crab
from lipdb.characters.gltf_read import parse_glb, read_glb
from lipdb.characters.gltf_write import glb_bytes, write_glb
from lipdb.characters.human import robin
from lipdb.characters.mesh import Mesh, Part
from lipdb.track import Track


def content_of(data):
    (length,) = struct.unpack_from("<I", data, 12)
    return json.loads(data[20 : 20 + length]), data[20 + length + 8 :]


def floats(data, accessor):
    content, binary = content_of(data)
    entry = content["accessors"][accessor]
    view = content["bufferViews"][entry["bufferView"]]
    width = {"SCALAR": 1, "VEC3": 3}[entry["type"]]
    return np.frombuffer(binary, "<f4", entry["count"] * width, view["byteOffset"]).reshape(-1, width)


def test_robin_reads_back_as_written():
    mesh = parse_glb(glb_bytes(robin()), name="robin")
    assert mesh.shape_names == robin().shape_names
    for written, read in zip(robin().parts, mesh.parts, strict=True):
        assert (read.faces == written.faces).all()
        assert np.allclose(read.positions, written.positions, atol=1e-6)
        assert np.allclose(read.colours, written.colours, atol=2e-4)
        assert set(read.shapes) == {name for name, moved in written.shapes.items() if np.abs(moved).max() > 1e-5}
        for name, moved in read.shapes.items():
            assert np.allclose(moved, written.shapes[name], atol=1.1e-5)


@st.composite
def meshes(draw):
    count = draw(st.integers(3, 12))
    number = st.floats(-10, 10, width=32)
    points = st.lists(st.tuples(number, number, number), min_size=count, max_size=count).map(np.array)
    faces = draw(st.lists(st.tuples(*[st.integers(0, count - 1)] * 3), min_size=1, max_size=10).map(np.array))
    names = draw(st.lists(st.from_regex(r"[A-Za-z_]{1,8}", fullmatch=True), min_size=1, max_size=3, unique=True))
    shapes = {name: draw(points) for name in names}
    shapes[names[0]][0] = [1, 2, 3]
    return Mesh("any", (Part("any", draw(points), faces, np.full((count, 3), 0.5), shapes=shapes),))


@given(meshes())
def test_any_mesh_reads_back(mesh):
    (read,) = parse_glb(glb_bytes(mesh), name="any").parts
    (written,) = mesh.parts
    assert (read.faces == written.faces).all()
    assert np.allclose(read.positions, written.positions, atol=1e-5)
    for name, moved in written.shapes.items():
        assert np.allclose(read.shapes.get(name, 0), moved, atol=1.1e-5)


def test_an_animation_moves_the_shapes_by_the_weights_of_the_track():
    weights = np.array([[0.0, 0.5], [1.0, 0.25], [0.5, 0.0]])
    data = glb_bytes(crab(), animation=Track(weights, ("smile", "no_such_shape"), 30.0))
    content, _ = content_of(data)
    (animation,) = content["animations"]
    sampler = animation["samplers"][0]
    names = content["meshes"][0]["extras"]["targetNames"]
    assert animation["channels"] == [{"sampler": 0, "target": {"node": 0, "path": "weights"}}]
    assert np.allclose(floats(data, sampler["input"])[:, 0], [0, 1 / 30, 2 / 30])
    moved = floats(data, sampler["output"]).reshape(3, len(names))
    assert moved[:, names.index("smile")].tolist() == [0, 1, 0.5]
    assert np.delete(moved, names.index("smile"), axis=1).max() == 0


def test_every_primitive_has_every_target_and_none_is_empty():
    content, _ = content_of(glb_bytes(crab()))
    names = content["meshes"][0]["extras"]["targetNames"]
    for primitive in content["meshes"][0]["primitives"]:
        assert len(primitive["targets"]) == len(names)
    for accessor in content["accessors"]:
        assert accessor["count"] > 0
        assert accessor.get("sparse", {"count": 1})["count"] > 0


def test_vertices_that_a_shape_leaves_are_not_written():
    content, _ = content_of(glb_bytes(robin()))
    sparse = [accessor["sparse"]["count"] / accessor["count"] for accessor in content["accessors"] if "sparse" in accessor]
    assert len(sparse) > 100
    assert len(glb_bytes(robin())) < 3_000_000


def test_normals_are_of_unit_length():
    data = glb_bytes(crab())
    for primitive in content_of(data)[0]["meshes"][0]["primitives"]:
        assert np.allclose(np.linalg.norm(floats(data, primitive["attributes"]["NORMAL"]), axis=1), 1, atol=1e-4)


def test_the_same_mesh_and_track_give_the_same_bytes():
    track = Track(np.random.default_rng(1).random((10, 2)), ("open", "W"), 60.0)
    assert glb_bytes(robin(), animation=track) == glb_bytes(robin(), animation=track)


def test_a_mesh_without_shapes_is_written_without_targets():
    still = Mesh("still", (Part("still", np.eye(3), np.array([[0, 1, 2]]), np.zeros((3, 3))),))
    content, _ = content_of(glb_bytes(still, animation=Track(np.zeros((2, 1)), ("open",), 60.0)))
    assert "targets" not in content["meshes"][0]["primitives"][0]
    assert "animations" not in content


def test_the_file_is_written_to_its_path(tmp_path):
    write_glb(tmp_path / "crab.glb", crab())
    assert read_glb(tmp_path / "crab.glb", name="crab").vertices == crab().vertices


@pytest.mark.parametrize("count", [65_534, 65_536])
def test_large_meshes_get_larger_indices(count):
    points = np.random.default_rng(0).random((count, 3))
    faces = np.array([[0, 1, count - 1]])
    lone = np.zeros((count, 3))
    lone[-1] = 1
    mesh = Mesh("large", (Part("large", points, faces, points, shapes={"far": lone}),))
    read = parse_glb(glb_bytes(mesh), name="large")
    assert read.parts[0].faces.tolist() == faces.tolist()
    assert np.allclose(read.parts[0].shapes["far"][-1], 1)
