"""Which known set of shapes a mesh has, told by the shapes' names, and the links from facefx's poses to them.

Names are compared without case, separators and prefixes (``blendShape1.jawOpen``, ``viseme_aa``), and with the sides
written out (``mouthSmile_L``); ``shape_names.tsv`` holds names that other programs use for the same shapes.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from typing import TYPE_CHECKING, Literal

from lipdb.errors import InputError
from lipdb.poses import SHARED

if TYPE_CHECKING:
    from lipdb.curated.tsv import Records, Row

Certainty = Literal["sure", "doubtful", "missing"]

MISSING: tuple[str, Certainty] = ("", "missing")
ENOUGH, LEAST = 0.5, 0.2
"""Of the shapes that speech needs, the share that makes a set likely, and the least with which one is proposed."""

_SIDE = re.compile(r"(?:[._\- ](l|r|left|right)|(?<=[a-z])(L|R|Left|Right))$", re.IGNORECASE)
_CAMEL = re.compile(r"(?<=[a-z])(L|R|Left|Right)$")
_OWNER = re.compile(r"^.*[.:|/](?=.)")
_PREFIX = re.compile(r"^(?:viseme|vis|v|phoneme|shape|bs)[_\-. ]+", re.IGNORECASE)


@dataclass(frozen=True, slots=True)
class Proposal:
    """One link from a pose to a shape of the mesh, and how certain the *shape* is the one of the set, *known*."""

    pose: str
    shape: str
    known: str
    gain: str
    combine: str
    curve: str
    certainty: Certainty
    comment: str


@dataclass(frozen=True, slots=True)
class Match:
    """The best fitting set, its share of needed shapes that were found, and the links; missing shapes have none."""

    shape_set: str
    share: float
    proposals: tuple[Proposal, ...]

    @property
    def doubtful(self) -> tuple[str, ...]:
        """Shapes of the mesh that may be the wrong ones."""
        return tuple(dict.fromkeys(p.shape for p in self.proposals if p.certainty == "doubtful"))

    @property
    def missing(self) -> tuple[str, ...]:
        """Shapes of the set that speech needs and that the mesh lacks."""
        return tuple(dict.fromkeys(p.known for p in self.proposals if p.certainty == "missing"))


def match(shapes: Sequence[str], records: Records) -> Match:
    """The known set that *shapes* fit best, with links from facefx's poses to them.

    Of the sets with half or more of the shapes that speech needs, the one with the most; raises `InputError` when no set
    has a fifth of them.
    """
    found = []
    for shape_set in sorted(key[0] for key in records.get("poses/sets.tsv", {})):
        links = _shared_links(records, shape_set)
        needed = sorted({row["shape"] for row in links})
        if not needed:
            continue
        known = find_shapes(needed, shapes, _other_names(records, shape_set))
        share = sum(1.0 if certainty == "sure" else 0.5 for _, certainty in known.values()) / len(needed)
        found.append((share >= ENOUGH, len(known) if share >= ENOUGH else 0, share, shape_set, known, links))
    best = max(found, key=lambda entry: entry[:3], default=None)
    if best is None or best[2] < LEAST:
        some = ", ".join(shapes[:8]) + (" …" if len(shapes) > 8 else "")
        known_by = "ARKit, VRM, Oculus, FaceFX or Rhubarb (A to H, X)"
        raise InputError(f"none of the known sets has shapes of these names ({some}); rename them as {known_by} do")
    _, _, share, shape_set, known, links = best
    return Match(shape_set, share, tuple(_proposals(links, known)))


def find_shapes(needed: Iterable[str], shapes: Sequence[str], other_names: Mapping[str, Sequence[str]]) -> dict[str, tuple[str, Certainty]]:
    """For each of *needed* that is there: which of *shapes* it is, and how certain that is.

    *other_names* gives further names of a needed shape.
    """
    plain = {key: shape for shape in reversed(shapes) for key in reversed(plain_names(shape))}
    found: dict[str, tuple[str, Certainty]] = {}
    for name in needed:
        names = [name, *other_names.get(name, ())]
        by_plain = (plain[key] for n in names for key in plain_names(n) if key in plain)
        same = name if name in shapes else next(by_plain, None)
        if same is not None:
            found[name] = (same, "sure")
        elif close := get_close_matches(plain_names(name)[0], plain, 1, 0.86) if len(name) > 4 else []:
            found[name] = (plain[close[0]], "doubtful")
    return found


def plain_names(name: str) -> list[str]:
    """*name* as it is compared: without owner, case and separators, sides written out; then also without a prefix."""
    side = _SIDE.search(name) if not _CAMEL.search(name) else _CAMEL.search(name)
    base, ending = (name[: side.start()], "left" if side.group().lstrip("._- ").lower()[0] == "l" else "right") if side else (name, "")
    base = _OWNER.sub("", base)
    keys = [re.sub(r"[\W_]+", "", text).lower() + ending for text in (base, _PREFIX.sub("", base))]
    return list(dict.fromkeys(key for key in keys if key))


def _shared_links(records: Records, shape_set: str) -> list[Row]:
    """The links from facefx's poses to the shapes of *shape_set*; of facefx itself one a pose."""
    if shape_set == SHARED:
        poses = sorted(key[0] for key in records.get(f"poses/{SHARED}.tsv", {}))
        return [{"pose": p, "shape": p, "gain": "1", "combine": "sum", "curve": "", "comment": "The same pose"} for p in poses]
    rows = records.get(f"links/{SHARED}/{shape_set}.tsv", {})
    return [dict(rows[key]) for key in sorted(rows)]


def _other_names(records: Records, shape_set: str) -> dict[str, list[str]]:
    """Other programs' names for the shapes of *shape_set*."""
    names: dict[str, list[str]] = {}
    for owner, name, pose in sorted(records.get("shape_names.tsv", {})):
        if owner == shape_set:
            names.setdefault(pose, []).append(name)
    return names


def _proposals(links: Sequence[Row], known: Mapping[str, tuple[str, Certainty]]) -> list[Proposal]:
    """A proposal for each link; of two that lead from one pose to one shape the stronger."""
    made: dict[tuple[str, str], Proposal] = {}
    for row in links:
        shape, certainty = known.get(row["shape"], MISSING)
        proposal = Proposal(row["pose"], shape, row["shape"], row["gain"], row["combine"], row["curve"], certainty, row["comment"])
        key = (row["pose"], shape or f"?{row['shape']}")
        if key not in made or abs(float(row["gain"])) > abs(float(made[key].gain)):
            made[key] = proposal
    return list(made.values())
