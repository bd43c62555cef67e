"""A character's links as a person edits them: which come from the shared table, which are its own, and what saving writes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from lipdb.characters.links import bent, identity_links
from lipdb.curated.schema import USER_SOURCE, table_of
from lipdb.curated.tsv import Key, Records, Row, canonical_row
from lipdb.curves.keys import Keys
from lipdb.errors import InputError, PhonesetError
from lipdb.poses import PoseSet

VALUES = ("gain", "combine", "curve")
DOUBTFUL = "doubtful"
STRAIGHT: Keys = ((0.0, 0.0), (1.0, 1.0))
"""What a link without a curve does."""
SAMPLES = 50
"""Parts in which the weight of a pose is cut to draw what a link makes of it."""


@dataclass(frozen=True, slots=True)
class OwnLink:
    """One link: its *row*, and the shared row that it stands in place of, if there is one."""

    row: Row
    own: bool
    shared: Row | None

    @property
    def doubtful(self) -> bool:
        """Whether the shape was matched by a name that is only alike."""
        return self.row["comment"].endswith(DOUBTFUL)


def own_table(name: str) -> str:
    """The table of the links of the character *name*."""
    return f"characters/{name}/links.tsv"


def shared_links(records: Records, character: Row) -> dict[Key, Row]:
    """The links that *character* (its row) takes from the pose set or from ``links/``. Raises `PhonesetError` when they are not there."""
    pose_set, shapes = character["pose_set"], character["shapes"]
    if shapes != pose_set:
        path = f"links/{pose_set}/{shapes}.tsv"
        if shapes and path not in records:
            raise PhonesetError(f"characters/{character['character']}/character.tsv: there is no {path}; name another set in column shapes")
        return dict(records[path]) if shapes else {}
    poses = PoseSet.from_records(records, pose_set).poses
    return {(link.pose, link.shape): {**link.to_row(), "source": "lipdb", "comment": ""} for link in identity_links(poses)}


def links_of(records: Records, name: str) -> list[OwnLink]:
    """The links of the character *name* that move something, in the order of its poses."""
    character = records[f"characters/{name}/character.tsv"][name,]
    shared, own = shared_links(records, character), records.get(own_table(name), {})
    poses = PoseSet.from_records(records, character["pose_set"]).poses
    rows = {**{key: OwnLink(row, False, None) for key, row in shared.items()}}
    rows |= {key: OwnLink(row, True, shared.get(key)) for key, row in own.items()}
    kept = [link for link in rows.values() if float(link.row["gain"])]
    return sorted(kept, key=lambda link: (poses.index(link.row["pose"]) if link.row["pose"] in poses else len(poses), link.row["shape"]))


def link_rows(records: Records, name: str, wanted: Sequence[Mapping[str, str]]) -> dict[Key, Row | None]:
    """What saving the links *wanted* writes into the character's own table: rows to put, None for rows to take away.

    A link that is as the shared table has it needs no row; a shared link that is not wanted gets one with gain 0. Only rows
    that change are in the answer. Raises `InputError` for a link that can't be, two of the same, or none at all.
    """
    character = records[f"characters/{name}/character.tsv"][name,]
    shared, own = shared_links(records, character), records.get(own_table(name), {})
    poses = PoseSet.from_records(records, character["pose_set"]).poses
    result: dict[Key, Row | None] = {}
    seen: set[Key] = set()
    for given in wanted:
        row = _checked(name, given, poses)
        key: Key = (row["pose"], row["shape"])
        if "comment" not in given and key in own:
            row["comment"] = own[key]["comment"]
        if key in seen:
            raise InputError(f"{row['pose']} leads to {row['shape']} twice; keep one of the two links")
        seen.add(key)
        result[key] = None if key in shared and _same(row, shared[key]) else _kept(row, own.get(key))
    if not any(float(given["gain"]) for given in wanted):
        raise InputError("no link moves anything; keep one at least")
    for key, row in shared.items():
        if key not in seen:
            result[key] = _kept({**row, "gain": "0", "comment": own[key]["comment"] if key in own else ""}, own.get(key))
    result |= {key: None for key in own if key not in result}
    return {key: row for key, row in result.items() if row != own.get(key)}


def bend_drawn(keys: Keys, gain: float) -> Keys:
    """The weight of the shape, 0..1, that a link with *gain* and the curve *keys* makes of weights 0..1 of its pose."""
    inner = {time for time, _ in keys} | {k / SAMPLES for k in range(SAMPLES + 1)}
    weights = np.array(sorted(inner))
    made = np.clip(gain * bent(weights, keys), 0.0, 1.0)
    return tuple(zip(weights.tolist(), made.tolist(), strict=True))


def _checked(name: str, given: Mapping[str, str], poses: Sequence[str]) -> Row:
    table = table_of(own_table(name))
    assert table is not None
    where = f"the link from {given.get('pose') or 'no pose'} to {given.get('shape') or 'no shape'}"
    cells = {column: str(given.get(column) or "").strip() for column in ("pose", "shape", *VALUES, "comment")}
    try:
        row = canonical_row(table, {**cells, "combine": cells["combine"] or "sum", "source": USER_SOURCE})
    except ValueError as error:
        raise InputError(f"{where}: {error}") from error
    if row["pose"] not in poses:
        raise InputError(f"{where}: there is no such pose; there are {', '.join(poses)}")
    return row


def _same(row: Row, other: Row) -> bool:
    return all(row[name] == other[name] for name in VALUES)


def _kept(row: Row, before: Row | None) -> Row:
    """*row* as it is stored: as it stands when nothing changes; a doubt ends when somebody changes the link."""
    if before is not None and _same(row, before):
        return before if row["comment"] == before["comment"] else {**before, "comment": row["comment"]}
    doubted = before is not None and row["comment"].endswith(DOUBTFUL)
    return {**row, "source": USER_SOURCE, "comment": "" if doubted else row["comment"]}
