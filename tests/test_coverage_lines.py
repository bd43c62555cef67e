"""Lines: what is given to the voice, and what is left out before."""

from __future__ import annotations

import pyarrow as pa
import pytest

from lipdb.coverage.findings import LONGEST_LINE, REASONS
from lipdb.coverage.lines import lines_of, rows_of, shown


def texts(raw: bytes) -> list[str]:
    return lines_of(raw).lines.texts.to_pylist()


@pytest.mark.parametrize(
    ("raw", "expected"),
    [
        (b"", []),
        (b"\n", []),
        (b"a", ["a"]),
        (b"a\nb\n", ["a", "b"]),
        (b"a\r\n\r\n b \t\n", ["a", "b"]),
        ("ä\n\u00a0\nö".encode(), ["ä", "ö"]),
        (b"\x00\n", ["\x00"]),
    ],
)
def test_lines_come_without_their_ends_and_blank_ones_do_not_count(raw: bytes, expected: list[str]) -> None:
    assert texts(raw) == expected
    assert lines_of(raw).left_out.documents.num_rows == 0


def test_lines_that_are_no_utf8_are_left_out_and_counted_with_the_first_as_example() -> None:
    read = lines_of(b"good\nb\xe4d\nworse \xff\xfe\nfine \xc3\xa4\n")
    assert read.lines.texts.to_pylist() == ["good", "fine ä"]
    assert read.left_out.findings.to_pylist() == [{"document": "", "reason": "not UTF-8", "count": 2, "example": "b�d"}]
    assert read.left_out.documents.to_pylist() == [{"document": "", "lines": 2, "spoken": 0}]


def test_lines_that_are_too_long_are_left_out() -> None:
    longest = b"x" * (LONGEST_LINE - 1)
    read = lines_of(longest + b"\n" + longest + b"y\nz\n" + longest + b"yy")
    assert [len(line) for line in read.lines.texts.to_pylist()] == [LONGEST_LINE - 1, 1]
    assert read.left_out.findings["reason"].to_pylist() == ["too long"]
    assert read.left_out.documents["lines"].to_pylist() == [2]


def test_rows_are_cut_into_lines_and_grouped_by_document() -> None:
    rows = {"document": ["b", "a", "b", None, "a"], "text": ["1\n2", "3", None, "4", "5\n"]}
    lines = rows_of(pa.RecordBatch.from_pydict(rows), None).lines
    said = [(lines.names[k], text) for k, text in zip(lines.document, lines.texts.to_pylist(), strict=True)]
    assert said == [("b", "1"), ("b", "2"), ("a", "3"), ("a", "5"), ("", "4")]


def test_rows_of_a_file_without_documents_are_all_of_the_file() -> None:
    lines = rows_of(pa.RecordBatch.from_pydict({"text": ["1", "2\n3"]}), "").lines
    assert (lines.names, lines.document.tolist(), lines.texts.to_pylist()) == (("",), [0, 0, 0], ["1", "2", "3"])


def test_an_example_is_short_and_obeys_no_terminal() -> None:
    assert shown("a\x1b[31mb\u202ec") == "a�[31mb�c"
    assert shown("x" * 100) == "x" * 59 + "…"


def test_every_reason_is_a_sentence_for_a_person() -> None:
    assert all(reason.meaning and reason.unit and not reason.meaning.endswith(".") for reason in REASONS.values())
