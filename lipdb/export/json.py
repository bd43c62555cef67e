"""A performance as JSON: the whole line, so that it can be edited, explained and made again, and the track as sparse keys."""

from __future__ import annotations

import json
import re
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from lipdb.errors import InputError
from lipdb.export.keys import TOLERANCE, Key, dense_weights, sparse_keys
from lipdb.line import FORMAT as LINE_FORMAT
from lipdb.line import Line
from lipdb.schedule import LONGEST
from lipdb.track import Track

if TYPE_CHECKING:
    from lipdb.performance import Performance
    from lipdb.sound import Sound

FORMAT = "lipdb performance 1"

_PAIR = re.compile(r"\[\n\s*([-\d.e]+),\n\s*([-\d.e]+)\n\s*\]")


def write_json(performance: Performance, path: Path) -> None:
    """Write the line, the character's name and the pose track.

    Keys are ``[frame, weight]``, joined by straight lines; read back, they are within `TOLERANCE` of the track.
    """
    document = {
        "format": FORMAT,
        "lipdb": version("lipdb"),
        "character": performance.character.name,
        "pose_set": performance.character.pose_set,
        "line": performance.line.to_json() if performance.line else None,
        "track": track_to_json(performance.track),
    }
    text = json.dumps(document, indent=1, ensure_ascii=False)
    # One key a line; a line break never stands inside a JSON string, so only keys can match.
    path.write_text(_PAIR.sub(r"[\1, \2]", text) + "\n", "utf-8", newline="\n")


def track_to_json(track: Track) -> dict[str, Any]:
    """Plain data: frames a second, number of frames, and each pose's sparse keys."""
    keys = {pose: [list(key) for key in sparse_keys(track.pose(pose))] for pose in track.poses}
    return {"fps": track.fps, "frames": len(track.weights), "tolerance": TOLERANCE, "keys": keys}


def track_from_json(data: Any) -> Track:
    """The track that `track_to_json` wrote. Raises `InputError` for anything else."""
    try:
        fps, frames = float(data["fps"]), int(data["frames"])
        keys = {str(pose): [_key(key, frames) for key in pose_keys] for pose, pose_keys in data["keys"].items()}
    except (LookupError, TypeError, ValueError, AttributeError, OverflowError) as error:
        raise InputError(f"not a track in lipdb's JSON ({type(error).__name__}: {error}); make one with `lipdb say -o`") from error
    if not 0 < fps <= 1000 or not 0 <= frames <= LONGEST * fps:
        raise InputError(
            f"a track of {frames} frames at {fps:g} a second can't be; frames a second must be 0 to 1000 and a track at most a day"
        )
    columns = [dense_weights(sorted(pose_keys), frames) for pose_keys in keys.values()]
    return Track(np.column_stack(columns) if columns else np.zeros((frames, 0)), tuple(keys), fps)


def _key(key: Any, frames: int) -> Key:
    frame, weight = int(key[0]), float(key[1])
    if not 0 <= frame < frames or not 0 <= weight <= 1:
        raise ValueError(f"key {key!r} is outside of the track")
    return frame, weight


def read_track(path: Path) -> Track:
    """The track in a performance's JSON. Raises `InputError`."""
    try:
        return track_from_json(_document(path).get("track"))
    except InputError as error:
        raise _at(path, error) from error


def read_line(path: Path, *, sound: Sound | None = None) -> Line:
    """The line in a performance's JSON, or in a line's own. Raises `InputError`."""
    document = _document(path)
    try:
        return Line.from_json(document if document.get("format") == LINE_FORMAT else document.get("line"), sound=sound)
    except InputError as error:
        raise _at(path, error) from error


def made_for(path: Path) -> tuple[str | None, float | None]:
    """The character and the frames a second that a performance's JSON was made for; None each for a line's own."""
    document = _document(path)
    if document.get("format") == LINE_FORMAT:
        return None, None
    try:
        return str(document["character"]), track_from_json(document.get("track")).fps
    except (InputError, KeyError) as error:
        raise InputError(f"{path}: it names no character or holds no track ({error}); make it again with `lipdb say -o`") from error


def _at(path: Path, error: InputError) -> InputError:
    return error if str(error).startswith(str(path)) else type(error)(f"{path}: {error}")


def _document(path: Path) -> dict[str, Any]:
    try:
        # Editors on Windows put a byte order mark in front, and JSON may escape half a character, which no file can hold.
        document = json.loads(path.read_text("utf-8-sig"))
        json.dumps(document, ensure_ascii=False).encode()
    except FileNotFoundError as error:
        raise InputError(f"{path}: no such file") from error
    except (OSError, ValueError, RecursionError) as error:
        raise InputError(f"{path}: not JSON in UTF-8 ({error}); give a file that `lipdb say -o` wrote") from error
    if not isinstance(document, dict) or document.get("format") not in (FORMAT, LINE_FORMAT):
        raise InputError(f'{path}: its "format" should be {FORMAT!r} or {LINE_FORMAT!r}; give a file that `lipdb say -o` wrote')
    return document
