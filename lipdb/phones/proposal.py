"""What an IPA segment maps to, proposed for a person to look at: rules by articulation, and PanPhon's opinion of them."""

from __future__ import annotations

import unicodedata
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import groupby
from types import MappingProxyType
from typing import Any

from lipdb.curated.tsv import Key, Row
from lipdb.phones.articulation import Classified, classify
from lipdb.phones.second_opinion import opinions
from lipdb.phones.segments import Segment, read_segment

_NO_ROWS: Mapping[Key, Row] = MappingProxyType({})
UNSURE = 0.7
"""With no more confidence than this a person should look, whatever the second opinion says."""
_DISAGREEMENT, _DOUBT = 0.8, 0.9
"""What each of them leaves of the confidence."""


@dataclass(frozen=True, slots=True)
class Proposal:
    """What an IPA segment maps to: its *common* phones, *confidence* (0 to 1) and *reason*.

    *second* is the next best answer, if there is one; *review* whether a person should look: the second opinion is another
    one, or the rules are not sure. A text that is no IPA has no common phones and confidence 0.
    """

    ipa: str
    common: tuple[str, ...]
    confidence: float
    reason: str
    second: tuple[str, ...] = ()
    review: bool = False

    def to_row(self) -> dict[str, Any]:
        """Plain data for a listing."""
        return {
            "ipa": self.ipa,
            "common": list(self.common),
            "confidence": self.confidence,
            "reason": self.reason,
            "second": list(self.second),
            "review": self.review,
        }


def propose(ipa: str, rows: Mapping[Key, Row] = _NO_ROWS) -> Proposal:
    """The common phones of the IPA segment *ipa*, one or more, with a confidence and a reason. Never raises.

    *rows* are those of ``ipa.tsv``: what a person wrote there for just this segment wins over the rules.
    """
    row = rows.get((unicodedata.normalize("NFC", ipa.strip("/[] ")),))
    if row and row["origin"] != "generated":
        return Proposal(ipa, tuple(row["common"].split()), 1.0, row["comment"] or f"{row['origin']} by {row['author']}")
    read, found = read_segment(ipa), classify(ipa)
    if read.foreign:
        signs = "".join(dict.fromkeys(read.foreign))[:8]
        return Proposal(ipa, (), 0.0, f"no IPA: {signs!r} stands in no chart", review=True)
    if found is None:
        return Proposal(ipa, (), 0.0, "no segment: there is no vowel and no consonant in it", review=True)
    return _judged(ipa, found, read)


def _judged(ipa: str, found: Classified, read: Segment) -> Proposal:
    """What the rules *found*, with the second opinion on every part of it."""
    confidence, notes = found.confidence, list[str]()
    for verdict in found.verdicts:
        ranked = opinions(verdict.text) if verdict.text else ()
        if ranked and ranked[0].common != verdict.common:
            confidence *= _DISAGREEMENT
            notes.append(f"review: by PanPhon's features {verdict.text} is nearest to {ranked[0].common}")
    if read.strange:
        confidence *= _DOUBT
        notes.append(f"review: nothing is known of {' '.join(f'U+{ord(sign):04X}' for sign in read.strange)}")
    if bar := next((sign for sign in ipa if sign in "|‖"), ""):
        confidence *= _DOUBT
        notes.append(f"review: {bar} is read as a click; between phrases it would be a pause")
    unseen = [f"({', '.join(read.unseen)}: not seen)"] if read.unseen else []
    reason = "; ".join([" ".join([found.reason, *unseen]), *notes])
    return Proposal(ipa, found.common, round(confidence, 3), reason, _second(found), bool(notes) or confidence <= UNSURE)


def _second(found: Classified) -> tuple[str, ...]:
    """The answer with its least certain part replaced by what would also do: by the rules, or else by PanPhon's features.

    Nothing when neither can say.
    """
    weakest = min((verdict for verdict in found.verdicts if verdict.text), key=lambda verdict: verdict.confidence)
    near = (opinion.common for opinion in opinions(weakest.text) if opinion.common != weakest.common)
    other = weakest.other or next(near, "")
    row = [other if verdict is weakest else verdict.common for verdict in found.verdicts]
    return tuple(common for common, _ in groupby(row)) if other else ()
