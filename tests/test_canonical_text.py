"""Canonical text and the store are two forms of the same records."""

import re
from datetime import datetime
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from store_cases import TEXT

from lipdb.curated.folder import read_folder, write_folder
from lipdb.curated.schema import TABLES, Column, table_of
from lipdb.curated.tsv import canonical_row, key_of
from lipdb.curves.keys import format_keys
from lipdb.paths import data_dir
from lipdb.store import Store

words = st.text(st.characters(codec="utf-8", exclude_categories=["Z", "C"]), min_size=1, max_size=6)
sentences = st.text(st.characters(codec="utf-8"), max_size=20)
numbers = st.floats(-1e6, 1e6).map(str)
keys = st.lists(st.tuples(st.floats(0, 1), st.floats(0, 1)), max_size=4).map(lambda pairs: format_keys(sorted(pairs)))
times = st.datetimes(datetime(1970, 1, 1)).map(lambda time: time.strftime("%Y-%m-%dT%H:%M:%SZ"))

# A column is of the first kind whose example it takes.
KINDS = {
    "two words": sentences,
    "wörd": words,
    "0:0 1:1": keys,
    "-0.5": numbers,
    "0.5": st.floats(0, 1e6).map(str),
    "7": st.integers(0, 999).map(str),
    "2026-11-22T00:00:00Z": times,
    "mesh.glb": st.sampled_from(["built:robin", "mesh.glb", "pictures"]),
}


def takes(column: Column, cell: str) -> bool:
    try:
        column.canonical(cell)
    except ValueError:
        return False
    return True


def choices(column: Column) -> list[str]:
    """The words that a column of few words takes, as its error says them."""
    with pytest.raises(ValueError, match="is none of") as caught:
        column.canonical("?")
    return str(caught.value).split("is none of ")[1].split(", ")


def cells(column: Column) -> st.SearchStrategy[str]:
    kind = next((strategy for example, strategy in KINDS.items() if takes(column, example)), None)
    cell = kind if kind is not None else st.sampled_from(choices(column))
    return st.just("") | cell if column.optional else cell.filter(str.strip)


def rows(path: str) -> st.SearchStrategy[list[dict[str, str]]]:
    table = table_of(path)
    return st.lists(st.fixed_dictionaries({column.name: cells(column) for column in table.columns}), min_size=1, max_size=4)


PATHS = sorted(
    re.sub(r"\{(?!language)\w+\}", name, table.pattern).replace("{language}", language)
    for table in TABLES
    for language, name in (("en", "facefx"), ("cmn", "crab_2"))
)


@st.composite
def records(draw):
    result = {}
    for path in draw(st.sets(st.sampled_from(PATHS), min_size=1, max_size=4)):
        table = table_of(path)
        clean = [canonical_row(table, row) for row in draw(rows(path))]
        result[path] = {key_of(table, row): row for row in clean}
    return result


def files(folder: Path) -> dict[str, bytes]:
    return {file.relative_to(folder).as_posix(): file.read_bytes() for file in folder.rglob("*") if file.is_file()}


@pytest.fixture(scope="module")
def store(tmp_path_factory):
    store = Store.open(tmp_path_factory.mktemp("text") / "a.db", TEXT)
    yield store
    store.close()


@settings(max_examples=40)
@given(made=records())
def test_dumping_what_was_loaded_from_canonical_text_gives_the_same_bytes(store, made):
    with TemporaryDirectory() as folder:
        text, dumped, again = (Path(folder) / name for name in ("text", "dumped", "again"))
        write_folder(made, text)
        store.load(text, author="anna")
        assert store.records() == made
        store.dump(dumped)
        assert files(dumped) == files(text)
        store.load(dumped, author="anna")
        store.dump(again)
        assert files(again) == files(dumped)


def test_the_shipped_text_is_canonical(tmp_path):
    shipped = data_dir("phonesets")
    write_folder(read_folder(shipped), tmp_path)
    assert {path: text for path, text in files(shipped).items() if path.endswith(".tsv")} == files(tmp_path)


def test_a_new_store_dumps_the_shipped_text_byte_for_byte(tmp_path):
    shipped = data_dir("phonesets")
    store = Store.open(tmp_path / "a.db", shipped)
    store.dump(tmp_path / "dump")
    store.close()
    assert {path: text for path, text in files(shipped).items() if path.endswith(".tsv")} == files(tmp_path / "dump")


def test_a_dump_removes_tables_that_the_store_no_longer_has(store, tmp_path):
    store.load(TEXT, author="anna")
    store.dump(tmp_path)
    (tmp_path / "README.md").write_text("not a table")
    with store.edit(author="anna") as edit:
        edit.delete("constraints/facefx.tsv", ("open", "PBM"))
    store.dump(tmp_path)
    assert set(files(tmp_path)) == {"README.md", *files(TEXT)} - {"constraints/facefx.tsv"}


def test_one_edited_curve_is_one_changed_line(store, tmp_path):
    store.load(TEXT, author="anna")
    with store.edit(author="anna") as edit:
        edit.put("curves/facefx.tsv", {"left": "aa", "right": "bmp", "pose": "PBM", "keys": "0:0 1:1", "warp": "border"})
    store.dump(tmp_path)
    old, new = (file.read_text().splitlines() for file in (TEXT / "curves/facefx.tsv", tmp_path / "curves/facefx.tsv"))
    assert [line.split("\t")[:3] for line, other in zip(new, old, strict=True) if line != other] == [["aa", "bmp", "PBM"]]
