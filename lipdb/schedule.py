"""Timed phones: what every voice and every reader makes, and what the engine plays."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any, Self

from lipdb.errors import ScheduleError

SILENCE = "_"
MICROSECONDS = 1_000_000
LONGEST = 24 * 60 * 60
"""Seconds: a schedule that ends later is wrong."""


@dataclass(frozen=True, slots=True)
class Phone:
    """One phone of a schedule.

    *symbol* is written as the voice or the file wrote it until a phone set resolves it; *common* is empty until then.
    *layer* names where the mapping came from. *word* is an index into `Schedule.words`, -1 for none. Tone (1 to 5),
    stress (1 primary, 2 secondary) and length are attributes: they are kept, and they are never phones.
    """

    symbol: str
    common: tuple[str, ...] = ()
    layer: str = ""
    word: int = -1
    tone: int = 0
    stress: int = 0
    long: bool = False

    @property
    def silent(self) -> bool:
        """Whether this is a pause."""
        return self.symbol == SILENCE


@dataclass(frozen=True, slots=True)
class Schedule:
    """Contiguous timed phones, silences explicit.

    *edges* are whole microseconds, one more than there are phones, strictly increasing: phone ``i`` lasts from
    ``edges[i]`` to ``edges[i + 1]``. Whole numbers, because with floats a frame on a border flips to the other phone.
    """

    edges: tuple[int, ...]
    phones: tuple[Phone, ...]
    language: str = ""
    notation: str = ""
    words: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        if len(self.edges) != len(self.phones) + 1:
            raise ScheduleError(f"schedule: {len(self.phones)} phones need {len(self.phones) + 1} edges, not {len(self.edges)}")
        for i, (start, end) in enumerate(zip(self.edges, self.edges[1:], strict=False)):
            if end <= start:
                raise ScheduleError(
                    f"schedule: phone {i} ({self.phones[i].symbol!r}) lasts from {start} to {end} µs; it must last a microsecond or more"
                )

    @classmethod
    def from_intervals(
        cls,
        intervals: Iterable[tuple[float, float, Phone | str]],
        *,
        language: str = "",
        notation: str = "",
        words: Sequence[str] = (),
    ) -> Self:
        """Make a schedule of ``(start, end, phone)`` in seconds, in order of time; gaps become silence.

        Raises `ScheduleError` for times that are not finite or beyond a day, for negative or zero lengths, and for overlaps of more
        than a microsecond.
        """
        edges: list[int] = []
        phones: list[Phone] = []
        for i, (start, end, label) in enumerate(intervals):
            phone = Phone(label) if isinstance(label, str) else label
            where = f"schedule: phone {i} ({phone.symbol!r})"
            if not (math.isfinite(start) and math.isfinite(end)):
                raise ScheduleError(f"{where} has a time that is not a number ({start}, {end}); write seconds")
            if max(abs(start), abs(end)) > LONGEST:
                raise ScheduleError(f"{where} lasts from {start:g} to {end:g} s, beyond a day; write seconds, and cut what is longer")
            a, b = round(start * MICROSECONDS), round(end * MICROSECONDS)
            if b <= a:
                raise ScheduleError(f"{where} lasts from {start:g} to {end:g} s; its end must come after its start")
            if not edges:
                edges.append(a)
            elif a > edges[-1] + 1:
                phones.append(Phone(SILENCE))
                edges.append(a)
            elif a < edges[-1] - 1:
                raise ScheduleError(f"{where} starts at {start:g} s, before the one in front of it ends ({edges[-1] / MICROSECONDS:g} s)")
            if b <= edges[-1]:
                raise ScheduleError(f"{where} is shorter than a microsecond ({start:g} to {end:g} s)")
            phones.append(phone)
            edges.append(b)
        if not phones:
            raise ScheduleError("schedule: there are no phones in it; give it at least one")
        return cls(tuple(edges), tuple(phones), language, notation, tuple(words))

    @property
    def duration(self) -> float:
        """Seconds from the start of the first phone to the end of the last."""
        return (self.edges[-1] - self.edges[0]) / MICROSECONDS

    def common(self) -> tuple[tuple[int, ...], tuple[str, ...]]:
        """Edges in microseconds and the common phones between them; a phone of several shares its time evenly.

        Raises `ScheduleError` when a phone has no common phone yet, or is too short to be shared.
        """
        edges, names = [self.edges[0]], list[str]()
        for phone, start, end in zip(self.phones, self.edges, self.edges[1:], strict=False):
            if not phone.common:
                raise ScheduleError(f"schedule: phone {phone.symbol!r} has no common phone; resolve the schedule with a phone set first")
            share = len(phone.common)
            if end - start < share:
                raise ScheduleError(f"schedule: phone {phone.symbol!r} lasts {end - start} µs, too short for {share} common phones")
            names.extend(phone.common)
            edges.extend(start + (end - start) * (k + 1) // share for k in range(share))
        return tuple(edges), tuple(names)

    def shifted(self, microseconds: int) -> Schedule:
        """The same phones, *microseconds* later."""
        return replace(self, edges=tuple(edge + microseconds for edge in self.edges))

    def to_json(self) -> dict[str, Any]:
        """Plain data for a JSON file: times in seconds with six decimals, so nothing is lost."""
        rows = [
            {
                "start": start / MICROSECONDS,
                "end": end / MICROSECONDS,
                "symbol": p.symbol,
                "common": list(p.common),
                "layer": p.layer,
                "word": p.word,
                **({"tone": p.tone} if p.tone else {}),
                **({"stress": p.stress} if p.stress else {}),
                **({"long": True} if p.long else {}),
            }
            for p, start, end in zip(self.phones, self.edges, self.edges[1:], strict=False)
        ]
        return {"language": self.language, "notation": self.notation, "words": list(self.words), "phones": rows}

    @classmethod
    def from_json(cls, data: Any) -> Self:
        """The schedule that `to_json` wrote. Raises `ScheduleError` for anything else."""
        try:
            words = [str(word) for word in data.get("words", [])]
            intervals = [
                (
                    float(row["start"]),
                    float(row["end"]),
                    Phone(
                        str(row["symbol"]),
                        tuple(str(c) for c in row.get("common", ())),
                        str(row.get("layer", "")),
                        int(row.get("word", -1)),
                        int(row.get("tone", 0)),
                        int(row.get("stress", 0)),
                        bool(row.get("long", False)),
                    ),
                )
                for row in data["phones"]
            ]
            language, notation = str(data.get("language", "")), str(data.get("notation", ""))
        except (KeyError, TypeError, ValueError, AttributeError, OverflowError) as error:
            raise ScheduleError(
                f"schedule: not a schedule in lipdb's JSON ({type(error).__name__}: {error}); make one with `lipdb say -o`"
            ) from error
        for i, (_, _, phone) in enumerate(intervals):
            if not -1 <= phone.word < len(words):
                raise ScheduleError(
                    f"schedule: phone {i} ({phone.symbol!r}) is of word {phone.word}, but there are {len(words)}; -1 is none"
                )
        return cls.from_intervals(intervals, language=language, notation=notation, words=words)
