"""The tables of curated data: one file pattern, its columns and its key. Everything else follows from this list.

A table is a tab-separated file below `phonesets/`; a row is one fact. The same rows are what the store keeps, edits,
compares and writes back, so a new kind of fact is one more entry here.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime
from functools import cache

from lipdb.curves.keys import format_keys, parse_keys
from lipdb.errors import CurveError

ORIGINS = ("authored", "fitted", "generated", "imported")
BY_HAND = ("authored", "fitted")
"""The origins that need no more work."""
USER_SOURCE, USER_LICENCE = "user", "LicenseRef-user"
"""The row of sources.tsv that stands for the work of the people who use a database, and its licence."""
TIME_FORMAT = "%Y-%m-%dT%H:%M:%SZ"
NAME = re.compile(r"\S+")
CODE = re.compile(r"[a-z]{2,3}(?:_[a-z0-9]+)?")
"""The code of a language: ISO 639, with a word for a variety."""

Canonical = Callable[[str], str]
"""Turns a cell into its canonical text; raises `ValueError` with a sentence that says what is wrong."""


def _text(cell: str) -> str:
    return " ".join(cell.split())


def _name(cell: str) -> str:
    if not NAME.fullmatch(cell):
        raise ValueError(f"{cell!r} must be one word")
    return cell


def _drawing(cell: str) -> str:
    if not re.fullmatch(r"built:[a-z0-9_]+|(?:[a-z0-9_]+/)?(?:mesh\.glb|pictures)", cell):
        raise ValueError(f"{cell!r} is nothing to draw; write built:NAME, mesh.glb or pictures")
    return cell


def _number(cell: str) -> str:
    try:
        value = float(cell)
    except ValueError:
        raise ValueError(f"{cell!r} is not a number") from None
    if value != value or value in (float("inf"), float("-inf")):
        raise ValueError(f"{cell!r} is not a finite number")
    text = f"{value:.4f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def _count(cell: str) -> str:
    if not cell.isascii() or not cell.isdecimal():
        raise ValueError(f"{cell!r} is not a whole number")
    return str(int(cell))


def _keys(cell: str) -> str:
    try:
        return format_keys(parse_keys(cell))
    except CurveError as error:
        raise ValueError(str(error)) from error


def _time(cell: str) -> str:
    try:
        return datetime.strptime(cell, TIME_FORMAT).strftime(TIME_FORMAT)
    except ValueError:
        raise ValueError(f"{cell!r} is not a time; write it as 2026-11-22T09:30:00Z (UTC)") from None


def _one_of(*choices: str) -> Canonical:
    def check(cell: str) -> str:
        if cell not in choices:
            raise ValueError(f"{cell!r} is none of {', '.join(choices)}")
        return cell

    return check


@dataclass(frozen=True, slots=True)
class Column:
    """One column: its name, its canonical form, and whether a row may leave it empty."""

    name: str
    canonical: Canonical = _text
    optional: bool = False


@dataclass(frozen=True, slots=True)
class Table:
    """One kind of file: *pattern* with ``{parts}`` that stand for one path component's name, columns, key columns."""

    pattern: str
    columns: tuple[Column, ...]
    key: tuple[str, ...]

    @property
    def names(self) -> tuple[str, ...]:
        """The column names in order, as the header line has them."""
        return tuple(column.name for column in self.columns)

    def parts(self, path: str) -> dict[str, str] | None:
        """What the ``{parts}`` of the pattern are in *path*, or None when the path is not of this table."""
        match = _regex(self.pattern).fullmatch(path)
        return match.groupdict() if match else None


@cache
def _regex(pattern: str) -> re.Pattern[str]:
    parts = re.split(r"(\{\w+\})", pattern)
    kinds = {"language": CODE.pattern}
    return re.compile("".join(f"(?P<{p[1:-1]}>{kinds.get(p[1:-1], '[a-z0-9_]+')})" if p.startswith("{") else re.escape(p) for p in parts))


def _columns(words: str, **kinds: Canonical) -> tuple[Column, ...]:
    """Columns from their names; a name that ends in ``?`` may be empty."""
    return tuple(Column(word.rstrip("?"), kinds.get(word.rstrip("?"), _text), word.endswith("?")) for word in words.split())


_SOURCED = "source comment?"
_PROVENANCE = "origin source licence author time comment?"
_ORIGIN: dict[str, Canonical] = {"origin": _one_of(*ORIGINS), "source": _name, "licence": _name, "time": _time}
_PHONE_KIND = _one_of("vowel", "consonant", "initial", "final", "erhua")
_MAPPING: dict[str, Canonical] = {"phone": _name, **_ORIGIN}
_CURVE = _columns(
    "left right pose keys? warp " + _PROVENANCE,
    left=_name, right=_name, pose=_name, keys=_keys, warp=_one_of("border", "linear"), **_ORIGIN,
)  # fmt: skip
_LINK = _columns(
    "pose shape gain combine curve? " + _SOURCED,
    pose=_name, shape=_name, gain=_number, combine=_one_of("sum", "max"), curve=_keys, source=_name,
)  # fmt: skip

TABLES: tuple[Table, ...] = (
    Table("sources.tsv", _columns("source title licence url? comment?", source=_name, licence=_name), ("source",)),
    # Common phones. *ipa* is a typical segment of the class: what "nearest by articulation" compares. *kind_of* is the coarser
    # phone that a refined one was split from (empty: none): until somebody draws its own curves, it uses those.
    Table(
        "common.tsv",
        _columns(
            "phone kind ipa? language? example? kind_of? " + _SOURCED,
            phone=_name, kind=_one_of("vowel", "consonant", "silence"), kind_of=_name, source=_name,
        ),
        ("phone",),
    ),
    # The common layer of the phone mapping: IPA segment to common phones.
    Table("ipa.tsv", _columns("phone xsampa? common " + _PROVENANCE, **_MAPPING), ("phone",)),
    # Labels that are no phone in any notation: pauses, and noises during which the mouth rests.
    Table("marks.tsv", _columns("mark meaning " + _SOURCED, mark=_name, meaning=_one_of("pause", "noise"), source=_name), ("mark",)),
    # Pose sets: order, priority (empty: none), speed limit (1/s), and whether the pose must reach its peak.
    Table(
        "poses/{pose_set}.tsv",
        _columns(
            "pose position priority? speed must_reach description " + _SOURCED,
            pose=_name, position=_count, priority=_count, speed=_number, must_reach=_one_of("yes", "no"), source=_name,
        ),
        ("pose",),
    ),
    # What other programs call a pose of a set: shapes of meshes are matched by these names too.
    Table(
        "shape_names.tsv",
        _columns("pose_set name pose " + _SOURCED, pose_set=_name, name=_name, pose=_name, source=_name),
        ("pose_set", "name", "pose"),
    ),
    Table(
        "poses/sets.tsv",
        _columns("pose_set window threshold title " + _SOURCED, pose_set=_name, window=_number, threshold=_number, source=_name),
        ("pose_set",),
    ),
    Table(
        "constraints/{pose_set}.tsv",
        _columns("pose other threshold " + _SOURCED, pose=_name, other=_name, threshold=_number, source=_name),
        ("pose", "other"),
    ),
    Table("links/{pose_set}/{target}.tsv", _LINK, ("pose", "shape")),
    Table("curves/{pose_set}.tsv", _CURVE, ("left", "right", "pose")),
    # How often pairs of common phones occur, in per cent of all, as somebody published it: what counts are compared with.
    Table(
        "frequencies/{corpus}.tsv",
        _columns("left right percent " + _SOURCED, left=_name, right=_name, percent=_number, source=_name),
        ("left", "right"),
    ),
    # What the shared curves are generated from. *glide* is the second target of a phone that moves, such as a diphthong
    # (empty: it stays at the first); *before* and *after* are what a phone adds to its neighbours' targets (empty: nothing).
    Table(
        "targets/{pose_set}.tsv",
        _columns(
            "phone pose target glide? insistence before? after? " + _PROVENANCE,
            phone=_name, pose=_name, target=_number, glide=_number, insistence=_number, before=_number, after=_number, **_ORIGIN,
        ),
        ("phone", "pose"),
    ),
    # How far a phone reaches into its neighbours: before its own start (lead) and after its own end (release).
    Table(
        "timing/{pose_set}.tsv",
        _columns("phone lead release " + _PROVENANCE, phone=_name, lead=_number, release=_number, **_ORIGIN),
        ("phone",),
    ),
    # A language. *voice* is what the speech engine calls it, *speech* the plug-in that makes schedules from its text.
    Table(
        "{language}/language.tsv",
        _columns("language name notation speech voice script " + _SOURCED, language=_name, notation=_name, source=_name),
        ("language",),
    ),
    Table("{language}/phones.tsv", _columns("phone kind ipa common example " + _PROVENANCE, kind=_PHONE_KIND, **_MAPPING), ("phone",)),
    Table(
        "{language}/aliases.tsv",
        _columns("notation symbol phones " + _SOURCED, notation=_name, symbol=_name, source=_name),
        ("notation", "symbol"),
    ),
    # Written syllables. *characters*: how many of a standard set are read so; *status*: how common the syllable is.
    Table(
        "{language}/syllables.tsv",
        _columns(
            "syllable initial? final ipa xsampa characters example? status " + _SOURCED,
            syllable=_name, characters=_count, status=_one_of("core", "dict", "theory"), source=_name,
        ),
        ("syllable",),
    ),
    # How words are read where the language's own reader can't know: pinyin with tone numbers for Mandarin.
    Table("{language}/readings.tsv", _columns("word reading " + _SOURCED, word=_name, source=_name), ("word",)),
    # Sentences written for the project, in which between them every phone occurs: what a language is tried on.
    Table("{language}/sentences.tsv", _columns("sentence " + _SOURCED, source=_name), ("sentence",)),
    Table("{language}/curves/{pose_set}.tsv", _CURVE, ("left", "right", "pose")),
    # A character. *drawing* is `built:NAME` for the shipped ones, else `mesh.glb` or `pictures`: what stands in the
    # character's folder, or in the one that is named in front of it (`bob_2/mesh.glb`). *shapes* names the set whose
    # shapes it has: links/POSE_SET/SHAPES.tsv leads to them (one to one when that is the pose set itself), and the
    # character's own links.tsv comes on top.
    Table(
        "characters/{character}/character.tsv",
        _columns(
            "character pose_set shapes? drawing title " + _SOURCED,
            character=_name, pose_set=_name, shapes=_name, drawing=_drawing, source=_name,
        ),
        ("character",),
    ),
    Table("characters/{character}/links.tsv", _LINK, ("pose", "shape")),
    Table("characters/{character}/curves/{pose_set}.tsv", _CURVE, ("left", "right", "pose")),
    Table(
        "characters/{character}/mapping.tsv",
        _columns("language phone common " + _PROVENANCE, language=_name, **_MAPPING),
        ("language", "phone"),
    ),
)  # fmt: skip


@cache
def table_of(path: str) -> Table | None:
    """The table that the file at *path* (relative to the folder, with ``/``) belongs to, or None. Exact names go first."""
    return next((t for t in sorted(TABLES, key=lambda t: t.pattern.count("{")) if t.parts(path) is not None), None)
