"""Arrays in a file that processes map into their memory: opened at once however large they are, and there only once for all."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from lipdb.files import whole_file

Arrays = Mapping[str, NDArray[Any]]
_TOLD = b"lipdb"


def write_arrays(arrays: Arrays, told: Any, path: Path) -> None:
    """Write *arrays* of one dimension and *told*, plain data, to *path*, whole or not at all. Raises `OutputError`."""
    columns = {
        name: pa.LargeListArray.from_arrays(np.array([0, len(array)]), pa.array(array.view(np.uint8) if array.dtype == bool else array))
        for name, array in arrays.items()
    }
    table = pa.table(columns).replace_schema_metadata({_TOLD: json.dumps(told).encode()})
    with whole_file(path) as temporary, pa.ipc.new_file(str(temporary), table.schema) as file:
        file.write_table(table)


def map_arrays(path: Path) -> tuple[dict[str, NDArray[Any]], Any]:
    """What `write_arrays` wrote; the arrays can't be written. Raises `OSError` or `ValueError` for any other file."""
    table = pa.ipc.open_file(pa.memory_map(str(path))).read_all()
    told = json.loads((table.schema.metadata or {})[_TOLD])
    return {name: table[name].chunk(0).values.to_numpy() for name in table.column_names}, told
