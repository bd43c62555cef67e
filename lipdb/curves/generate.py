"""Pair curves from articulation: what each phone wants of each pose, how strongly, how early and how late.

A pair's curve runs from the left phone's target to the right phone's. The way from one to the other starts *lead* (of
the right phone) before the border and ends *release* (of the left phone) after it; the phone that insists more on the
pose gives up less of its own time. Pairs are joined by maximum, so each pair speaks for the half of a phone next to its
own border, where it knows both phones, and falls away to zero in the outer half, where the other pair knows more.
There is no term that belongs to one pair alone, so pairs that nobody ever recorded are as good as the rest.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from itertools import pairwise, product
from typing import Self

import numpy as np
from numpy.typing import NDArray

from lipdb.curated.tsv import Records, Rows
from lipdb.curves.curve import Curve, CurveKey
from lipdb.curves.keys import DECIMALS, Keys
from lipdb.errors import CurveError
from lipdb.schedule import SILENCE

Array = NDArray[np.float64]
Source = tuple[str, str]
"""Name of a source and its licence."""

LEFT_MIDDLE, BORDER, RIGHT_MIDDLE = 0.25, 0.5, 0.75
HANDOVER = 0.15
"""Normalised time that a pair takes to fall silent past the middle of a phone, where the next pair takes over."""
SHORTEST = 0.04
"""Normalised time that any way from one target to another takes at least."""
NEGLIGIBLE = 0.05
"""A curve that stays below this weight is left out; no eye sees it."""
TOLERANCE = 0.03
"""Weight by which a line may miss a key that is left out."""
NUMBERS = ("target", "glide", "insistence", "before", "after")
OWN: Source = ("lipdb", "Apache-2.0")


@dataclass(frozen=True, slots=True, eq=False)
class Targets:
    """Parameters of *phones* (N) over *poses* (P).

    *target* and *glide*, shape (N, P), 0..1: where the phone starts to be and where it ends (they differ for
    diphthongs). *insistence*, shape (N, P), above 0: how strongly it wants that. *before* and *after*, shape (N, P): what
    it adds to the target of the phone before and of the phone after it. *lead* and *release*, shape (N,): how far it
    reaches into a neighbour before its start and after its end; 1 is all of a neighbour that insists on nothing.
    *must_reach*, shape (P,): poses whose targets are reached by the middle of the phone, whoever stands beside it.
    *sources* names source and licence of the numbers by phone and pose (no pose: of lead and release).
    """

    phones: tuple[str, ...]
    poses: tuple[str, ...]
    target: Array
    glide: Array
    insistence: Array
    before: Array
    after: Array
    lead: Array
    release: Array
    must_reach: NDArray[np.bool_]
    sources: Mapping[tuple[str, str], Source] = field(default_factory=dict)

    @classmethod
    def from_records(cls, records: Records, pose_set: str) -> Self:
        """The parameters of *pose_set*: targets/ and timing/. Phones without timing are left out; a missing pose is 0.

        Raises `CurveError` for numbers out of range.
        """
        rows = records.get(f"targets/{pose_set}.tsv", {})
        timing = {phone: row for (phone,), row in records.get(f"timing/{pose_set}.tsv", {}).items()}
        phones = tuple(sorted({phone for phone, _ in rows} & timing.keys()))
        poses = tuple(sorted({pose for _, pose in rows}))
        lead, release = (np.array([float(timing[phone][name]) for phone in phones]) for name in ("lead", "release"))
        held = {pose for (pose,), row in records.get(f"poses/{pose_set}.tsv", {}).items() if row["must_reach"] == "yes"}
        must_reach = np.array([pose in held for pose in poses], dtype=bool)
        sources = {(row["phone"], row.get("pose", "")): (row["source"], row["licence"]) for row in (*rows.values(), *timing.values())}
        numbers = _numbers(rows, phones, poses)
        targets = cls(phones, poses, **numbers, lead=lead, release=release, must_reach=must_reach, sources=sources)
        targets.check(pose_set)
        return targets

    def check(self, pose_set: str) -> None:
        """Raise `CurveError` for the first number that is out of range."""
        bad = (self.target < 0) | (self.target > 1) | (self.glide < 0) | (self.glide > 1) | (self.insistence <= 0)
        for n, p in np.argwhere(bad):
            raise CurveError(
                f"targets/{pose_set}.tsv: {self.phones[n]} {self.poses[p]}: target and glide must lie in 0..1, insistence above 0"
            )
        for n in np.flatnonzero((self.lead < 0) | (self.release < 0)):
            raise CurveError(f"timing/{pose_set}.tsv: {self.phones[n]}: lead and release can't be negative")


def _numbers(rows: Rows, phones: tuple[str, ...], poses: tuple[str, ...]) -> dict[str, Array]:
    """The columns of targets/ as arrays (N, P); what a row leaves out adds nothing, and a phone without glide stays."""
    numbers = np.zeros((len(NUMBERS), len(phones), len(poses)))
    numbers[NUMBERS.index("insistence")] = 1.0
    for (n, phone), (p, pose) in product(enumerate(phones), enumerate(poses)):
        if row := rows.get((phone, pose)):
            numbers[:, n, p] = [float(row[name] or (row["target"] if name == "glide" else 0)) for name in NUMBERS]
    return dict(zip(NUMBERS, numbers, strict=True))


def shapes(targets: Targets, left: NDArray[np.intp], right: NDArray[np.intp]) -> tuple[Array, Array]:
    """Key times and weights of the pairs *left* → *right* (indices into the phones, shape (M,)).

    Two arrays of shape (M, P, 7): silence, the left phone's middle, where the way starts, the border, where it ends,
    the right phone's middle, silence. Times never run backwards; weights lie in 0..1.
    """
    awake = np.array([phone != SILENCE for phone in targets.phones])[:, None]
    a = np.clip(targets.glide[left] + targets.before[right], 0, 1) * awake[left]
    b = np.clip(targets.target[right] + targets.after[left], 0, 1) * awake[right]
    share = targets.insistence[right] / (targets.insistence[left] + targets.insistence[right])
    start = np.clip(BORDER - targets.lead[right][:, None] * share / 2, 0, BORDER - SHORTEST / 2)
    end = np.clip(BORDER + targets.release[left][:, None] * (1 - share) / 2, BORDER + SHORTEST / 2, 1)
    start = np.where(targets.must_reach & (a > b), np.maximum(start, LEFT_MIDDLE), start)
    end = np.where(targets.must_reach & (b > a), np.minimum(end, RIGHT_MIDDLE), end)
    times = np.stack(
        [
            np.minimum(LEFT_MIDDLE - HANDOVER, start),
            np.full_like(a, LEFT_MIDDLE),
            np.maximum(start, LEFT_MIDDLE),
            np.full_like(a, BORDER),
            np.minimum(end, RIGHT_MIDDLE),
            np.full_like(a, RIGHT_MIDDLE),
            np.maximum(RIGHT_MIDDLE + HANDOVER, end),
        ],
        axis=-1,
    )
    way = np.clip((times - start[..., None]) / (end - start)[..., None], 0, 1)
    weights = a[..., None] + (b - a)[..., None] * way
    weights[..., 0] = weights[..., -1] = 0
    return times, weights


def thinned(times: Array, weights: Array) -> Keys:
    """Those of the keys that draw the line to `TOLERANCE`, since each key costs the engine time; none for a negligible curve.

    The key on the border stays: phones of unequal length bend the line there.
    """
    keys = [(round(float(t), DECIMALS), round(float(w), DECIMALS)) for t, w in zip(times, weights, strict=True)]
    if max(weight for _, weight in keys) < NEGLIGIBLE:
        return ()
    kept = [keys[0]]
    for here, after in pairwise(keys[1:]):
        if here == kept[-1]:
            continue
        (t0, w0), (t1, w1), (t2, w2) = kept[-1], here, after
        line = w0 + (w2 - w0) * (t1 - t0) / (t2 - t0) if t2 > t0 else w1 + 1
        if abs(w1 - line) > TOLERANCE or (t1 == BORDER and w0 != w2):
            kept.append(here)
    kept.append(keys[-1])
    first = next(n for n, (_, weight) in enumerate(kept) if weight)
    last = max(n for n, (_, weight) in enumerate(kept) if weight)
    return tuple(kept[max(first - 1, 0) : last + 2])


def generated(targets: Targets, pairs: list[tuple[str, str]]) -> Iterator[tuple[CurveKey, Keys]]:
    """The keys of every pose for each of *pairs*; empty keys where the pose stays at rest.

    Raises `CurveError` for a phone without targets.
    """
    index = {phone: n for n, phone in enumerate(targets.phones)}
    missing = sorted({phone for pair in pairs for phone in pair} - index.keys())
    if missing:
        raise CurveError(f"no targets for the common phone {missing[0]!r}; add its rows to targets/ and timing/")
    left, right = (np.array([index[pair[side]] for pair in pairs], dtype=np.intp) for side in (0, 1))
    times, weights = shapes(targets, left, right)
    for (m, pair), (p, pose) in product(enumerate(pairs), enumerate(targets.poses)):
        yield (*pair, pose), thinned(times[m, p], weights[m, p])


def all_pairs(phones: tuple[str, ...]) -> list[tuple[str, str]]:
    """Every ordered pair of *phones*, sorted; silence never follows silence."""
    ordered = sorted(phones)
    return [(left, right) for left in ordered for right in ordered if (left, right) != (SILENCE, SILENCE)]


def source_of(targets: Targets, key: CurveKey) -> Source:
    """Where the curve at *key* comes from: the first outside source of the numbers that it is made of, else our own."""
    left, right, pose = key
    used = [targets.sources.get(cell, OWN) for cell in ((left, pose), (right, pose), (left, ""), (right, ""))]
    return next((source for source in used if source != OWN), OWN)


def regenerate(
    targets: Targets, pairs: list[tuple[str, str]], old: Mapping[CurveKey, Curve], *, author: str, time: str
) -> dict[CurveKey, Curve]:
    """The curves of a table after making its generated ones again.

    Curves of any other origin stay as they are, and a generated one that comes out the same keeps its row, author and
    time included. Generated curves of pairs that are not among *pairs* are dropped.
    """
    curves = {key: curve for key, curve in old.items() if curve.origin != "generated"}
    for key, keys in generated(targets, pairs):
        if key in curves:
            continue
        new = Curve(keys, "border", "generated", *source_of(targets, key), author, time)
        before = old.get(key)
        curves[key] = before if before and _same(before, new) else new
    return curves


def _same(one: Curve, other: Curve) -> bool:
    return (one.keys, one.warp, one.source, one.licence) == (other.keys, other.warp, other.source, other.licence)
