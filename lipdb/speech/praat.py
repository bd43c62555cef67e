"""Praat's TextGrid files: long and short text in every encoding that Praat writes, and the binary form.

Praat's manual ("TextGrid file formats") defines the text: only free-standing numbers, texts in double quotes (a quote
within is doubled) and flags in angle brackets count, everything else is for people. So the long and the short form are
one, read by one pass. Nothing is taken on trust: each tier must have as many entries as it claims.
"""

from __future__ import annotations

import codecs
import re
import struct
from collections.abc import Iterator
from typing import NamedTuple, Protocol

from lipdb.errors import InputError

BINARY = b"ooBinaryFile"
_TOKEN = re.compile(r'"([^"]*(?:""[^"]*)*)"|("(?s:.*))|<(\w+)>|!.*|[^\s"!]+')
_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?%?|[+-]?nan|[+-]?inf(?:inity)?|--undefined--", re.IGNORECASE)
_MARKS = (
    (codecs.BOM_UTF8, "utf-8"),
    (codecs.BOM_UTF32_LE, "utf-32-le"),
    (codecs.BOM_UTF16_LE, "utf-16-le"),
    (codecs.BOM_UTF16_BE, "utf-16-be"),
)


class Interval(NamedTuple):
    """A stretch of a tier: seconds and its label."""

    start: float
    end: float
    label: str


class Tier(NamedTuple):
    """A tier: its name, and its intervals; None for a tier of points."""

    name: str
    intervals: tuple[Interval, ...] | None


class _Source(Protocol):
    """Values one after another, from text or binary; each raises `InputError` if there is none of its kind."""

    def number(self, what: str) -> float: ...

    def count(self, what: str) -> int: ...

    def text(self, what: str) -> str: ...

    def kind(self, what: str) -> str: ...

    def exists(self) -> bool: ...

    def at_end(self) -> bool: ...


def parse_textgrid(raw: bytes, *, name: str) -> list[Tier]:
    """The tiers of a TextGrid, in order. *name* stands in errors. Raises `InputError`."""
    if not raw.strip():
        raise InputError(f"{name}: the file is empty; export it again from Praat or the aligner")
    source: _Source
    if raw.startswith(BINARY):
        source = _Binary(raw, name)
    else:
        text = _decode(raw, name)
        if '"ooTextFile' not in text[:200]:
            raise InputError(f'{name}: not a Praat text file (no "ooTextFile" in its first line); give a TextGrid')
        source = _Text(text, name)
        source.kind("the file's type")
    kind = source.kind("the class of the object")
    if kind != "TextGrid":
        raise InputError(f"{name}: holds a Praat {kind[:40]!r}, not a TextGrid; save the TextGrid alone")
    return list(_tiers(source, name))


def _tiers(source: _Source, name: str) -> Iterator[Tier]:
    source.number("the start of the file")
    source.number("the end of the file")
    if not source.exists():
        return
    count = source.count("the number of tiers")
    for index in range(1, count + 1):
        kind = source.kind(f"the class of tier {index} of {count}")
        title = source.text(f"the name of tier {index} of {count}")
        if kind not in ("IntervalTier", "TextTier"):
            raise InputError(f"{name}: tier {index} is of the unknown class {kind[:40]!r}; Praat knows IntervalTier and TextTier")
        yield Tier(title, _entries(source, title, points=kind == "TextTier"))
    if not source.at_end():
        raise InputError(f"{name}: there is more in the file than the {count} tiers that it claims; export it again")


def _entries(source: _Source, title: str, *, points: bool) -> tuple[Interval, ...] | None:
    where = f"tier {title[:40]!r}"
    source.number(f"the start of {where}")
    source.number(f"the end of {where}")
    count = source.count(f"the size of {where}")
    intervals = []
    for index in range(1, count + 1):
        here = f"entry {index} of {count} in {where}"
        start = source.number(f"the time of {here}")
        end = start if points else source.number(f"the end of {here}")
        intervals.append(Interval(start, end, source.text(f"the label of {here}")))
    return None if points else tuple(intervals)


def _decode(raw: bytes, name: str) -> str:
    """Text by its byte order mark; without one UTF-16 by its zeros, UTF-8, or what Windows or the old Mac wrote."""
    encoding = next((code for mark, code in _MARKS if raw.startswith(mark)), "")
    if not encoding and raw[:2].count(0) == 1:
        encoding = "utf-16-be" if raw[0] == 0 else "utf-16-le"
    try:
        if encoding:
            return raw.decode(encoding).removeprefix("\ufeff")
        if b"\0" in raw:
            raise InputError(f"{name}: not a text file (it has zero bytes); give a TextGrid")
        return raw.decode("utf-8")
    except UnicodeDecodeError as error:
        if encoding:
            raise InputError(f"{name}: broken {encoding.upper()} text at byte {error.start}; export it again as UTF-8") from error
    old_mac = b"\r" in raw and b"\n" not in raw
    return raw.decode("mac-roman") if old_mac else raw.decode("cp1252", "replace")


class _Text:
    """The tokens of a text file."""

    def __init__(self, text: str, name: str) -> None:
        self.content = text
        self.name = name
        self.tokens = self._scan()

    def _scan(self) -> Iterator[tuple[str, str, int]]:
        """Kind, value and position of every token that counts."""
        for match in _TOKEN.finditer(self.content):
            if match[1] is not None:
                yield "text", match[1].replace('""', '"'), match.start()
            elif match[2] is not None:
                yield "a text without a closing quote", "", match.start()
            elif match[3] is not None:
                yield "flag", match[3], match.start()
            elif _NUMBER.fullmatch(match[0]):
                yield "number", match[0], match.start()

    def _next(self, kind: str, what: str) -> str:
        found, value, position = next(self.tokens, ("", "", -1))
        if found == kind:
            return value
        if not found:
            raise InputError(f"{self.name}: the file ends before {what}; it is cut off or claims more than it has, export it again")
        line = self.content.count("\n", 0, position) + 1
        shown = f"{found} {value[:40]!r}" if value else found
        raise InputError(f"{self.name}: line {line}: {shown} stands where {what} should be; the file is damaged, export it again")

    def number(self, what: str) -> float:
        value = self._next("number", what)
        if value == "--undefined--":
            return float("nan")
        return float(value.rstrip("%")) / (100 if value.endswith("%") else 1)

    def count(self, what: str) -> int:
        value = self.number(what)
        if not (0 <= value < 2**53 and value.is_integer()):
            raise InputError(f"{self.name}: {what} is {value:g}, which can't be; the file is damaged, export it again")
        return int(value)

    def text(self, what: str) -> str:
        return self._next("text", what)

    kind = text

    def exists(self) -> bool:
        return self._next("flag", "whether there are tiers") == "exists"

    def at_end(self) -> bool:
        return next(self.tokens, None) is None


class _Binary:
    """The values of a binary file: big-endian, texts with their length in front."""

    def __init__(self, raw: bytes, name: str) -> None:
        self.raw = raw
        self.name = name
        self.position = len(BINARY)

    def _take(self, size: int, what: str) -> bytes:
        taken = self.raw[self.position : self.position + size]
        if len(taken) < size:
            raise InputError(f"{self.name}: the file ends before {what}; it is cut off or claims more than it has, export it again")
        self.position += size
        return taken

    def _unpack(self, form: str, what: str) -> int | float:
        value: int | float = struct.unpack(form, self._take(struct.calcsize(form), what))[0]
        return value

    def number(self, what: str) -> float:
        return float(self._unpack(">d", what))

    def count(self, what: str) -> int:
        value = int(self._unpack(">i", what))
        if value < 0:
            raise InputError(f"{self.name}: {what} is {value}, which can't be; the file is damaged, export it again")
        return value

    def text(self, what: str) -> str:
        """Two bytes of length and Latin-1 text, or -1, the length, and UTF-16."""
        size = int(self._unpack(">h", what))
        if size >= 0:
            return self._take(size, what).decode("latin-1")
        size = int(self._unpack(">H", what))
        return self._take(2 * size, what).decode("utf-16-be", "replace")

    def kind(self, what: str) -> str:
        return self._take(int(self._unpack(">B", what)), what).decode("latin-1")

    def exists(self) -> bool:
        return bool(self._unpack(">B", "whether there are tiers"))

    def at_end(self) -> bool:
        return self.position == len(self.raw)
