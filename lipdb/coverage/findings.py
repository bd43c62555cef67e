"""Why a line or a file was left out of a count, or was read in a way that a person may not expect."""

from __future__ import annotations

from typing import NamedTuple


class Reason(NamedTuple):
    """One reason: whether what it names is *left out*, what it is counted in, and a sentence for a person."""

    left_out: bool
    unit: str
    meaning: str


FILE, LINE, LABEL, STRETCH = "file", "line", "phone", "stretch"

NOT_TEXT = "not text"
NOT_READABLE = "not readable"
CUT_OFF = "cut off"
NO_LINES = "no lines"
NOT_UTF8 = "not UTF-8"
TOO_LONG = "too long"
OTHER_SCRIPT = "other script"
NO_WORDS = "no words"
NOT_SAID = "not said"
FAILED = "voice failed"
CRASHED = "voice broke down"
EMOJI = "emoji"
CONTROLS = "control characters"
LONG_WORDS = "long words"
LONG_LINE = "long line"
NUMBERS = "numbers"
SYMBOLS = "symbols"
FOREIGN = "foreign words"
UNKNOWN = "unknown label"

LONGEST_LINE = 1 << 20
"""Bytes. Longer lines are no sentences and would need unbounded memory."""

REASONS = {
    NOT_TEXT: Reason(True, FILE, "it is no text: a binary file, or an encoding that is not UTF-8"),
    NOT_READABLE: Reason(True, FILE, "it can't be opened or read"),
    CUT_OFF: Reason(True, FILE, "it ends early or is damaged; what stands before that is counted"),
    NO_LINES: Reason(True, FILE, "there is nothing in it"),
    NOT_UTF8: Reason(True, LINE, "it is not valid UTF-8"),
    TOO_LONG: Reason(True, LINE, f"it is longer than {LONGEST_LINE >> 20} MB"),
    OTHER_SCRIPT: Reason(True, LINE, "it has letters of another script than the language's"),
    NO_WORDS: Reason(True, LINE, "there is no letter and no digit in it"),
    NOT_SAID: Reason(True, LINE, "the voice can't say it"),
    FAILED: Reason(True, LINE, "the voice has a fault that it shows; please tell the people who make lipdb"),
    CRASHED: Reason(True, STRETCH, "the voice never came back from something in these lines"),
    EMOJI: Reason(False, LINE, "its emoji and pictograms are not read"),
    CONTROLS: Reason(False, LINE, "its control codes and broken characters are not read"),
    LONG_WORDS: Reason(False, LINE, "its words of more than 60 letters are read in pieces"),
    LONG_LINE: Reason(False, LINE, "it is read in pieces of 2,000 characters, with a pause where no sentence ends"),
    NUMBERS: Reason(False, LINE, "its numbers are read out as words"),
    SYMBOLS: Reason(False, LINE, "its symbols (such as & % € +) are read by their names"),
    FOREIGN: Reason(False, LINE, "the voice reads some of its words by the rules of another language"),
    UNKNOWN: Reason(False, LABEL, "no table knows it; it is mapped by articulation"),
}
