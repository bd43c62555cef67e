"""The page Characters without a browser: every section draws, what is uploaded is checked, overrides are reset."""

from __future__ import annotations

import json
import shutil

import pytest
from glb_cases import Builder
from page_cases import behind_pages, page
from test_characters_uploaded import SVG, packed

from lipdb.characters.overrides import overrides

CURVE = {"left": "l", "right": "ow", "pose": "W", "keys": "0:0 0.5:1 1:0", "warp": "border"}
ARKIT = ("jawOpen", "mouthPuckr", "mouthFunnel", "mouthRollLower", "mouthSmile", "mouthPress")
LETTERS = [(f"{letter}.svg", SVG) for letter in "ABCDEFGHX"]


@pytest.fixture
def db(as_shipped, tmp_path, monkeypatch):
    with behind_pages(shutil.copy(as_shipped, tmp_path), monkeypatch) as db:
        yield db


def section(name, **session):
    shown = page("characters", characters_section=name, **session)
    assert not shown.exception
    return shown


def words(shown) -> str:
    assert not shown.exception
    return " | ".join(one.value for kind in ("error", "warning", "success", "info", "caption") for one in shown.get(kind))


def stages(shown):
    return [json.loads(one.proto.json) for one in shown.get("bidi_component") if one.proto.component_name.endswith("stage")]


def test_links_are_shown_with_a_face_that_does_one_pose(db) -> None:
    shown = section("Links")
    table = shown.dataframe[0].value
    assert table["pose"].tolist() == list(db.pose_set("facefx").poses)
    assert set(table["gain"]) == {1.0}
    for face in stages(shown):
        assert face["autoplay"]
        assert face["loop"] == [0.0, 2.0]
    assert "Double-click a cell" in words(shown)
    assert shown.button(key="characters_links_robin_save").disabled


def test_every_pose_is_drawn_at_full_weight(db) -> None:
    shown = section("Poses", characters_name="flat")
    assert len(shown.get("image")) == len(db.pose_set("facefx").poses)


def test_pictures_of_poses_are_kept_until_their_shapes_change_and_show_the_tongue_in_an_open_mouth(db, tmp_path, monkeypatch) -> None:
    monkeypatch.setenv("LIPDB_CACHE", str(tmp_path / "cache"))
    poses, inside = len(db.pose_set("facefx").poses), ("tBack", "tRoof", "tTeeth")

    def kept() -> set[str]:
        shown = section("Poses", characters_name="robin")
        captions = [image.proto.imgs[0].caption for image in shown.get("image")]
        assert len(captions) == poses
        assert tuple(one.split("**")[1] for one in captions if "with open at 0.6" in one) == inside
        return {file.name for file in (tmp_path / "cache" / "gallery").iterdir()}

    first = kept()
    assert len(first) == poses + 1 + len(inside)  # and the face at rest, and the tongue behind closed lips
    with db.edit(author="bob") as edit:
        edit.put("characters/robin/links.tsv", {"pose": "W", "shape": "W", "gain": "0.5", "combine": "sum", "source": "user"})
    assert len(kept() - first) == 1
    (tmp_path / "cache").rename(tmp_path / "gone")
    (tmp_path / "cache").write_text("no folder")
    section("Poses", characters_name="flat")


def test_rules_say_whom_they_count_for(db) -> None:
    shown = section("Rules", characters_name="crab")
    assert "the pose set crab. They count in every language and every line for crab." in words(shown)
    assert len(shown.dataframe) == 3
    assert shown.button(key="characters_rules_crab_save").disabled


def test_overrides_stand_beside_what_is_inherited_and_all_are_reset_at_once(db) -> None:
    with db.edit(author="bob") as edit:
        edit.put("characters/robin/curves/facefx.tsv", CURVE)
        edit.put("characters/robin/mapping.tsv", {"language": "en", "phone": "p", "common": "f"})
    shown = section("Overrides")
    rows = shown.dataframe[0].value.to_dict("records")
    assert [(row["name"], row["own"], row["layer"]) for row in rows] == [
        ("l-ow W", "0:0 0.5:1 1:0", "common"),
        ("en p", "f", "language:en"),
    ]
    shown = shown.button(key="characters_reset_all").click().run()
    assert "Saved as revision 3." in words(shown)
    assert overrides(db.records, "robin", "en") == []
    newest = db.store.history(limit=1)[0]
    assert (newest.author, newest.note) == ("anna", "Reset everything of robin")


def uploaded(name, *files):
    shown = section("Add one")
    shown.text_input(key="characters_add_name").set_value(name)
    shown.file_uploader(key="characters_add_files").set_value([(file, content, "application/octet-stream") for file, content in files])
    return shown.button[0].click().run()


def test_a_mesh_is_added_and_doubtful_shapes_are_marked(db) -> None:
    shown = uploaded("bob", ("../../evil name.glb", Builder(ARKIT).glb()))
    assert "bob is here. Its shapes are named as those of arkit" in words(shown)
    marks = {row["shape"]: row[""] for row in shown.dataframe[0].value.to_dict("records")}
    assert marks["mouthPuckr"] == "⚠ doubtful"
    assert marks["(tongueOut)"] == "✗ not found"
    assert db.store.history(limit=1)[0].author == "anna"
    assert sorted(file.name for file in db.store.characters_folder.rglob("*") if file.is_file()) == ["mesh.glb"]
    links = section("Links", characters_name="bob")
    assert "2 links lead to shapes of a name that is only alike" in words(links)
    assert links.dataframe[0].value["doubtful"].sum() == 2


def test_a_zip_of_pictures_is_added(db) -> None:
    assert "toon is here. Its shapes are named as those of rhubarb (100%" in words(uploaded("toon", ("mouths.zip", packed(LETTERS))))
    assert db.character("toon").mesh is None


BAD = [
    ("bob", [("a.glb", b"glTF nonsense")], "a.glb: "),
    ("bob", [("a.glb", Builder(()).glb())], "a.glb: has no morph targets"),
    ("bob", [("a.glb", Builder(("nose", "ear")).glb())], "none of the known sets"),
    ("bob", [("a.zip", packed([("A.svg", b" " * 100_000_000)]))], "unpacks to more than 64 MB"),
    ("bob", [("A.svg", SVG.replace(b"<path", b"<script/><path"))], "A.svg: this SVG has an element script, which is more than a picture"),
    ("bob", [("a.glb", b"")], "is empty"),
    ("bob", [], "choose a .glb or .vrm file"),
    ("", [("a.glb", b"x")], "short name"),
    ("Bob!", [("a.glb", Builder(ARKIT).glb())], "small letters"),
    ("robin", [("a.glb", Builder(ARKIT).glb())], "already"),
]


def test_what_can_not_be_added_is_answered_in_a_line(db) -> None:
    for name, files, why in BAD:
        shown = uploaded(name, *files)
        assert not shown.exception
        (error,) = shown.error
        assert why in error.value
        assert "\n" not in error.value
        assert "/tmp" not in error.value
    assert db.store.revision == 1
    assert not list(db.store.characters_folder.glob("*"))


@pytest.fixture
def draft(db):
    """Anna has halved the gain of *open* on the page and not saved it; Bob has saved another one for *W* since."""
    shown = section("Links")
    held = shown.session_state["rows_held"]["characters_links_robin"]
    held.put("links", [{**row, "gain": 0.5} if row["pose"] == "open" else row for row in held.tables["links"]])
    with db.edit(author="bob") as edit:
        edit.put("characters/robin/links.tsv", {"pose": "W", "shape": "W", "gain": "0.7", "combine": "sum", "source": "user"})
    shown = shown.run()
    assert "1 row to save." in words(shown)
    return shown


def gains(db):
    return {key[0]: row["gain"] for key, row in db.records.get("characters/robin/links.tsv", {}).items()}


def test_a_draft_saves_what_its_visitor_changed_and_nothing_that_others_did(db, draft) -> None:
    draft = draft.button(key="characters_links_robin_save").click().run()
    assert "Saved as revision 3." in words(draft)
    assert gains(db) == {"open": "0.5", "W": "0.7"}
    assert dict(zip(*(draft.dataframe[0].value[column] for column in ("pose", "gain")), strict=True))["W"] == 0.7
    draft = draft.button(key="characters_links_robin_undo").click().run()
    assert "Revision 4 takes revision 3 back." in words(draft)
    assert gains(db) == {"W": "0.7"}


def test_who_gives_no_name_reads_why_nothing_is_saved_and_keeps_draft_and_face(db, draft) -> None:
    faces = len(stages(draft))
    draft.session_state["visitor"] = ""
    draft = draft.button(key="characters_links_robin_save").click().run()
    assert "who are you? Give your name" in words(draft)
    assert "1 row to save." in words(draft)
    assert len(stages(draft)) == faces
    assert gains(db) == {"W": "0.7"}


def test_a_draft_waits_in_other_sections_and_with_other_characters_until_it_is_discarded(db, draft) -> None:
    draft.session_state["characters_section"] = "Rules"
    draft = draft.run()
    assert "Not saved yet elsewhere: links of robin." in words(draft)
    draft.session_state["characters_section"] = "Links"
    draft = draft.selectbox(key="characters_name").set_value("crab").run()
    assert "0 row" not in words(draft)
    draft = draft.selectbox(key="characters_name").set_value("robin").run()
    assert "1 row to save." in words(draft)
    assert "1 row to save." not in words(section("Links", visitor="bob"))
    draft = draft.button(key="characters_links_robin_discard").click().run()
    assert "Double-click a cell" in words(draft)
    assert gains(db) == {"W": "0.7"}


def test_the_links_of_a_pose_are_drawn_and_what_the_browser_draws_goes_into_the_table(db) -> None:
    shown = section("Links")
    [editor] = [json.loads(one.proto.json) for one in shown.get("bidi_component") if one.proto.component_name.endswith("keys")]
    [lane] = editor["lanes"]
    assert (lane["pose"], lane["keys"], lane["below"]) == ("open", None, [[0.0, 0.0], [1.0, 1.0]])
    drawn = {"open": [[0, 0], [0.5, 0.2], [1, 1]]}
    shown.session_state["characters_bends"] = {"curves": {"id": editor["id"], "taken": "", "curves": drawn}}
    shown = shown.run()
    assert shown.dataframe[0].value["curve"].tolist()[0] == "0:0 0.5:0.2 1:1"
    shown = shown.button(key="characters_links_robin_save").click().run()
    assert db.records["characters/robin/links.tsv"]["open", "open"]["curve"] == "0:0 0.5:0.2 1:1"
