"""One pair of phones as an editor sees it: each pose's curve in one layer, the layer below, and what saving it changes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from lipdb.curated.schema import BY_HAND
from lipdb.curated.tsv import Key, Records, Row
from lipdb.curves.curve import Curve, CurveKey, curve_from_row
from lipdb.curves.keys import Keys, format_keys, parse_keys
from lipdb.curves.lookup import CurveBook, Found
from lipdb.errors import CurveError, InputError
from lipdb.poses import SHARED
from lipdb.schedule import SILENCE

COMMON, LANGUAGE, CHARACTER = "common", "language", "character"
KINDS = (COMMON, LANGUAGE, CHARACTER)

Curves = Mapping[str, Keys | None]
"""By pose: the keys in the edited layer, none at all for zero; None leaves the pose to the layers below."""


@dataclass(frozen=True, slots=True)
class Place:
    """What is edited: the pair *left* → *right* of *pose_set* in one layer, heard in *language* and seen on *character*.

    *kind* is the layer: ``common``, ``language`` or ``character``.
    """

    left: str
    right: str
    pose_set: str
    language: str
    character: str
    kind: str = COMMON

    def __post_init__(self) -> None:
        if self.kind not in KINDS:
            raise InputError(f"there is no layer {self.kind!r} to save to; there are {', '.join(KINDS)}")
        if self.left == self.right == SILENCE:
            raise InputError("two silences never meet; choose a pair with a phone")

    @property
    def pair(self) -> str:
        """The pair as people write it."""
        return f"{self.left}-{self.right}"

    @property
    def layer(self) -> str:
        """The layer as answers name it."""
        return {COMMON: COMMON, LANGUAGE: f"language:{self.language}", CHARACTER: f"character:{self.character}"}[self.kind]

    @property
    def table(self) -> str:
        """The table of the layer."""
        folder = {COMMON: "", LANGUAGE: f"{self.language}/", CHARACTER: f"characters/{self.character}/"}[self.kind]
        return f"{folder}curves/{self.pose_set}.tsv"

    def key(self, pose: str) -> CurveKey:
        """The key of the row of *pose*."""
        return self.left, self.right, pose

    def view(self, records: Records) -> CurveBook:
        """The curves as this layer and those below it give them, without the more specific ones."""
        language = self.language if self.kind in (LANGUAGE, CHARACTER) else None
        character = self.character if self.kind == CHARACTER else None
        return CurveBook.from_records(records, self.pose_set, language=language, character=character)

    def book(self, records: Records) -> CurveBook:
        """The curves as the character speaks the language: all layers."""
        return CurveBook.from_records(records, self.pose_set, language=self.language, character=self.character)


@dataclass(frozen=True, slots=True)
class Lane:
    """One pose: the layer's *own* curve, if it has one, and what the layers *below* say.

    *hidden* names the more specific layer whose curve the character uses instead; "" when this one is seen.
    """

    pose: str
    own: Curve | None
    below: Found
    hidden: str = ""

    @property
    def keys(self) -> Keys:
        """The keys that count in this layer."""
        return self.own.keys if self.own else self.below.curve.keys

    def by_hand(self, own: bool) -> bool:
        """Whether a person made the layer's *own* curve, or else the one below, or the data did."""
        curve = self.own if own else self.below.curve
        return curve is not None and curve.origin in BY_HAND


@dataclass(frozen=True, slots=True)
class Draft:
    """A pair as it stands at *place*, ready to be edited; *lanes* by pose, in the order of the pose set.

    *whole* says that the pair's curves come through links, and win or lose as a whole: the first one that is saved takes
    all others with it, or they would come to rest (see `CurveBook`).
    """

    place: Place
    lanes: Mapping[str, Lane]
    whole: bool

    @classmethod
    def load(cls, records: Records, place: Place) -> Draft:
        """The pair as *records* have it. Raises `LipdbError` for a pose set, language or phone that does not exist."""
        for phone in (place.left, place.right):
            if (phone,) not in records.get("common.tsv", {}):
                raise InputError(f"there is no common phone {phone!r}")
        own = {key[2]: curve_from_row(row) for key, row in _rows(records, place).items()}
        below = place.view(_replaced(records, place, {}))
        book = place.book(records)
        lanes = {}
        for pose in below.poses:
            key = place.key(pose)
            seen = book.find(*key).layer
            above = KINDS[KINDS.index(place.kind) + 1 :]
            lanes[pose] = Lane(pose, own.get(pose), below.find(*key), seen if seen.split(":")[0] in above else "")
        linked = place.pose_set != SHARED and bool(records.get(f"links/{SHARED}/{place.pose_set}.tsv"))
        tabled = [not lane.below.fallback and " via " not in lane.below.layer for lane in lanes.values()]
        return cls(place, lanes, whole=linked and not all(tabled))

    @property
    def curves(self) -> dict[str, Keys | None]:
        """The layer's own keys by pose; None where it has none."""
        return {pose: lane.own.keys if lane.own else None for pose, lane in self.lanes.items()}

    def read(self, given: Mapping[str, object]) -> dict[str, Keys | None]:
        """Curves as an editor sent them, by pose: lists of (time, weight), or None; poses left out are as they stand.

        Raises `CurveError` for keys that can't be.
        """
        read = self.curves
        for pose, keys in given.items():
            if pose not in self.lanes:
                raise CurveError(f"pose set {self.place.pose_set!r} has no pose {pose!r}")
            read[pose] = None if keys is None else self._checked(pose, keys)
        return read

    def _checked(self, pose: str, given: object) -> Keys:
        try:
            keys = parse_keys(format_keys((float(time), float(weight)) for time, weight in given))  # type: ignore[attr-defined]
        except (TypeError, ValueError) as error:
            raise CurveError(f"{self.place.pair} {pose}: keys are pairs of numbers, not {given!r:.60}") from error
        if keys and self.place.left == SILENCE and keys[0][1]:
            raise CurveError(f"{self.place.pair} {pose}: a curve out of silence begins with weight 0; move its first key down")
        if keys and self.place.right == SILENCE and keys[-1][1]:
            raise CurveError(f"{self.place.pair} {pose}: a curve into silence ends with weight 0; move its last key down")
        return keys

    def changed(self, curves: Curves) -> list[str]:
        """The poses in which *curves* differ from what stands."""
        return [pose for pose, keys in self.curves.items() if curves.get(pose) != keys]

    def rows(self, curves: Curves) -> dict[Key, Row | None]:
        """What saving *curves* writes into the table of the place: rows to put, None for rows to take away.

        Only rows that change are in it.
        """
        if self.whole and any(keys is not None for keys in curves.values()):
            curves = {pose: lane.below.curve.keys if curves.get(pose) is None else curves[pose] for pose, lane in self.lanes.items()}
        return {self.place.key(pose): self._row(self.lanes[pose], curves.get(pose)) for pose in self.changed(curves)}

    def unfinished(self, curves: Curves) -> list[str]:
        """The poses that move the face in this pair with a curve that nobody has drawn, fitted or accepted.

        Of a pair that leaves every pose at rest, all of them may be. What *curves* change counts as drawn.
        """
        counting = {pose: lane.below.curve.keys if curves.get(pose) is None else curves[pose] for pose, lane in self.lanes.items()}
        moving = [pose for pose, keys in counting.items() if keys] or list(counting)
        changed = [pose for pose in self.changed(curves) if curves.get(pose) is not None]
        return [pose for pose in moving if pose not in changed and not self.lanes[pose].by_hand(curves.get(pose) is not None)]

    def accepted(self, curves: Curves) -> dict[Key, Row | None]:
        """As `rows`, and with them a row for every pose of `unfinished`, with the curve that it has now.

        To be saved as accepted (see `lipdb.store.edit.Edit.put`): then the pair is work for nobody any more.
        """
        poses = self.unfinished(curves)
        below = {pose: self.lanes[pose].below.curve.keys for pose in poses if curves.get(pose) is None}
        own = {self.place.key(pose): self._row(self.lanes[pose], curves[pose]) for pose in poses if pose not in below}
        return own | self.rows({**curves, **below})

    def _row(self, lane: Lane, keys: Keys | None) -> Row | None:
        if keys is None:
            return None
        key = (self.place.left, self.place.right, lane.pose)
        if lane.own:
            return {**lane.own.row(key), "keys": format_keys(keys)}
        below = lane.below.curve
        if keys == below.keys:  # what made them made these
            return Curve(keys, below.warp, origin="", source=below.source, licence=below.licence).row(key)
        return Curve(keys, below.warp, origin="", source="", licence="").row(key)

    def applied(self, records: Records, curves: Curves) -> Records:
        """*records* as they will be when *curves* are saved."""
        rows = dict(_rows(records, self.place))
        for key, row in self.rows(curves).items():
            if row is None:
                rows.pop(key, None)
            else:
                rows[key] = {**row, "origin": row["origin"] or "authored"}
        return _replaced(records, self.place, rows)


def overriding(records: Records, place: Place) -> list[str]:
    """The more specific layers that have curves of their own for the pair: an edit at *place* does not reach them."""
    found = []
    for path, rows in sorted(records.items()):
        parts = path.split("/")
        if parts[-2:] != ["curves", f"{place.pose_set}.tsv"] or len(parts) == 2:
            continue
        kind, name = (CHARACTER, parts[1]) if parts[0] == "characters" else (LANGUAGE, parts[0])
        if KINDS.index(kind) > KINDS.index(place.kind) and any(key[:2] == (place.left, place.right) for key in rows):
            found.append(f"{kind}:{name}")
    return found


def _rows(records: Records, place: Place) -> dict[Key, Row]:
    return {key: row for key, row in records.get(place.table, {}).items() if key[:2] == (place.left, place.right)}


def _replaced(records: Records, place: Place, rows: Mapping[Key, Row]) -> Records:
    """*records* with *rows* as the pair's in the table of *place*."""
    others = {key: row for key, row in records.get(place.table, {}).items() if key[:2] != (place.left, place.right)}
    return {**records, place.table: {**others, **rows}}
