"""Pictures of a bent mesh by pyrender: one primitive, one shader, new vertices for every picture."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lipdb.render.gl import on_gl_thread, pyrender
from lipdb.render.morph import Morph
from lipdb.render.scene import BACKGROUND_BOTTOM, BACKGROUND_TOP, FIELD_OF_VIEW, LIGHTS, Camera, Floats, light_directions

SHADERS = Path(__file__).parent / "shaders"
_POSITION, _NORMAL, _FINISH, _COLOUR = slice(0, 3), slice(3, 6), slice(6, 8), slice(8, 12)
"""Columns of the vertex buffer, in pyrender's order. Alpha is 1 on the mesh and 0 on the wall behind it."""


class GLPainter:
    """Draws a mesh with OpenGL. Every method does its work on the OpenGL thread; call from any."""

    def __init__(self, morph: Morph, camera: Camera, width: int, height: int) -> None:
        mesh = np.column_stack([morph.positions, morph.normals, morph.finish, morph.colours, np.ones(len(morph.positions))])
        self._vertices = np.concatenate([mesh, _wall(camera, width / height)]).astype(np.float32)
        corner = len(morph.positions)
        self._faces = np.concatenate([morph.faces, [[corner, corner + 1, corner + 2], [corner, corner + 2, corner + 3]]])
        on_gl_thread(self._open, camera, width, height)

    def _open(self, camera: Camera, width: int, height: int) -> None:
        library = pyrender()
        self._primitive = library.Primitive(
            positions=self._vertices[:, _POSITION], normals=self._vertices[:, _NORMAL], texcoord_0=self._vertices[:, _FINISH],
            color_0=self._vertices[:, _COLOUR], indices=self._faces,
            material=library.MetallicRoughnessMaterial(),
        )  # fmt: skip
        self._scene = library.Scene()
        self._scene.add(library.Mesh([self._primitive]))
        self._scene.add(library.PerspectiveCamera(yfov=FIELD_OF_VIEW, znear=camera.near, zfar=camera.far), pose=camera.pose)
        for direction, (_, colour) in zip(light_directions(camera), LIGHTS, strict=True):
            light = library.DirectionalLight(color=np.array(colour), intensity=1.0)
            self._scene.add(light, pose=_towards(direction))
        self._renderer = _colour_renderer(library)(width, height)
        self._renderer.render(self._scene, library.RenderFlags.OFFSCREEN)

    def paint(self, positions: Floats, normals: Floats) -> NDArray[np.uint8]:
        """The picture of these vertices, ``(height, width, 3)`` sRGB."""
        return on_gl_thread(self._paint, positions, normals)

    def _paint(self, positions: Floats, normals: Floats) -> NDArray[np.uint8]:
        from OpenGL.GL import GL_ARRAY_BUFFER, glBindBuffer, glBufferSubData

        self._vertices[:-4, _POSITION], self._vertices[:-4, _NORMAL] = positions, normals
        glBindBuffer(GL_ARRAY_BUFFER, self._primitive._buffers[0])
        glBufferSubData(GL_ARRAY_BUFFER, 0, self._vertices.nbytes, self._vertices)
        glBindBuffer(GL_ARRAY_BUFFER, 0)
        picture: NDArray[np.uint8] = self._renderer.render(self._scene, pyrender().RenderFlags.OFFSCREEN)
        return picture

    def close(self) -> None:
        """Give the buffers back. The context stays: it is the process's only one."""
        on_gl_thread(self._renderer.delete)


def _wall(camera: Camera, aspect: float) -> Floats:
    """Four corners just in front of the far plane that fill the picture, lighter at the top."""
    inverse = np.linalg.inv(camera.projection(aspect))
    corners = np.array([[-1, -1, 0.9999, 1], [1, -1, 0.9999, 1], [1, 1, 0.9999, 1], [-1, 1, 0.9999, 1]]) @ inverse.T
    wall = np.zeros((4, 12), np.float32)
    wall[:, _POSITION] = corners[:, :3] / corners[:, 3:]
    wall[:2, 8:11], wall[2:, 8:11] = BACKGROUND_BOTTOM, BACKGROUND_TOP
    return wall


def _towards(direction: NDArray[np.float64]) -> NDArray[np.float64]:
    """A pose whose +z is *direction*: pyrender's lights shine along their own -z."""
    side = np.cross([0.0, 1.0, 0.0], direction)
    side /= np.linalg.norm(side)
    pose = np.eye(4)
    pose[:3, 0], pose[:3, 1], pose[:3, 2] = side, np.cross(direction, side), direction
    return pose


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
