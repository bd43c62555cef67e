"""The character's shapes as a table, one row a frame: CSV for people and spreadsheets, Parquet for pipelines."""

from __future__ import annotations

import csv
import io
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from lipdb.performance import Performance

_CHUNK = 10_000


def write_csv(performance: Performance, path: Path) -> None:
    """Columns *frame*, *time* (seconds, six decimals) and one a shape (weight, four decimals), lines ending in LF."""
    shapes = performance.shapes
    header = io.StringIO()
    csv.writer(header, lineterminator="\n").writerow(["frame", "time", *shapes.poses])
    line = "%d,%.6f" + ",%.4f" * len(shapes.poses)
    # Adding zero turns -0.0, which would print as -0.0000, into 0.0.
    rows = np.column_stack([np.arange(len(shapes.weights)), shapes.times, np.round(shapes.weights, 4) + 0.0])
    with path.open("w", encoding="utf-8", newline="") as file:
        file.write(header.getvalue())
        for start in range(0, len(rows), _CHUNK):
            file.writelines(line % tuple(row) + "\n" for row in rows[start : start + _CHUNK].tolist())


def write_parquet(performance: Performance, path: Path) -> None:
    """The same columns (int32, float64, float32), with fps, character, language and text as metadata of the schema."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    shapes = performance.shapes
    line = performance.line
    about = {
        "fps": f"{shapes.fps:g}",
        "character": performance.character.name,
        "language": line.language if line else "",
        "text": line.text if line else "",
    }
    columns = [pa.array(np.arange(len(shapes.weights)), pa.int32()), pa.array(shapes.times, pa.float64())]
    columns += [pa.array(weights.astype(np.float32), pa.float32()) for weights in shapes.weights.T]
    table = pa.Table.from_arrays(columns, names=["frame", "time", *shapes.poses]).replace_schema_metadata(about)
    pq.write_table(table, path, compression="zstd")
