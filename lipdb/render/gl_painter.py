"""Pictures of a bent mesh by pyrender: one primitive, one shader, new vertices for every picture."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lipdb.render.gl import on_gl_thread, pyrender
from lipdb.render.morph import Morph
from lipdb.render.scene import BACKGROUND_BOTTOM, BACKGROUND_TOP, FIELD_OF_VIEW, Camera, Floats, to_screen

SHADERS = Path(__file__).parent / "shaders"
_POSITION, _LIGHT = slice(0, 3), slice(3, 6)
"""Columns of the vertex buffer, in pyrender's order; the last one, alpha, is 1."""


class GLPainter:
    """Draws a mesh with OpenGL. Every method does its work on the OpenGL thread; call from any."""

    def __init__(self, morph: Morph, light: Floats, camera: Camera, width: int, height: int) -> None:
        mesh = np.column_stack([morph.positions, light, np.ones(len(morph.positions))])
        self._vertices = np.concatenate([mesh, _wall(camera, width / height)]).astype(np.float32)
        corner = len(morph.positions)
        self._faces = np.concatenate([morph.faces, [[corner, corner + 1, corner + 2], [corner, corner + 2, corner + 3]]])
        self._matrix, self._size = camera.projection(width / height).astype(np.float32), np.array([width, height])
        on_gl_thread(self._open, camera, width, height)

    def _open(self, camera: Camera, width: int, height: int) -> None:
        library = pyrender()
        self._primitive = library.Primitive(
            positions=self._vertices[:, _POSITION],
            color_0=self._vertices[:, 3:],
            indices=self._faces,
            material=library.MetallicRoughnessMaterial(),
        )
        self._scene = library.Scene()
        self._scene.add(library.Mesh([self._primitive]))
        self._scene.add(library.PerspectiveCamera(yfov=FIELD_OF_VIEW, znear=camera.near, zfar=camera.far), pose=camera.pose)
        self._renderer = _colour_renderer(library)(width, height)
        self._renderer.render(self._scene, library.RenderFlags.OFFSCREEN)

    def paint(self, positions: Floats, light: Floats) -> NDArray[np.uint8]:
        """The picture of vertices that send this light, ``(height, width, 3)`` sRGB."""
        new = np.column_stack([positions, light])
        changed = (self._vertices[:-4, :6] != new).any(axis=1)
        rows = self._faces[:-2][changed[self._faces[:-2]].any(axis=1)].ravel()
        box = self._box(np.concatenate([self._vertices[rows, _POSITION], positions[rows]])) if len(rows) else (0, 0, 0, 0)
        self._vertices[:-4, :6] = new
        return on_gl_thread(self._paint, box)

    def _box(self, points: Floats) -> tuple[int, int, int, int]:
        """The rectangle of pixels round *points*, as OpenGL has it: left, bottom, width, height."""
        pixels = (to_screen(points, self._matrix)[:, :2] + 1) / 2 * self._size
        low = np.clip(np.floor(pixels.min(axis=0)) - 2, 0, self._size).astype(int)
        high = np.clip(np.ceil(pixels.max(axis=0)) + 2, 0, self._size).astype(int)
        return int(low[0]), int(low[1]), int(high[0] - low[0]), int(high[1] - low[1])

    def _paint(self, box: tuple[int, int, int, int]) -> NDArray[np.uint8]:
        from OpenGL import GL

        GL.glBindBuffer(GL.GL_ARRAY_BUFFER, self._primitive._buffers[0])
        GL.glBufferSubData(GL.GL_ARRAY_BUFFER, 0, self._vertices.nbytes, self._vertices)
        GL.glBindBuffer(GL.GL_ARRAY_BUFFER, 0)
        # What changes from one picture to the next is mostly the mouth: the rest stands in the frame buffer already.
        GL.glEnable(GL.GL_SCISSOR_TEST)
        GL.glScissor(*box)
        try:
            picture: NDArray[np.uint8] = self._renderer.render(self._scene, pyrender().RenderFlags.OFFSCREEN)
        finally:
            GL.glDisable(GL.GL_SCISSOR_TEST)
        return picture

    def close(self) -> None:
        """Give the buffers back. The context stays: it is the process's only one."""
        on_gl_thread(self._renderer.delete)


def _wall(camera: Camera, aspect: float) -> Floats:
    """Four corners just in front of the far plane that fill the picture, lighter at the top."""
    inverse = np.linalg.inv(camera.projection(aspect))
    corners = np.array([[-1, -1, 0.9999, 1], [1, -1, 0.9999, 1], [1, 1, 0.9999, 1], [-1, 1, 0.9999, 1]]) @ inverse.T
    wall = np.ones((4, 7), np.float32)
    wall[:, _POSITION] = corners[:, :3] / corners[:, 3:]
    wall[:2, _LIGHT], wall[2:, _LIGHT] = BACKGROUND_BOTTOM, BACKGROUND_TOP
    return wall


def _colour_renderer(library: Any) -> Any:
    """The renderer of pyrender with our shaders, that reads back colour alone (it would also read and convert the depth)."""
    from OpenGL import GL
    from pyrender.shader_program import ShaderProgramCache

    class ColourRenderer(library.Renderer):  # type: ignore[misc]
        def __init__(self, width: int, height: int) -> None:
            super().__init__(width, height)
            self._program_cache = ShaderProgramCache(shader_dir=str(SHADERS))

        def _read_main_framebuffer(self, _scene: Any, _flags: int) -> NDArray[np.uint8]:
            width, height = self._main_fb_dims
            GL.glBindFramebuffer(GL.GL_READ_FRAMEBUFFER, self._main_fb_ms)
            GL.glBindFramebuffer(GL.GL_DRAW_FRAMEBUFFER, self._main_fb)
            GL.glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL.GL_COLOR_BUFFER_BIT, GL.GL_NEAREST)
            GL.glBindFramebuffer(GL.GL_READ_FRAMEBUFFER, self._main_fb)
            GL.glPixelStorei(GL.GL_PACK_ALIGNMENT, 1)
            raw = GL.glReadPixels(0, 0, width, height, GL.GL_RGB, GL.GL_UNSIGNED_BYTE)
            return np.ascontiguousarray(np.frombuffer(raw, np.uint8).reshape(height, width, 3)[::-1])

    return ColourRenderer
