"""Voices, readers and exporters, found through one plug-in group.

A studio adds its own format without a fork: a package whose ``pyproject.toml`` says

    [project.entry-points.lipdb]
    studio = "studio_lipdb"

and whose module has functions of the names below, marked with `hookimpl`. lipdb's own are found the same way.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cache
from importlib.metadata import EntryPoints, entry_points
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pluggy

from lipdb.errors import InputError, MissingToolError

if TYPE_CHECKING:
    from lipdb.curated.tsv import Records
    from lipdb.performance import Performance
    from lipdb.schedule import Schedule
    from lipdb.speech.voice import Voice

GROUP = "lipdb"
OWN = "builtin"
"""The plug-in that comes with lipdb (`lipdb.builtin`)."""
hookspec = pluggy.HookspecMarker(GROUP)
hookimpl = pluggy.HookimplMarker(GROUP)

VoiceMaker = Callable[["Records", str], "Voice"]
"""Makes the voice of a language: ``maker(records, language)``."""
Reader = Callable[..., "Schedule"]
"""Reads a file of timed phones: ``reader(path, tier=None)`` gives a schedule whose symbols are not resolved yet."""
Exporter = Callable[["Performance", Path], None]
"""Writes a performance to a path that is there and empty."""


class Hooks:
    """What a plug-in may offer; each answers with names. Others win over lipdb's own, and of others the last by name."""

    @hookspec
    def lipdb_voices(self) -> Mapping[str, VoiceMaker]:  # type: ignore[empty-body]
        """Voices by the word that the column *speech* of a language's row uses."""

    @hookspec
    def lipdb_readers(self) -> Mapping[str, Reader]:  # type: ignore[empty-body]
        """Readers of timed phones by file suffix, in lower case and with the dot."""

    @hookspec
    def lipdb_exporters(self) -> Mapping[str, Exporter]:  # type: ignore[empty-body]
        """Exporters by file suffix, in lower case and with the dot."""


@cache
def _manager() -> pluggy.PluginManager:
    manager = pluggy.PluginManager(GROUP)
    manager.add_hookspecs(Hooks)
    # lipdb's own first, so that any other may take a name over, however packages are found.
    for entry in sorted(installed(), key=lambda entry: (entry.name != OWN, entry.name)):
        try:
            manager.register(entry.load(), entry.name)
        except Exception as error:  # another's code fails in ways of its own
            package = entry.dist.name if entry.dist else entry.value
            what = f"plug-in {entry.name!r} of {package} can't be loaded ({type(error).__name__}: {' '.join(str(error).split())})"
            raise MissingToolError(f"{what}; mend that package, or uninstall it") from error
    return manager


def installed() -> EntryPoints:
    """The plug-ins of the packages that are installed, lipdb's own among them."""
    return entry_points(group=GROUP)


def _gather(answers: list[Mapping[str, Any]]) -> dict[str, Any]:
    # pluggy lists the answers of the last registered plug-in first.
    return {name: value for answer in reversed(answers) for name, value in answer.items()}


def voices() -> dict[str, VoiceMaker]:
    """Every voice by name."""
    return _gather(_manager().hook.lipdb_voices())


def readers() -> dict[str, Reader]:
    """Every reader by suffix."""
    return _gather(_manager().hook.lipdb_readers())


def exporters() -> dict[str, Exporter]:
    """Every exporter by suffix."""
    return _gather(_manager().hook.lipdb_exporters())


def by_suffix(offers: Mapping[str, Any], path: Path, what: str, *, besides: Sequence[str] = ()) -> Any:
    """The offer for *path*: the longest suffix that its name ends with.

    Raises `InputError` naming every suffix there is, and those that the caller reads *besides*.
    """
    name = path.name.lower()
    for suffix in sorted(offers, key=len, reverse=True):
        if name.endswith(suffix):
            return offers[suffix]
    raise InputError(f"{path}: no {what} for this kind of file; there are {' '.join(sorted({*offers, *besides}))}")
