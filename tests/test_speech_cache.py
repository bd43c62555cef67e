"""What a voice has said is kept; a repeat gives the same, and a broken entry is made again."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from lipdb.schedule import Phone, Schedule
from lipdb.sound import Sound
from lipdb.speech import cache
from lipdb.speech.cache import cache_folder, spoken
from lipdb.speech.voice import Spoken


@dataclass
class Humming:
    """A voice that hums something else each time it is asked."""

    version: str = "1"
    name: str = "hum"
    language: str = "xx"
    asked: list[str] = field(default_factory=list)

    def speak(self, text: str) -> Spoken:
        self.asked.append(text)
        samples = np.arange(1000 + len(self.asked), dtype=np.int16)
        phones = (Phone("_"), Phone("m", word=0, tone=3, stress=1, long=True))
        return Spoken(Schedule((0, 40_001, 90_000), phones, "xx", "hum", ("mm",)), Sound(samples, 8000), ("a note",))

    def phones(self, text: str) -> tuple[tuple[str, ...], ...]:
        return (("m",),)


def _same(a: Spoken, b: Spoken) -> bool:
    sounds = a.sound.rate == b.sound.rate and a.sound.samples.tobytes() == b.sound.samples.tobytes()
    return sounds and a.schedule == b.schedule and a.notes == b.notes


def test_a_repeat_gives_the_same_without_asking_the_voice(tmp_path: Path):
    voice = Humming()
    first = spoken(voice, "mm", folder=tmp_path / "new")
    again = spoken(voice, "mm", folder=tmp_path / "new")
    assert _same(first, again)
    assert voice.asked == ["mm"]
    assert again.sound.samples.dtype == np.int16


@pytest.mark.parametrize("changed", [{"version": "2"}, {"name": "buzz"}, {"language": "yy"}])
def test_another_voice_or_version_is_asked_again(tmp_path: Path, changed: dict[str, str]):
    spoken(Humming(), "mm", folder=tmp_path)
    other = Humming(**changed)
    spoken(other, "mm", folder=tmp_path)
    assert other.asked == ["mm"]


def test_another_text_is_another_entry(tmp_path: Path):
    voice = Humming()
    spoken(voice, "mm", folder=tmp_path)
    spoken(voice, "mm ", folder=tmp_path)
    assert voice.asked == ["mm", "mm "]


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=150)
@given(data=st.data())
def test_a_damaged_entry_is_the_same_or_made_again(tmp_path: Path, data: st.DataObject):
    voice = Humming()
    first = spoken(voice, "mm", folder=tmp_path)
    [entry] = tmp_path.glob("*.speech")
    raw = bytearray(entry.read_bytes())
    match data.draw(st.sampled_from(["cut", "change", "replace"])):
        case "cut":
            raw = raw[: data.draw(st.integers(0, len(raw) - 1))]
        case "change":
            for _ in range(data.draw(st.integers(1, 3))):
                raw[data.draw(st.integers(0, len(raw) - 1))] = data.draw(st.integers(0, 255))
        case "replace":
            raw = bytearray(data.draw(st.binary(max_size=300)))
    entry.write_bytes(raw)
    again = spoken(voice, "mm", folder=tmp_path)
    assert _same(first, again) or len(voice.asked) == 2
    entry.unlink()


def test_a_broken_entry_is_written_anew(tmp_path: Path):
    voice = Humming()
    spoken(voice, "mm", folder=tmp_path)
    [entry] = tmp_path.glob("*.speech")
    entry.write_bytes(b"junk")
    second = spoken(voice, "mm", folder=tmp_path)
    assert _same(second, spoken(voice, "mm", folder=tmp_path))
    assert len(voice.asked) == 2


def test_a_folder_that_cannot_be_written_is_done_without(tmp_path: Path):
    blocked = tmp_path / "file"
    blocked.write_text("not a folder")
    voice = Humming()
    assert spoken(voice, "mm", folder=blocked).notes == ("a note",)
    assert blocked.read_text() == "not a folder"


def test_the_entries_used_longest_ago_go_first(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    voice = Humming()
    for age, text in enumerate(["new", "old", "older"]):
        before = set(tmp_path.glob("*.speech"))
        spoken(voice, text, folder=tmp_path)
        [entry] = set(tmp_path.glob("*.speech")) - before
        os.utime(entry, (1000 - age, 1000 - age))
    monkeypatch.setattr(cache, "LIMIT", entry.stat().st_size * 2 + 500)
    spoken(voice, "newest", folder=tmp_path)
    assert len(list(tmp_path.glob("*.speech"))) == 2
    voice.asked.clear()
    spoken(voice, "new", folder=tmp_path)
    assert voice.asked == []


def test_nothing_half_written_stays(tmp_path: Path):
    spoken(Humming(), "mm", folder=tmp_path)
    assert [entry.suffix for entry in tmp_path.iterdir()] == [".speech"]


def test_the_folder_is_the_users_cache_or_what_the_environment_says(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.delenv("LIPDB_CACHE", raising=False)
    monkeypatch.setenv("XDG_CACHE_HOME", "/somewhere/cache")
    assert cache_folder() == Path("/somewhere/cache/lipdb")
    monkeypatch.setenv("LIPDB_CACHE", "/elsewhere")
    assert cache_folder() == Path("/elsewhere")
    monkeypatch.delenv("LIPDB_CACHE")
    monkeypatch.delenv("XDG_CACHE_HOME")
    monkeypatch.setenv("HOME", "/home/robin")
    assert cache_folder() == Path("/home/robin/.cache/lipdb")
