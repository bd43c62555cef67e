"""Lip sync data for any language and any face.

    import lipdb

    db = lipdb.open()
    line = db.say("Hello world", language="en")
    take = db.animate(line, character="robin", fps=60)
    take.save("hello.glb")

Names are imported on first use: `import lipdb` costs nothing.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from lipdb.characters.character import Character
    from lipdb.curves.curve import Curve
    from lipdb.database import Database, open
    from lipdb.errors import LipdbError
    from lipdb.line import Line
    from lipdb.performance import Performance
    from lipdb.schedule import Phone, Schedule
    from lipdb.sound import Sound
    from lipdb.track import Track

_HOMES = {
    "Character": "lipdb.characters.character",
    "Curve": "lipdb.curves.curve",
    "Database": "lipdb.database",
    "Line": "lipdb.line",
    "LipdbError": "lipdb.errors",
    "Performance": "lipdb.performance",
    "Phone": "lipdb.schedule",
    "Schedule": "lipdb.schedule",
    "Sound": "lipdb.sound",
    "Track": "lipdb.track",
    "open": "lipdb.database",
}

__all__ = [
    "Character",
    "Curve",
    "Database",
    "Line",
    "LipdbError",
    "Performance",
    "Phone",
    "Schedule",
    "Sound",
    "Track",
    "open",
]


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(_HOMES[name]), name)


def __dir__() -> list[str]:
    return __all__
