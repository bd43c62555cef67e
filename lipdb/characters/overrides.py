"""What a character has otherwise than others: its own curves, mappings and links, and what it would inherit instead."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from lipdb.characters.own_links import VALUES, own_table, shared_links
from lipdb.curated.tsv import Key, Records, Row
from lipdb.curves.keys import format_keys
from lipdb.curves.lookup import CurveBook
from lipdb.phones.phoneset import PhoneSet
from lipdb.poses import SHARED

REST = "at rest"


@dataclass(frozen=True, slots=True)
class Override:
    """One row of a character's own: *what* it is (``curve``, ``mapping`` or ``link``) and its *name*, such as ``l-ow W``.

    *own* and *inherited* are its value and the one that counts without it, which comes from *layer*. *pair* are the common
    phones of a curve, *language* is that of a mapping.
    """

    table: str
    key: Key
    what: str
    name: str
    own: str
    inherited: str
    layer: str
    pair: tuple[str, str] | None = None
    language: str = ""

    def to_row(self) -> dict[str, str]:
        """Plain cells for a listing."""
        return {"what": self.what, "name": self.name, "own": self.own, "inherited": self.inherited, "layer": self.layer}


def overrides(records: Records, name: str, language: str) -> list[Override]:
    """Everything that stands in the tables of the character *name*, against what it would inherit in *language*.

    Links stand in it only where they are in place of shared ones: the others are no overrides, they are the character.
    """
    return [*_curves(records, name, language), *_mappings(records, name, language), *_links(records, name)]


def with_siblings(records: Records, chosen: Iterable[Override]) -> dict[tuple[str, Key], None]:
    """The rows to take away so that the values of *chosen* are inherited again.

    In a pose set that is reached through links a pair's own curves win as a whole: what is left of them would keep the
    others at rest, so they go together.
    """
    rows: dict[tuple[str, Key], None] = {}
    for one in chosen:
        rows[one.table, one.key] = None
        pose_set = one.table.rpartition("/")[2].removesuffix(".tsv")
        if one.what == "curve" and records.get(f"links/{SHARED}/{pose_set}.tsv"):
            rows |= {(one.table, key): None for key in records[one.table] if key[:2] == one.key[:2]}
    return rows


def _curves(records: Records, name: str, language: str) -> Iterable[Override]:
    folder = f"characters/{name}/curves/"
    for path in sorted(path for path in records if path.startswith(folder)):
        book = CurveBook.from_records(records, path.removeprefix(folder).removesuffix(".tsv"), language=language)
        for key, row in sorted(records[path].items()):
            left, right, pose = key
            if pose not in book.poses:
                continue
            found = book.find(left, right, pose)
            inherited = format_keys(found.curve.keys) or REST
            yield Override(path, key, "curve", f"{left}-{right} {pose}", row["keys"] or REST, inherited, found.where, (left, right))


def _mappings(records: Records, name: str, language: str) -> Iterable[Override]:
    path = f"characters/{name}/mapping.tsv"
    rows = sorted(records.get(path, {}).items())
    others = {key[0]: PhoneSet.from_records(records, key[0]) for key, _ in rows if f"{key[0]}/language.tsv" in records}
    for key, row in sorted(rows, key=lambda item: (item[0][0] != language, item[0])):
        phoneset = others.get(key[0])
        known = phoneset is not None and key[1] in phoneset.symbols.phones
        mapped = phoneset.mapping(key[1]) if phoneset and known else None
        inherited, layer = (" ".join(mapped.common), mapped.layer) if mapped else ("no such phone", "")
        yield Override(path, key, "mapping", f"{key[0]} {key[1]}", row["common"], inherited, layer, language=key[0])


def _links(records: Records, name: str) -> Iterable[Override]:
    character = records[f"characters/{name}/character.tsv"][name,]
    shared = shared_links(records, character)
    shapes = character["shapes"]
    layer = "one shape a pose" if shapes == character["pose_set"] else f"links/{character['pose_set']}/{shapes}"
    for key, row in sorted(records.get(own_table(name), {}).items()):
        if key in shared:
            yield Override(own_table(name), key, "link", " → ".join(key), _link(row), _link(shared[key]), layer)


def _link(row: Row) -> str:
    return ", ".join(f"{name} {row[name]}" for name in VALUES if row[name]) if float(row["gain"]) else "none"
