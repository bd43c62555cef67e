"""Open a glTF file: its JSON and its buffers, with nothing believed before it is checked.

Binary files (.glb, .vrm) carry their buffer; a .gltf file may hold data URIs or name a file beside it. Everything else
that a file can name (folders, absolute paths, other machines) is refused.
"""

from __future__ import annotations

import base64
import binascii
import json
import re
import struct
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from lipdb.errors import MeshError

LARGEST_FILE = 512 * 1024 * 1024
LARGEST_LIST = 200_000
PLAIN_NAME = re.compile(r"[A-Za-z0-9_-][A-Za-z0-9_. -]*")
COMPRESSED = {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression"}
JSON_CHUNK, BINARY_CHUNK = 0x4E4F534A, 0x004E4942


@dataclass(frozen=True, slots=True)
class GltfFile:
    """The file's JSON object and its buffers; *where* begins every error."""

    where: str
    content: Mapping[str, Any]
    buffers: tuple[bytes, ...]

    def fault(self, what: str) -> MeshError:
        """The error that says *what* is wrong with this file."""
        return MeshError(f"{self.where}: {what}")

    def table(self, name: str) -> list[Any]:
        """The list *name* at the top of the JSON, empty when there is none."""
        found = self.content.get(name, [])
        if not isinstance(found, list) or len(found) > LARGEST_LIST:
            raise self.fault(f"{name} is not a list of at most {LARGEST_LIST} entries; export the file again")
        return found

    def entry(self, table: str, index: Any) -> Mapping[str, Any]:
        """Entry *index* of the list *table*, an object."""
        rows = self.table(table)
        if not isinstance(index, int) or isinstance(index, bool) or not 0 <= index < len(rows):
            raise self.fault(f"{table} {index!r} does not exist (there are {len(rows)}); export the file again")
        return self.object(rows[index], f"{table} {index}")

    def object(self, value: Any, what: str) -> Mapping[str, Any]:
        """*value*, which must be a JSON object."""
        if not isinstance(value, dict):
            raise self.fault(f"{what} is not an object; export the file again")
        return value

    def items(self, value: Any, what: str) -> Sequence[Any]:
        """*value*, which must be a JSON list; None is an empty one."""
        if value is None:
            return []
        if not isinstance(value, list) or len(value) > LARGEST_LIST:
            raise self.fault(f"{what} is not a list of at most {LARGEST_LIST} entries; export the file again")
        return value

    def whole(self, value: Any, what: str, *, low: int = 0, high: int = 2**32) -> int:
        """*value*, which must be a whole number in *low*..*high*."""
        if isinstance(value, float) and value.is_integer():
            value = int(value)
        if not isinstance(value, int) or isinstance(value, bool) or not low <= value <= high:
            raise self.fault(f"{what} is {str(value)[:40]!r}, not a whole number from {low} to {high}; export the file again")
        return value

    def numbers(self, value: Any, count: int, what: str) -> list[float]:
        """*value*, which must be a list of *count* finite numbers."""
        ok = isinstance(value, list) and len(value) == count
        if not ok or not all(isinstance(x, int | float) and not isinstance(x, bool) and abs(x) < 1e30 for x in value):
            raise self.fault(f"{what} is not {count} numbers; export the file again")
        return [float(x) for x in value]


def open_gltf(path: Path) -> GltfFile:
    """Read *path*. Raises `MeshError` for a file that is missing, too large, cut off or not glTF 2.0."""
    try:
        if path.stat().st_size > LARGEST_FILE:
            raise MeshError(f"{path}: larger than {LARGEST_FILE >> 20} MiB; export the head alone")
        data = path.read_bytes()
    except OSError as error:
        raise MeshError(f"{path}: can't be read ({error.strerror}); give a .glb, .vrm or .gltf file") from error
    return parse_gltf(data, where=str(path), beside=path.parent)


def parse_gltf(data: bytes, *, where: str, beside: Path | None = None) -> GltfFile:
    """The file whose bytes are *data*; *beside* is the folder in which a .gltf's buffers may stand."""
    binary: bytes | None = None
    text = data
    if data[:4] == b"glTF":
        text, binary = _chunks(data, where)
    content = _json(text, where)
    version = content.get("asset", {}).get("version") if isinstance(content.get("asset"), dict) else None
    if not isinstance(version, str) or not version.startswith("2."):
        raise MeshError(f"{where}: glTF version {str(version)[:20]!r}, not 2.0; export the file as glTF 2.0")
    bare = GltfFile(where, content, ())
    required = set(map(str, bare.items(content.get("extensionsRequired"), "extensionsRequired")))
    if required & COMPRESSED:
        raise bare.fault(f"is compressed ({', '.join(sorted(required & COMPRESSED))}); export it without compression")
    buffers = tuple(_buffer(bare, bare.object(entry, f"buffers {i}"), i, binary, beside) for i, entry in enumerate(bare.table("buffers")))
    return GltfFile(where, content, buffers)


def _chunks(data: bytes, where: str) -> tuple[bytes, bytes | None]:
    """The JSON and the binary chunk of a GLB."""
    if len(data) < 20:
        raise MeshError(f"{where}: cut off after {len(data)} bytes; export or copy it again")
    version, length = struct.unpack_from("<II", data, 4)
    if version != 2:
        raise MeshError(f"{where}: GLB version {version}, not 2; export the file as glTF 2.0")
    if length != len(data):
        raise MeshError(f"{where}: says that it is {length} bytes long, but it has {len(data)}; export or copy it again")
    found: dict[int, bytes] = {}
    at = 12
    while at + 8 <= length:
        size, kind = struct.unpack_from("<II", data, at)
        if size > length - at - 8:
            raise MeshError(f"{where}: a chunk says that it is {size} bytes long, but {length - at - 8} are left; export or copy it again")
        found.setdefault(kind, data[at + 8 : at + 8 + size])
        at += 8 + size
    if JSON_CHUNK not in found:
        raise MeshError(f"{where}: has no JSON chunk; export the file again")
    return found[JSON_CHUNK], found.get(BINARY_CHUNK)


def _json(text: bytes, where: str) -> dict[str, Any]:
    try:
        content = json.loads(text.decode("utf-8"), parse_constant=_no_constant)
    except (ValueError, RecursionError) as error:
        raise MeshError(f"{where}: not a glTF file ({type(error).__name__}); give a .glb, .vrm or .gltf file") from error
    if not isinstance(content, dict):
        raise MeshError(f"{where}: not a glTF file; give a .glb, .vrm or .gltf file")
    return content


def _no_constant(name: str) -> float:
    raise ValueError(f"{name} is not a number")


def _buffer(file: GltfFile, entry: Mapping[str, Any], index: int, binary: bytes | None, beside: Path | None) -> bytes:
    """The bytes of one buffer, as many as it says."""
    length = file.whole(entry.get("byteLength"), f"the length of buffer {index}", high=LARGEST_FILE)
    uri = entry.get("uri")
    if uri is None:
        if index or binary is None:
            raise file.fault(f"buffer {index} has no data; export the file again")
        data = binary
    elif isinstance(uri, str) and uri.startswith("data:"):
        data = _data_uri(file, uri, index)
    else:
        data = _file_beside(file, uri, index, beside)
    if len(data) < length:
        raise file.fault(f"buffer {index} says that it is {length} bytes long, but it has {len(data)}; export or copy it again")
    return data[:length]


def _data_uri(file: GltfFile, uri: str, index: int) -> bytes:
    head, comma, body = uri.partition(",")
    try:
        if not comma or not head.endswith(";base64"):
            raise binascii.Error("not base64")
        return base64.b64decode(body, validate=True)
    except (binascii.Error, ValueError) as error:
        raise file.fault(f"buffer {index} is not base64 data ({error}); export the file again") from error


def _file_beside(file: GltfFile, uri: Any, index: int, beside: Path | None) -> bytes:
    if beside is None or not isinstance(uri, str) or not PLAIN_NAME.fullmatch(uri):
        raise file.fault(f"buffer {index} is in {str(uri)[:60]!r}; only a file beside this one can be read: export as .glb")
    path = beside / uri
    try:
        if path.is_symlink() or path.stat().st_size > LARGEST_FILE:
            raise file.fault(f"buffer {index}: {uri} is a link or too large; export as .glb")
        return path.read_bytes()
    except OSError as error:
        raise file.fault(f"buffer {index}: {uri} can't be read ({error.strerror}); keep it beside the .gltf file") from error
