"""Find the curve that wins: the most specific layer that has it, and always an answer.

Order: line, character, language, common; for a pose set of its own, facefx's curves through links; generated from the
two phones' targets; generated from the targets of the nearest phone by articulation. An explicit empty curve means
zero and ends the search. In each layer a pair of refined phones (`Kinds`) is asked for first and then the pairs that it
was split from, so whoever draws bmp draws for all kinds of bmp that nobody drew more closely in that layer.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from itertools import product
from typing import TYPE_CHECKING, Any, Self

from lipdb.curated.tsv import Records, Row
from lipdb.curves.curve import Curve, CurveKey, curve_from_row
from lipdb.curves.generate import Targets, generated, source_of
from lipdb.curves.through import Link, carried, link_from_row
from lipdb.errors import CurveError, PhonesetError
from lipdb.phones.refined import Kinds
from lipdb.poses import SHARED
from lipdb.schedule import SILENCE

if TYPE_CHECKING:
    from lipdb.engine.table import CurveTable

GENERATED, NEAREST = "generated", "nearest"
AT_REST = Curve((), origin="generated")


@dataclass(frozen=True, slots=True)
class Found:
    """The winning *curve* of a pair and pose, the *layer* and *pose_set* that it stands in, and in words why it won.

    *inherited* names the pair of coarser phones whose curve it is, such as ``("bmp", "ah")``; empty for a curve of its own.
    """

    curve: Curve
    layer: str
    pose_set: str
    reason: str
    inherited: tuple[str, ...] = ()

    @property
    def where(self) -> str:
        """The layer, and the coarser pair that the curve is inherited from, if it is."""
        return f"{self.layer} (from {'-'.join(self.inherited)})" if self.inherited else self.layer

    @property
    def fallback(self) -> bool:
        """Whether no table has the curve, so that it was made for the moment."""
        return self.layer.split()[0] in (GENERATED, NEAREST)


@dataclass(frozen=True, slots=True)
class Fallback:
    """A pair without a curve of its own for some *poses*: what stands in for it, and why."""

    left: str
    right: str
    poses: tuple[str, ...]
    layer: str
    reason: str


@dataclass(frozen=True, slots=True)
class Layer:
    """One layer's curves by left phone, right phone and pose; curated ones stay rows until they are asked for."""

    name: str
    curves: Mapping[Any, Curve | Row]


class CurveBook:
    """The winning curve of every pair of common phones and every pose of one pose set."""

    def __init__(
        self,
        pose_set: str,
        poses: tuple[str, ...],
        layers: tuple[Layer, ...],
        *,
        targets: Targets,
        common: Mapping[str, Row],
        base: CurveBook | None = None,
        links: tuple[Link, ...] = (),
    ) -> None:
        self.pose_set, self.poses = pose_set, poses
        self._layers, self._targets, self._common, self._base = layers, targets, common, base
        self._kinds = Kinds.from_common(common)
        self._links = {pose: tuple(link for link in links if link.shape == pose) for pose in poses}
        self._own_pairs = {(left, right) for layer in layers for left, right, _ in layer.curves} if base else set()
        self._found: dict[CurveKey, Found] = {}
        self._made: dict[tuple[str, str], dict[str, Curve]] = {}

    @classmethod
    def from_records(
        cls,
        records: Records,
        pose_set: str,
        *,
        language: str | None = None,
        character: str | None = None,
        line: Mapping[CurveKey, Curve] | None = None,
    ) -> Self:
        """The curves of *pose_set* through all layers; *line* holds the line's own.

        Raises `PhonesetError` for a pose set that there is not.
        """
        rows = records.get(f"poses/{pose_set}.tsv")
        if not rows:
            raise PhonesetError(f"no pose set {pose_set!r}; add poses/{pose_set}.tsv and its row in poses/sets.tsv")
        poses = tuple(row["pose"] for row in sorted(rows.values(), key=lambda row: int(row["position"])))
        links = tuple(link_from_row(row) for row in records.get(f"links/{SHARED}/{pose_set}.tsv", {}).values())
        return cls(
            pose_set,
            poses,
            _layers(records, pose_set, language, character, line or {}),
            targets=Targets.from_records(records, pose_set),
            common={phone: row for (phone,), row in records.get("common.tsv", {}).items()},
            base=CurveBook.from_records(records, SHARED, language=language, character=character) if links else None,
            links=links,
        )

    def find(self, left: str, right: str, pose: str) -> Found:
        """The winning curve of *left* → *right* (common phones) for *pose*. Always answers; see `Found.fallback`.

        Raises `PhonesetError` for a pose that the set lacks, `CurveError` when the set has nothing to make a curve from.
        """
        key = left, right, pose
        if key not in self._found:
            if pose not in self._links:
                raise PhonesetError(f"pose set {self.pose_set!r} has no pose {pose!r}; it has {', '.join(self.poses)}")
            self._found[key] = self._own(key) or self._elsewhere(key)
        return self._found[key]

    def table(self, phones: Iterable[str]) -> CurveTable:
        """The curves of every pair of *phones* (repeats and order don't matter) and silence, compiled for the engine."""
        from lipdb.engine.table import CurveTable

        names = (SILENCE, *sorted(set(phones) - {SILENCE}))
        curves = {}
        for left, right, pose in product(names, names, self.poses):
            curve = self.find(left, right, pose).curve
            if curve.keys:
                curves[left, right, pose] = curve
        return CurveTable.build(names, self.poses, curves)

    def report(self, pairs: Iterable[tuple[str, str]]) -> list[Fallback]:
        """What stands in where *pairs* have no curve in any table: one entry a pair and reason, in the order of *pairs*."""
        entries = []
        for left, right in dict.fromkeys(pairs):
            reasons: dict[tuple[str, str], list[str]] = {}
            for pose in self.poses:
                found = self.find(left, right, pose)
                if found.fallback:
                    reasons.setdefault((found.layer, found.reason), []).append(pose)
            entries += [Fallback(left, right, tuple(poses), *why) for why, poses in reasons.items()]
        return entries

    def _own(self, key: CurveKey) -> Found | None:
        """The most specific layer's curve. For a set that has links, a pair's own curves win as a whole."""
        if key[:2] == (SILENCE, SILENCE):
            return Found(AT_REST, "common", self.pose_set, "between silence and silence every pose is at rest")
        pair, pose = key[:2], key[2]
        pairs = (pair, *self._kinds.coarser_pairs(*pair))
        for layer in self._layers:
            for own in pairs:
                if entry := layer.curves.get((*own, pose)):
                    curve = entry if isinstance(entry, Curve) else curve_from_row(entry)
                    what = f"{curve.origin} curve" if curve.keys else f"{curve.origin} as zero"
                    return self._found_at(curve, layer.name, what, own, pair)
        for own in pairs:
            if own in self._own_pairs:
                layer = next(layer for layer in self._layers if any(other[:2] == own for other in layer.curves))
                what = "the pair has curves of its own, and they leave this pose at rest"
                return self._found_at(AT_REST, layer.name, what, own, pair)
        return None

    def _found_at(self, curve: Curve, layer: str, reason: str, own: tuple[str, str], pair: tuple[str, str]) -> Found:
        """What stands in a table for *own*, which may be coarser than the *pair* that was asked for."""
        if own == pair:
            return Found(curve, layer, self.pose_set, reason)
        return Found(curve, layer, self.pose_set, f"inherited from {'-'.join(own)}: {reason}", own)

    def _elsewhere(self, key: CurveKey) -> Found:
        """A curve through links or from targets, for a pair that no table of this pose set has."""
        via = self._via_links(key)
        if via and not via.fallback:
            return via
        pair, pose = key[:2], key[2]
        for own in (pair, *self._kinds.coarser_pairs(*pair)):
            if set(own) <= set(self._targets.phones):
                reason = f"no table has it; generated from the targets of {own[0]} and {own[1]}"
                return Found(self._generate(*own)[pose], GENERATED, self.pose_set, reason, () if own == pair else own)
        return via or self._nearest(key)

    def _via_links(self, key: CurveKey) -> Found | None:
        if self._base is None:
            return None
        left, right, pose = key
        sources = {link.pose: self._base.find(left, right, link.pose) for link in self._links[pose]}
        curve = carried(self._links[pose], {name: found.curve for name, found in sources.items()})
        # The layer to name is that of the least trusted curve that takes part.
        parts = [found for found in sources.values() if found.curve.keys] or list(sources.values())
        worst = max(parts, key=lambda found: trust(found.layer), default=None)
        if worst is None:
            return Found(curve, f"common via {SHARED}", self.pose_set, "no link leads to this pose, so it is at rest")
        return Found(curve, f"{worst.layer} via {SHARED}", self.pose_set, worst.reason, worst.inherited)

    def _nearest(self, key: CurveKey) -> Found:
        left, right, pose = key
        near = self._stand_in(left), self._stand_in(right)
        instead = " and ".join(f"{new} for {old}" for new, old in zip(near, (left, right), strict=True) if new != old)
        reason = f"no table has it; generated from targets with the nearest phone by articulation: {instead}"
        return Found(self._generate(*near)[pose], NEAREST, self.pose_set, reason)

    def _stand_in(self, phone: str) -> str:
        from lipdb.curves.nearest import stand_in

        if not set(self._targets.phones) - {SILENCE}:
            raise CurveError(
                f"pose set {self.pose_set!r} has nothing to make curves from; add targets/{self.pose_set}.tsv and "
                f"timing/{self.pose_set}.tsv, or links/{SHARED}/{self.pose_set}.tsv"
            )
        known = next((coarser for coarser in self._kinds.line(phone) if coarser in self._targets.phones), "")
        return known or stand_in(phone, self._targets.phones, self._common)

    def _generate(self, left: str, right: str) -> dict[str, Curve]:
        if (left, right) not in self._made:
            made = {pose: Curve((), origin="generated") for pose in self.poses}
            for key, keys in generated(self._targets, [(left, right)]):
                source, licence = source_of(self._targets, key)
                made[key[2]] = Curve(keys, "border", "generated", source, licence)
            self._made[left, right] = made
        return self._made[left, right]


def _layers(
    records: Records, pose_set: str, language: str | None, character: str | None, line: Mapping[CurveKey, Curve]
) -> tuple[Layer, ...]:
    """The layers that hold anything, most specific first."""
    layers = [
        Layer("line", line),
        Layer(f"character:{character}", records.get(f"characters/{character}/curves/{pose_set}.tsv", {})),
        Layer(f"language:{language}", records.get(f"{language}/curves/{pose_set}.tsv", {})),
        Layer("common", records.get(f"curves/{pose_set}.tsv", {})),
    ]
    return tuple(layer for layer in layers if layer.curves)


def trust(layer: str) -> int:
    """Larger for layers that are less specific, largest for curves made for the moment."""
    kinds = ("line", "character", "language", "common", GENERATED, NEAREST)
    return kinds.index(layer.split(":")[0].split()[0])
