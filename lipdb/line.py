"""A line of speech: what is said, when each phone sounds, the sound, and the line's own layer."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Self

from lipdb.curves.curve import Curve, CurveKey, curve_from_row
from lipdb.curves.keys import format_keys
from lipdb.errors import CurveError, InputError
from lipdb.schedule import Schedule
from lipdb.sound import Sound

FORMAT = "lipdb line 1"


@dataclass(frozen=True, slots=True, eq=False)
class Line:
    """A schedule with its sound and the layer that belongs to this line alone.

    *mapping* gives phones of the language other common phones; *curves* gives pairs other curves, by pose set. Both win
    over every other layer. They travel in the line's JSON, where a person edits them; the sound does not. *notes* say
    what of the text was left out, or read in a way that a person might not expect.
    """

    schedule: Schedule
    sound: Sound | None = None
    text: str = ""
    mapping: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    curves: Mapping[str, Mapping[CurveKey, Curve]] = field(default_factory=dict)
    notes: tuple[str, ...] = ()

    @property
    def language(self) -> str:
        """The language's code."""
        return self.schedule.language

    def to_json(self) -> dict[str, Any]:
        """Plain data for a JSON file."""
        return {
            "format": FORMAT,
            "text": self.text,
            "schedule": self.schedule.to_json(),
            "mapping": {phone: " ".join(common) for phone, common in sorted(self.mapping.items())},
            "curves": {
                pose_set: [
                    {"left": left, "right": right, "pose": pose, "keys": format_keys(curve.keys), "warp": curve.warp}
                    for (left, right, pose), curve in sorted(curves.items())
                ]
                for pose_set, curves in sorted(self.curves.items())
            },
        }

    @classmethod
    def from_json(cls, data: Any, *, sound: Sound | None = None) -> Self:
        """The line that `to_json` wrote, with the edits that a person made to it. Raises `InputError`."""
        if not isinstance(data, dict) or data.get("format") != FORMAT:
            raise InputError(f'not a line in lipdb\'s JSON (its "format" should be {FORMAT!r}); make one with `lipdb say -o`')
        try:
            mapping = {str(phone): tuple(str(common).split()) for phone, common in data.get("mapping", {}).items()}
            curves = {str(pose_set): dict(map(_curve, rows)) for pose_set, rows in data.get("curves", {}).items()}
        except (KeyError, TypeError, AttributeError, CurveError) as error:
            raise InputError(f'the line\'s own layer is wrong ({type(error).__name__}: {error}); mend "mapping" or "curves"') from error
        return cls(Schedule.from_json(data.get("schedule")), sound, str(data.get("text", "")), mapping, curves)


def _curve(row: Mapping[str, str]) -> tuple[CurveKey, Curve]:
    whole = {"warp": "border", "origin": "authored", "source": "line", "licence": "", "author": "", "time": "", "comment": "", **row}
    return (str(row["left"]), str(row["right"]), str(row["pose"])), curve_from_row(whole)
