"""The phone that lends its targets to one that has none."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from lipdb.curated.tsv import Row
from lipdb.phones.articulation import NEUTRAL
from lipdb.phones.likeness import nearest
from lipdb.schedule import SILENCE

NEUTRAL_CONSONANT = "d"


def stand_in(phone: str, known: Sequence[str], common: Mapping[str, Row]) -> str:
    """The one of *known* common phones that looks most like *phone*, by the segments that common.tsv gives as typical.

    A phone without a segment there is read as IPA itself; where that says nothing either, a neutral phone of its kind
    (a vowel when the kind is not known) stands in. *known* holds one phone that is not silence, or more.
    """
    heard = {name: common[name]["ipa"] for name in known if name in common and name != SILENCE}
    row = common.get(phone, {})
    if found := nearest(row.get("ipa") or phone, heard):
        return found[0]
    neutral = NEUTRAL_CONSONANT if row.get("kind") == "consonant" else NEUTRAL
    if neutral in known:
        return neutral
    return next(name for name in known if name != SILENCE)
