"""A curve's keys as text: ``0:0 0.25:0.8 1:0``, normalised time and weight, at most three decimals."""

from __future__ import annotations

import math
from collections.abc import Iterable

from lipdb.errors import CurveError

Keys = tuple[tuple[float, float], ...]
DECIMALS = 3


def _number(value: float) -> str:
    return f"{value:.{DECIMALS}f}".rstrip("0").rstrip(".") or "0"


def format_keys(keys: Iterable[tuple[float, float]]) -> str:
    """The canonical text of *keys*; empty for the empty curve, which means zero."""
    return " ".join(f"{_number(time)}:{_number(abs(weight))}" for time, weight in keys)


def parse_keys(text: str) -> Keys:
    """The keys that *text* names.

    Raises `CurveError` unless times lie in 0..1 and never run backwards, and weights lie in 0..1. Two keys may share a
    time: the curve steps there.
    """
    keys: list[tuple[float, float]] = []
    for word in text.split():
        time_text, colon, weight_text = word.partition(":")
        try:
            time, weight = float(time_text), float(weight_text)
        except ValueError:
            colon = ""
        if not colon:
            raise CurveError(f"key {word!r} is not time:weight; write for example 0.25:0.8")
        for what, value in (("time", time), ("weight", weight)):
            if not math.isfinite(value) or not 0 <= value <= 1:
                raise CurveError(f"key {word!r}: {what} {value:g} is not between 0 and 1")
        if keys and time < keys[-1][0]:
            raise CurveError(f"key {word!r} comes before the key in front of it ({keys[-1][0]:g}); sort the keys by time")
        keys.append((time, weight))
    return tuple(keys)
