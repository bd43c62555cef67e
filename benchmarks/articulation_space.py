"""The numbers of targets/ and timing/ that a recording may change, as one vector, each with how far it may stray."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from lipdb.curves.generate import Targets
from lipdb.schedule import SILENCE

Floats = NDArray[np.float64]

MEASURED = ("open", "W", "wide", "ShCh")
"""Poses that change the opening or the width of the mouth; the tongue and closed lips can't be learned from those."""
CLOSING = ("PBM", "FV")
"""They change the opening too, but how they close is decided by what must hold (docs/curves.md), not by a fit."""
WIDEST_OPEN = 0.5
"""The constraints of the pose set let the jaw open no further (constraints/facefx.tsv)."""
LIMITS = {
    ("sh", "ShCh", "target"): (0.45, 1.0),
    ("w", "W", "target"): (0.75, 1.0),
    ("ow", "W", "target"): (0.5, 1.0),
    ("ow", "W", "glide"): (0.6, 1.0),
    ("ao", "W", "target"): (0.45, 1.0),
    ("aw", "W", "glide"): (0.4, 1.0),
    ("z", "open", "target"): (0.0, 0.18),
    ("sh", "open", "target"): (0.0, 0.12),
}
"""What must be seen whatever one speaker does: a funnel for sh, round lips for who, teeth nearly shut for a hiss.

Opening and width of the lips don't tell a jaw that drops from lips that part.
"""


@dataclass(frozen=True)
class Number:
    """One tunable number: where it stands (*field*, phone, pose), its start, how far it strays (*sd*), and its limits."""

    field: str
    phone: int
    pose: int
    start: float
    sd: float
    low: float
    high: float


class Space:
    """The tunable numbers of *start* for the phones that a recording has (*heard*)."""

    def __init__(self, start: Targets, heard: Sequence[str]) -> None:
        self.start = start
        self.numbers: list[Number] = []
        for n, phone in enumerate(start.phones):
            if phone == SILENCE or phone in heard:
                self._of_phone(n, phone)
        self.x0, self.sd, self.low, self.high = (
            np.array([getattr(number, name) for number in self.numbers]) for name in ("start", "sd", "low", "high")
        )

    def _of_phone(self, n: int, phone: str) -> None:
        for pose in MEASURED:
            self._of_pose(n, self.start.poses.index(pose), phone, pose)
        for field in ("lead", "release"):
            self._add(field, n, 0, float(getattr(self.start, field)[n]), 0.35, 0.1, 2.0)

    def _of_pose(self, n: int, p: int, phone: str, pose: str) -> None:
        target, glide = float(self.start.target[n, p]), float(self.start.glide[n, p])
        moved = max(target, glide) > 0
        if phone != SILENCE and (phone, pose) != ("bmp", "open") and (moved or pose != "ShCh"):
            high = WIDEST_OPEN if pose == "open" else 1.0
            # A pose that articulation does not ask for may show a little, no more.
            sd = 0.15 if moved or pose == "open" else 0.06
            self._add("target", n, p, target, sd, *LIMITS.get((phone, pose, "target"), (0.0, high)))
            if glide != target:
                self._add("glide", n, p, glide, sd, *LIMITS.get((phone, pose, "glide"), (0.0, high)))
        if pose != "ShCh":
            self._add("insistence", n, p, float(np.log(self.start.insistence[n, p])), 0.7, -3.0, 3.0)
            for field in ("before", "after"):
                self._add(field, n, p, float(getattr(self.start, field)[n, p]), 0.08, -0.4, 0.4)

    def _add(self, field: str, n: int, p: int, start: float, sd: float, low: float, high: float) -> None:
        self.numbers.append(Number(field, n, p, start, sd, low, high))

    def targets(self, x: Floats) -> Targets:
        """The targets with the numbers *x*; a phone that did not glide before does not glide now."""
        names = ("target", "glide", "insistence", "before", "after", "lead", "release")
        fields = {name: getattr(self.start, name).copy() for name in names}
        for number, value in zip(self.numbers, x, strict=True):
            at = number.phone if number.field in ("lead", "release") else (number.phone, number.pose)
            if number.field == "target" and self.start.target[at] == self.start.glide[at]:
                fields["glide"][at] = value
            fields[number.field][at] = np.exp(value) if number.field == "insistence" else value
        return replace(self.start, **fields)
