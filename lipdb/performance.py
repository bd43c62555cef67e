"""A performance: a track of pose weights on a character, with its sound. What is saved, drawn and exported."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from lipdb import plugins
from lipdb.files import whole_file

if TYPE_CHECKING:
    from lipdb.characters.character import Character
    from lipdb.export.cues import Cue
    from lipdb.line import Line
    from lipdb.sound import Sound
    from lipdb.track import Track

HOLD = 0.08
"""Seconds that a sprite cue is held at least: two frames of film at 24 a second, as hand-drawn mouths are."""

REST_NAMES = ("X", "rest", "neutral")


@dataclass(frozen=True, slots=True, eq=False)
class Performance:
    """*track* holds weights of the poses of *character*'s pose set; *sound* starts where the track starts.

    *line* is what the track was made from; it travels in the JSON.
    """

    track: Track
    character: Character
    sound: Sound | None = None
    line: Line | None = None

    @property
    def shapes(self) -> Track:
        """Weights of the character's own shapes, through its links."""
        return self.character.shapes(self.track)

    @property
    def rest(self) -> str:
        """The shape of silence: the character's own if it has one of the usual names, else ``X``."""
        shapes = (*self.character.pictures, *self.shapes.poses)
        return next((name for name in REST_NAMES if name in shapes), REST_NAMES[0])

    def cues(self, hold: float = HOLD) -> list[Cue]:
        """One shape at a time, each held for *hold* seconds or more: ``(start, end, shape)``, closures never lost."""
        from lipdb.export.cues import cues

        return cues(self.shapes, hold, keep=self.character.closures, rest=self.rest)

    def save(self, path: str | Path) -> None:
        """Write to *path* in the format that its suffix names (see docs/formats.md), whole or not at all.

        The same schedule, sound and character give the same bytes. Raises `InputError` for a suffix that no exporter has,
        `OutputError` when the file can't be written.
        """
        path = Path(path)
        export = plugins.by_suffix(plugins.exporters(), path, "exporter")
        with whole_file(path) as temporary:
            export(self, temporary)
