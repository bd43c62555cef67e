"""Text to sound and phone times through libespeak-ng.

espeak-ng keeps all its state in global variables and some of it, such as the phase of its oscillators, survives a new
voice and a new seed: the second utterance of a process differs from the first by about 2 ms. So every utterance gets a
library of its own: a private copy is loaded, used once and unloaded (4 ms). The same text then gives the same bytes in
every call and every process, calls can run in several threads, and phonemizer's copy in the same process is not
disturbed.

espeak-ng is GPL-3. It is loaded at run time, and only from here.
"""

from __future__ import annotations

import ctypes
import importlib
import itertools
import os
import shutil
import tempfile
import unicodedata
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from ctypes.util import find_library
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from lipdb.errors import MissingToolError, PhonesetError
from lipdb.sound import Sound
from lipdb.speech.espeak_voices import set_voice

# From espeak-ng's speak_lib.h.
AUDIO_SYNCHRONOUS = 2
INITIALIZE_EVENTS, INITIALIZE_IPA, INITIALIZE_DONT_EXIT = 0x1, 0x2, 0x8000
CHARS_UTF8, PHONEMES_IN, END_PAUSE = 0x1, 0x100, 0x1000
TRACE_IPA = 0x2
EVENT_END, EVENT_WORD, EVENT_PHONEME = 0, 1, 7
POSITION_CHARACTER = 1
SEED = 1
LEAD_IN = 0.25
SEPARATOR = "_"
STRESS = "ˈˌ"


class _Id(ctypes.Union):
    _fields_ = (("number", ctypes.c_int), ("name", ctypes.c_void_p), ("string", ctypes.c_char * 8))


class _Event(ctypes.Structure):
    _fields_ = (
        ("type", ctypes.c_int),
        ("uid", ctypes.c_uint),
        ("text_position", ctypes.c_int),
        ("length", ctypes.c_int),
        ("audio_position", ctypes.c_int),
        ("sample", ctypes.c_int),
        ("user_data", ctypes.c_void_p),
        ("id", _Id),
    )


_SYNTH_CALLBACK = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, ctypes.c_int, ctypes.POINTER(_Event))
_TRACE_CALLBACK = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_char_p)


class Mark(NamedTuple):
    """One phone or pause as espeak played it: *label* with stress marks (empty: a pause), samples, and its word.

    *position* is the character of the text at which the word starts, -1 before the first word.
    """

    label: str
    start: int
    end: int
    position: int


class Utterance(NamedTuple):
    """The sound of one text and its marks, contiguous from 0 to the end of the sound; pauses at both ends."""

    sound: Sound
    marks: tuple[Mark, ...]


@cache
def find_espeak() -> tuple[Path, Path | None]:
    """The library and its data: those of espeakng-loader, else the system's. Raises `MissingToolError`."""
    try:
        loader = importlib.import_module("espeakng_loader")
        return Path(loader.get_library_path()), Path(loader.get_data_path())
    except (ImportError, OSError, RuntimeError):
        name = find_library("espeak-ng")
    if not name:
        raise MissingToolError("espeak-ng: the speech library is not installed; run `pip install espeakng-loader`")
    return Path(importlib.import_module("dlinfo").DLInfo(_load(name)).path), None


@cache
def espeak_version() -> str:
    """The version of the library, with the package that brought it, as caches need it."""
    try:
        package = f" (espeakng-loader {version('espeakng-loader')})"
    except PackageNotFoundError:
        package = ""
    with _private_library() as (library, _):
        library.espeak_Info.restype = ctypes.c_char_p
        return str(library.espeak_Info(None).decode().split()[0]) + package


def no_such_voice(voice: str) -> PhonesetError:
    """What to say of a voice that espeak-ng does not have."""
    return PhonesetError(f"espeak-ng has no voice {voice!r}; mend the column voice of the language's language.tsv")


def speak(text: str, voice: str, *, phonemes: bool = False) -> Utterance:
    """Synthesise *text* with espeak's *voice*, after 0.25 s of silence, in which a mouth prepares, and before 0.3 s.

    With *phonemes*, ``[[...]]`` in the text is espeak's own phoneme notation; without, it is plain text. The same
    arguments give the same samples and marks. Raises `MissingToolError` and `PhonesetError` (no such voice).
    """
    options = INITIALIZE_EVENTS | INITIALIZE_IPA | INITIALIZE_DONT_EXIT
    flags = CHARS_UTF8 | END_PAUSE | (PHONEMES_IN if phonemes else 0)
    with _private_library() as (library, data):
        rate = library.espeak_Initialize(AUDIO_SYNCHRONOUS, 0, data, options)
        if rate <= 0:
            raise MissingToolError("espeak-ng: its data can't be read; run `pip install --force-reinstall espeakng-loader`")
        try:
            if not set_voice(library, voice):
                raise no_such_voice(voice)
            library.espeak_ng_SetRandSeed(ctypes.c_long(SEED))
            with _tracing(library) as clauses:
                samples, events = _synthesise(library, text.encode("utf-8"), flags)
        finally:
            library.espeak_Terminate()
    lead = round(LEAD_IN * rate)
    samples = np.pad(samples, (lead, 0))
    whole = [label for clause in clauses for label in _labels(clause)]
    return Utterance(Sound(samples, rate), _marks(events, whole, lead, len(samples)))


def _synthesise(library: ctypes.CDLL, text: bytes, flags: int) -> tuple[np.ndarray[Any, np.dtype[np.int16]], list[tuple[int, int, Any]]]:
    """Samples, and ``(type, sample, label or text position)`` of every event that matters."""
    sound = bytearray()
    events: list[tuple[int, int, Any]] = []

    def collect(wave: int | None, count: int, event: Any) -> int:
        if wave and count > 0:
            sound.extend(ctypes.string_at(wave, count * 2))
        for i in itertools.takewhile(lambda i: event[i].type != EVENT_END, itertools.count()):
            if event[i].type == EVENT_PHONEME:
                raw = ctypes.string_at(ctypes.addressof(event[i].id), 8).split(b"\0", 1)[0]
                events.append((EVENT_PHONEME, event[i].sample, raw))
            elif event[i].type == EVENT_WORD:
                events.append((EVENT_WORD, event[i].sample, event[i].text_position - 1))
        return 0

    callback = _SYNTH_CALLBACK(collect)
    library.espeak_SetSynthCallback(callback)
    library.espeak_Synth(text, len(text) + 1, 0, POSITION_CHARACTER, 0, flags, None, None)
    library.espeak_Synchronize()
    return np.frombuffer(bytes(sound), np.dtype("<i2")).astype(np.int16), events


def _marks(events: list[tuple[int, int, Any]], whole: list[str], lead: int, total: int) -> tuple[Mark, ...]:
    """Marks with whole labels.

    An event's label is cut at eight bytes, even within a character, and lacks a length mark that a rule adds. The
    phoneme trace of the same synthesis has the whole label of every event that is no pause, in the same order.
    """
    starts = [lead + sample for kind, sample, _ in events if kind == EVENT_PHONEME] + [total]
    sounding = sum(1 for kind, _, raw in events if kind == EVENT_PHONEME and is_phone(raw.decode("utf-8", "ignore")))
    if sounding != len(whole):
        raise MissingToolError(
            f"espeak-ng: it played {sounding} phones but named {len(whole)}, so it is of no use; run `pip install espeakng-loader`"
        )
    names, ends = iter(whole), iter(starts[1:])
    marks, position = [Mark("", 0, starts[0], -1)], -1
    for kind, sample, payload in events:
        if kind == EVENT_WORD:
            position = payload
            continue
        label, end = payload.decode("utf-8", "ignore"), next(ends)
        if _is_modifier(label):
            marks[-1] = marks[-1]._replace(end=end)
        else:
            marks.append(Mark(next(names) if is_phone(label) else "", lead + sample, end, position))
    return tuple(marks)


def is_phone(label: str) -> bool:
    """Whether *label* names a phone: it is no pause and no modifier."""
    return bool(label.strip(STRESS + "',%=|_:!")) and not _is_modifier(label)


def _is_modifier(label: str) -> bool:
    """Whether *label* is only a modifier, as ʲ, which espeak plays by itself and writes behind the phone in front."""
    bare = label.strip(STRESS)
    return bool(bare) and all(unicodedata.category(sign) in ("Lm", "Mn") for sign in bare)


def _labels(clause: str) -> list[str]:
    return [label for word in clause.split() for label in word.split(SEPARATOR) if is_phone(label)]


@contextmanager
def _tracing(library: ctypes.CDLL) -> Iterator[list[str]]:
    """The phonemes of every clause that is spoken in the block, separated by `SEPARATOR` and spaces."""
    clauses: list[str] = []

    def collect(clause: bytes) -> int:
        clauses.append(clause.decode("utf-8", "replace"))
        return 0

    callback = _TRACE_CALLBACK(collect)
    libc = ctypes.CDLL(None)
    libc.fopen.restype = ctypes.c_void_p
    # The library writes each clause to a C stream too; one that goes nowhere keeps the terminal clean.
    stream = ctypes.c_void_p(libc.fopen(os.devnull.encode(), b"w"))
    try:
        library.espeak_SetPhonemeTrace(ctypes.c_int(TRACE_IPA | ord(SEPARATOR) << 8), stream)
        library.espeak_SetPhonemeCallback(callback)
        yield clauses
    finally:
        libc.fclose(stream)


@contextmanager
def _private_library() -> Iterator[tuple[ctypes.CDLL, bytes | None]]:
    """A copy of the library that nobody else uses, and the path of its data; both are gone after the block."""
    path, data = find_espeak()
    with ExitStack() as stack:
        try:
            folder = stack.enter_context(tempfile.TemporaryDirectory(prefix="lipdb-"))
            copy = Path(shutil.copy(path, folder))
            near = Path(folder, "espeak-ng-data")
            if data:
                near.symlink_to(data)  # espeak cuts paths at 160 characters
        except OSError as error:
            raise MissingToolError(f"espeak-ng: no private copy of {path} can be made ({error}); set TMPDIR to another folder") from error
        library = _load(str(copy))
        try:
            yield library, str(near).encode() if data else None
        finally:
            _unload(library)


def _load(path: str) -> ctypes.CDLL:
    try:
        return ctypes.CDLL(path)
    except OSError as error:
        raise MissingToolError(
            f"espeak-ng: can't be loaded ({error}); run `pip install --force-reinstall espeakng-loader`, "
            "or set TMPDIR to a folder from which programs may run"
        ) from error


def _unload(library: ctypes.CDLL) -> None:
    close: Callable[[int], None] = importlib.import_module("_ctypes").dlclose
    close(library._handle)
