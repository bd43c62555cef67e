"""Lay lines on one time axis: phones become pairs, frames get their places among the control points.

Everything here is whole numbers. The unit of time divides a microsecond, a frame and a sixtieth of a second alike, so
a frame that falls exactly on a border is known to, and shifting a schedule by whole frames shifts every number alike.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache

import numpy as np

from lipdb.engine.lines import Line, flat
from lipdb.engine.table import CurveTable, Floats, Ints
from lipdb.errors import InputError, ScheduleError

CONTROL_RATE = 60
"""Control points of the B-spline a second: smoothing is fixed in time, whatever the frame rate."""
REST = 250_000
"""The most of a pause, in microseconds, that a pair with silence covers; also the silence put before and after speech."""
SPLIT = 1_000_000
"""Pauses this long, in microseconds, part a line into runs that each lay out their control points anew."""


@dataclass(frozen=True, slots=True)
class Rate:
    """A frame rate in whole units: *microsecond*, *frame* and *control* step, and how many units make a second."""

    fps: float
    second: int
    microsecond: int
    frame: int
    control: int

    @property
    def on_grid(self) -> bool:
        """Whether frames are the control points, one to one."""
        return self.frame == self.control

    @property
    def aligned(self) -> bool:
        """Whether every frame falls on a control point, so that one grid serves the whole time line."""
        return self.frame % self.control == 0


@cache
def rate_of(fps: float) -> Rate:
    """The units for *fps*, any number above 0. Raises `InputError` for others.

    A rate is read as the simplest fraction that is this number: 29.97 is 2997/100, 30000 / 1001 is itself.
    """
    if not (math.isfinite(fps) and 1 <= fps <= 1000):
        raise InputError(f"frame rate {fps!r} can't be played; give frames a second between 1 and 1000")
    guesses = (Fraction(fps).limit_denominator(size) for size in (1, 1001, 100_000))
    exact = next((guess for guess in guesses if float(guess) == fps), Fraction(fps).limit_denominator(100_000))
    second = math.lcm(1_000_000, CONTROL_RATE, exact.numerator)
    return Rate(fps, second, second // 1_000_000, second * exact.denominator // exact.numerator, second // CONTROL_RATE)


@dataclass(frozen=True, slots=True, eq=False)
class Pairs:
    """Pairs on a grid of *step* units, by time, each array ``(n,)``.

    *pair* is the number in the table; its time 0 lies *rest* units after grid point *base*, its phones last *first* and
    *second* units, and it ends at or before grid point *stop*.
    """

    step: int
    pair: Ints
    base: Ints
    rest: Ints
    first: Ints
    second: Ints
    stop: Ints

    def between(self, low: int, high: int) -> Pairs:
        """The pairs that overlap grid points *low* to *high*."""
        part = slice(int(np.searchsorted(self.stop, low)), int(np.searchsorted(self.base, high, side="right")))
        return Pairs(self.step, self.pair[part], self.base[part], self.rest[part], self.first[part], self.second[part], self.stop[part])


@dataclass(frozen=True, slots=True, eq=False)
class Timeline:
    """Lines one after another on one axis of frames, with rest between them, so that they are played as one.

    A run is a stretch of speech with control points (cells) of its own. It is anchored on the frame at or before its
    first sound: there stand its cell *cell* and the axis' frame *frame*; its cells are *low* to *high*, its frames begin
    at *first_frame*. *pairs* stand on the cells. Frame 0 of each line stands at *origin* on the axis of *axis* frames;
    *frames* were asked for.
    """

    rate: Rate
    pairs: Pairs
    cell: Ints
    frame: Ints
    first_frame: Ints
    low: Ints
    high: Ints
    origin: Ints
    frames: Ints
    axis: int

    def cells(self, frames: Ints) -> tuple[Ints, Floats]:
        """The cell at or before each of *frames* of the axis, and how far on (0..1) to the next one the frame is."""
        if not len(self.cell):
            return np.zeros_like(frames), np.zeros(len(frames))
        run = np.maximum(np.searchsorted(self.first_frame, frames, side="right") - 1, 0)
        whole, rest = np.divmod((frames - self.frame[run]) * self.rate.frame, self.rate.control)
        return np.clip(whole + self.cell[run], self.low[run] + 1, self.high[run] - 3), rest / self.rate.control

    def seconds(self, cells: Ints) -> Floats:
        """When each of *cells* is, for a timeline of one line."""
        run = np.maximum(np.searchsorted(self.low, cells, side="right") - 1, 0)
        units = (self.frame[run] - self.origin[0]) * self.rate.frame + (cells - self.cell[run]) * self.rate.control
        seconds: Floats = units / self.rate.second
        return seconds

    def nearest_frames(self, cells: Ints) -> Ints:
        """The frame of the axis nearest to each of *cells*."""
        if not len(self.cell):
            return np.zeros_like(cells)
        run = np.maximum(np.searchsorted(self.low, cells, side="right") - 1, 0)
        units = (cells - self.cell[run]) * self.rate.control
        return self.frame[run] + (2 * units + self.rate.frame) // (2 * self.rate.frame)


def lay(table: CurveTable, lines: Sequence[Line], *, fps: float, frames: Sequence[int] | None, window: float, slowest: float) -> Timeline:
    """Lay *lines* on one axis of *fps* frames a second.

    *frames* asked for of each line; without it, up to the first frame at or after the end of speech and rest. Between
    lines lies rest enough that none reaches another: valleys are filled within *window* seconds, and peaks spread by
    one over *slowest* seconds. Raises `InputError`, `ScheduleError` and `CurveError`.
    """
    rate = rate_of(fps)
    edges, phone, sizes = flat(table, lines)
    tail = sizes.cumsum() + np.arange(len(sizes))
    head = tail - sizes
    left, right, first, second = _borders(edges, phone, head, tail)
    at = _runs(rate, edges, left, right, head)
    for length in (edges, first, second):
        length *= rate.microsecond
    asked = _asked(rate, edges[tail] + second[tail], frames)
    anchor = edges[at + (right[at] == 0)] // rate.frame
    count = np.concatenate((at[1:], [len(edges)])) - at
    begin = edges - first
    begin -= (anchor * rate.frame).repeat(count)
    finish = (begin + first + second)[at + count - 1]
    begins, line = begin[at], head.searchsorted(at, side="right") - 1
    pad = 1 + math.ceil(max(window * CONTROL_RATE / 2, CONTROL_RATE / slowest + 2))  # held, limited and splined
    low, high = begins // rate.control - pad, _up(finish, rate.control) + pad + 1
    low_frame, high_frame = low + anchor, high + anchor
    if not rate.on_grid:
        pad = 2 + math.ceil(pad * fps / CONTROL_RATE + fps / slowest)  # raised and limited once more
        low_frame, high_frame = begins // rate.frame + anchor - pad, _up(finish, rate.frame) + anchor + pad + 1
    first_frame, last_frame = np.zeros_like(asked), asked.copy()
    np.minimum.at(first_frame, line, low_frame)
    np.maximum.at(last_frame, line, high_frame)
    last_frame -= first_frame
    origin = last_frame.cumsum() - last_frame - first_frame
    frame = origin[line] + anchor
    cell = frame if rate.on_grid else (high - low).cumsum() - high
    whole, rest = np.divmod(begin, rate.control)
    whole += cell.repeat(count)
    stop = whole + _up(rest + first + second, rate.control)
    left *= len(table.phones)
    left += right
    pairs = Pairs(rate.control, left, whole, rest, first, second, stop)
    shares = frame - anchor + _shares(low_frame, high_frame, line)
    return Timeline(rate, pairs, cell, frame, shares, cell + low, cell + high, origin, asked, int(last_frame.sum()))


def _borders(edges: Ints, phone: Ints, head: Ints, tail: Ints) -> tuple[Ints, Ints, Ints, Ints]:
    """The phones before and after every edge, and how much of each belongs to their pair (microseconds).

    Before the first edge of a line, *head*, and after its last one, *tail*, comes rest, where there is no silence already.
    """
    inner = np.ones(len(edges), dtype=bool)
    inner[tail] = False
    start = inner.nonzero()[0]
    end = start + 1
    length = edges[end] - edges[start]
    np.minimum(length, REST, out=length, where=phone == 0)
    left, right, first, second = np.zeros((4, len(edges)), dtype=np.int64)
    left[end], first[end] = phone, length
    right[start], second[start] = phone, length
    first[head], second[tail] = REST * (right[head] != 0), REST * (left[tail] != 0)
    return left, right, first, second


def _runs(rate: Rate, edges: Ints, left: Ints, right: Ints, head: Ints) -> Ints:
    """The first pair of each run: of each line, and after long pauses where frames do not fall on one grid of cells."""
    if rate.aligned:
        return head
    opens = (left == 0) & (right != 0)
    opens[1:] &= edges[1:] - edges[:-1] >= SPLIT
    opens[head] = True
    runs: Ints = opens.nonzero()[0]
    return runs


def _asked(rate: Rate, end: Ints, frames: Sequence[int] | None) -> Ints:
    """How many frames each line gets, which ends at *end* units. Raises `ScheduleError`."""
    if frames is None:
        return np.maximum(_up(end, rate.frame) + 1, 0)
    asked = np.array(frames, dtype=np.int64)
    if len(asked) != len(end) or (asked < 0).any():
        raise ScheduleError(f"{asked.min(initial=0)} frames asked for in {len(asked)} of {len(end)} lines; ask for 0 or more in each")
    return asked


def _shares(begin: Ints, end: Ints, line: Ints) -> Ints:
    """The first frame of each run: where its line begins, or halfway through the rest after the run before."""
    if len(line) == line[-1] + 1:  # a run a line
        return begin
    first = begin.copy()
    inner = (line[1:] == line[:-1]).nonzero()[0] + 1
    first[inner] = (end[inner - 1] + begin[inner]) // 2
    return first


def _up(units: Ints, step: int) -> Ints:
    """How many whole steps reach *units*, rounded up."""
    return (units + (step - 1)) // step
