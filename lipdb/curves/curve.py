"""One blend curve: the weight of one pose while one phone passes into the next."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Literal

from lipdb.curves.keys import Keys, format_keys, parse_keys
from lipdb.errors import CurveError

Warp = Literal["border", "linear"]
CurveKey = tuple[str, str, str]
"""Left common phone, right common phone, pose."""

_WARPS: dict[str, Warp] = {"border": "border", "linear": "linear"}


@dataclass(frozen=True, slots=True)
class Curve:
    """Keys of ``(time, weight)``, joined by straight lines; before the first and after the last key the weight is 0.

    Times are normalised: 0 is the start of the left phone, 1 the end of the right one. With *warp* ``border``, 0.5 is
    the border between them; with ``linear``, time runs evenly over both. No keys at all means zero, on purpose.
    The other fields say where the curve comes from.
    """

    keys: Keys
    warp: Warp = "border"
    origin: str = "authored"
    source: str = "lipdb"
    licence: str = "Apache-2.0"
    author: str = ""
    time: str = ""
    comment: str = ""

    @property
    def peak(self) -> float:
        """The largest weight."""
        return max((weight for _, weight in self.keys), default=0.0)

    def row(self, key: CurveKey) -> dict[str, str]:
        """The row of curated data that says this curve stands at *key*."""
        left, right, pose = key
        return {
            "left": left,
            "right": right,
            "pose": pose,
            "keys": format_keys(self.keys),
            "warp": self.warp,
            "origin": self.origin,
            "source": self.source,
            "licence": self.licence,
            "author": self.author,
            "time": self.time,
            "comment": self.comment,
        }


def curve_from_row(row: Mapping[str, str]) -> Curve:
    """The curve that *row* holds. Raises `CurveError` for keys or a warp that can't be."""
    warp = _WARPS.get(row["warp"])
    if warp is None:
        raise CurveError(f"curve {row['left']} {row['right']} {row['pose']}: warp {row['warp']!r} is neither border nor linear")
    return Curve(
        parse_keys(row["keys"]), warp, row["origin"], row["source"], row["licence"], row["author"], row["time"], row["comment"]
    )  # fmt: skip


def curves_from_rows(rows: Iterable[Mapping[str, str]]) -> dict[CurveKey, Curve]:
    """The curves of one table by left phone, right phone and pose. Raises `CurveError`."""
    return {(row["left"], row["right"], row["pose"]): curve_from_row(row) for row in rows}
