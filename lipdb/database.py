"""The facade: curated data, and what can be done with it."""

from __future__ import annotations

import shutil
from collections import Counter
from collections.abc import Mapping
from difflib import get_close_matches
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Self

from lipdb import plugins
from lipdb.decisions import Cause, PairUse, pair_uses
from lipdb.errors import InputError
from lipdb.line import Line
from lipdb.schedule import MICROSECONDS, SILENCE

if TYPE_CHECKING:
    from contextlib import AbstractContextManager

    from lipdb.characters.add import Added
    from lipdb.characters.character import Character
    from lipdb.curated.tsv import Key, Records, Row
    from lipdb.curves.curve import Curve, CurveKey
    from lipdb.curves.lookup import CurveBook
    from lipdb.engine import Stages
    from lipdb.performance import Performance
    from lipdb.phones.phoneset import PhoneSet, Unknown
    from lipdb.poses import PoseSet
    from lipdb.schedule import Schedule
    from lipdb.sound import Sound
    from lipdb.speech.voice import Voice
    from lipdb.store import Edit, Store

DEFAULT_CHARACTER = "robin"
DEFAULT_LANGUAGE = "en"
DEFAULT_FPS = 60.0
ESPEAKING = ("espeak", "hangul", "kana", "pinyin")
"""Voice plug-ins whose voices are espeak-ng's, which has variants of each."""
SHORT = 0.25
"""Seconds that a recording may lack at its end before that is said."""


def open(url: str | None = None, *, phonesets: str | Path | None = None) -> Database:
    """Open the database at *url*, making and filling it on first use.

    *url* is a file, an SQLAlchemy URL, or None for ``LIPDB_URL`` or else a file in the user's data folder. *phonesets*
    is the folder of curated text that fills a new database. Raises `StoreError`.
    """
    from lipdb.store import Store

    return Database(Store.open(url, phonesets=Path(phonesets) if phonesets else None))


class Database:
    """Curated data, and everything that is made with it. Use it as a context manager, or `close` it."""

    def __init__(self, store: Store, *, revision: int | None = None) -> None:
        self.store = store
        self._revision = revision
        self._records: tuple[int, Records] | None = None
        self._voices: dict[tuple[str, str], Voice] = {}

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Let go of the database."""
        self.store.close()

    @property
    def records(self) -> Records:
        """All the curated data as it stands now; read again only when somebody has edited it."""
        revision = self.store.revision if self._revision is None else self._revision
        if self._records is None or self._records[0] != revision:
            self._records = revision, self.store.records() if self._revision is None else self.store.at(revision)
            self._voices.clear()
        return self._records[1]

    def at(self, revision: int) -> Database:
        """The same database as it stood at *revision* (0: empty), to look at and to play. Raises `InputError` when there is none."""
        past = Database(self.store, revision=revision)
        _ = past.records  # a revision that there is not is told here
        return past

    def read_only(self) -> Database:
        """The same database for those who may only look: every way to change it raises `StoreError`."""
        return Database(self.store.read_only(), revision=self._revision)

    def supposing(self, rows: Mapping[tuple[str, Key], Row | None]) -> Database:
        """The same database as if *rows*, by table and key, stood in it (None: did not), to look at and to play.

        Nothing is saved. Rows are taken as they are given.
        """
        records = dict(self.records)
        for (table, key), row in rows.items():
            changed = {**records.get(table, {})}
            if row is None:
                changed.pop(key, None)
            else:
                changed[key] = row
            records[table] = changed
        revision = self._records[0] if self._records else 0
        trial = Database(self.store.read_only(), revision=revision)
        trial._records = revision, records
        return trial

    def edit(self, *, author: str, note: str = "") -> AbstractContextManager[Edit]:
        """One transaction of edits: `put` and `delete` rows inside the block. See `lipdb.store`."""
        return self.store.edit(author=author, note=note)

    # Languages and characters

    def languages(self) -> list[Row]:
        """The row of every language, sorted by its code."""
        return [row for path, rows in sorted(self.records.items()) if path.endswith("/language.tsv") for row in rows.values()]

    def language(self, code: str) -> Row:
        """The row of language *code*. Raises `InputError` when there is none."""
        known = {row["language"]: row for row in self.languages()}
        return known[_known(code, known, "language")]

    def phoneset(self, language: str, *, character: str | None = None) -> PhoneSet:
        """The phones of *language* and what they map to, as *character* says them."""
        from lipdb.phones.phoneset import PhoneSet

        self.language(language)
        return PhoneSet.from_records(self.records, language, character=character)

    def characters(self) -> list[Row]:
        """The row of every character, sorted by its name."""
        return [row for path, rows in sorted(self.records.items()) if path.endswith("/character.tsv") for row in rows.values()]

    def character(self, name: str) -> Character:
        """The character *name*. Raises `InputError` when there is none."""
        from lipdb.characters.character import Character

        known = {row["character"]: row for row in self.characters()}
        return Character.from_records(self.records, _known(name, known, "character"), folder=self.store.characters_folder)

    def add_character(self, path: str | Path, *, name: str, title: str = "", author: str) -> Added:
        """Add the face in the files at *path* as *name*: copy them, match its shapes to known sets, save its rows.

        What was doubtful or missing stands in the answer. Raises `InputError`, `MeshError`, `OutputError`, and
        `EditConflictError` when somebody else has just taken the name; nothing is left behind then.
        """
        from lipdb.characters.add import add_character

        self.store.require_writable()  # before any file is copied
        seen = self.store.revision
        added = add_character(Path(path), name=name, title=title, records=self.records, folder=self.store.characters_folder)
        try:
            with self.edit(author=author, note=f"Add the character {name}") as edit:
                for table, rows in added.tables.items():
                    for row in rows:
                        edit.put(table, row, expected_revision=seen)
        except BaseException:
            shutil.rmtree(added.folder, ignore_errors=True)
            raise
        return added

    def pose_set(self, name: str) -> PoseSet:
        """The pose set *name*."""
        from lipdb.poses import PoseSet

        return PoseSet.from_records(self.records, name)

    # From text or a recording to a line

    def voices(self, language: str) -> list[str]:
        """The names of the voices that speak *language*, its own first. Raises `InputError` when there is no such language."""
        from lipdb.speech.espeak_voices import TIMBRES

        row = self.language(language)
        return [row["voice"], *(f"{row['voice']}+{timbre}" for timbre in TIMBRES if row["speech"] in ESPEAKING)]

    def voice(self, language: str, name: str = "") -> Voice:
        """The voice that speaks *language*: its own, or the one of `voices` called *name*. Raises `InputError` for others."""
        row = self.language(language)
        if name:
            _known(name, dict.fromkeys(self.voices(language)), f"voice of {language}")
        if (language, name) not in self._voices:
            makers = plugins.voices()
            maker = makers[_known(row["speech"], makers, "voice plug-in")]
            renamed: Records = {f"{language}/language.tsv": {(language,): {**row, "voice": name or row["voice"]}}}
            self._voices[language, name] = maker({**self.records, **renamed}, language)
        return self._voices[language, name]

    def say(self, text: str, *, language: str = DEFAULT_LANGUAGE, voice: str = "", allow_unknown: bool = False) -> Line:
        """Speak *text* with the language's own *voice* or another: a line with schedule and sound, the same for the same text.

        Raises `InputError` for text that the language can't read or a voice that it lacks, and `UnknownSymbolError` for
        phones that no table knows unless *allow_unknown* maps them by articulation.
        """
        from lipdb.speech.cache import spoken

        result = spoken(self.voice(language, voice), text)
        schedule, unknown = self.phoneset(language).resolve(result.schedule, allow_unknown=allow_unknown)
        # A command line may hold bytes that are no text, which no file takes.
        return Line(schedule, result.sound, text.encode(errors="replace").decode(), notes=(*result.notes, *_by_articulation(unknown)))

    def sync(
        self,
        path: str | Path,
        *,
        audio: str | Path | None = None,
        language: str = DEFAULT_LANGUAGE,
        tier: str | None = None,
        notation: str = "",
        allow_unknown: bool = False,
    ) -> Line:
        """Read a recording that was aligned already: a TextGrid, or a line's JSON with a person's edits.

        *tier* names the tier of phones, *notation* the symbols that it uses; both are found when not given. Raises as
        `say` does, and `ScheduleError` for times that can't be.
        """
        from dataclasses import replace

        from lipdb.export.json import read_line
        from lipdb.sound import read_wav

        path = Path(path)
        sound = read_wav(Path(audio)) if audio else None
        if path.suffix.lower() == ".json":
            line = read_line(path, sound=sound)
        else:
            self.language(language)
            raw: Schedule = plugins.by_suffix(plugins.readers(), path, "reader", besides=[".json"])(path, tier=tier)
            line = Line(replace(raw, language=language, notation=notation or raw.notation), sound)
        try:
            self._check_curves(line)
            schedule, unknown = self.phoneset(line.language).resolve(line.schedule, line=line.mapping, allow_unknown=allow_unknown)
        except InputError as error:
            raise type(error)(f"{path}: {error}") from error
        return replace(line, schedule=schedule, notes=(*_fit(schedule, sound), *_by_articulation(unknown)))

    # From a line to a moving face

    def book(
        self, pose_set: str, *, language: str, character: str | None = None, line: Mapping[CurveKey, Curve] | None = None
    ) -> CurveBook:
        """The winning curve of every pair and pose, through all layers."""
        from lipdb.curves.lookup import CurveBook

        return CurveBook.from_records(self.records, pose_set, language=language, character=character, line=line or {})

    def animate(self, line: Line, *, character: str | Character = DEFAULT_CHARACTER, fps: float = DEFAULT_FPS) -> Performance:
        """Move *character*'s face to *line*: a track of pose weights, with the character and the sound."""
        from lipdb import engine
        from lipdb.performance import Performance

        who, line, book = self._prepare(line, character)
        edges, phones = line.schedule.common()
        pose_set = self.pose_set(who.pose_set)
        track = engine.animate(book.table(phones), pose_set, edges, phones, fps=fps)
        return Performance(track, who, line.sound, line)

    def _prepare(self, line: Line, character: str | Character) -> tuple[Character, Line, CurveBook]:
        """The character, the line with its phones mapped as the character says them, and the curves for both."""
        from dataclasses import replace

        who = self.character(character) if isinstance(character, str) else character
        phoneset = self.phoneset(line.language, character=who.name)
        schedule, _ = phoneset.resolve(line.schedule, line=line.mapping, allow_unknown=True)
        book = self.book(who.pose_set, language=line.language, character=who.name, line=line.curves.get(who.pose_set))
        return who, replace(line, schedule=schedule), book

    def _check_curves(self, line: Line) -> None:
        """Raise `InputError` for a curve of *line*'s own whose pose set, pose or common phone does not exist."""
        sets = {key[0]: None for key in self.records["poses/sets.tsv"]}
        phones = {key[0]: None for key in self.records["common.tsv"]}
        for name, curves in line.curves.items():
            poses = dict.fromkeys(self.pose_set(_known(name, sets, "pose set")).poses)
            for left, right, pose in curves:
                _known(pose, poses, f"pose of {name}, in the line's curves,")
                for phone in (left, right):
                    _known(phone, phones, "common phone, in the line's curves,")

    # What decided

    def pairs(self, line: Line, *, character: str | Character = DEFAULT_CHARACTER) -> list[PairUse]:
        """Every pair of common phones in *line*, most frequent first, with the winning curve of every pose."""
        _, line, book = self._prepare(line, character)
        _, phones = line.schedule.common()
        counts = Counter(pair for pair in pairwise((SILENCE, *phones, SILENCE)) if pair != (SILENCE, SILENCE))
        return pair_uses(book, sorted(counts.items(), key=lambda item: (-item[1], item[0])))

    def uses(
        self, counts: Mapping[tuple[str, str], float], *, language: str, character: str | Character = DEFAULT_CHARACTER
    ) -> list[PairUse]:
        """The pairs of *counts*, in its order, with the winning curve of every pose of *character* in *language*."""
        who = self.character(character) if isinstance(character, str) else character
        return pair_uses(self.book(who.pose_set, language=language, character=who.name), counts.items())

    def stages(self, line: Line, *, character: str | Character = DEFAULT_CHARACTER, fps: float = DEFAULT_FPS) -> Stages:
        """What every stage of the engine makes of *line* on *character*, and the curves as they are laid on the time line."""
        from lipdb import engine

        who, line, book = self._prepare(line, character)
        edges, phones = line.schedule.common()
        return engine.stages(book.table(phones), self.pose_set(who.pose_set), edges, phones, fps=fps)

    def explain(self, line: Line, *, at: float, character: str | Character = DEFAULT_CHARACTER, fps: float = DEFAULT_FPS) -> list[Cause]:
        """What made each pose's weight at the frame nearest to *at* seconds, in the order of the pose set.

        Raises `InputError` for a time outside the track.
        """
        from lipdb import engine

        who, line, book = self._prepare(line, character)
        edges, phones = line.schedule.common()
        told = engine.explain(book.table(phones), self.pose_set(who.pose_set), edges, phones, at=at, fps=fps)
        return [
            Cause(
                story.pose,
                told.time,
                story.weights,
                tuple((left, right, weight, book.find(left, right, story.pose)) for left, right, weight in story.curves),
                story.stage,
                story.yields_to,
            )
            for story in told.poses
        ]


def _fit(schedule: Schedule, sound: Sound | None) -> tuple[str, ...]:
    """A note when *sound* ends long before the last phone that is heard; a recording may well go on after it."""
    ends = [end for phone, end in zip(schedule.phones, schedule.edges[1:], strict=True) if not phone.silent]
    last = max(ends, default=0) / MICROSECONDS
    if sound is None or sound.duration > last - SHORT:
        return ()
    return (f"the recording ends at {sound.duration:.2f} s, but its phones at {last:.2f} s; is it the right one?",)


def _by_articulation(unknown: tuple[Unknown, ...]) -> tuple[str, ...]:
    """A note for each symbol that no table knows and that was mapped all the same."""
    return tuple(f"unknown symbol {symbol} was mapped by articulation" for symbol in unknown)


def _known(name: str, known: Mapping[str, object], what: str) -> str:
    """*name*, if it is *known*. Raises `InputError` with the nearest name or all of them."""
    if name in known:
        return name
    near = get_close_matches(name, known, 1)
    hint = f"did you mean {near[0]!r}?" if near else f"there are {', '.join(sorted(known)) or 'none'}"
    raise InputError(f"no {what} {name!r}; {hint}")
