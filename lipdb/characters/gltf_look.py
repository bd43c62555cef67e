"""What the surface of a glTF file looks like: base colour, vertex colours, and the texture's colour at each vertex.

Vertices carry the colours, so a texture is as fine as the mesh. A texture that can't be read leaves the base colour.
"""

from __future__ import annotations

import io
import warnings
from collections.abc import Mapping
from functools import lru_cache
from typing import Any

import numpy as np

from lipdb.characters.gltf_accessor import read_floats
from lipdb.characters.gltf_file import GltfFile
from lipdb.characters.mesh import Floats
from lipdb.errors import MeshError

GREY = (0.6, 0.6, 0.6, 1.0)
LARGEST_SIDE, KEPT_SIDE = 8192, 1024
ROUGHNESS = 0.6


def surface_look(
    file: GltfFile, primitive: Mapping[str, Any], attributes: Mapping[str, Any], count: int, where: str
) -> tuple[Floats, float]:
    """Colours ``(count, 3)`` in sRGB and roughness of a primitive with *count* vertices."""
    factor, roughness, texture = list(GREY), ROUGHNESS, None
    if "material" in primitive:
        material = file.entry("materials", primitive["material"])
        surface = file.object(material.get("pbrMetallicRoughness", {}), f"the material of {where}")
        factor = file.numbers(surface.get("baseColorFactor", [1, 1, 1, 1]), 4, f"the base colour of {where}")
        rough = file.numbers([surface.get("roughnessFactor", ROUGHNESS)], 1, f"the roughness of {where}")[0]
        roughness, texture = float(np.clip(rough, 0, 1)), surface.get("baseColorTexture")
    linear = np.tile(np.array(factor[:3]), (count, 1))
    if texture is not None:
        linear *= _texture_colours(file, texture, attributes, count)
    if "COLOR_0" in attributes:
        kind = "VEC4" if file.entry("accessors", attributes["COLOR_0"]).get("type") == "VEC4" else "VEC3"
        linear *= read_floats(file, attributes["COLOR_0"], kind, count=count)[:, :3]
    linear = np.clip(linear, 0, 1)
    return np.where(linear <= 0.0031308, linear * 12.92, 1.055 * linear ** (1 / 2.4) - 0.055), roughness


def _texture_colours(file: GltfFile, texture: Any, attributes: Mapping[str, Any], count: int) -> Floats:
    """The texture's linear colours ``(count, 3)`` where the vertices lie on it, grey when it can't be read."""
    try:
        info = file.object(texture, "a texture")
        channel = f"TEXCOORD_{file.whole(info.get('texCoord', 0), 'a texture channel', high=7)}"
        places = read_floats(file, attributes.get(channel), "VEC2", count=count)
        image = _image(file, file.entry("textures", info.get("index")).get("source"))
    except (MeshError, OSError, SyntaxError, ValueError, Warning):
        return np.full((count, 3), GREY[0])
    height, width = image.shape[:2]
    column = np.minimum((places[:, 0] % 1.0) * width, width - 1).astype(np.int64)
    row = np.minimum((places[:, 1] % 1.0) * height, height - 1).astype(np.int64)
    colours = image[row, column] / 255
    return np.asarray(np.where(colours <= 0.04045, colours / 12.92, ((colours + 0.055) / 1.055) ** 2.4))


def _image(file: GltfFile, source: Any) -> Floats:
    """A PNG or JPEG of the file. Raises what PIL and the checks raise."""
    entry = file.entry("images", source)
    view = file.entry("bufferViews", entry.get("bufferView"))
    buffer = file.whole(view.get("buffer"), "the buffer of an image", high=max(len(file.buffers) - 1, 0))
    start = file.whole(view.get("byteOffset", 0), "the offset of an image")
    length = file.whole(view.get("byteLength"), "the length of an image")
    return _decoded(file.buffers[buffer][start : start + length])


@lru_cache(maxsize=4)  # several parts of a face share one picture
def _decoded(data: bytes) -> Floats:
    """The picture in *data* as sRGB ``(height, width, 3)`` 0..255, made smaller when it is large."""
    from PIL import Image

    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with Image.open(io.BytesIO(data), formats=["PNG", "JPEG"]) as opened:
            if max(opened.size) > LARGEST_SIDE:
                raise ValueError("larger than any texture of a face")
            opened.draft("RGB", (KEPT_SIDE, KEPT_SIDE))
            opened.thumbnail((KEPT_SIDE, KEPT_SIDE))
            pixels: Floats = np.asarray(opened.convert("RGB"), dtype=np.float64)
            return pixels
