"""Cut a block of text into written words, by bytes and all at once: a hundred megabytes a second.

Nothing here knows a language. A word is a run of letters, marks, digits and signs that voices read by their name, with
what stands inside it: the apostrophe of "don't", the full stops of "e.g", the signs of "3.5" and "10:30". A Chinese
character is a word by itself. What stands between two words is a gap.
"""

from __future__ import annotations

import unicodedata
from dataclasses import dataclass
from functools import cache

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

Bytes = NDArray[np.uint8]
Places = NDArray[np.int64]
Keys = NDArray[np.uint64]

GAP, WORD, DIGIT, CHARACTER = range(4)
JOINS_LETTERS, JOINS_DIGITS, UNREAD = 4, 8, 16
JOINERS = {"'": JOINS_LETTERS, "’": JOINS_LETTERS, ".": JOINS_LETTERS | JOINS_DIGITS, ",": JOINS_DIGITS, ":": JOINS_DIGITS}
SIGNS = "%&@#"
# Signs that only style or join the one in front: of emoji, and skin colours.
STYLES = (range(0xFE00, 0xFE10), range(0x1F3FB, 0x1F400))
CHARACTERS = (range(0x3005, 0x3008), range(0x3400, 0x4DC0), range(0x4E00, 0xA000), range(0xF900, 0xFB00))
PLANES = 0x20000
"""Above it are more Chinese characters, up to `LAST_CHARACTER`, and then nothing that is read."""
LAST_CHARACTER = 0x3FFFF
SPACE, CONTINUATION, LEAD = 0x20, 0x80, 0xC0
# By the category of a character in Unicode; of any other it is in a gap.
_KINDS = {
    "Nd": DIGIT,
    **dict.fromkeys(("Lu", "Ll", "Lt", "Lm", "Lo", "Mn", "Mc", "Me", "Nl", "No", "Sc", "Sm", "Cf"), WORD),
    **dict.fromkeys(("So", "Cc", "Co", "Cn", "Cs"), UNREAD),
}

_MIX = np.uint64(0x9E3779B97F4A7C15)
_MASKS = np.array([(1 << 8 * n) - 1 for n in range(8)] + [2**64 - 1], np.uint64)
_PADDING = bytes(8)
# By the kind of a character, that of its bytes after the first.
_FOLLOWING = np.array([{WORD: WORD, DIGIT: DIGIT, CHARACTER: WORD}.get(kind, GAP) for kind in range(UNREAD + 1)], np.uint8)


@dataclass(frozen=True)
class Words:
    """The *n* words of lines: the bytes where each starts and ends, and for each line the index of its first word.

    *unread* are the lines with signs that voices may not read: emoji, other pictograms, control codes.

    Gap *i* is between the words *i* and *i* + 1; there are *n* - 1, those where a line ends among them.
    """

    raw: bytes
    starts: Places
    ends: Places
    lines: Places
    unread: Places

    def __len__(self) -> int:
        return len(self.starts)

    def word(self, place: int) -> str:
        """The word at *place* as it is written."""
        return self.raw[self.starts[place] : self.ends[place]].decode()

    def gap(self, place: int) -> str:
        """What stands after the word at *place*, before the next; can be empty."""
        return self.raw[self.ends[place] : self.starts[place + 1]].decode()

    def keys(self) -> Keys:
        """A key of every word, see `keys_of`."""
        return keys_of(self.raw, self.starts, self.ends)

    def wide_gaps(self) -> Places:
        """The places of gaps that are neither empty nor a single space: few of them."""
        if len(self) < 2:
            return np.zeros(0, np.int64)
        ends, lengths = self.ends[:-1], self.starts[1:] - self.ends[:-1]
        return np.flatnonzero((lengths > 1) | ((lengths == 1) & (np.frombuffer(self.raw, np.uint8)[ends] != SPACE)))

    def gap_keys(self, places: Places) -> Keys:
        """A key of every gap in *places*, see `keys_of`."""
        return keys_of(self.raw, self.ends[places], self.starts[places + 1])


def cut(texts: pa.StringArray) -> Words:
    """The words of lines of text."""
    raw, lines, _ = spans_of(texts)
    kinds, unread = _kinds(raw, lines)
    inside = kinds != GAP
    before = np.append(False, inside[:-1])
    opens, closes = inside > before, inside < before
    # Two lines with nothing between their words, and characters: there one word ends and the next one starts.
    borders = [lines[inside[lines] & before[lines]]]
    if not raw.isascii() and (characters := np.flatnonzero(kinds == CHARACTER)).size:
        ends = characters + _widths(raw, characters)
        borders += [characters[before[characters]], ends[inside[ends]]]
    for places in borders:
        opens[places] = closes[places] = True
    starts, ends = np.flatnonzero(opens), np.flatnonzero(closes)
    return Words(raw, starts, ends, np.searchsorted(starts, lines), _distinct(np.searchsorted(lines, unread, side="right") - 1))


def is_character(word: str) -> bool:
    """Whether *word* is a Chinese character."""
    return len(word) == 1 and (kind_of_codes()[min(ord(word), PLANES)] == CHARACTER or PLANES <= ord(word) <= LAST_CHARACTER)


def spans_of(texts: pa.StringArray) -> tuple[bytes, Places, Places]:
    """The bytes of *texts*, and where each starts and ends in them."""
    if not len(texts):
        return b"", np.zeros(0, np.int64), np.zeros(0, np.int64)
    _, places, data = texts.buffers()
    offsets = np.frombuffer(places, np.int32)[texts.offset : texts.offset + len(texts) + 1].astype(np.int64)
    first, last = offsets[0], offsets[-1]
    return data.slice(first, last - first).to_pybytes() if data else b"", offsets[:-1] - first, offsets[1:] - first


def each_a_word(texts: pa.StringArray) -> Words:
    """*texts*, each of them one word, whatever is in it."""
    return Words(*spans_of(texts), *np.zeros((2, 0), np.int64))


def keys_of(raw: bytes, starts: Places, ends: Places) -> Keys:
    """A 64-bit key, never 0, of every piece of *raw*: a mixed form of its bytes up to eight, a hash of them beyond.

    So short pieces never share a key, and of a million longer ones two do with a chance of 3 in 100 million.
    """
    eights = np.ndarray((len(raw) + 1,), "<u8", raw + _PADDING, strides=(1,))
    lengths = ends - starts
    keys = (eights[starts] & _MASKS.take(np.minimum(lengths, 8))) * _MIX  # take would copy all of eights, eight times the text
    rest = np.flatnonzero(lengths > 8)
    offset = 8
    while rest.size:
        part = eights[starts[rest] + offset] & _MASKS[np.minimum(lengths[rest] - offset, 8)]
        mixed = keys[rest]
        keys[rest] = ((mixed ^ (mixed >> np.uint64(32))) + part + np.uint64(offset)) * _MIX
        offset += 8
        rest = rest[lengths[rest] > offset]
    return np.where(keys == 0, _MIX, keys) if (keys == 0).any() else keys


def _kinds(raw: bytes, lines: Places) -> tuple[Bytes, Places]:
    """What each byte is part of, and a `GAP` more at the end; the bytes after a character's first are `WORD`.

    Nothing is joined across the starts of *lines*. Also returns the places of signs that voices may not read.
    """
    kinds = np.zeros(len(raw) + 1, np.uint8)
    kinds[:-1] = np.frombuffer(raw.translate(_ascii_kinds()), np.uint8)
    if not raw.isascii():
        _mark_others(raw, kinds)
    marked = np.flatnonzero(kinds >= JOINS_LETTERS)
    of = kinds[marked]
    joiners, unread = marked[of < UNREAD], marked[of >= UNREAD]
    kinds[unread] = GAP
    # Most marks stand before a space and join nothing.
    ending = kinds[joiners + 1] == GAP
    ending &= np.frombuffer(raw, np.uint8)[joiners] < LEAD
    kinds[joiners[ending]] = GAP
    joiners = joiners[~ending]
    if joiners.size:
        widths = _widths(raw, joiners)
        kind, before, after = kinds[joiners], kinds[joiners - 1], kinds[joiners + widths]
        opens = np.zeros(len(kinds), bool)
        opens[lines] = True
        kind[opens[joiners] | opens[joiners + widths]] = GAP
        letters = (kind & JOINS_LETTERS > 0) & (before == WORD) & (after == WORD)
        digits = (kind & JOINS_DIGITS > 0) & (before == DIGIT) & (after == DIGIT)
        kinds[joiners] = np.where(letters | digits, WORD, GAP)
        wide = joiners[(letters | digits) & (widths > 1)]
        for byte in (1, 2):
            kinds[wide + byte] = WORD
    return kinds, unread


def _mark_others(raw: bytes, kinds: Bytes) -> None:
    """Write the kinds of the characters beyond ASCII into *kinds*."""
    data = np.frombuffer(raw + b"\0\0\0", np.uint8)
    leads = np.flatnonzero(data >= LEAD)
    widths = _widths(raw, leads)
    codes = data[leads].astype(np.int64) & (0x7F >> widths)
    for byte in range(1, 4):
        longer = widths > byte
        codes[longer] = (codes[longer] << 6) | (data[leads[longer] + byte] & 0x3F)
    found = kind_of_codes()[np.minimum(codes, PLANES)]
    found[(codes >= PLANES) & (codes <= LAST_CHARACTER)] = CHARACTER
    kinds[leads] = found
    following = _FOLLOWING[found]
    for byte in range(1, 4):
        longer = widths > byte
        kinds[leads[longer] + byte] = following[longer]


def _widths(raw: bytes, leads: Places) -> Places:
    """The bytes of each character that starts at *leads*."""
    first = np.frombuffer(raw, np.uint8)[leads]
    return 1 + (first >= LEAD).astype(np.int64) + (first >= 0xE0) + (first >= 0xF0)


def _distinct(places: Places) -> Places:
    ordered = np.sort(places, kind="stable")
    return ordered[np.append(True, ordered[1:] != ordered[:-1])] if ordered.size else ordered


@cache
def _ascii_kinds() -> bytes:
    return bytes(kind_of_codes()[:CONTINUATION]) + bytes(256 - CONTINUATION)


@cache
def kind_of_codes() -> Bytes:
    """The kind of every character below `PLANES`, by its code, and of one above."""
    kinds = np.frombuffer(bytearray(_KINDS.get(unicodedata.category(chr(code)), GAP) for code in range(PLANES + 1)), np.uint8)
    for codes in CHARACTERS:
        found = kinds[codes.start : codes.stop]
        found[found == WORD] = CHARACTER
    for styles in STYLES:
        kinds[styles.start : styles.stop] = GAP
    kinds[[code for code in range(CONTINUATION << 1) if chr(code).isspace()] + [PLANES]] = GAP
    kinds[[ord(sign) for sign in SIGNS]] = WORD
    kinds[[ord(joiner) for joiner in JOINERS]] = list(JOINERS.values())
    return kinds
