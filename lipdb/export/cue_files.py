"""Sprite cues in Rhubarb Lip Sync's two layouts, so that what reads Rhubarb's output reads this."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from lipdb.performance import Performance


def write_cue_tsv(performance: Performance, path: Path) -> None:
    """A line a cue, start and shape; the last line closes with the rest shape at the end."""
    found = performance.cues()
    lines = [f"{start:.2f}\t{shape}" for start, _, shape in found]
    lines += [f"{found[-1][1]:.2f}\t{performance.rest}"] if found else []
    path.write_text("".join(f"{line}\n" for line in lines), "utf-8", newline="\n")


def write_cue_json(performance: Performance, path: Path) -> None:
    """``metadata`` with the duration, and ``mouthCues`` of start, end and value."""
    found = [(round(start, 2), round(end, 2), shape) for start, end, shape in performance.cues()]
    document = {
        "metadata": {"soundFile": "", "duration": found[-1][1] if found else 0.0},
        "mouthCues": [{"start": start, "end": end, "value": shape} for start, end, shape in found],
    }
    path.write_text(json.dumps(document, indent=1, ensure_ascii=False) + "\n", "utf-8", newline="\n")
