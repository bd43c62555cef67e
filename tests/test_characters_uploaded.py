"""Files of a face that people upload: checked before use, and never written under the names that they came with."""

import io
import struct
import zipfile
import zlib

import pytest

from lipdb.characters.add import add_character
from lipdb.characters.uploaded import lay_out
from lipdb.errors import InputError, LipdbError, MeshError

SVG = b'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><path d="M0 0L9 9"/></svg>'
LETTERS = [(f"{letter}.svg", SVG) for letter in "ABCDEFGHX"]


def packed(files, **options):
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED, **options) as out:
        for name, content in files:
            out.writestr(name, content)
    return made.getvalue()


def png(width, height):
    """The head of a PNG that says it is this large."""

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(b"")) + chunk(b"IEND", b"")


def test_pictures_and_a_zip_of_them_become_the_same_character(tmp_path, db):
    several = add_from(tmp_path / "a", LETTERS, db.records)
    zipped = add_from(tmp_path / "b", [("mouths.zip", packed(LETTERS))], db.records)
    assert several.links == zipped.links
    assert several.shape_set == "rhubarb"


def add_from(folder, files, records):
    (folder / "upload").mkdir(parents=True)
    return add_character(lay_out(files, folder / "upload"), name="toon", records=records, folder=folder / "characters")


def test_no_file_on_disk_has_a_name_that_came_with_an_upload(tmp_path, db):
    hostile = [("../../A.svg", SVG), ("C:\\windows\\B.svg", SVG), *LETTERS[2:]]
    add_from(tmp_path, [("x/../../../evil.zip", packed([("__MACOSX/._A.svg", b"x"), (".hidden.svg", b"x"), *hostile]))], db.records)
    written = sorted(str(file.relative_to(tmp_path)) for file in tmp_path.rglob("*") if file.is_file())
    ours = {"names.json", *(f"{k}.svg" for k in range(9))}
    assert {name.rpartition("/")[2] for name in written} == ours
    assert {name.split("/")[0] for name in written} == {"upload", "characters"}


def test_a_mesh_is_called_mesh(tmp_path):
    assert lay_out([("../x.VRM", b"glTF")], tmp_path) == tmp_path / "mesh.vrm"


@pytest.mark.parametrize(
    ("files", "why"),
    [
        ([], "choose a .glb"),
        ([("a.exe", b"MZ")], "here is 1 × .exe"),
        ([("a.glb", b""), ("b.glb", b"")], "give one .glb"),
        ([("a.glb", b""), *LETTERS], "give one .glb"),
        ([("A.svg", SVG), ("x/A.png", b"")], "two pictures of the shape 'A'"),
        ([("a b.svg", SVG)], "name pictures after their shapes"),
        ([("a.zip", b"PK nonsense")], "can't be unpacked"),
        ([("a.zip", packed(LETTERS)[:-40])], "can't be unpacked"),
        ([("a.zip", packed([("inner.zip", packed(LETTERS))]))], "here is 1 × .zip"),
        ([("a.zip", packed([(f"{k}.txt", b"") for k in range(500)]))], "500 entries"),
        ([("a.zip", packed([("A.svg", b" " * 100_000_000)]))], "unpacks to more than 64 MB"),
        ([("a.zip", packed([("A.svg", b" " * 20_000_000)]))], "a picture in the ZIP file is larger"),
        ([("a.glb", b" " * 64_000_001)], "more than 64 MB together"),
    ],
)
def test_what_can_not_be_a_face_is_refused_in_a_line(tmp_path, files, why):
    with pytest.raises(InputError, match=why) as refused:
        lay_out(files, tmp_path)
    assert "\n" not in str(refused.value)


def test_a_damaged_entry_is_refused(tmp_path):
    whole = bytearray(packed([("A.svg", SVG * 50)]))
    whole[60:70] = b"\xff" * 10
    with pytest.raises(InputError, match=r"damaged|can't be unpacked"):
        lay_out([("a.zip", bytes(whole))], tmp_path)


@pytest.mark.parametrize(
    ("name", "content", "why"),
    [
        ("A.png", png(60_000, 60_000), "wider or higher than 4096 pixels"),
        ("A.png", png(5000, 10), "wider or higher than 4096 pixels"),
        ("A.png", b"no picture", "not a PNG picture"),
        ("A.svg", SVG.replace(b"<path", b"<script>alert(1)</script><path"), "element script"),
        ("mesh.glb", b"glTF nonsense", "mesh.glb"),
    ],
)
def test_what_is_no_picture_or_mesh_is_refused_and_leaves_nothing(tmp_path, db, name, content, why):
    with pytest.raises(LipdbError, match=why) as refused:
        add_from(tmp_path, [(name, content)], db.records)
    assert isinstance(refused.value, MeshError)
    assert not [file for file in (tmp_path / "characters").rglob("*") if file.is_file()]
