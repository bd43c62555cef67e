"""Faces from glTF files: everything a file may hold, and everything that may be wrong with it."""

import io
import struct

import numpy as np
import pytest
from glb_cases import FACES, JAW, SQUARE, Builder, container
from PIL import Image

from lipdb.characters.gltf_read import parse_glb, read_glb
from lipdb.errors import MeshError


def read(builder):
    return parse_glb(builder.glb(), name="face")


def test_positions_triangles_and_targets_are_read():
    mesh = read(Builder(("jawOpen", "mouthSmile_L")))
    (part,) = mesh.parts
    assert mesh.name == "face"
    assert mesh.shape_names == ("jawOpen", "mouthSmile_L")
    assert part.positions.tolist() == SQUARE.tolist()
    assert part.faces.tolist() == FACES.reshape(-1, 3).tolist()
    assert part.shapes["mouthSmile_L"].tolist() == (2 * JAW).tolist()


def test_the_file_is_read_from_a_path(tmp_path):
    (tmp_path / "bob.glb").write_bytes(Builder().glb())
    assert read_glb(tmp_path / "bob.glb", name="bob").shape_names == ("jawOpen",)


def test_sparse_targets_move_only_the_vertices_they_name():
    builder = Builder()
    sparse = {
        "count": 1,
        "indices": {"bufferView": builder.view(np.array([2], "<u2")), "componentType": 5123},
        "values": {"bufferView": builder.view(np.array([[0, 0, 3]], "<f4"))},
    }
    builder.content["accessors"].append({"componentType": 5126, "count": 4, "type": "VEC3", "sparse": sparse})
    builder.primitive["targets"][0]["POSITION"] = len(builder.content["accessors"]) - 1
    assert read(builder).parts[0].shapes["jawOpen"].tolist() == [[0, 0, 0], [0, 0, 0], [0, 0, 3], [0, 0, 0]]


def test_quantised_numbers_become_what_they_stand_for():
    builder = Builder()
    normalized = builder.accessor(np.array([[0, -127, 0], [127, 0, 0], [0, 0, -128], [0, 0, 0]], "i1"), "VEC3", normalized=True)
    builder.primitive["targets"][0]["POSITION"] = normalized
    builder.primitive["attributes"]["POSITION"] = builder.accessor(np.array(SQUARE * 100, "<i2"), "VEC3")
    (part,) = read(builder).parts
    assert part.positions[2].tolist() == [100, 100, 0]
    assert part.shapes["jawOpen"].tolist() == [[0, -1, 0], [1, 0, 0], [0, 0, -1], [0, 0, 0]]


def test_vertices_may_stand_apart_in_the_buffer():
    builder = Builder()
    spread = np.concatenate([SQUARE, np.full((4, 1), 9, "<f4")], axis=1).astype("<f4")
    view = builder.view(spread, byteStride=16)
    builder.content["accessors"][0] = {"bufferView": view, "componentType": 5126, "count": 4, "type": "VEC3"}
    assert read(builder).parts[0].positions.tolist() == SQUARE.tolist()


def test_nodes_move_turn_and_scale_their_meshes_and_shapes():
    builder = Builder()
    half = np.sqrt(0.5)
    builder.content["nodes"] = [
        {"children": [1], "translation": [10, 0, 0]},
        {"mesh": 0, "rotation": [0, 0, half, half], "scale": [2, 2, 2]},
    ]
    (part,) = read(builder).parts
    assert np.allclose(part.positions[1], [10, 2, 0])  # (1, 0, 0) twice as far, a quarter turn about z, then moved
    assert np.allclose(part.shapes["jawOpen"][0], [2, 0, 0])


def test_a_matrix_is_read_column_by_column():
    builder = Builder()
    builder.content["nodes"] = [{"mesh": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1]}]
    assert read(builder).parts[0].positions[0].tolist() == [5, 6, 7]


def test_a_mirrored_node_keeps_its_faces_outside():
    builder = Builder()
    builder.content["nodes"] = [{"mesh": 0, "scale": [-1, 1, 1]}]
    assert read(builder).parts[0].faces[0].tolist() == [2, 1, 0]


def test_a_mesh_on_bones_stands_where_its_bones_bound_it():
    builder = Builder()
    bind = builder.accessor(np.array([np.diag([100, 100, 100, 1.0])], "<f4").reshape(1, 16), "MAT4")
    builder.content["nodes"] = [{"mesh": 0, "skin": 0, "translation": [5, 5, 5]}, {"scale": [0.01, 0.01, 0.01]}]
    builder.content["scenes"] = [{"nodes": [0, 1]}]
    builder.content["skins"] = [{"joints": [1], "inverseBindMatrices": bind}]
    assert np.allclose(read(builder).parts[0].positions, SQUARE)


def test_several_meshes_share_shapes_by_name():
    builder = Builder()
    builder.content["meshes"].append({**builder.content["meshes"][0], "name": "teeth"})
    builder.content["nodes"].append({"mesh": 1})
    builder.content["scenes"] = [{"nodes": [0, 1]}]
    mesh = read(builder)
    assert len(mesh.parts) == 2
    assert mesh.shape_names == ("jawOpen",)


def test_names_come_from_the_primitive_or_the_accessors_where_the_mesh_has_none():
    builder = Builder()
    del builder.content["meshes"][0]["extras"]
    assert read(builder).shape_names == ("target_0",)
    builder.content["accessors"][builder.primitive["targets"][0]["POSITION"]]["name"] = "Jaw Open"
    assert read(builder).shape_names == ("Jaw_Open",)
    builder.primitive["extras"] = {"targetNames": ["open"]}
    assert read(builder).shape_names == ("open",)


def test_names_become_single_printable_words():
    assert read(Builder(("jaw\topen\n x",))).shape_names == ("jaw_open_x",)


def test_the_base_colour_becomes_srgb_and_vertex_colours_tint_it():
    builder = Builder()
    builder.content["materials"] = [{"pbrMetallicRoughness": {"baseColorFactor": [1, 0.2158605, 0, 1], "roughnessFactor": 0.9}}]
    builder.primitive["material"] = 0
    half = np.tile(np.array([255, 255, 255, 255], "u1"), (4, 1))
    builder.primitive["attributes"]["COLOR_0"] = builder.accessor(half, "VEC4", normalized=True)
    (part,) = read(builder).parts
    assert np.allclose(part.colours, [1, 0.502, 0], atol=1e-3)
    assert part.roughness == 0.9


def with_texture(builder, data):
    places = builder.accessor(np.array([[0.1, 0.1], [0.9, 0.1], [1.9, 0.9], [-0.9, 0.9]], "<f4"), "VEC2")
    builder.primitive["attributes"]["TEXCOORD_0"] = places
    builder.content["images"] = [{"bufferView": builder.view(np.frombuffer(data, "u1")), "mimeType": "image/png"}]
    builder.content["textures"] = [{"source": 0}]
    builder.content["materials"] = [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]
    builder.primitive["material"] = 0
    return read(builder).parts[0].colours


def test_a_texture_colours_each_vertex():
    picture = Image.fromarray(np.array([[[255, 0, 0], [0, 255, 0]], [[0, 0, 255], [255, 255, 255]]], np.uint8))
    file = io.BytesIO()
    picture.save(file, "PNG")
    assert np.allclose(with_texture(Builder(), file.getvalue()), [[1, 0, 0], [0, 1, 0], [1, 1, 1], [0, 0, 1]], atol=1e-6)


@pytest.mark.parametrize("data", [b"no picture", b"\x89PNG\r\n\x1a\n" + bytes(40), b"GIF89a" + bytes(40)])
def test_a_texture_that_is_no_picture_leaves_grey(data):
    assert np.ptp(with_texture(Builder(), data)) < 1e-9


@pytest.mark.parametrize(("mode", "count"), [(5, 2), (6, 2)])
def test_strips_and_fans_become_triangles(mode, count):
    builder = Builder()
    builder.primitive.update(mode=mode)
    del builder.primitive["indices"]
    assert len(read(builder).parts[0].faces) == count


def test_vrm_0_expressions_become_shapes_under_their_names_of_vrm_1():
    builder = Builder(("Fcl_MTH_A", "Fcl_EYE_Close"))
    groups = [
        {"presetName": "a", "binds": [{"mesh": 0, "index": 0, "weight": 50}]},
        {"presetName": "blink", "binds": [{"mesh": 0, "index": 1, "weight": 100}]},
        {"presetName": "unknown", "binds": [{"mesh": 0, "index": 1, "weight": 100}]},
    ]
    builder.content["extensions"] = {"VRM": {"blendShapeMaster": {"blendShapeGroups": groups}}}
    mesh = read(builder)
    assert mesh.shape_names == ("Fcl_MTH_A", "Fcl_EYE_Close", "aa", "blink")
    assert np.allclose(mesh.parts[0].shapes["aa"], 0.5 * JAW)


def test_vrm_1_expressions_mix_several_targets():
    builder = Builder(("open", "round"))
    binds = [{"node": 0, "index": 0, "weight": 0.5}, {"node": 0, "index": 1, "weight": 0.25}, {"node": 0, "index": 9, "weight": 1}]
    builder.content["extensions"] = {"VRMC_vrm": {"expressions": {"preset": {"oh": {"morphTargetBinds": binds}}}}}
    assert np.allclose(read(builder).parts[0].shapes["oh"], 1.0 * JAW)


def test_text_files_may_hold_their_data(tmp_path):
    (tmp_path / "bob.gltf").write_bytes(Builder().gltf())
    assert read_glb(tmp_path / "bob.gltf", name="bob").vertices == 4


def test_text_files_may_have_their_data_beside_them(tmp_path):
    builder = Builder()
    (tmp_path / "bob.gltf").write_bytes(builder.gltf("bob.bin"))
    (tmp_path / "bob.bin").write_bytes(builder.data)
    assert read_glb(tmp_path / "bob.gltf", name="bob").vertices == 4


@pytest.mark.parametrize(
    "uri", ["../bob.bin", "/etc/passwd", "sub/bob.bin", "http://example.org/bob.bin", "..", "file:///etc/passwd", "", ".hidden"]
)
def test_data_anywhere_else_is_refused(tmp_path, uri):
    folder = tmp_path / "inner"
    folder.mkdir()
    builder = Builder()
    (tmp_path / "bob.bin").write_bytes(builder.data)
    path = folder / "bob.gltf"
    text = builder.gltf("placeholder.bin").replace(b"placeholder.bin", uri.encode())
    path.write_bytes(text)
    with pytest.raises(MeshError, match="only a file beside this one can be read"):
        read_glb(path, name="bob")


def bent(change):
    builder = Builder()
    change(builder)
    return builder.glb()


def accessor(number, **changes):
    return lambda b: b.content["accessors"][number].update(changes)


FAULTS = [
    (lambda b: b.primitive.pop("targets"), "has no morph targets"),
    (accessor(2, count=3), "accessor 2 has 3 entries where 4 are needed"),
    (accessor(0, count=2_000_001), "the count of accessor 0 is '2000001'"),
    (accessor(0, count=400), "accessor 0 reaches beyond its data"),
    (accessor(0, count=-4), "the count of accessor 0 is '-4'"),
    (accessor(0, count=True), "the count of accessor 0 is 'True'"),
    (accessor(0, byteOffset=2**31), "reaches beyond its data"),
    (accessor(0, componentType=9999), "component type '9999'"),
    (accessor(0, type="MAT9"), "'MAT9' where VEC3 is needed"),
    (accessor(0, bufferView=77), "bufferViews 77 does not exist"),
    (lambda b: b.content["accessors"][0].pop("bufferView"), "accessor 0 has no data"),
    (lambda b: b.content["bufferViews"][0].update(byteLength=2**31), "reaches beyond its data"),
    (lambda b: b.content["bufferViews"][0].update(byteOffset=-1), "the offset of bufferView 0 is '-1'"),
    (lambda b: b.content["bufferViews"][0].update(byteStride=0), "the stride of bufferView 0 is '0'"),
    (lambda b: b.content["bufferViews"][0].update(buffer=1), "the buffer of bufferView 0 is '1'"),
    (lambda b: b.content["buffers"][0].update(byteLength=10**6), "buffer 0 says that it is 1000000 bytes long, but it has"),
    (lambda b: b.content.update(buffers=[]), "has no buffers"),
    (lambda b: b.primitive.update(indices=b.accessor(np.array([0, 1, 4], "<u2"), "SCALAR")), "names vertex 4, but there are 4"),
    (lambda b: b.primitive.update(indices=b.accessor(np.array([0, 1], "<u2"), "SCALAR")), "2 indices are not triangles"),
    (lambda b: b.primitive.update(indices=b.accessor(np.array([0, 1, 2], "<f4"), "SCALAR")), "holds no whole numbers"),
    (lambda b: b.primitive["attributes"].pop("POSITION"), "has no positions"),
    (lambda b: b.primitive["attributes"].update(POSITION=b.accessor(SQUARE * np.float32("nan"), "VEC3")), "not numbers"),
    (lambda b: b.content.update(nodes=[{"mesh": 5}]), "the mesh of node 0 is '5'"),
    (lambda b: b.content.update(nodes=[{"mesh": 0, "children": [0]}]), "node 0 hangs in two places"),
    (lambda b: b.content.update(nodes=[{"mesh": 0, "children": [3]}]), "nodes 3 does not exist"),
    (lambda b: b.content.update(nodes=[{"mesh": 0, "scale": [1, "x", 1]}]), "the scale of node 0 is not 3 numbers"),
    (lambda b: b.content.update(nodes=[{"mesh": 0, "scale": [1e29, 1, 1]}]), "scaled beyond reason"),
    (lambda b: b.content.update(meshes={"a": 1}), "meshes is not a list"),
    (lambda b: b.content.update(meshes=[]), "meshes 0 does not exist"),
    (lambda b: b.content.update(accessors=[1, 2, 3]), "accessors 0 is not an object"),
    (lambda b: b.content.update(asset={"version": "1.0"}), "glTF version '1.0', not 2.0"),
    (lambda b: b.content.update(asset=[]), "glTF version 'None', not 2.0"),
    (lambda b: b.content.update(extensionsRequired=["KHR_draco_mesh_compression"]), "is compressed"),
    (lambda b: b.content.update(extensionsRequired=["EXT_meshopt_compression"]), "is compressed"),
]


@pytest.mark.parametrize(("change", "message"), FAULTS, ids=[message for _, message in FAULTS])
def test_a_fault_gets_one_line_that_says_what_and_where(change, message):
    with pytest.raises(MeshError) as caught:
        parse_glb(bent(change), name="bob.glb")
    assert message in str(caught.value)
    assert str(caught.value).startswith("bob.glb: ")
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"", "not a glTF file"),
        (b"glTF", "cut off after 4 bytes"),
        (Builder().glb()[:-10], "says that it is"),
        (Builder().glb() + b"more", "says that it is"),
        (b"glTF" + struct.pack("<II", 1, 20) + bytes(8), "GLB version 1"),
        (b"glTF" + struct.pack("<IIII", 2, 20, 9999, 0x4E4F534A), "a chunk says that it is 9999 bytes long, but 0 are left"),
        (b"glTF" + struct.pack("<IIII", 2, 20, 0, 0x004E4942), "has no JSON chunk"),
        (container(b"[]", b""), "not a glTF file"),
        (container(b'{"asset": {"version": NaN}}', b""), "not a glTF file"),
        (container(b'{"asset"', b""), "not a glTF file"),
        (container(b"[" * 200_000, b""), "not a glTF file"),
        (b"\x89PNG\r\n\x1a\n", "not a glTF file"),
    ],
)
def test_files_that_are_no_gltf_are_refused(data, message):
    with pytest.raises(MeshError, match=r"^bob\.glb: ") as caught:
        parse_glb(data, name="bob.glb")
    assert message in str(caught.value)


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(MeshError, match=r"nobody\.glb: can't be read \(No such file"):
        read_glb(tmp_path / "nobody.glb", name="nobody")


@pytest.mark.parametrize("targets", [0, 50])
def test_one_array_used_again_and_again_does_not_fill_the_memory(targets):
    builder = Builder()
    position = builder.accessor(np.zeros((60_000, 3), "<f4"), "VEC3")
    faces = builder.accessor(np.zeros(60_000, "<u2"), "SCALAR")
    primitive = {"attributes": {"POSITION": position}, "indices": faces, "targets": [{"POSITION": position}] * targets}
    builder.content["meshes"][0]["primitives"] = [primitive] * 200
    builder.content["meshes"][0].pop("extras")
    with pytest.raises(MeshError, match="vertices times shapes"):
        parse_glb(builder.glb(), name="bomb")
