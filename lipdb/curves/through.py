"""Curves of one pose set carried over to another through links: each pose's weight, scaled, bent, summed or the largest."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal

from lipdb.curves.curve import Curve
from lipdb.curves.keys import DECIMALS, Keys, format_keys, parse_keys

Line = list[tuple[float, float]]


@dataclass(frozen=True, slots=True)
class Link:
    """How one pose moves one shape: bend its weight by *curve* (if any), multiply by *gain*, then sum or take the largest."""

    pose: str
    shape: str
    gain: float
    combine: Literal["sum", "max"]
    curve: Keys

    def to_row(self) -> dict[str, str]:
        """Plain text cells for a listing."""
        return {"pose": self.pose, "shape": self.shape, "gain": f"{self.gain:g}", "combine": self.combine, "curve": format_keys(self.curve)}


def link_from_row(row: Mapping[str, str]) -> Link:
    """The link that *row* of a links table holds."""
    return Link(row["pose"], row["shape"], float(row["gain"]), "max" if row["combine"] == "max" else "sum", parse_keys(row["curve"]))


def carried(links: Sequence[Link], curves: Mapping[str, Curve]) -> Curve:
    """The curve of one shape, from the *links* that lead to it and one pair's *curves* by pose. Weights stay in 0..1.

    Straight lines stay straight: keys are added wherever a bend, a crossing or a border of 0..1 lies between two. All
    times count from border to border; a curve drawn for the linear warp is taken as for two phones of equal length.
    """
    sums: Line = []
    largest: Line = []
    for link in links:
        line = list(curves[link.pose].keys) if link.pose in curves else []
        if not any(weight for _, weight in line) or not link.gain:
            continue
        scaled = [(time, link.gain * weight) for time, weight in _bent(line, link.curve)]
        if link.combine == "max":
            largest = _joined(largest, scaled, max)
        else:
            sums = _joined(sums, scaled, float.__add__)
    both = _joined(sums, largest, max) if sums and largest else sums or largest
    clipped = [(time, min(1.0, max(0.0, weight))) for time, weight in _crossed(both, (0.0, 1.0))]
    return Curve(_rounded(clipped), "border", "generated", "links", "Apache-2.0")


def _bent(line: Line, bend: Keys) -> Line:
    """*line* with its weights sent through the piecewise linear *bend*, which holds its end values outside its keys."""
    if not bend:
        return line
    return [(time, _hold(bend, weight)) for time, weight in _crossed(line, [at for at, _ in bend])]


def _hold(keys: Keys, x: float) -> float:
    i = bisect_right(keys, x, key=lambda key: key[0])
    if i in (0, len(keys)):
        return keys[min(i, len(keys) - 1)][1]
    (x0, y0), (x1, y1) = keys[i - 1], keys[i]
    return y0 + (y1 - y0) * (x - x0) / (x1 - x0)


def _crossed(line: Line, levels: Sequence[float]) -> Line:
    """*line* with a key added wherever it crosses one of *levels*."""
    crossed = line[:1]
    for (t0, w0), (t1, w1) in pairwise(line):
        inside = [(level - w0) / (w1 - w0) for level in levels if min(w0, w1) < level < max(w0, w1)]
        crossed += [(t0 + (t1 - t0) * part, w0 + (w1 - w0) * part) for part in sorted(inside)]
        crossed.append((t1, w1))
    return crossed


def _joined(one: Line, other: Line, join: Callable[[float, float], float]) -> Line:
    """Two lines joined weight by weight; each is 0 outside its keys, and may step where two of its keys share a time."""
    if not one or not other:
        return one or other
    times = sorted({time for time, _ in one + other})
    gaps = list(pairwise(times))
    if join is max:
        gaps = [piece for gap in gaps for piece in _split(one, other, gap)]
    joined: Line = []
    for t0, t1 in gaps:
        for time in (t0, t1):
            joined.append((time, join(_inside(one, time, (t0, t1)), _inside(other, time, (t0, t1)))))
    return [key for n, key in enumerate(joined) if not n or key != joined[n - 1]]


def _split(one: Line, other: Line, gap: tuple[float, float]) -> list[tuple[float, float]]:
    """*gap* in two where the lines cross inside it."""
    before, after = (_inside(one, time, gap) - _inside(other, time, gap) for time in gap)
    if before * after >= 0:
        return [gap]
    cut = gap[0] + (gap[1] - gap[0]) * before / (before - after)
    return [(gap[0], cut), (cut, gap[1])]


def _inside(line: Line, time: float, gap: tuple[float, float]) -> float:
    """The weight at *time*, an end of *gap*, seen from within *gap*: no key of the line lies between the ends."""
    middle = (gap[0] + gap[1]) / 2
    i = bisect_right(line, middle, key=lambda key: key[0])
    if i in (0, len(line)):
        return 0.0
    (t0, w0), (t1, w1) = line[i - 1], line[i]
    return w0 + (w1 - w0) * (time - t0) / (t1 - t0)


def _rounded(line: Line) -> Keys:
    keys = [(round(time, DECIMALS), round(weight, DECIMALS)) for time, weight in line]
    return tuple(key for n, key in enumerate(keys) if not n or key != keys[n - 1]) if any(weight for _, weight in keys) else ()
