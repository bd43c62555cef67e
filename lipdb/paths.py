"""Where the shipped folders are (the checkout or the wheel), and where a person's own data goes."""

from __future__ import annotations

import os
from pathlib import Path

from lipdb.errors import PhonesetError

_PACKAGE = Path(__file__).resolve().parent
DATABASE = "lipdb.db"


def data_dir(name: str) -> Path:
    """The shipped folder *name* (``phonesets``, ``migrations``, ``dashboard``): the checkout's, or else the wheel's.

    Raises `PhonesetError` when neither has it.
    """
    checkout = _PACKAGE.parent
    if (checkout / "pyproject.toml").is_file() and (checkout / name).is_dir():
        return checkout / name
    packaged = _PACKAGE / "_data" / name
    if packaged.is_dir():
        return packaged
    raise PhonesetError(f"{packaged}: lipdb's own folder {name} is missing; install lipdb again")


def phonesets_dir(folder: Path | str | None = None) -> Path:
    """The folder of curated text: *folder*, else ``LIPDB_PHONESETS``, else the shipped one."""
    chosen = folder or os.environ.get("LIPDB_PHONESETS")
    return expanded(chosen) if chosen else data_dir("phonesets")


def workspace_dir(folder: Path | str | None = None) -> Path:
    """The folder of curated text that a person edits: *folder*, else ``LIPDB_PHONESETS``, else the checkout's, else ``phonesets``
    in the user's data folder, which need not be there yet; never what was installed.
    """
    chosen = phonesets_dir(folder)
    return home() / "phonesets" if chosen.is_relative_to(_PACKAGE) else chosen


def home() -> Path:
    """The folder of a person's own data: ``LIPDB_HOME``, else ``lipdb`` in the place for users' data (XDG)."""
    if chosen := os.environ.get("LIPDB_HOME"):
        return expanded(chosen)
    return expanded(os.environ.get("XDG_DATA_HOME") or "~/.local/share") / "lipdb"


def expanded(path: Path | str) -> Path:
    """*path* with ``~`` as the home folder; it stays as it is where there is none (an unknown user, a bare container)."""
    return Path(os.path.expanduser(path))  # noqa: PTH111  (Path.expanduser raises instead)
