"""The fast way of counting: the voice is asked for every written word once, and for a sample of the lines.

Words are cut from bytes (`words`), numbered (`lexicon`), read as their place asks (`context`, `forms`) and counted
(`word_pairs`). A sample of the very lines, chosen by what is in them, is counted both ways; that is what the error of the
result is measured on (`lipdb.coverage.fast.error`). Nothing was learned from these lines.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from pathlib import Path

import numpy as np
import pyarrow as pa

from lipdb.coverage.counts import DOCUMENTS, FINDINGS, SAMPLE, Counts, Lines
from lipdb.coverage.exact import ExactCounter
from lipdb.coverage.fast.context import Context
from lipdb.coverage.fast.forms import Forms
from lipdb.coverage.fast.lexicon import REMARKS, Masks, mask_of
from lipdb.coverage.fast.lexicon_files import MOST, join_files, share
from lipdb.coverage.fast.opened import context_of, keep_forms, open_forms
from lipdb.coverage.fast.running import ENDS, LEFT_OUT, Running, running
from lipdb.coverage.fast.word_pairs import pairs_of
from lipdb.coverage.fast.words import Keys, keys_of, spans_of
from lipdb.coverage.findings import CONTROLS, EMOJI, NO_WORDS
from lipdb.coverage.lines import shown
from lipdb.errors import InputError
from lipdb.speech.text import cleaned_up
from lipdb.speech.voice import Voice

VERSION = 1
"""Change it with anything that changes counts of the same labels."""
SIZE = 1 << 24
"""Bytes of a part: what fits into memory a few times as numbers, and is not felt when the counts of all parts are summed."""
UNSPACED = ("Jpan", "Khmr", "Laoo", "Mymr", "Thai")
"""Scripts without spaces, but for Chinese, of which each character is taken as a word: what it is, is mostly how it is read."""
FOLDS = 8
_LOOKED_AT = 8  # Bytes at the start and the end of a line: enough to tell lines apart.
_MIX = np.uint64(0xD6E8FEB86659FD93)
# Bytes of a corpus; the share of its lines that is counted both ways, some thousands of them; and the bytes of a part, small where
# there would be too few for all who count.
_SHARES = ((1 << 20, 8, 1 << 18), (1 << 22, 32, 1 << 20), (1 << 24, 128, 1 << 20), (1 << 26, 512, 1 << 21), (1 << 28, 2048, 1 << 23))
_LARGEST = 4096, SIZE
_NOT_SAID = LEFT_OUT | np.uint32(mask_of((NO_WORDS,)))


def fast_counter(voice: Voice, sentences: Sequence[str], *, size: int = 0, folder: Path | None = None) -> FastCounter:
    """The counter of *voice* (give it `Voice.raw`), which learns what running speech does to words from *sentences*.

    *size* is that of the corpus in bytes, 0 if nobody knows: of a small one a larger share is counted both ways. Answers of
    the voice are kept in *folder*; none, and they are not kept. Raises `InputError` for a script without spaces.
    """
    if voice.script in UNSPACED:
        raise InputError(
            f"fast counting takes a text word by word, and {voice.language!r} is written without spaces between words; count it exactly"
        )
    context = context_of(voice, sentences, folder)
    if folder is not None:
        join_files(folder)
        keep_forms(voice, context, folder)
    share, part = next(((share, part) for limit, share, part in _SHARES if 0 < size <= limit), _LARGEST)
    return FastCounter(voice, context, share, folder, part)


@dataclass(frozen=True)
class FastCounter:
    """Counts by words; see `lipdb.coverage.counts.Counter`.

    *context* is what is known of running speech. One line in *share* is counted both ways. *folder* is where the voice's
    answers are kept, *size* how many bytes of text are a part.
    """

    voice: Voice
    context: Context
    share: int
    folder: Path | None = None
    size: int = SIZE

    @cached_property
    def key(self) -> str:
        """The way of counting, the voice, and what was learned."""
        voice = f"{self.voice.language} {self.voice.name}; {self.voice.version}"
        return f"fast {VERSION}; {voice}; context {self.context.digest}; sample 1/{self.share}"

    @property
    def mode(self) -> str:
        """Always ``fast``."""
        return "fast"

    @property
    def notation(self) -> str:
        """That of the voice."""
        return self.voice.notation

    @property
    def threads(self) -> bool:
        """A process has one espeak, and new words are half of the work of a first scan."""
        return False

    def count(self, lines: Lines) -> Counts:
        """The pairs of *lines*, as their words are read one by one."""
        forms = _at_work(self)
        found = running(forms.lexicon, lines.texts, partial(share, forms.lexicon, self.folder))
        remarks = _with_lines(lines, found)
        return Counts.of(
            pairs=pairs_of(lines, found, forms),
            findings=_findings(lines, remarks),
            documents=_documents(lines, remarks),
            sample=self._sample(lines, forms),
        )

    def _sample(self, lines: Lines, forms: Forms) -> pa.Table:
        """The pairs of the lines that are counted both ways."""
        keys = _line_keys(lines.texts)
        chosen = np.flatnonzero(keys % np.uint64(self.share) == 0)
        fold = (keys[chosen] >> np.uint64(24)) % np.uint64(FOLDS)
        order = np.argsort(fold, kind="stable")
        folded = Lines(lines.texts.take(pa.array(chosen[order])), fold[order].astype(np.int32), tuple(map(str, range(FOLDS))))
        exact = ExactCounter(self.voice).count(folded).pairs
        fast = pairs_of(folded, running(forms.lexicon, folded.texts), forms)
        both = [(exact, exact["count"], _zeros(exact)), (fast, _zeros(fast), fast["count"])]
        return pa.concat_tables(
            pa.table([pairs["document"].cast(pa.int64()), pairs["left"], pairs["right"], *columns], schema=SAMPLE)
            for pairs, *columns in both
        )


def _zeros(table: pa.Table) -> pa.Array:
    return pa.repeat(pa.scalar(0, pa.int64()), len(table))


def _line_keys(texts: pa.StringArray) -> Keys:
    """A key for each line by its length and some of its bytes."""
    raw, starts, ends = spans_of(texts)
    heads = keys_of(raw, starts, np.minimum(starts + _LOOKED_AT, ends))
    tails = keys_of(raw, np.maximum(ends - _LOOKED_AT, starts), ends)
    mixed = (heads ^ (tails >> np.uint64(32))) + tails + (ends - starts).astype(np.uint64)
    keys: Keys = ((mixed ^ (mixed >> np.uint64(32))) * _MIX) >> np.uint64(16)
    return keys


def _with_lines(lines: Lines, found: Running) -> Masks:
    """The remarks on every line: those on its words, signs that are not read, and that there is nothing to say."""
    remarks = found.remarks.copy()
    for line in found.unread.tolist():
        remarks[line] |= np.uint32(mask_of(_unread(lines.texts[line].as_py())))
    spoken = np.zeros(len(lines.texts), bool)
    spoken[found.line[found.behind == ENDS]] = True
    remarks[~spoken & (remarks & LEFT_OUT == 0)] = np.uint32(mask_of((NO_WORDS,)))
    return remarks


def _unread(text: str) -> tuple[str, ...]:
    try:
        cleaned = cleaned_up(text)
    except InputError:
        return ()
    return (EMOJI,) * bool(cleaned.emoji) + (CONTROLS,) * bool(cleaned.broken)


def _findings(lines: Lines, remarks: Masks) -> pa.Table:
    """How often there is each remark in each document, with the first line by its bytes as the example."""
    tables = [FINDINGS.empty_table()]
    names = pa.array(lines.names, pa.string())
    for bit, reason in enumerate(REMARKS):
        where = np.flatnonzero(remarks & np.uint32(1 << bit))
        if not where.size:
            continue
        rows = pa.table([pa.array(lines.document[where]), lines.texts.take(pa.array(where))], ["document", "example"])
        found = rows.group_by("document").aggregate([("example", "count"), ("example", "min")]).combine_chunks()
        examples = pa.array([shown(text) for text in found["example_min"].to_pylist()], pa.string())
        columns = [names.take(found["document"]), pa.repeat(reason, len(found)), found["example_count"], examples]
        tables.append(pa.table(columns, schema=FINDINGS))
    return pa.concat_tables(tables)


def _documents(lines: Lines, remarks: Masks) -> pa.Table:
    said = (remarks & _NOT_SAID) == 0
    given = np.bincount(lines.document, minlength=len(lines.names))
    spoken = np.bincount(lines.document[said], minlength=len(lines.names))
    return pa.table([pa.array(lines.names, pa.string()), given, spoken], schema=DOCUMENTS)


_AT_WORK: dict[str, Forms] = {}


def _at_work(counter: FastCounter) -> Forms:
    """The forms of *counter*'s words in this process, with the lexicon that they are of."""
    forms = _AT_WORK.get(counter.key)
    if forms is None or len(forms.lexicon) > MOST:
        full = forms is not None
        forms = open_forms(counter.voice, counter.context, None if full else counter.folder)
        _AT_WORK.clear()
        _AT_WORK[counter.key] = forms
    return forms
