"""What people decided for the same sound in other languages: the best proposal there is."""

from __future__ import annotations

import unicodedata
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, replace

from lipdb.curated.tsv import Records
from lipdb.languages.report import REVIEW
from lipdb.phones.proposal import Proposal, propose

ENOUGH = 2
"""Languages: one alone may be a special case."""
SHOWN = 4
CLEAR = 0.75
"""The share of languages from which on they agree."""


@dataclass(frozen=True, slots=True)
class Precedent:
    """The *common* phones that most languages which have a sound map it to, those *languages*, and how many have it (*asked*)."""

    common: tuple[str, ...]
    languages: tuple[str, ...]
    asked: int

    @property
    def clear(self) -> bool:
        """Whether hardly any language differs."""
        return len(self.languages) >= CLEAR * self.asked

    @property
    def confidence(self) -> float:
        """0 to 1: the share of languages, as if one more might differ."""
        return round(len(self.languages) / (self.asked + 1), 3)

    def __str__(self) -> str:
        more = f" and {len(self.languages) - SHOWN} more" if len(self.languages) > SHOWN else ""
        return f"like {', '.join(self.languages[:SHOWN])}{more}"


def precedents(records: Records) -> Mapping[str, Precedent]:
    """By IPA segment without length, what at least two and most languages map it to, in rows that people wrote."""
    found: dict[str, dict[str, str]] = {}
    for path, rows in records.items():
        language, _, name = path.partition("/")
        for row in rows.values() if name == "phones.tsv" else ():
            # What a rule wrote is no second voice beside the rule.
            if row["origin"] != "generated" and " " not in row["ipa"]:
                found.setdefault(without_length(row["ipa"]), {}).setdefault(language, row["common"])
    return {segment: precedent for segment, by in found.items() if (precedent := _agreed(by))}


def judged(segment: str, records: Records, known: Mapping[str, Precedent]) -> Proposal:
    """What *segment* may map to: as in other languages (*known*, of `precedents`), else as the rules by articulation say.

    Where languages differ much, a person should look, but not where they agree against the second opinion.
    """
    rule = propose(segment, records.get("ipa.tsv", {}))
    precedent = known.get(without_length(segment))
    if precedent is None:
        return rule
    why = rule.reason.partition(f"; {REVIEW}")[0]
    confidence, reason, second = max(rule.confidence, precedent.confidence), f"{why}; {precedent}", rule.second
    if precedent.common != rule.common:
        confidence, reason = precedent.confidence, f"{precedent}; by the rule {' '.join(rule.common) or 'nothing'}: {why}"
        second = rule.common
    if not precedent.clear:
        reason += f"; {REVIEW} languages differ"
    return replace(rule, common=precedent.common, confidence=confidence, reason=reason, second=second, review=not precedent.clear)


def _agreed(by: Mapping[str, str]) -> Precedent | None:
    """What most of the languages *by* agree on (language → common phones), if they are enough."""
    common, count = Counter(by.values()).most_common(1)[0]
    if count < ENOUGH or 2 * count <= len(by):
        return None
    return Precedent(tuple(common.split()), tuple(sorted(code for code, of in by.items() if of == common)), len(by))


def without_length(segment: str) -> str:
    """*segment* in composed form without marks of length."""
    return unicodedata.normalize("NFC", segment).replace("ː", "").replace("ˑ", "")
