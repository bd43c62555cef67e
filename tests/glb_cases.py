"""Small glTF files for tests, made by hand so that each part of one can be bent."""

from __future__ import annotations

import base64
import json
import struct
from typing import Any

import numpy as np

SQUARE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], "<f4")
FACES = np.array([0, 1, 2, 0, 2, 3], "<u2")
JAW = np.array([[0, -1, 0], [0, -1, 0], [0, 0, 0], [0, 0, 0]], "<f4")
KINDS = {"i1": 5120, "u1": 5121, "i2": 5122, "u2": 5123, "u4": 5125, "f4": 5126}


class Builder:
    """A glTF file of one square with morph targets; change `content` before asking for the bytes."""

    def __init__(self, targets: tuple[str, ...] = ("jawOpen",)) -> None:
        self.data = bytearray()
        self.content: dict[str, Any] = {
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "accessors": [], "bufferViews": [], "buffers": [{}],
        }  # fmt: skip
        position, faces = self.accessor(SQUARE, "VEC3"), self.accessor(FACES, "SCALAR")
        moved = [{"POSITION": self.accessor(JAW * (i + 1), "VEC3")} for i in range(len(targets))]
        primitive = {"attributes": {"POSITION": position}, "indices": faces, "targets": moved}
        self.content["meshes"] = [{"name": "face", "primitives": [primitive], "extras": {"targetNames": list(targets)}}]

    @property
    def primitive(self) -> dict[str, Any]:
        return self.content["meshes"][0]["primitives"][0]

    def view(self, array: np.ndarray, **more: Any) -> int:
        self.data += b"\0" * (-len(self.data) % 4)
        raw = array.tobytes()
        self.content["bufferViews"].append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(raw), **more})
        self.data += raw
        return len(self.content["bufferViews"]) - 1

    def accessor(self, array: np.ndarray, kind: str, **more: Any) -> int:
        component = KINDS[array.dtype.str[1:]]
        entry = {"bufferView": self.view(array), "componentType": component, "count": len(array), "type": kind, **more}
        self.content["accessors"].append(entry)
        return len(self.content["accessors"]) - 1

    def glb(self) -> bytes:
        for buffer in self.content["buffers"]:
            buffer.setdefault("byteLength", len(self.data))
        return container(json.dumps(self.content).encode(), bytes(self.data))

    def gltf(self, uri: str | None = None) -> bytes:
        uri = uri or "data:application/octet-stream;base64," + base64.b64encode(self.data).decode()
        self.content["buffers"][0] = {"byteLength": len(self.data), "uri": uri}
        return json.dumps(self.content).encode()


def container(text: bytes, data: bytes) -> bytes:
    text += b" " * (-len(text) % 4)
    data += b"\0" * (-len(data) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(data), 0x004E4942) + data
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks
