"""What the engine's tests share: pose sets, curve tables and schedules, invented and random, and the plain definition.

`plain_track` is the engine's definition written down as directly as can be, frame by frame and pair by pair, for
60 frames a second: slow, and independent of the engine's own code.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise, product

import numpy as np
from hypothesis import strategies as st

from lipdb.engine import CurveTable
from lipdb.poses import PoseSet

RATES = (24.0, 25.0, 30.0, 48.0, 50.0, 60.0, 120.0, 23.976, 29.97, 24000 / 1001)
POSES = ("open", "W", "ShCh", "PBM", "FV", "wide", "tBack", "tRoof", "tTeeth")
PHONES = ("_", "bmp", "f", "sh", "w", "ah", "ih", "d", "kg")


@dataclass(frozen=True)
class Drawn:
    """A curve for the tests."""

    keys: tuple[tuple[float, float], ...]
    warp: str = "border"


def pose_set(poses=POSES, *, priority=None, speed=15.0, must=("PBM", "FV"), limits=None, window=0.18, name="facefx"):
    """A pose set with facefx's rules unless told otherwise."""
    ranks = {"open": 1, "W": 2, "wide": 3, "ShCh": 4, "FV": 5, "PBM": 6} if priority is None else priority
    limits = {("open", "FV"): 0.5, ("open", "PBM"): 0.5, ("open", "ShCh"): 0.5} if limits is None else limits
    threshold = np.full((len(poses), len(poses)), 2.0)
    for (a, b), value in limits.items():
        if a in poses and b in poses:
            threshold[poses.index(a), poses.index(b)] = threshold[poses.index(b), poses.index(a)] = value
    speeds = np.broadcast_to(np.asarray(speed, dtype=float), len(poses)).copy()
    return PoseSet(name, tuple(poses), tuple(ranks.get(p) for p in poses), speeds, np.array([p in must for p in poses]), threshold, window)


TARGETS = {
    "bmp": {"PBM": 1.0},
    "f": {"FV": 0.95},
    "sh": {"ShCh": 0.9},
    "w": {"W": 0.9, "open": 0.2},
    "ah": {"open": 0.9},
    "ih": {"open": 0.35, "wide": 0.6},
    "d": {"tRoof": 0.8, "open": 0.15},
    "kg": {"tBack": 0.8, "open": 0.25},
    "_": {},
}


def articulated(phones=PHONES, poses=POSES) -> CurveTable:
    """Curves as an artist might draw them: up to each phone's target in its middle, and down again."""
    curves = {}
    for a, b, pose in product(phones, phones, poses):
        first, second = TARGETS[a].get(pose, 0.0), TARGETS[b].get(pose, 0.0)
        keys = ((0.05, 0.0), (0.2, first), (0.3, first), (0.45, min(first, second)), (0.65, second), (0.8, second), (0.95, 0.0))
        if pose in ("PBM", "FV"):  # lips touch in the middle of the phone, and are apart at its borders
            keys = ((0.1, 0.0), (0.25, first), (0.4, 0.0), (0.6, 0.0), (0.75, second), (0.9, 0.0))
        if (first or second) and (a, b) != ("_", "_"):
            curves[a, b, pose] = Drawn(keys)
    return CurveTable.build(phones, poses, curves)


@st.composite
def worlds(draw, *, must=True):
    """A random pose set and a random table of curves for it."""
    rng = np.random.default_rng(draw(st.integers(0, 2**32)))
    poses = tuple(f"pose{i}" for i in range(draw(st.integers(1, 5))))
    ranks = {p: int(r) for p, r in zip(poses, rng.permutation(len(poses)) + 1, strict=True) if rng.random() < 0.7}
    held = tuple(p for p in poses if must and rng.random() < 0.4)
    limits = {pair: round(float(rng.uniform(0, 2)), 2) for pair in product(poses, poses) if pair[0] < pair[1] and rng.random() < 0.6}
    speed = rng.choice([4.0, 8.0, 15.0, 15.0, 40.0, 150.0], len(poses))
    window = float(rng.choice([0.0, 0.1, 0.18, 0.3]))
    rules = pose_set(poses, priority=ranks, speed=speed, must=held, limits=limits, window=window, name="own")
    phones = ("_", *"abcd"[: draw(st.integers(1, 4))])
    return rules, random_table(rng, phones, poses, held)


def random_table(rng, phones, poses, held=()) -> CurveTable:
    """Random keys, steps among them; pairs with silence are at rest where silence is, must-reach poses seldom used."""
    curves = {}
    for a, b, pose in product(phones, phones, poses):
        if (a, b) == ("_", "_") or rng.random() < (0.6 if pose in held else 0.25):
            continue
        # Odd thousandths, so that no key falls halfway between two frames: which of them takes it is a matter of rounding.
        size = rng.integers(1, 7)
        times = np.sort(np.where(rng.random(size) < 0.3, rng.integers(0, 3, size) / 2, rng.integers(0, 500, size) / 500 + 0.001))
        weights = np.round(rng.uniform(0, 1, len(times)) ** 0.5, 3)
        weights[(times <= 0.1) if a == "_" else (times < 0)] = 0
        weights[(times >= 0.9) if b == "_" else (times < 0)] = 0
        keys = tuple(zip(times.tolist(), weights.tolist(), strict=True))
        curves[a, b, pose] = Drawn(keys, "linear" if rng.random() < 0.2 else "border")
    return CurveTable.build(phones, poses, curves)


@st.composite
def schedules(draw, phones, *, size=20, start=None):
    """Edges and phones: short, long and very long ones, pauses anywhere, also side by side."""
    rng = np.random.default_rng(draw(st.integers(0, 2**32)))
    names = draw(st.lists(st.sampled_from(phones), min_size=1, max_size=size))
    kinds = np.array([7, 30, 80, 120, 250, 1500])
    lengths = rng.choice(kinds, len(names), p=[0.08, 0.2, 0.3, 0.25, 0.12, 0.05]) * rng.uniform(500, 1500, len(names))
    first = int(rng.integers(0, 400_000)) if start is None else start
    edges = first + np.concatenate(([0], np.cumsum(np.maximum(lengths.astype(int), 1))))
    if rng.random() < 0.4:  # borders on frames
        edges = np.unique(edges // 50_000) * 50_000
        edges = np.append(edges, edges[-1] + 50_000 * np.arange(1, len(names) + 2 - len(edges)))
    return edges.tolist(), names


def broken(weights, rules: PoseSet, fps: float) -> list[str]:
    """Which promises *weights* break, in words; none is what the tests want."""
    found = []
    if weights.size and (weights.min() < 0 or weights.max() > 1):
        found.append(f"range {weights.min()}..{weights.max()}")
    for i, pose in enumerate(rules.poses):
        if len(weights) > 1 and (fast := float(np.abs(np.diff(weights[:, i])).max()) * fps - rules.speed[i]) > 1e-9 * fps:
            found.append(f"{pose} is too fast by {fast}")
        for j, limit in rules.bounds(i):
            over = float((weights[:, i] - np.maximum(0, limit - weights[:, j])).max(initial=0))
            if over > 1e-9:
                found.append(f"{pose} breaks its constraint with {rules.poses[j]} by {over}")
    return found


def polygons(table: CurveTable, edges, phones):
    """Keys in seconds of every pair and pose: ``[(pose, times, weights)]``, straight from the definition."""
    spans = [[e0, e1, p] for (e0, e1), p in zip(pairwise(edges), phones, strict=True)]
    for i in range(len(spans) - 1, 0, -1):
        if spans[i][2] == spans[i - 1][2] == "_":
            spans[i - 1][1] = spans.pop(i)[1]
    if spans[0][2] != "_":
        spans.insert(0, [spans[0][0] - 250_000, spans[0][0], "_"])
    if spans[-1][2] != "_":
        spans.append([spans[-1][1], spans[-1][1] + 250_000, "_"])
    drawn = []
    for (s0, e0, a), (s1, e1, b) in pairwise(spans):
        first = min(e0 - s0, 250_000) if a == "_" else e0 - s0
        second = min(e1 - s1, 250_000) if b == "_" else e1 - s1
        number = table.number[a] * len(table.phones) + table.number[b]
        strips = np.arange(table.first[number], table.first[number + 1])
        for pose in np.unique(table.pose[strips]):
            own = strips[table.pose[strips] == pose]
            left, right, weight = (keys[:, own].T.ravel() for keys in (table.left, table.right, table.weight))
            drawn.append((int(pose), (e0 - first + left * first + right * second) / 1e6, weight))
    return drawn, [(s / 1e6, e / 1e6, p) for s, e, p in spans]


def at_times(drawn, poses: int, times):
    """The largest curve of each pose at *times* (s), shape ``(P, T)``; a time on a border belongs to both sides."""
    out = np.zeros((poses, len(times)))
    for pose, xs, ys in drawn:
        inside = (times >= xs[0] - 1e-12) & (times <= xs[-1] + 1e-12)
        out[pose, inside] = np.maximum(out[pose, inside], np.round(np.interp(times[inside], xs, ys) * 2**33) / 2**33)
        for x, y in zip(xs, ys, strict=True):  # both sides of a step
            on = np.abs(times - x) < 1e-12
            out[pose, on] = np.maximum(out[pose, on], y)
    return out


def plain_track(table: CurveTable, rules: PoseSet, edges, phones, frames: int):
    """The definition of the engine at 60 frames a second, step by step and slowly, shape ``(frames, P)``."""
    lead = 240
    drawn, spans = polygons(table, edges, phones)
    count = frames + 2 * lead + int((edges[-1] - edges[0]) * 60 / 1e6)
    grid = np.array([float(Fraction(k - lead, 60)) for k in range(count)])
    weights = at_times(drawn, len(rules.poses), grid)
    for pose in np.flatnonzero(rules.must_reach):
        for own, xs, ys in drawn:
            if own == pose:
                np.maximum.at(weights[pose], np.floor(xs * 60 + 0.5).astype(int) + lead, ys)
    shut = {p for p in table.phones if table.closing[rules.must_reach, table.number[p]].any()}
    for pose in range(len(weights)):
        opened = [(s, e) for s, e, p in spans if p not in shut] if rules.must_reach[pose] else []
        opened += [(-np.inf, spans[0][0])] if rules.must_reach[pose] else []
        weights[pose] = _plain_smooth(weights[pose], rules.window * 60, [((s * 60) + lead, (e * 60) + lead) for s, e in opened])
    points: dict[int, np.ndarray] = {}
    done: dict[int, np.ndarray] = {}
    for pose in rules.descending:
        w = points[pose] = _plain_control(weights[pose], pose, points, rules)
        done[pose] = w.copy()
        done[pose][1:-1] = (w[:-2] + 4 * w[1:-1] + w[2:]) / 6
    for pose in rules.descending:
        for j, limit in rules.bounds(pose):
            done[pose] = np.minimum(done[pose], np.maximum(0, limit - done[j]))
        if not rules.must_reach[pose]:
            done[pose] = _plain_limit(done[pose], rules.speed[pose] / 60, up=False)
    return np.array([done[p][lead : lead + frames] for p in range(len(rules.poses))]).T


def _plain_smooth(w, window, opened):
    """Fill what lies between neighbouring peaks closer than the window, unless an opened phone overlaps it."""
    levels = [0, *(np.flatnonzero(np.diff(w)) + 1).tolist(), len(w)]
    runs = [(a, b - 1, w[a]) for a, b in pairwise(levels)]
    out = w.copy()
    begin = None
    for k in range(1, len(runs) - 1):
        first, last, value = runs[k]
        long = last - first >= window
        falls, rises = runs[k + 1][2] < value, runs[k - 1][2] < value
        if begin is not None and rises and (falls or long):
            if first - begin < window and not any(s < first - 1e-9 and e > begin + 1e-9 for s, e in opened):
                line = np.interp(np.arange(begin, first + 1), [begin, first], [w[begin], value])
                out[begin : first + 1] = np.maximum(out[begin : first + 1], line)
            begin = None
        if falls and (rises or long):
            begin = last
    return out


def _plain_control(w, pose, done, rules):
    """Control points of one pose, those of the poses above it *done*."""
    most = rules.speed[pose] / 60
    if rules.must_reach[pose]:
        wide = w.copy()
        for first, last in _plateaus(w):
            sides = [first - 1, last + 1]
            if last - first == 1:
                sides = [max(sides, key=lambda k: w[k])]
            for k in sides if last - first < 2 else ():
                wide[k] = max(wide[k], w[first])
        w = wide
    for j, limit in rules.bounds(pose):
        w = np.minimum(w, np.maximum(0, limit - done[j]))
    return _plain_limit(w, most, up=bool(rules.must_reach[pose]))


def _plain_limit(w, most, *, up):
    w, n = w.copy(), len(w)
    for k, before in [*zip(range(1, n), range(n - 1), strict=True), *zip(range(n - 2, -1, -1), range(n - 1, 0, -1), strict=True)]:
        w[k] = max(w[k], w[before] - most) if up else min(w[k], w[before] + most)
    return w


def _plateaus(w):
    """First and last point of every peak."""
    levels = [0, *(np.flatnonzero(np.diff(w)) + 1).tolist(), len(w)]
    runs = list(pairwise(levels))
    for (_, before), (first, after), (_, _) in zip(runs, runs[1:], runs[2:], strict=False):
        if w[before - 1] < w[first] > w[after]:
            yield first, after - 1
