"""What a performance can be written as, by file suffix. Heavy packages are imported when an exporter runs."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from lipdb.export.cue_files import write_cue_json, write_cue_tsv
from lipdb.export.glb import write_glb
from lipdb.export.json import write_json
from lipdb.export.picture import write_png
from lipdb.export.table import write_csv, write_parquet
from lipdb.export.video import write_mp4, write_webp
from lipdb.export.wave import write_wave

if TYPE_CHECKING:
    from lipdb.performance import Performance

EXPORTERS: Mapping[str, Callable[[Performance, Path], None]] = {
    ".csv": write_csv,
    ".cues.json": write_cue_json,
    ".glb": write_glb,
    ".json": write_json,
    ".mp4": write_mp4,
    ".parquet": write_parquet,
    ".png": write_png,
    ".tsv": write_cue_tsv,
    ".wav": write_wave,
    ".webp": write_webp,
}
