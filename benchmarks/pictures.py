"""How long a picture takes: `python benchmarks/pictures.py`. Prints milliseconds a picture for each character and painter."""

from __future__ import annotations

import time

import numpy as np

from lipdb.characters.character import built_mesh
from lipdb.render.gl import backend
from lipdb.render.renderer import Renderer

PICTURES = 30
SIZE = 512


def milliseconds(character: str, painter: str) -> float:
    """The median time of a picture whose mouth differs from the last one's, numpy and drawing together."""
    mesh = built_mesh(character)
    assert mesh is not None
    shapes = mesh.shape_names[:2]
    times = []
    with Renderer(mesh, size=(SIZE, SIZE), painter=painter) as renderer:
        renderer.draw({})
        for number in range(PICTURES):
            start = time.perf_counter()
            renderer.draw(dict(zip(shapes, (0.02 * number, 0.3), strict=True)))
            times.append(time.perf_counter() - start)
    return 1000 * float(np.median(times))


if __name__ == "__main__":
    print(f"{SIZE} x {SIZE}, ms a picture")
    for painter in dict.fromkeys((backend(), "numpy")):
        for character in ("robin", "crab"):
            print(f"{character:8}{painter:8}{milliseconds(character, painter):8.1f}")
