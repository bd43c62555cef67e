"""Whatever way a text is kept, it is the same corpus; parts depend on nothing but their place."""

from __future__ import annotations

import bz2
import gzip
import io
import os
import threading
from pathlib import Path

import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from coverage_cases import LetterCounter, pairs_in, pairs_of, text, write
from hypothesis import given
from hypothesis import strategies as st

from lipdb.coverage import cut as cutting
from lipdb.coverage.archive import Archive
from lipdb.coverage.corpus import Source, parts, sources
from lipdb.coverage.counts import Counts
from lipdb.coverage.cut import Piece, cut, digests, read_piece
from lipdb.coverage.executors import Workers
from lipdb.coverage.scan import Counted, count_corpus
from lipdb.errors import InputError

TEXT = text(300)
LINES = st.text("ab\n", max_size=80).map(str.encode)
TEXTGRID = """File type = "ooTextFile"
Object class = "TextGrid"
0
1
<exists>
1
"IntervalTier"
"phones"
0
1
3
0
0.4
"b"
0.4
0.6
"aa"
0.6
1
""
"""


def count(*paths: Path | str, size: int = 1000, archive: Path) -> tuple[Counted, Counts]:
    with Workers(2, threads=True) as workers:
        counted = count_corpus([str(path) for path in paths], LetterCounter(size), workers, Archive(archive))
    return counted, Counts.sum(
        counts.named(place.document) if place.document else counts
        for place in counted.places
        for counts in [Archive(archive).read(place.key)]
    )


def kept_as(kind: str, file: Path) -> Path:
    raw = TEXT.encode()
    if kind == "parquet":
        pq.write_table(pa.table({"text": TEXT.splitlines()}), file, row_group_size=70)
    else:
        packed = {
            "plain": raw,
            "gzip": gzip.compress(raw[:2000]) + gzip.compress(raw[2000:]),
            "zstd": pa.compress(raw, "zstd", asbytes=True),
            "bz2": bz2.compress(raw),
            "utf-16": TEXT.encode("utf-16"),
            "bom": TEXT.encode("utf-8-sig"),
            "crlf": raw.replace(b"\n", b"\r\n"),
        }
        file.write_bytes(packed[kind])
    return file


@pytest.mark.parametrize("kind", ["plain", "gzip", "zstd", "bz2", "utf-16", "bom", "crlf", "parquet"])
def test_a_text_is_the_same_however_it_is_kept(tmp_path: Path, kind: str) -> None:
    _, counts = count(kept_as(kind, tmp_path / "text"), archive=tmp_path / "archive")
    assert pairs_of(counts) == pairs_in(TEXT)
    assert counts.documents.to_pylist() == [{"document": str(tmp_path / "text"), "lines": 300, "spoken": 300}]


def test_standard_input_is_a_document_called_by_its_sign(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = write(tmp_path, text=TEXT) / "text"
    with file.open() as stdin:
        monkeypatch.setattr("sys.stdin", stdin)
        _, counts = count("-", archive=tmp_path / "archive")
    assert pairs_of(counts) == pairs_in(TEXT)
    assert counts.documents["document"].to_pylist() == ["-"]


def test_a_pipe_is_read_as_it_comes(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    writer = threading.Thread(target=(tmp_path / "pipe").write_text, args=(TEXT,))
    writer.start()
    _, counts = count(tmp_path / "pipe", archive=tmp_path / "archive")
    writer.join()
    assert pairs_of(counts) == pairs_in(TEXT)


def test_a_document_is_a_file_in_a_folder_and_below(tmp_path: Path) -> None:
    write(write(tmp_path / "a", one__txt="bob\n") / "deep", two__txt="go\n", __hidden="see\n")
    _, counts = count(tmp_path / "a", archive=tmp_path / "archive")
    assert counts.documents["document"].to_pylist() == [f"{tmp_path}/a/deep/two.txt", f"{tmp_path}/a/one.txt"]


def test_a_document_is_a_row_of_parquet_and_its_lines_are_lines(tmp_path: Path) -> None:
    rows = {"document": ["b", "a", "b", None], "text": ["go\nsee", "bob", "go", None]}
    pq.write_table(pa.table(rows), tmp_path / "rows.parquet", row_group_size=2)
    _, counts = count(tmp_path / "rows.parquet", archive=tmp_path / "archive")
    assert counts.documents.to_pylist() == [
        {"document": "", "lines": 0, "spoken": 0},
        {"document": "a", "lines": 1, "spoken": 1},
        {"document": "b", "lines": 3, "spoken": 3},
    ]
    assert pairs_of(counts) == pairs_in("go\nsee\nbob\ngo")


def test_in_a_folder_with_alignments_the_texts_beside_them_are_not_counted_twice(tmp_path: Path) -> None:
    write(tmp_path / "a", one__TextGrid=TEXTGRID, one__txt="bob\n")
    counted, counts = count(tmp_path / "a", archive=tmp_path / "archive")
    assert [place.aligned for place in counted.places] == [True]
    assert pairs_of(counts) == {("_", "b"): 1, ("b", "aa"): 1, ("aa", "_"): 1}


def test_a_link_that_leads_back_is_followed_once(tmp_path: Path) -> None:
    folder = write(tmp_path / "a", one__txt="bob\n")
    (folder / "again").symlink_to(folder)
    (folder / "gone").symlink_to(folder / "nothing")
    counted, counts = count(folder, archive=tmp_path / "archive")
    assert pairs_of(counts) == pairs_in("bob")
    assert counted.apart.findings["reason"].to_pylist() == ["not readable"]


def test_names_that_are_no_text_or_no_single_line_are_documents_too(tmp_path: Path) -> None:
    for name in (b"a\xff.txt", b"b\nc.txt", b" d .txt", "ä€.txt".encode()):
        Path(os.fsdecode(bytes(tmp_path) + b"/" + name)).write_text("bob\n")
    _, counts = count(tmp_path, archive=tmp_path.parent / "archive of names")
    assert [name.removeprefix(f"{tmp_path}/") for name in counts.documents["document"].to_pylist()] == [
        " d .txt", "a\\udcff.txt", "b\nc.txt", "ä€.txt",
    ]  # fmt: skip


def test_a_path_that_is_not_there_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="there is no such file or folder"):
        count(tmp_path / "nothing", archive=tmp_path)


@given(raw=LINES, size=st.integers(1, 20), step=st.integers(1, 20))
def test_parts_have_every_line_once_and_streams_are_cut_as_files_are(raw: bytes, size: int, step: int) -> None:
    file = io.BytesIO(raw)
    pieces = [piece for start in range(0, len(raw), size) if (piece := read_piece(file, start, size)).raw]
    assert b"".join(piece.raw for piece in pieces) == raw
    assert [piece.at for piece in pieces] == [sum(len(p.raw) for p in pieces[:k]) for k in range(len(pieces))]
    assert list(cut((raw[k : k + step] for k in range(0, len(raw), step)), size)) == pieces


@given(raw=LINES, more=LINES, size=st.integers(1, 20))
def test_parts_that_ended_stay_as_they_are_when_a_file_grows(raw: bytes, more: bytes, size: int) -> None:
    before, after = [list(cut((text,), size)) for text in (raw, raw + more)]
    whole = [piece for piece in before if piece.at + len(piece.raw) < len(raw)]
    assert after[: len(whole)] == whole


@given(raw=LINES, factor=st.integers(1, 5))
def test_a_corpus_has_one_digest_however_large_its_parts_are(raw: bytes, factor: int) -> None:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(cutting, "BLOCK", 4)
        small, large = ([d for piece in cut((raw,), 4 * k) for d in digests(piece)] for k in (1, factor))
    assert small == large


@given(lines=st.lists(st.integers(0, 40), max_size=20), step=st.integers(1, 8), size=st.sampled_from([16, 32]))
def test_a_line_that_is_too_long_is_kept_only_so_far_that_this_can_be_told(lines: list[int], step: int, size: int) -> None:
    raw = b"".join(b"x" * length + b"\n" for length in lines)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(cutting, "LONGEST_LINE", 8)
        patch.setattr(cutting, "_OVERLONG", cutting.overlong(8))
        patch.setattr(cutting, "STEP", step)
        file = io.BytesIO(raw)
        pieces = [read_piece(file, start, size) for start in range(0, len(raw), size)]
        streamed = list(cut((raw[k : k + step] for k in range(0, len(raw), step)), size))
    for found in (pieces, streamed):
        kept = [len(line) for piece in found for line in piece.raw.splitlines()]
        assert kept == [min(length, 9) for length in lines]


def test_a_part_falls_into_halves_that_have_the_same_lines(tmp_path: Path) -> None:
    folder = write(tmp_path, text=TEXT * 20, packed=gzip.compress(TEXT.encode() * 20))
    for path in sorted(folder.iterdir()):
        [source] = [one for one in sources([str(path)]) if isinstance(one, Source)]
        found = list(parts(source, 1 << 18))
        assert found
        for part in found:
            halves = part.halves()
            assert len(halves) == 2
            both, whole = ([p.read().counted(LetterCounter()) for p in some] for some in (halves, [part]))
            assert Counts.sum(both) == Counts.sum(whole)


def test_a_piece_knows_where_it_starts() -> None:
    assert list(cut((b"ab\ncd\n",), 3)) == [Piece(0, b"ab\n"), Piece(3, b"cd\n")]
