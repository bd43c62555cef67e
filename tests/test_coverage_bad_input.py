"""Bad input: counted in a report of what was left out and why; it stops nothing, and nothing hangs."""

from __future__ import annotations

import gzip
import os
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from coverage_cases import write
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import lipdb
from lipdb.coverage.archive import Archive
from lipdb.coverage.corpus import parts, sources
from lipdb.coverage.counts import Counts, Lines
from lipdb.coverage.exact import ExactCounter
from lipdb.coverage.executors import Workers
from lipdb.coverage.findings import REASONS
from lipdb.coverage.register import scan
from lipdb.coverage.scan import count_corpus
from lipdb.coverage.speaker import LONGEST_PIECE

GOOD = "Bob sees the moon.\nGo!\n"
PACKED = gzip.compress(os.urandom(3000).hex().encode())


def rows(path: Path, **columns: list[object]) -> Path:
    pq.write_table(pa.table(columns), path)
    return path


def folder_of_everything(folder: Path) -> Path:
    """Two good lines, and one file of each kind of trouble."""
    write(
        folder,
        good__txt=GOOD,
        another_script__txt="Привет, мир\n你好\n",
        mixed__txt="Bob said привет\nBob said hello\n",
        emoji__txt="Hello 😀\n🎉🎉\n",
        controls__txt="Hel\x07lo\n\x1b[31mred\x1b[0m\n",
        latin1__txt="caf\u00e9\nfine\n".encode("latin-1"),
        utf16__txt="Hello moon\n".encode("utf-16"),
        bom__txt="Hello moon\n".encode("utf-8-sig"),
        truncated__gz=PACKED[: len(PACKED) // 2],
        binary__bin=bytes(range(256)) * 20,
        empty__txt="",
        blank__txt="\n \n\t\n",
        numbers__txt="5 % of 1,234.50 €\n",
        notes__TextGrid="no TextGrid",
    )
    damaged = rows(folder / "damaged.parquet", text=["Hello moon"] * 1000, document=["d"] * 1000)
    raw = damaged.read_bytes()
    damaged.write_bytes(raw[:200] + os.urandom(len(raw) - 200))
    torn = rows(folder / "torn.parquet", text=[f"Hello {k}" for k in range(1000)])
    raw = torn.read_bytes()
    torn.write_bytes(raw[:100] + bytes(2000) + raw[2100:])
    rows(folder / "other.parquet", body=["Hello moon"], number=[1])
    (folder / "gone").symlink_to(folder / "nothing")
    os.mkfifo(folder / "waiting")
    return folder


@pytest.mark.parametrize(
    "text",
    [
        pa.array(["Hello moon", "Bob\nsees"]).dictionary_encode(),
        pa.array([b"Hello moon", b"Bob\nsees"]),
        pa.array(["Hello moon", "Bob\nsees"], pa.large_string()),
        pa.array(["Hello moon", "Bob\nsees"], pa.string_view()),
    ],
    ids=lambda text: str(text.type.id),
)
def test_strings_are_text_however_parquet_keeps_them(db: lipdb.Database, tmp_path: Path, text: pa.Array) -> None:
    file = rows(tmp_path / "a.parquet", text=text)
    done = scan(db, [str(file)], language="en", scheduler="threads", folder=tmp_path / "parts", output=tmp_path / "r.parquet")
    assert (done.told["spoken"], done.told["findings"]) == (3, [])


@pytest.mark.parametrize(
    ("columns", "says"),
    [
        ({"text": [1, 2]}, "its column text is int64, not strings"),
        ({"text": ["Hello"], "document": [[1]]}, "its column document is list<element: int64>, not names"),
        ({"body": ["Hello"]}, "it has no column text of strings, but body"),
    ],
)
def test_a_parquet_file_whose_columns_are_no_text_says_which(tmp_path: Path, columns: dict[str, list[object]], says: str) -> None:
    assert reported(rows(tmp_path / "a.parquet", **columns)) == [("not text", says)]


def test_a_parquet_file_with_two_columns_of_one_name_is_reported(tmp_path: Path) -> None:
    pq.write_table(pa.Table.from_arrays([pa.array(["Hi"])] * 2, names=["text", "text"]), tmp_path / "a.parquet")
    assert reported(tmp_path / "a.parquet") == [("not text", "it has more than one column text")]


def reported(path: Path) -> list[tuple[str, str]]:
    """The reasons and the examples of what the reader leaves out of the file *path*."""
    found = [part for source in sources([str(path)]) for part in ([source] if isinstance(source, Counts) else parts(source, 1 << 20))]
    return [(row["reason"], row["example"]) for counts in found if isinstance(counts, Counts) for row in counts.findings.to_pylist()]


def test_each_trouble_is_reported_and_the_rest_is_counted(db: lipdb.Database, tmp_path: Path) -> None:
    folder = folder_of_everything(tmp_path / "all")
    (folder / "notes.TextGrid").rename(tmp_path / "notes.TextGrid")
    done = scan(db, [str(folder)], language="en", scheduler="threads", folder=tmp_path / "parts", output=tmp_path / "r.parquet")
    found = {(Path(row["document"]).name, row["reason"]): row["count"] for row in done.told["findings_by_document"]}
    assert found == {
        ("another_script.txt", "other script"): 2,
        ("mixed.txt", "other script"): 1,
        ("emoji.txt", "emoji"): 1,
        ("emoji.txt", "no words"): 1,
        ("controls.txt", "control characters"): 1,
        ("latin1.txt", "not UTF-8"): 1,
        ("truncated.gz", "cut off"): 1,
        ("binary.bin", "not text"): 1,
        ("empty.txt", "no lines"): 1,
        ("numbers.txt", "numbers"): 1,
        ("numbers.txt", "symbols"): 1,
        ("damaged.parquet", "not readable"): 1,
        ("torn.parquet", "cut off"): 1,
        ("other.parquet", "not text"): 1,
        ("gone", "not readable"): 1,
        ("waiting", "not readable"): 1,
    }
    spoken = pq.read_table(done.scan.path).group_by("document").aggregate([("count", "sum")])["document"].to_pylist()
    assert {Path(name).name for name in spoken} == {
        "good.txt", "mixed.txt", "emoji.txt", "controls.txt", "latin1.txt", "utf16.txt", "bom.txt", "numbers.txt",
    }  # fmt: skip
    assert all(row["meaning"] == REASONS[row["reason"]].meaning for row in done.told["findings"])


def test_a_file_that_is_no_alignment_is_reported(db: lipdb.Database, tmp_path: Path) -> None:
    write(tmp_path / "a", notes__TextGrid="no TextGrid")
    done = scan(db, [str(tmp_path / "a")], language="en", scheduler="threads", folder=tmp_path / "parts", output=tmp_path / "r.parquet")
    [finding] = done.told["findings_by_document"]
    assert (Path(finding["document"]).name, finding["reason"]) == ("notes.TextGrid", "not readable")


def test_what_stands_before_the_end_of_a_truncated_file_is_counted(db: lipdb.Database, tmp_path: Path) -> None:
    text = "".join(f"{'Bob' * 3} {os.urandom(20).hex()} go\n" for _ in range(20_000)).replace("0", "o")
    packed = gzip.compress(text.encode(), 1)
    write(tmp_path / "a", story__gz=packed[: len(packed) * 9 // 10])
    counted, lines = counts(db, tmp_path)
    assert counted["reason"].to_pylist().count("cut off") == 1
    assert 12_000 < lines < 19_000


def counts(db: lipdb.Database, folder: Path) -> tuple[pa.Table, int]:
    """The findings in the folder ``a`` below *folder*, and how many lines were counted."""
    from coverage_cases import ByteCounter

    archive = Archive(folder / "archive")
    with Workers(1, threads=True) as crew:
        counted = count_corpus([str(folder / "a")], ByteCounter(), crew, archive)
    total = Counts.sum([counted.apart, *(archive.read(place.key) for place in counted.places)])
    return total.findings, sum(total.documents["spoken"].to_pylist())


def test_a_line_of_a_hundred_megabytes_is_left_out_and_its_neighbours_are_not(db: lipdb.Database, tmp_path: Path) -> None:
    write(tmp_path / "a", long__txt=GOOD.encode() + b"x" * 100_000_000 + b"\n" + GOOD.encode())
    findings, lines = counts(db, tmp_path)
    assert findings["reason"].to_pylist() == ["too long"]
    assert lines == 4


@pytest.mark.skipif(not os.geteuid(), reason="a superuser may read everything")
def test_what_may_not_be_read_is_reported(db: lipdb.Database, tmp_path: Path) -> None:
    folder = write(tmp_path / "a", good__txt=GOOD, secret__txt=GOOD)
    (folder / "closed").mkdir(mode=0)
    (folder / "secret.txt").chmod(0)
    findings, lines = counts(db, tmp_path)
    assert findings["reason"].to_pylist() == ["not readable"] * 2
    assert lines == 2


def test_a_file_that_vanishes_between_two_looks_is_reported(db: lipdb.Database, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = write(tmp_path / "a", good__txt=GOOD, vanishing__txt=GOOD)

    def found(paths: list[str]) -> object:
        listed = list(sources(paths))
        (folder / "vanishing.txt").unlink()
        return listed

    monkeypatch.setattr("lipdb.coverage.scan.sources", found)
    findings, lines = counts(db, tmp_path)
    assert findings["reason"].to_pylist() == ["cut off"]
    assert "No such file" in findings["example"].to_pylist()[0]
    assert lines == 2


def test_a_name_that_is_no_text_is_shown_as_its_bytes(db: lipdb.Database, tmp_path: Path) -> None:
    file = tmp_path / "bad\udcffname.txt"
    try:
        file.write_text(GOOD)
    except OSError:
        pytest.skip("the file system takes no such names")
    done = scan(db, [str(file)], language="en", scheduler="threads", folder=tmp_path / "parts", output=tmp_path / "r.parquet")
    assert done.scan.corpus == (f"{tmp_path.as_posix()}/bad\\udcffname.txt",)
    assert done.scan.totals["lines"] == 2


def test_a_file_that_is_cut_while_it_is_counted_is_reported(db: lipdb.Database, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write(tmp_path / "a", story__txt=GOOD * 20_000, good__txt=GOOD)
    whole = list(sources([str(tmp_path / "a")]))
    write(tmp_path / "a", story__txt=GOOD)
    monkeypatch.setattr("lipdb.coverage.scan.sources", lambda paths: iter(whole))
    counted, lines = counts(db, tmp_path)
    assert {row["reason"] for row in counted.to_pylist()} == {"cut off"}
    assert {row["example"] for row in counted.to_pylist()} == {"it became shorter while it was read"}
    assert lines == 2


def test_a_long_line_is_read_in_pieces_that_end_with_sentences(db: lipdb.Database) -> None:
    counter = ExactCounter(db.voice("en").raw())
    sentence = "Bob sees the moon, and the moon sees Bob. "
    whole = counter.count(lines_of(sentence * 200))
    assert len(sentence * 200) > 2 * LONGEST_PIECE
    assert whole.pairs.equals(counter.count(lines_of(*[sentence] * 200)).pairs)
    assert whole.findings.num_rows == 0
    assert counter.count(lines_of("moon " * 2000)).findings["reason"].to_pylist() == ["long line"]


def lines_of(*texts: str) -> Lines:
    return Lines(pa.array(texts, pa.string()), np.zeros(len(texts), np.int32), ("",))


TROUBLE = st.text(
    st.one_of(
        st.sampled_from(list("abc  .,;!?'\"-_()[]{}<>&%$€0123456789\t\x00\x07\x1b\u200b\u202e\ufeff😀é中文かなприветαβم")),
        st.characters(exclude_categories=["Cs"]),
    ),
    max_size=80,
)


@pytest.mark.parametrize("language", ["en", "cmn", "de"])
@settings(max_examples=150, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(texts=st.lists(TROUBLE, min_size=1, max_size=4))
def test_no_text_stops_a_scan_or_gets_lost(db: lipdb.Database, language: str, texts: list[str]) -> None:
    counts = ExactCounter(db.voice(language).raw()).count(lines_of(*texts))
    [told] = counts.documents.to_pylist()
    left_out = sum(row["count"] for row in counts.findings.to_pylist() if REASONS[row["reason"]].left_out)
    assert told["lines"] == len(texts)
    assert told["spoken"] + left_out == len(texts)
    assert "voice failed" not in counts.findings["reason"].to_pylist()
    assert (len(counts.pairs) > 0) == (told["spoken"] > 0)
