"""The speech library: the same text gives the same bytes, and labels are whole."""

from __future__ import annotations

import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise
from pathlib import Path

import pytest

from lipdb.errors import MissingToolError, PhonesetError
from lipdb.speech import libespeak

TEXT = "Bob said hello to a happy baby."


def test_the_same_text_gives_the_same_sound_and_marks_every_time():
    first = libespeak.speak(TEXT, "en-us")
    for between in ("Something else, quite different!", "..", TEXT):
        libespeak.speak(between, "en-us")
        again = libespeak.speak(TEXT, "en-us")
        assert again.sound.samples.tobytes() == first.sound.samples.tobytes()
        assert again.marks == first.marks


def test_another_process_gives_the_same_sound():
    code = (
        f"import sys; from lipdb.speech.libespeak import speak; sys.stdout.buffer.write(speak({TEXT!r}, 'en-us').sound.samples.tobytes())"
    )
    outputs = {subprocess.run([sys.executable, "-c", code], capture_output=True, check=True).stdout for _ in range(2)}
    assert outputs == {libespeak.speak(TEXT, "en-us").sound.samples.tobytes()}


def test_threads_do_not_disturb_each_other():
    texts = [f"{TEXT} Number {n}." for n in range(6)] * 2
    alone = [libespeak.speak(text, "en-us").marks for text in texts]
    with ThreadPoolExecutor(4) as pool:
        assert [u.marks for u in pool.map(lambda text: libespeak.speak(text, "en-us"), texts)] == alone


def test_phonemizer_and_the_synthesis_live_in_one_process():
    from lipdb.speech import phonemes

    before = libespeak.speak(TEXT, "en-us")
    assert phonemes.words("Bob", "en-us") == [["b", "ˈɑː", "b"]]
    assert libespeak.speak(TEXT, "en-us").marks == before.marks


def test_marks_are_contiguous_from_silence_to_silence():
    utterance = libespeak.speak(TEXT, "en-us")
    marks = utterance.marks
    assert marks[0].start == 0
    assert marks[-1].end == len(utterance.sound.samples)
    assert all(a.end == b.start for a, b in pairwise(marks))
    assert not marks[0].label
    assert not marks[-1].label
    assert not utterance.sound.samples[: marks[0].end].any()


def test_a_label_that_an_event_cuts_within_a_character_is_whole():
    """ɯᵝɯᵝ has ten bytes; the event has room for eight, which ends in the middle of the second ᵝ."""
    labels = [mark.label for mark in libespeak.speak("くう", "ja").marks]
    assert any(len(label.encode()) > 8 for label in labels)
    assert "".join(label.strip("ˈˌ") for label in labels) == "kɯᵝɯᵝ"


def test_a_modifier_that_is_played_by_itself_belongs_to_the_phone_in_front():
    labels = [mark.label.strip("ˈˌ") for mark in libespeak.speak("ニュー", "ja").marks]
    assert labels[1:3] == ["nʲ", "ɯᵝɯᵝ"]


def test_a_length_that_a_rule_adds_is_kept():
    assert "pː" in [mark.label for mark in libespeak.speak("septiembre", "es").marks]


def test_no_temporary_files_stay(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    libespeak.speak(TEXT, "en-us")
    assert not list(tmp_path.iterdir())


def test_a_data_folder_with_a_very_long_path_works(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    library, data = libespeak.find_espeak()
    assert data is not None
    deep = tmp_path / ("x" * 100) / ("y" * 100)
    deep.mkdir(parents=True)
    (deep / "espeak-ng-data").symlink_to(data)
    monkeypatch.setattr(libespeak, "find_espeak", lambda: (library, deep / "espeak-ng-data"))
    assert libespeak.speak("hi", "en-us").marks


def test_an_unknown_voice_is_named():
    with pytest.raises(PhonesetError, match="no voice 'klingonese'"):
        libespeak.speak(TEXT, "klingonese")


def test_a_library_that_cannot_be_loaded_is_a_missing_tool(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    broken = tmp_path / "libespeak-ng.so"
    broken.write_bytes(b"not a library")
    monkeypatch.setattr(libespeak, "find_espeak", lambda: (broken, None))
    with pytest.raises(MissingToolError, match="pip install"):
        libespeak.speak(TEXT, "en-us")


def test_without_a_place_for_its_copy_the_error_says_what_to_set(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr("tempfile.tempdir", "/nowhere/at/all")
    with pytest.raises(MissingToolError, match="set TMPDIR"):
        libespeak.speak(TEXT, "en-us")


def test_without_any_library_the_error_says_what_to_install(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setitem(sys.modules, "espeakng_loader", None)
    monkeypatch.setattr(libespeak, "find_library", lambda name: None)
    with pytest.raises(MissingToolError, match="pip install espeakng-loader"):
        libespeak.find_espeak.__wrapped__()


def test_a_voice_is_found_by_its_language_code_too():
    assert libespeak.speak("huit", "fr-fr").marks == libespeak.speak("huit", "fr").marks
    with pytest.raises(PhonesetError, match="no voice 'fr-xx'"):
        libespeak.speak("huit", "fr-xx")
