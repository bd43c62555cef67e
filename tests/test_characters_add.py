"""Characters made of somebody's files: copied under names of ours, or not at all."""

import shutil
from pathlib import Path

import numpy as np
import pytest
from glb_cases import Builder

import lipdb
from lipdb.characters.add import add_character
from lipdb.characters.character import Character
from lipdb.characters.gltf_write import write_glb
from lipdb.characters.human import robin
from lipdb.characters.match import match
from lipdb.characters.obj_read import read_objects
from lipdb.curated.folder import read_folder
from lipdb.curated.schema import table_of
from lipdb.curated.tsv import canonical_row, key_of
from lipdb.errors import InputError, LipdbError, MeshError, OutputError
from lipdb.store.conflict import EditConflictError
from lipdb.track import Track

VOWELS = ("A", "I", "U", "E", "O")
FACEFX = ("open", "W", "PBM", "FV", "wide", "tRoof")
SVG = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10"><circle cx="5" cy="5" r="3"/></svg>'
OBJ = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"


@pytest.fixture(scope="module")
def records():
    return read_folder(Path(__file__).parent.parent / "phonesets")


def saved(records, added):
    """The records with the rows of *added* in their canonical form, as the store keeps them."""
    tables = dict(records)
    for path, rows in added.tables.items():
        table = table_of(path)
        canonical = [canonical_row(table, row) for row in rows]
        tables[path] = {key_of(table, row): row for row in canonical}
    return tables


def test_a_glb_becomes_a_character_that_speaks(tmp_path, records):
    write_glb(tmp_path / "My Face (final).glb", robin())
    added = add_character(tmp_path / "My Face (final).glb", name="bob", title="Bob", records=records, folder=tmp_path / "characters")
    assert [path.relative_to(tmp_path).as_posix() for path in sorted((tmp_path / "characters").rglob("*"))] == [
        "characters/bob",
        "characters/bob/mesh.glb",
    ]
    bob = Character.from_records(saved(records, added), "bob", folder=tmp_path / "characters")
    assert (bob.title, added.shape_set) == ("Bob", "facefx")
    assert bob.mesh.shape_names == robin().shape_names
    shapes = bob.shapes(Track(np.array([[0.25, 0.75]]), ("open", "PBM"), 60.0))
    assert shapes.pose("open")[0] == 0.25
    assert shapes.pose("PBM")[0] == 0.75
    assert bob.closures == ("PBM", "FV")


def test_a_vrm_is_known_by_its_vowels(tmp_path, records):
    (tmp_path / "a.vrm").write_bytes(Builder(VOWELS).glb())
    added = add_character(tmp_path / "a.vrm", name="vee", records=records, folder=tmp_path / "characters")
    assert added.shape_set == "vrm"
    assert {row["shape"] for row in added.links} == set(VOWELS)
    assert added.to_json()["missing"] == []


def test_a_text_file_with_its_data_beside_it_is_kept_as_one_file(tmp_path, records):
    builder = Builder(VOWELS)
    (tmp_path / "a.gltf").write_bytes(builder.gltf("a.bin"))
    (tmp_path / "a.bin").write_bytes(builder.data)
    added = add_character(tmp_path / "a.gltf", name="vee", records=records, folder=tmp_path / "characters")
    assert Character.from_records(saved(records, added), "vee", folder=tmp_path / "characters").mesh.shape_names == VOWELS


def test_obj_files_are_one_shape_each(tmp_path, records):
    faces = tmp_path / "objs"
    faces.mkdir()
    (faces / "neutral.obj").write_text(OBJ)
    for i, vowel in enumerate(VOWELS):
        (faces / f"{vowel}.obj").write_text(OBJ.replace("v 0 0 0", f"v 0 {i + 1} 0"))
    added = add_character(faces, name="ob", records=records, folder=tmp_path / "characters")
    mesh = Character.from_records(saved(records, added), "ob", folder=tmp_path / "characters").mesh
    assert mesh.parts[0].faces.tolist() == [[0, 1, 2], [0, 2, 3]]
    assert mesh.parts[0].shapes["U"][0].tolist() == [0, 3, 0]


def test_pictures_are_one_shape_each(tmp_path, records):
    drawings = tmp_path / "drawings"
    drawings.mkdir()
    for letter in "ABCDEFGHX":
        (drawings / f"{letter}.SVG").write_text(SVG)
    added = add_character(drawings, name="toon", records=records, folder=tmp_path / "characters")
    toon = Character.from_records(saved(records, added), "toon", folder=tmp_path / "characters")
    assert added.shape_set == "rhubarb"
    assert {shape: file.name for shape, file in toon.pictures.items()} == {letter: f"{k}.svg" for k, letter in enumerate("ABCDEFGHX")}
    assert toon.mesh is None


def test_doubtful_and_missing_shapes_are_listed(tmp_path, records):
    (tmp_path / "a.glb").write_bytes(Builder(("jawOpen", "mouthPuckr", "mouthFunnel", "mouthRollLower", "mouthSmile", "mouthPress")).glb())
    added = add_character(tmp_path / "a.glb", name="half", records=records, folder=tmp_path / "characters")
    certain = {row["shape"]: row["certainty"] for row in added.rows()}
    assert certain["jawOpen"] == "sure"
    assert certain["mouthPuckr"] == "doubtful"
    assert certain["(tongueOut)"] == "missing"
    assert added.to_json()["doubtful"] == ["mouthPuckr"]
    assert "(tongueOut)" not in {row["shape"] for row in added.links}


@pytest.mark.parametrize("name", ["", "Bob", "../bob", "bob/x", "a b", "9lives", ".hidden", "é", "x" * 41, "con\n"])
def test_a_name_that_could_be_a_path_is_refused(tmp_path, records, name):
    (tmp_path / "a.glb").write_bytes(Builder(VOWELS).glb())
    with pytest.raises(InputError, match="use small letters, digits and _"):
        add_character(tmp_path / "a.glb", name=name, records=records, folder=tmp_path / "characters")
    assert not (tmp_path / "characters").exists()


def test_a_name_that_is_taken_is_refused(tmp_path, records):
    (tmp_path / "a.glb").write_bytes(Builder(VOWELS).glb())
    with pytest.raises(InputError, match="there is a character 'robin' already"):
        add_character(tmp_path / "a.glb", name="robin", records=records, folder=tmp_path / "characters")


def folder_with(tmp_path, **files):
    place = tmp_path / "given"
    place.mkdir()
    for name, text in files.items():
        (place / name.replace("__", ".")).write_text(text)
    return place


@pytest.mark.parametrize(
    ("files", "error", "message"),
    [
        ({}, MeshError, "no SVG or PNG pictures in it"),
        ({"A__svg": "not a picture"}, MeshError, "A.svg"),
        ({"A__svg": SVG.replace("<circle", '<image href="/etc/passwd"/><circle')}, MeshError, "something outside"),
        ({"A__svg": SVG, "A__png": "x"}, MeshError, "A.png and A.svg show one shape; keep one of them"),
        ({"A B!__svg": SVG}, MeshError, "name pictures after their shapes"),
        ({"strange__svg": SVG}, InputError, "none of the known sets"),
        ({"neutral__obj": OBJ}, MeshError, "1 OBJ files in it"),
        ({"neutral__obj": OBJ, "A__obj": OBJ + "v 0 0 0\n"}, MeshError, "5 vertices, but neutral.obj has 4"),
        ({"neutral__obj": "v 0 0 0\n", "A__obj": "v 0 0 0\n"}, MeshError, "no faces in it"),
        ({"neutral__obj": OBJ.replace("f 1", "f 9"), "A__obj": OBJ}, MeshError, "names vertex 9, but there are 4"),
        ({"neutral__obj": OBJ.replace("f 1", "f x"), "A__obj": OBJ}, MeshError, r"neutral\.obj:5: 'f x 2 3 4' is not a vertex or face"),
        ({"neutral__obj": OBJ.replace("1 1 0", "nan 1 0"), "A__obj": OBJ}, MeshError, "a vertex is not a number"),
        ({"neutral__obj": "", "A__obj": OBJ}, MeshError, "no vertices"),
    ],
)
def test_what_can_not_be_used_leaves_nothing_behind(tmp_path, records, files, error, message):
    given = folder_with(tmp_path, **files)
    with pytest.raises(error, match=message):
        add_character(given, name="bob", records=records, folder=tmp_path / "characters")
    assert list((tmp_path / "characters").iterdir()) == []


@pytest.mark.parametrize(("name", "message"), [("face.fbx", "face.fbx: give a .glb"), ("nothing.glb", "nothing.glb: no such file")])
def test_other_files_are_refused(tmp_path, records, name, message):
    (tmp_path / "face.fbx").write_bytes(b"x")
    with pytest.raises(LipdbError, match=message):
        add_character(tmp_path / name, name="bob", records=records, folder=tmp_path / "characters")
    assert list((tmp_path / "characters").iterdir()) == []


def test_files_that_have_the_name_already_stay_and_each_face_finds_its_own(tmp_path, db):
    own = lipdb.open(shutil.copy(db.store.where, tmp_path / "own.db"))
    for shapes in (VOWELS, FACEFX):
        (tmp_path / "a.glb").write_bytes(Builder(shapes).glb())
        own.add_character(tmp_path / "a.glb", name="bob", author="ann")
        assert own.character("bob").mesh.shape_names == tuple(shapes)
        added = own.store.undo(own.store.revision, author="ann")
    assert sorted(file.name for file in own.store.characters_folder.iterdir()) == ["bob", "bob_2"]
    own.store.undo(added, author="ann")
    assert own.character("bob").mesh.shape_names == FACEFX
    assert own.at(2).character("bob").mesh.shape_names == VOWELS
    own.close()


def test_a_character_that_can_not_be_saved_leaves_no_files(tmp_path, db):
    (tmp_path / "a.glb").write_bytes(Builder(VOWELS).glb())
    with pytest.raises(InputError, match="there is no author"):
        db.add_character(tmp_path / "a.glb", name="bob", author=" ")
    assert list(db.store.characters_folder.iterdir()) == []


def test_a_name_that_somebody_else_takes_meanwhile_stays_theirs(tmp_path, db, monkeypatch):
    (tmp_path / "a.glb").write_bytes(Builder(VOWELS).glb())
    own = lipdb.open(shutil.copy(db.store.where, tmp_path / "own.db"))
    theirs = {"character": "bob", "pose_set": "facefx", "drawing": "built:robin", "source": "user", "title": "Ben's Bob"}

    def looked_at(*given):
        with own.edit(author="ben") as edit:
            edit.put("characters/bob/character.tsv", theirs)
        return match(*given)

    monkeypatch.setattr("lipdb.characters.add.match", looked_at)
    with pytest.raises(EditConflictError, match="ben changed the same"):
        own.add_character(tmp_path / "a.glb", name="bob", author="ann")
    assert own.records["characters/bob/character.tsv"]["bob",]["title"] == "Ben's Bob"
    assert list(own.store.characters_folder.iterdir()) == []
    own.close()


def test_a_file_where_the_folder_should_be_is_named(tmp_path, records):
    (tmp_path / "a.glb").write_bytes(Builder(VOWELS).glb())
    (tmp_path / "characters").write_text("a file")
    with pytest.raises(OutputError, match="can't be written"):
        add_character(tmp_path / "a.glb", name="bob", records=records, folder=tmp_path / "characters")


def test_obj_faces_may_count_from_the_end_and_name_more_than_vertices(tmp_path):
    text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nf -3/1/1 -2/2/2 -1//3\n"
    given = folder_with(tmp_path, base__obj=text, smile__obj=text.replace("v 1 1", "v 1 2"))
    mesh = read_objects(given, name="o")
    assert mesh.parts[0].faces.tolist() == [[0, 1, 2]]
    assert mesh.shape_names == ("smile",)
