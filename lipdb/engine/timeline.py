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
from itertools import chain
from operator import index

import numpy as np

from lipdb.engine.table import CurveTable, Floats, Ints
from lipdb.errors import CurveError, InputError, ScheduleError

CONTROL_RATE = 60
"""Control points of the B-spline a second: smoothing is fixed in time, whatever the frame rate."""
REST = 250_000
"""The most of a pause, in microseconds, that a pair with silence covers; also the silence put before and after speech."""
SPLIT = 1_000_000
"""Pauses this long, in microseconds, part a line into runs that each lay out their control points anew."""

Line = tuple[Sequence[int], Sequence[str]]
"""Edges in microseconds, one more than there are phones, and the common phones between them."""


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


@dataclass(frozen=True, eq=False)
class Timeline:
    """Lines one after another on one axis of frames, with rest between them, so that they are played as one.

    A run is a stretch of speech with control points (cells) of its own. It is anchored on the frame at or before its
    first sound: there stand its cell *cell* and the axis' frame *frame*; its cells are *low* to *high*, its frames begin at
    *first_frame*. Pair: number in the table, lengths of both phones and start after the anchor (units), run. Frame 0
    of each line stands at *origin* on the axis of *axis* frames; *frames* were asked for.
    """

    rate: Rate
    pair: Ints
    first_length: Ints
    second_length: Ints
    start: Ints
    run: Ints
    cell: Ints
    frame: Ints
    first_frame: Ints
    low: Ints
    high: Ints
    origin: Ints
    frames: Ints
    axis: int

    def pairs(self) -> Pairs:
        """The pairs on the grid of control points."""
        step = self.rate.control
        whole, rest = np.divmod(self.start, step)
        base = self.cell[self.run] + whole
        stop = base + _up(rest + self.first_length + self.second_length, step)
        return Pairs(step, self.pair, base, rest, self.first_length, self.second_length, stop)

    def cells(self, frames: Ints) -> tuple[Ints, Floats]:
        """The cell at or before each of *frames* of the axis, and how far on (0..1) to the next one the frame is."""
        if not len(self.cell):
            return np.zeros_like(frames), np.zeros(len(frames))
        run = np.maximum(np.searchsorted(self.first_frame, frames, side="right") - 1, 0)
        whole, rest = np.divmod((frames - self.frame[run]) * self.rate.frame, self.rate.control)
        return np.clip(whole + self.cell[run], self.low[run] + 1, self.high[run] - 3), rest / self.rate.control

    def nearest_frames(self, cells: Ints) -> Ints:
        """The frame of the axis nearest to each of *cells*."""
        if not len(self.cell):
            return np.zeros_like(cells)
        run = np.maximum(np.searchsorted(self.low, cells, side="right") - 1, 0)
        units = (cells - self.cell[run]) * self.rate.control
        return self.frame[run] + (2 * units + self.rate.frame) // (2 * self.rate.frame)


def _flat(table: CurveTable, lines: Sequence[Line]) -> tuple[Ints, Ints, Ints, Ints]:
    """Line number, phone number, start and end (µs) of every phone of *lines*. Raises errors for what can't be played."""
    sizes = np.fromiter((len(phones) for _, phones in lines), np.int64, len(lines))
    spans = np.fromiter((len(edges) for edges, _ in lines), np.int64, len(lines))
    if (spans != sizes + 1).any() or not sizes.all():
        bad = int(np.argmax((spans != sizes + 1) | (sizes == 0)))
        raise ScheduleError(
            f"line {bad}: {sizes[bad]} phones and {spans[bad]} edges; give at least one phone and one edge more than phones"
        )
    try:
        phone = np.fromiter(map(table.number.__getitem__, chain.from_iterable(phones for _, phones in lines)), np.int64, int(sizes.sum()))
    except KeyError as error:
        raise CurveError(f"the table of curves has no phone {error.args[0]!r}; build it with every phone of the schedule") from None
    edges = _whole([edges for edges, _ in lines], int(spans.sum()))
    line = np.repeat(np.arange(len(lines)), sizes)
    at = np.arange(len(phone)) + line
    start, end = edges[at], edges[at + 1]
    if (end <= start).any():
        bad = int(np.argmax(end <= start))
        raise ScheduleError(
            f"line {line[bad]}: a phone lasts from {start[bad]} to {end[bad]} µs; every phone must last a microsecond or more"
        )
    return line, phone, start, end


def _whole(parts: list[Sequence[int]], size: int) -> Ints:
    """All *parts* in one array. Raises `ScheduleError` for anything but whole numbers."""
    try:
        if parts and isinstance(parts[0], np.ndarray):
            return np.concatenate(parts).astype(np.int64, casting="safe")
        return np.fromiter(map(index, chain.from_iterable(parts)), np.int64, size)
    except TypeError:
        raise ScheduleError("edges must be whole microseconds; round(seconds * 1_000_000) gives them") from None


def _merged(line: Ints, phone: Ints, start: Ints, end: Ints) -> tuple[Ints, Ints, Ints, Ints]:
    """The same with neighbouring silences made one."""
    again = np.zeros(len(phone), dtype=bool)
    again[1:] = (phone[1:] == 0) & (phone[:-1] == 0) & (line[1:] == line[:-1])
    if not again.any():
        return line, phone, start, end
    kept = np.flatnonzero(~again)
    return line[kept], phone[kept], start[kept], end[np.append(kept[1:], len(phone)) - 1]


def _rested(line: Ints, phone: Ints, start: Ints, end: Ints) -> tuple[Ints, Ints, Ints, Ints]:
    """The same with a short silence before and after every line that has none there."""
    opens = np.append(True, line[1:] != line[:-1])
    closes = np.append(opens[1:], True)
    lead, trail = opens & (phone != 0), closes & (phone != 0)
    extra = lead.astype(np.int64) + trail
    if not extra.any():
        return line, phone, start, end
    at = np.arange(len(phone)) + np.cumsum(extra) - trail
    size = len(phone) + int(extra.sum())
    columns = [np.zeros(size, dtype=np.int64) for _ in range(4)]
    for column, values in zip(columns, (line, phone, start, end), strict=True):
        column[at] = values
    for where, step, low, high in ((lead, -1, start - REST, start), (trail, 1, end, end + REST)):
        there = at[where] + step
        columns[0][there], columns[2][there], columns[3][there] = line[where], low[where], high[where]
    return columns[0], columns[1], columns[2], columns[3]


def lay(table: CurveTable, lines: Sequence[Line], *, fps: float, frames: Sequence[int] | None, window: float, slowest: float) -> Timeline:
    """Lay *lines* on one axis of *fps* frames a second.

    *frames* asked for of each line; without it, up to the first frame at or after the end of speech and rest. Between
    lines lies rest enough that none reaches another: valleys are filled within *window* seconds, and peaks spread by
    one over *slowest* seconds. Raises `InputError`, `ScheduleError` and `CurveError`.
    """
    rate = rate_of(fps)
    line, phone, start, end = _rested(*_merged(*_flat(table, lines)))
    last = np.append(np.flatnonzero(line[1:] != line[:-1]), len(line) - 1)
    asked = np.maximum(_up(end[last] * rate.microsecond, rate.frame) + 1, 0) if frames is None else np.asarray(frames, dtype=np.int64)
    if (asked < 0).any() or len(asked) != len(lines):
        raise ScheduleError(f"{asked.min(initial=0)} frames asked for in {len(asked)} of {len(lines)} lines; ask for 0 or more in each")
    left = np.flatnonzero(line[1:] == line[:-1])
    length = np.where(phone == 0, np.minimum(end - start, REST), end - start) * rate.microsecond
    border, of_line = end[left] * rate.microsecond, line[left]
    opens = np.append(True, of_line[1:] != of_line[:-1])[: len(left)]
    if not rate.aligned:
        opens |= (phone[left] == 0) & (end[left] - start[left] >= SPLIT)
    at = np.flatnonzero(opens)
    run = np.cumsum(opens) - 1
    anchor = border[at] // rate.frame
    begin = border - length[left] - anchor[run] * rate.frame
    finish = begin + length[left] + length[left + 1]
    pad = 2 + math.ceil(max(window * CONTROL_RATE / 2, CONTROL_RATE / slowest + 3))
    pad_frames = 2 + math.ceil(max(window * fps / 2, fps / slowest + 3 + 3 * fps / CONTROL_RATE))
    tail = np.append(at[1:], len(left))[: len(at)] - 1
    low_frame, high_frame = begin[at] // rate.frame + anchor - pad_frames, _up(finish[tail], rate.frame) + anchor + pad_frames + 1
    first_frame, last_frame = np.zeros_like(asked), asked.copy()
    np.minimum.at(first_frame, of_line[at], low_frame)
    np.maximum.at(last_frame, of_line[at], high_frame)
    sizes = last_frame - first_frame
    origin = np.cumsum(sizes) - sizes - first_frame
    frame = origin[of_line[at]] + anchor
    low, high = begin[at] // rate.control - pad, _up(finish[tail], rate.control) + pad + 1
    cell = frame if rate.on_grid else np.cumsum(high - low) - high
    return Timeline(
        rate=rate,
        pair=phone[left] * len(table.phones) + phone[left + 1],
        first_length=length[left],
        second_length=length[left + 1],
        start=begin,
        run=run,
        cell=cell,
        frame=frame,
        first_frame=frame + _shares(low_frame, high_frame, of_line[at]) - anchor,
        low=cell + low,
        high=cell + high,
        origin=origin,
        frames=asked,
        axis=int(sizes.sum()),
    )


def _shares(begin: Ints, end: Ints, line: Ints) -> Ints:
    """The first frame of each run: where its line begins, or halfway through the rest after the run before."""
    first = begin.copy()
    inner = np.flatnonzero(line[1:] == line[:-1]) + 1
    first[inner] = (end[inner - 1] + begin[inner]) // 2
    return first


def _up(units: Ints, step: int) -> Ints:
    """How many whole steps reach *units*, rounded up."""
    return -(-units // step)
