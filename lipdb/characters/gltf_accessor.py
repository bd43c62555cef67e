"""Read the arrays of a glTF file: dense, strided, sparse and quantised, with every length and index checked first."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lipdb.characters.gltf_file import GltfFile
from lipdb.characters.mesh import Floats, Ints

COMPONENTS = {5120: "i1", 5121: "u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
LARGEST_COUNT = 2_000_000


def accessor_count(file: GltfFile, index: Any) -> int:
    """How many entries accessor *index* says that it has."""
    return file.whole(file.entry("accessors", index).get("count"), f"the count of accessor {index}", low=1, high=LARGEST_COUNT)


def read_floats(file: GltfFile, index: Any, kind: str, *, count: int | None = None) -> Floats:
    """Accessor *index* as numbers ``(count, width)``; whole numbers marked as normalised become -1..1 or 0..1.

    Raises `MeshError` when it is of another *kind*, has another *count*, lies about its length, or is not finite.
    """
    raw = _read(file, index, kind, count)
    values = raw.astype(np.float64)
    if file.entry("accessors", index).get("normalized") is True and raw.dtype.kind in "iu":
        values = np.maximum(values / np.iinfo(raw.dtype).max, -1.0)
    if not np.isfinite(values).all() or (len(values) and np.abs(values).max() > 1e9):
        raise file.fault(f"accessor {index} holds values that are not numbers, or beyond reason; export the file again")
    return values


def read_indices(file: GltfFile, index: Any) -> Ints:
    """Accessor *index* as whole numbers ``(count,)``."""
    raw = _read(file, index, "SCALAR", None)
    if raw.dtype.kind != "u":
        raise file.fault(f"accessor {index} holds no whole numbers, but is used as indices; export the file again")
    return raw[:, 0].astype(np.int64)


def _read(file: GltfFile, index: Any, kind: str, count: int | None) -> NDArray[Any]:
    accessor = file.entry("accessors", index)
    if accessor.get("type") != kind:
        raise file.fault(f"accessor {index} is {str(accessor.get('type'))[:20]!r} where {kind} is needed; export the file again")
    has = accessor_count(file, index)
    if count is not None and has != count:
        raise file.fault(f"accessor {index} has {has} entries where {count} are needed; export all shapes from one mesh")
    dtype, width = _component(file, accessor, index), WIDTHS[kind]
    if "bufferView" in accessor:
        values = _view(file, accessor, f"accessor {index}", has, dtype, width)
    elif count is None and "sparse" not in accessor:
        raise file.fault(f"accessor {index} has no data; export the file again")
    else:
        values = np.zeros((has, width), dtype)
    return _with_sparse(file, accessor["sparse"], index, values) if "sparse" in accessor else values


def _component(file: GltfFile, accessor: Mapping[str, Any], index: Any) -> np.dtype[Any]:
    component = accessor.get("componentType")
    if not isinstance(component, int) or component not in COMPONENTS:
        raise file.fault(f"accessor {index} has the component type {str(component)[:20]!r}; export the file again")
    return np.dtype(COMPONENTS[component])


def _view(file: GltfFile, holder: Mapping[str, Any], what: str, count: int, dtype: np.dtype[Any], width: int) -> NDArray[Any]:
    """*count* rows of *width* values from the buffer view that *holder* names."""
    number = holder.get("bufferView")
    view = file.entry("bufferViews", number)
    buffer = file.whole(view.get("buffer"), f"the buffer of bufferView {number}", high=max(len(file.buffers) - 1, 0))
    if not file.buffers:
        raise file.fault("has no buffers; export the file again")
    start = file.whole(view.get("byteOffset", 0), f"the offset of bufferView {number}")
    length = file.whole(view.get("byteLength"), f"the length of bufferView {number}")
    offset = file.whole(holder.get("byteOffset", 0), f"the offset of {what}")
    size = dtype.itemsize * width
    stride = file.whole(view.get("byteStride", size), f"the stride of bufferView {number}", low=1, high=4096)
    needed = offset + (count - 1) * stride + size
    if stride < size or start + length > len(file.buffers[buffer]) or needed > length:
        raise file.fault(f"{what} reaches beyond its data ({needed} of {length} bytes); export or copy the file again")
    data = np.frombuffer(file.buffers[buffer], np.uint8, count=needed - offset, offset=start + offset)
    rows = np.lib.stride_tricks.as_strided(data, (count, size), (stride, 1), writeable=False)
    return np.ascontiguousarray(rows).view(dtype).reshape(count, width)


def _with_sparse(file: GltfFile, sparse: Any, index: Any, values: NDArray[Any]) -> NDArray[Any]:
    """*values* with the rows that *sparse* names replaced."""
    entry = file.object(sparse, f"the sparse part of accessor {index}")
    count = file.whole(entry.get("count"), f"the sparse count of accessor {index}", low=1, high=len(values))
    places = file.object(entry.get("indices"), f"the sparse indices of accessor {index}")
    kind = _component(file, places, index)
    if kind.kind != "u":
        raise file.fault(f"the sparse indices of accessor {index} are not whole numbers; export the file again")
    rows = _view(file, places, f"the sparse indices of accessor {index}", count, kind, 1)[:, 0].astype(np.int64)
    if rows.max() >= len(values):
        raise file.fault(f"accessor {index} replaces entry {int(rows.max())}, but has {len(values)}; export the file again")
    given = file.object(entry.get("values"), f"the sparse values of accessor {index}")
    replaced = values.copy()
    replaced[rows] = _view(file, given, f"the sparse values of accessor {index}", count, values.dtype, values.shape[1])
    return replaced
