"""Damaged and hostile glTF files give a mesh or a `MeshError`, never anything else, and no great use of memory."""

import copy
import io
import json
import tracemalloc

import numpy as np
import pytest
from glb_cases import Builder, container
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

from lipdb.characters.gltf_read import parse_glb
from lipdb.characters.mesh import Mesh
from lipdb.errors import MeshError


def picture():
    file = io.BytesIO()
    Image.new("RGB", (2, 2), (200, 100, 50)).save(file, "PNG")
    return file.getvalue()


def rich():
    """A file with a bit of everything."""
    builder = Builder(("jawOpen", "mouthSmile"))
    builder.content["materials"] = [{"pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 1]}}]
    builder.primitive["material"] = 0
    builder.content["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {"index": 0}
    builder.content["textures"] = [{"source": 0}]
    builder.content["images"] = [{"bufferView": builder.view(np.frombuffer(picture(), "u1"))}]
    builder.primitive["attributes"]["TEXCOORD_0"] = builder.accessor(np.zeros((4, 2), "<f4"), "VEC2")
    builder.content["nodes"] = [{"children": [1], "rotation": [0, 0, 0, 1]}, {"mesh": 0, "scale": [1, 1, 1], "skin": 0}]
    builder.content["skins"] = [{"joints": [0]}]
    groups = [{"presetName": "a", "binds": [{"mesh": 0, "index": 0, "weight": 50}]}]
    preset = {"ou": {"morphTargetBinds": [{"node": 1, "index": 1, "weight": 1}]}}
    builder.content["extensions"] = {
        "VRM": {"blendShapeMaster": {"blendShapeGroups": groups}},
        "VRMC_vrm": {"expressions": {"preset": preset}},
    }
    return builder


GOOD = rich().glb()
CONTENT, DATA = rich().content | {"buffers": [{"byteLength": len(rich().data)}]}, bytes(rich().data)


def outcome(data):
    """Read *data*; anything but a mesh or a `MeshError` of one line fails the test."""
    try:
        mesh = parse_glb(data, name="fuzz.glb")
    except MeshError as error:
        assert "\n" not in str(error)
        return error
    assert isinstance(mesh, Mesh)
    return mesh


def places(value, path=()):
    """Every place in a JSON value."""
    yield path
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, inner in items:
        yield from places(inner, (*path, key))


def test_the_file_that_is_damaged_below_is_a_good_one():
    mesh = outcome(GOOD)
    assert mesh.shape_names == ("jawOpen", "mouthSmile", "ou", "aa")
    assert np.allclose(mesh.parts[0].colours[0] * 255, [200, 100, 50])


@settings(max_examples=400)
@given(st.lists(st.tuples(st.integers(0, len(GOOD) - 1), st.integers(0, 255)), min_size=1, max_size=8))
def test_changed_bytes(changes):
    data = bytearray(GOOD)
    for at, byte in changes:
        data[at] = byte
    outcome(bytes(data))


@settings(max_examples=100)
@given(st.integers(0, len(GOOD)), st.binary(max_size=40))
def test_cut_off_and_continued_files(end, tail):
    outcome(GOOD[:end] + tail)


STRANGE = st.one_of(
    st.none(), st.booleans(), st.integers(-(2**70), 2**70), st.floats(allow_nan=False, allow_infinity=False), st.text(max_size=20),
    st.lists(st.integers(-5, 5), max_size=20), st.dictionaries(st.text(max_size=5), st.integers(-5, 5), max_size=3),
    st.sampled_from([0, 1, 2, 3, 4, 255, 65535, 2**31, 2**32, -1, 1e308, "VEC3", "SCALAR", "__proto__"]),
)  # fmt: skip


@settings(max_examples=600)
@given(st.lists(st.tuples(st.sampled_from(sorted(places(CONTENT), key=repr)), STRANGE), min_size=1, max_size=3))
def test_strange_values_anywhere_in_the_json(changes):
    content = copy.deepcopy(CONTENT)
    for path, value in changes:
        holder = content
        try:
            for key in path[:-1]:
                holder = holder[key]
            if path:
                holder[path[-1]] = value
        except (TypeError, KeyError, IndexError):
            continue
    outcome(container(json.dumps(content).encode(), DATA))


@settings(max_examples=200)
@given(st.binary(max_size=200))
def test_any_bytes(data):
    outcome(data)
    outcome(b"glTF" + data)


@pytest.mark.parametrize("claim", [2_000_000, 10**9, 2**31 - 1, 2**63])
@pytest.mark.parametrize(
    "path", [("accessors", 0, "count"), ("accessors", 2, "count"), ("bufferViews", 0, "byteLength"), ("buffers", 0, "byteLength")]
)
def test_a_length_that_lies_allocates_next_to_nothing(path, claim):
    content = copy.deepcopy(CONTENT)
    content[path[0]][path[1]][path[2]] = claim
    data = container(json.dumps(content).encode(), DATA)
    tracemalloc.start()
    try:
        assert isinstance(outcome(data), MeshError)
        assert tracemalloc.get_traced_memory()[1] < 2_000_000
    finally:
        tracemalloc.stop()
