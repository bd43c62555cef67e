"""What a scan opens is what it would make: kept or not, read or damaged, counts are the same."""

from __future__ import annotations

from itertools import product
from pathlib import Path

import pytest
from test_coverage_fast import TEXT, Letters, lines

from lipdb.coverage.counts import Counts, Lines
from lipdb.coverage.fast import counter
from lipdb.coverage.fast.context import Context
from lipdb.coverage.fast.counter import FastCounter
from lipdb.coverage.fast.learn import learn
from lipdb.coverage.fast.lexicon import Lexicon
from lipdb.coverage.fast.opened import context_of, keep_forms

WORDS = ["".join(letters) for letters in product("bdfgklm", "aeiou", "bcdfghjklmnpqrst", "aeiou")]
LEARNED = learn(Lexicon(Letters(elides=True)), TEXT * 2)


def text(words: list[str]) -> Lines:
    return lines(*(" ".join(words[i : i + 10]) for i in range(0, len(words), 10)))


def counted(voice: Letters, given: Lines, folder: Path, monkeypatch: pytest.MonkeyPatch) -> Counts:
    """The counts of *given* in a process that has just begun."""
    monkeypatch.setattr(counter, "_AT_WORK", {})
    return FastCounter(voice, LEARNED, 8, folder).count(given)


def test_sentences_teach_once(tmp_path: Path) -> None:
    first, second = Letters(elides=True), Letters(elides=True)
    learned = context_of(first, TEXT * 2, tmp_path)
    assert learned == context_of(second, TEXT * 2, tmp_path) == context_of(second, TEXT * 2, None)
    assert len(second.asked) == len(first.asked)
    assert context_of(second, ["plain"], tmp_path) == Context()


def test_what_was_learned_and_is_damaged_is_learned_again(tmp_path: Path) -> None:
    learned = context_of(Letters(elides=True), TEXT * 2, tmp_path)
    for damage in ("{", '{"readings": 1}', '{"else": []}'):
        next(tmp_path.glob("context-*")).write_text(damage)
        assert context_of(Letters(elides=True), TEXT * 2, tmp_path) == learned


def test_kept_forms_count_as_fresh_ones_and_take_new_words(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    voice, given = Letters(elides=True), text([*WORDS, *reversed(WORDS)])
    fresh = counted(voice, given, tmp_path, monkeypatch)
    keep_forms(voice, LEARNED, tmp_path)
    asked = Letters(elides=True)
    assert counted(asked, given, tmp_path, monkeypatch) == fresh
    assert not {text for text in asked.asked if " " not in text} & set(WORDS)
    longer = text([f"{word}{end}" for word in WORDS for end in ("", "e", "te")])
    assert counted(asked, longer, tmp_path, monkeypatch) == counted(Letters(elides=True), longer, tmp_path / "none", monkeypatch)


def test_a_word_may_read_alone_as_another_does_in_its_place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    voice, given = Letters(elides=True), lines("tre cat")
    fresh = counted(voice, given, tmp_path, monkeypatch)
    monkeypatch.setattr(counter, "_AT_WORK", {})
    counting = FastCounter(voice, LEARNED, 8, tmp_path)
    counting.count(lines("tree cat"))
    assert counting.count(given) == fresh


@pytest.mark.parametrize("damage", [b"", b"ARROW1 no", None])
def test_forms_that_are_damaged_or_old_are_made_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, damage: bytes | None) -> None:
    voice, given = Letters(elides=True), text(WORDS)
    fresh = counted(voice, given, tmp_path, monkeypatch)
    keep_forms(voice, LEARNED, tmp_path)
    (file,) = tmp_path.glob("forms-*")
    if damage is None:
        counted(voice, text([f"{word}s" for word in WORDS]), tmp_path, monkeypatch)  # More answers, which it has not.
        keep_forms(voice, LEARNED, tmp_path)
        assert not file.exists()
        assert len(list(tmp_path.glob("forms-*"))) == 1
    else:
        file.write_bytes(damage)
    assert counted(voice, given, tmp_path, monkeypatch) == fresh
