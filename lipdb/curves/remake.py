"""Make the generated curves of curated data again, all tables of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from lipdb.curated.schema import table_of
from lipdb.curated.tsv import Key, Records, Row, canonical_row
from lipdb.curves.curve import Curve, CurveKey, curves_from_rows
from lipdb.curves.generate import Targets, all_pairs, regenerate
from lipdb.errors import CurveError
from lipdb.poses import SHARED

Pair = tuple[str, str]
Pairs = Mapping[str, Sequence[Pair]]
"""Path of a curve table -> pairs of common phones that it is to hold besides those it holds already."""


def remake(records: Records, *, author: str, time: str, more: Pairs | None = None) -> dict[str, dict[Key, Row]]:
    """Every curve table that has targets, with its generated rows made again; other rows stay as they are.

    The common table of a pose set that no links reach holds every pair of the phones that have targets. All other
    tables (a language's, a character's, those of a pose set that is reached from facefx) hold the pairs that they hold
    already, and *more*. Raises `CurveError`.
    """
    sets = [path.removeprefix("targets/").removesuffix(".tsv") for path in records if path.startswith("targets/")]
    made: dict[str, dict[Key, Row]] = {}
    for pose_set in sorted(sets):
        targets = Targets.from_records(records, pose_set)
        whole = None if f"links/{SHARED}/{pose_set}.tsv" in records else f"curves/{pose_set}.tsv"
        for path in sorted(p for p in {*records, *(more or {}), whole or ""} if p.endswith(f"curves/{pose_set}.tsv")):
            old = curves_from_rows(records.get(path, {}).values())
            pairs = all_pairs(targets.phones) if path == whole else sorted(_held(old, targets) | set((more or {}).get(path, ())))
            made[path] = _rows(path, regenerate(targets, pairs, old, author=author, time=time))
    lost = sorted(set(more or {}) - made.keys())
    if lost:
        raise CurveError(f"{lost[0]}: no curves can be generated for this table; its pose set needs targets/ and timing/")
    return made


def _held(old: Mapping[CurveKey, Curve], targets: Targets) -> set[Pair]:
    """The pairs with generated curves whose phones both still have targets."""
    known = set(targets.phones)
    return {(left, right) for (left, right, _), curve in old.items() if curve.origin == "generated" and {left, right} <= known}


def _rows(path: str, curves: Mapping[CurveKey, Curve]) -> dict[Key, Row]:
    table = table_of(path)
    if table is None:
        raise CurveError(f"{path}: no table has this name; a character's curves stand in characters/NAME/curves/POSE_SET.tsv")
    return {key: canonical_row(table, curve.row(key)) for key, curve in curves.items()}
