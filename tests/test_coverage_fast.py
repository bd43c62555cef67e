"""Counting by words gives what the voice says of whole lines, wherever the voice takes words as they come."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pyarrow as pa
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lipdb.coverage.counts import Counts, Lines
from lipdb.coverage.exact import ExactCounter
from lipdb.coverage.fast.align import align
from lipdb.coverage.fast.codes import UNKNOWN, Codes
from lipdb.coverage.fast.context import CONSONANT, KINDS, PAUSE, VOWEL, Context
from lipdb.coverage.fast.counter import FastCounter, fast_counter
from lipdb.coverage.fast.error import distance
from lipdb.coverage.fast.learn import learn
from lipdb.coverage.fast.lexicon import Lexicon
from lipdb.coverage.fast.lexicon_files import join_files, open_lexicon, share
from lipdb.coverage.fast.words import cut, keys_of
from lipdb.curated.folder import read_folder
from lipdb.errors import InputError
from lipdb.paths import phonesets_dir
from lipdb.phones.phoneset import PhoneSet
from lipdb.speech.espeak import espeak_voice
from lipdb.speech.mandarin import pinyin_voice
from lipdb.speech.text import check_script, clean
from lipdb.speech.voice import Phrases, Spoken, Voice

WORD = re.compile(r"[^\W_]+(?:['’.:,][^\W_]+)*")


@dataclass(frozen=True)
class Letters:
    """A voice that says letters, pauses at commas, and says a last e only in front of a vowel when *elides*."""

    elides: bool = False
    asked: list[str] = field(default_factory=list, compare=False)
    name: str = "letters"
    language: str = "en"
    notation: str = "letters"
    script: str = "Latn"

    @property
    def version(self) -> str:
        return f"1 {self.elides}"

    def raw(self) -> Voice:
        return self

    def speak(self, text: str) -> Spoken:
        raise NotImplementedError

    def phrases(self, text: str) -> Phrases:
        self.asked.append(text)
        text = clean(text).text
        check_script(text, self.script, language=self.language)
        return tuple(said for part in re.split(r", |; |\. ", text) if (said := self._phrase(WORD.findall(part.lower()))))

    def _phrase(self, words: list[str]) -> tuple[tuple[str, ...], ...]:
        following = [*(word[0] for word in words[1:]), ""]
        return tuple(
            tuple(word[:-1] if self.elides and len(word) > 1 and word[-1] == "e" and after and after not in "aeiou" else word)
            for word, after in zip(words, following, strict=False)
        )


def lines(*texts: str, document: list[int] | None = None) -> Lines:
    index = np.array(document or [0] * len(texts), np.int32)
    return Lines(pa.array(texts, pa.string()), index, tuple(f"d{i}" for i in range(max(index, default=0) + 1)))


def counter(voice: Voice, context: Context | None = None, share: int = 1, folder: Path | None = None) -> FastCounter:
    return FastCounter(voice, context or Context(), share, folder)


def words_of(*texts: str) -> list[str]:
    words = cut(pa.array(texts, pa.string()))
    return [words.word(i) for i in range(len(words))]


@pytest.mark.parametrize(
    ("texts", "expected"),
    [
        (["Don't say “hello” to U.S. boys'"], ["Don't", "say", "hello", "to", "U.S", "boys"]),
        (["3.5 or 10:30, R&D—well-known l’amie"], ["3.5", "or", "10:30", "R&D", "well", "known", "l’amie"]),
        (["one", "two.", "three"], ["one", "two", "three"]),
        (["one.", "two"], ["one", "two"]),
        (["Straße, él Ünü"], ["Straße", "él", "Ünü"]),
        (["你好，A4纸2008年ok"], ["你", "好", "A4", "纸", "2008", "年", "ok"]),
        (["𠀀a"], ["𠀀", "a"]),
        (["في ٢٠٠٨ و٣,٥"], ["في", "٢٠٠٨", "و٣,٥"]),
        (["नमस्ते। १२"], ["नमस्ते", "१२"]),
        (["", "😀️", "…"], []),
    ],
)
def test_words_are_cut_where_people_see_them(texts: list[str], expected: list[str]) -> None:
    assert words_of(*texts) == expected


@given(st.lists(st.text(max_size=12), max_size=6))
def test_cutting_never_crosses_a_line(texts: list[str]) -> None:
    texts = [text.replace("\n", " ").encode(errors="replace").decode() for text in texts]
    assert words_of(*texts) == [word for text in texts for word in words_of(text)]


@given(st.lists(st.binary(min_size=1, max_size=40).filter(lambda text: not text.endswith(b"\0")), unique=True, max_size=30))
def test_different_words_have_different_keys(words: list[bytes]) -> None:
    ends = np.cumsum([len(word) for word in words], dtype=np.int64)
    starts = ends - np.array([len(word) for word in words], np.int64)
    assert len(set(keys_of(b"".join(words), starts, ends).tolist())) == len(words)


@given(st.lists(st.sets(st.integers(1, 2**64 - 1), max_size=40), max_size=6))
def test_keys_keep_their_numbers_however_many_come(batches: list[set[int]]) -> None:
    codes, expected = Codes(), dict[int, int]()
    for batch in batches:
        new = [key for key in batch if key not in expected]
        expected |= {key: len(expected) + i for i, key in enumerate(new)}
        codes.add(np.array(new, np.uint64))
    keys = np.array(list(expected), np.uint64)
    assert codes.find(keys).tolist() == list(expected.values())
    assert (codes.find(keys ^ np.uint64(1 << 40)) == UNKNOWN).sum() >= len(keys) - 2


def test_rows_are_laid_side_by_side_at_the_least_cost() -> None:
    costs = np.where(np.eye(5), 0, 4).astype(np.int16)
    (places,) = align([np.array([1, 2, 3])], [np.array([1, 4, 2, 3])], costs, skip=1)
    assert places.tolist() == [0, 2, 3]
    rows = align([np.array([1, 2]), np.array([3])], [np.array([2]), np.array([1])], costs, skip=1)
    assert [row.tolist() for row in rows] == [[-1, 0], [-1]]


TEXT = ["The cat, the tree and the apple.", "Are we here? Some are; others came.", "no marks at all", "3.5 apples.", "the, end"]


def test_where_words_stand_alone_fast_is_exact() -> None:
    given = lines(*TEXT, document=[0, 0, 1, 1, 2])
    fast, exact = counter(Letters()).count(given), ExactCounter(Letters()).count(given)
    assert fast.pairs == exact.pairs
    assert (fast.documents, fast.findings) == (exact.documents, exact.findings)


def test_what_running_speech_does_to_words_is_learned() -> None:
    voice = Letters(elides=True)
    context = learn(Lexicon(voice), TEXT * 2)
    assert context.usual("t r e e", PAUSE * KINDS + CONSONANT) == "t r e"
    assert context.usual("t r e e", PAUSE * KINDS + VOWEL) == "t r e e"
    given = lines("the cat, some are some trees", "the, end")
    assert counter(voice, context).count(given).pairs != counter(voice).count(given).pairs
    given = lines("the cat and the apple, the")
    assert counter(voice, context).count(given).pairs == ExactCounter(voice).count(given).pairs


def test_other_words_do_what_more_than_half_of_the_words_do() -> None:
    voice = Letters(elides=True)
    context = learn(Lexicon(voice), ["the cat", "some cat", "one cat", "are cat", "see me"])
    assert context.tails == (("e", CONSONANT, ""),)
    given = lines("three trees and three apples, three")
    assert counter(voice, context).count(given).pairs == ExactCounter(voice).count(given).pairs


def test_nothing_is_learned_from_nothing() -> None:
    assert learn(Lexicon(Letters()), []) == learn(Lexicon(Letters()), ["…"]) == Context()


@settings(max_examples=25)
@given(st.lists(st.sampled_from(TEXT), min_size=1, max_size=12), st.integers(1, 4), st.data())
def test_counts_of_parts_add_up_to_counts_of_the_whole(texts: list[str], documents: int, data: st.DataObject) -> None:
    of = sorted(data.draw(st.lists(st.integers(0, documents - 1), min_size=len(texts), max_size=len(texts))))
    at = data.draw(st.integers(0, len(texts)))
    whole = lines(*texts, document=of)
    parts = [Lines(whole.texts[a:b], whole.document[a:b], whole.names) for a, b in ((0, at), (at, None))]
    counting = counter(Letters(), share=2)
    assert Counts.sum(map(counting.count, parts)) == counting.count(whole)


def test_documents_are_counted_alike_one_by_one_and_all_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    given = lines(*TEXT, document=[0, 0, 1, 1, 2])
    small = counter(Letters()).count(given)
    monkeypatch.setattr("lipdb.coverage.fast.word_pairs._LARGE", 0)
    assert counter(Letters()).count(given) == small


def test_what_is_left_out_is_what_the_exact_way_leaves_out() -> None:
    odd = ["привет and hello", "smile 😀", "😀 …", "100 % of €5", "bell \x07 rings", "x" * 80, "plain", "日本 only"]
    fast, exact = counter(Letters()).count(lines(*odd)), ExactCounter(Letters()).count(lines(*odd))
    assert fast.findings == exact.findings
    assert fast.documents == exact.documents


def test_the_sample_is_counted_both_ways_and_tells_the_distance() -> None:
    voice = Letters(elides=True)
    texts = [f"the {word} and some {word}" for word in ["cat", "dog", "ape", "owl", "ant", "eel", "fox", "hen"] * 20]
    sample = counter(voice).count(lines(*texts)).sample
    phoneset = PhoneSet.from_records(read_folder(phonesets_dir()), "en")
    found = distance(sample, phoneset, "ipa")
    assert found is not None
    assert found.value > 0.05
    assert 0 < found.spread < 0.05
    learned = distance(counter(voice, learn(Lexicon(voice), texts[:8] * 2)).count(lines(*texts)).sample, phoneset, "ipa")
    assert learned is not None
    assert learned.value == 0
    assert distance(Counts.of().sample, phoneset, "ipa") is None


def test_the_voice_is_asked_once_for_a_word_and_never_for_one_that_is_kept(tmp_path: Path) -> None:
    words = [f"{a}{b}{c}{d}" for a in "bdfgklmnprstv" for b in "aeiou" for c in "abcdefghijklmnopqrstuvwxyz" for d in "kt"]
    texts = lines(*(" ".join(words[i : i + 10]) for i in range(0, len(words), 10)))
    voice = Letters()
    lexicon = open_lexicon(voice, tmp_path)
    numbers = lexicon.words(cut(texts.texts))
    assert sorted(voice.asked) == sorted(words)
    share(lexicon, tmp_path)
    again = Letters()
    opened = open_lexicon(again, tmp_path)
    known = opened.words(cut(texts.texts))
    assert [opened.readings.spelled(n) for n in opened.reading[known]] == [lexicon.readings.spelled(n) for n in lexicon.reading[numbers]]
    assert again.asked == []


def test_what_one_process_asked_another_need_not_ask(tmp_path: Path) -> None:
    words = [f"{a}{b}{c}{d}" for a in "bdfgklmnprstv" for b in "aeiou" for c in "abcdefghijklmnopqrstuvwxyz" for d in "kt"]
    asking, other = (open_lexicon(Letters(), tmp_path) for _ in range(2))
    asking.words(cut(pa.array([" ".join(words)])))
    other.words(cut(pa.array(["some words", " ".join(words[:10])])))
    share(asking, tmp_path)
    share(other, tmp_path)
    numbers = other.words(cut(pa.array([" ".join(words)])))
    assert len(other.speaker.voice.asked) == 12
    assert [other.readings.spelled(n) for n in other.reading[numbers]] == [" ".join(word) for word in words]


def test_many_files_of_answers_are_joined_and_nothing_is_lost(tmp_path: Path) -> None:
    lexicon = open_lexicon(Letters(), None)
    whole = set()
    for first in range(6):
        words = [f"{a}{b}{c}{d}" for a in "bdfgk" for b in "aeiou" for c in "bcdfghjklmnpqrst" for d in "abcdef"[first : first + 1] * 5]
        words = [f"{word}{i}" for i, word in enumerate(words)]
        lexicon.words(cut(pa.array([" ".join(words)])))
        share(lexicon, tmp_path)
        whole |= set(words)
    join_files(tmp_path)
    assert len(list(tmp_path.iterdir())) == 1
    assert len(open_lexicon(Letters(), tmp_path)) >= len(whole) - len(lexicon.asked)


def test_a_language_without_spaces_is_refused() -> None:
    with pytest.raises(InputError, match="without spaces"):
        fast_counter(Letters(script="Jpan"), [])


def test_a_damaged_file_of_answers_is_done_without(tmp_path: Path) -> None:
    (tmp_path / "x.parquet").write_bytes(b"PAR1 no")
    assert len(open_lexicon(Letters(), tmp_path)) == 0


@pytest.mark.parametrize("language", ["cmn", "en", "es"])
def test_what_one_half_of_the_sentences_taught_holds_for_the_other(language: str) -> None:
    records = read_folder(phonesets_dir())
    voice = (pinyin_voice if language == "cmn" else espeak_voice)(records, language).raw()
    sentences = [row["sentence"] for row in records[f"{language}/sentences.tsv"].values()]
    context = fast_counter(voice, sentences[::2]).context
    found = counter(voice, context).count(lines(*sentences[1::2]))
    apart = distance(found.sample, PhoneSet.from_records(records, language), voice.notation)
    assert apart is not None
    assert apart.value < 0.02
