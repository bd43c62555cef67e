"""Which OpenGL draws: every library that is here works, and a missing one is said."""

from __future__ import annotations

import os
import subprocess
import sys
import threading

import numpy as np
import pytest

from lipdb.render.gl import on_gl_thread

DRAW = """
import numpy as np
from lipdb.characters.mesh import Mesh, Part
from lipdb.render.renderer import Renderer
corners = np.array([[-1, -1, 0], [1, -1, 0], [0, 1, 0.5]], float)
wide = np.array([[-1, 0, 0], [1, 0, 0], [0, 0, 0]], float)
part = Part("tile", corners, np.array([[0, 1, 2]]), np.full((3, 3), 0.7), shapes={"wide": wide})
with Renderer(Mesh("tile", (part,)), size=(48, 48)) as renderer:
    print(" ".join(map(str, renderer.draw({"wide": 0.5}).ravel())))
"""
BACKEND = "from lipdb.render.gl import available, backend; print(*available()); print(backend())"


def _run(program: str, **environment: str) -> subprocess.CompletedProcess[str]:
    # PyOpenGL binds itself to one library a process, so each gets a process of its own.
    kept = {name: value for name, value in os.environ.items() if not name.startswith("LIPDB_") and name != "PYOPENGL_PLATFORM"}
    return subprocess.run([sys.executable, "-c", program], env=kept | environment, capture_output=True, text=True, timeout=120)


def _picture(**environment: str) -> np.ndarray:
    run = _run(DRAW, **environment)
    assert run.returncode == 0, run.stderr
    return np.array(run.stdout.split(), int)


def test_every_library_that_is_here_draws_the_same_picture_twice() -> None:
    names = _run(BACKEND).stdout.splitlines()[0].split()
    numpys = _picture(LIPDB_GL="numpy")
    assert len(set(numpys)) > 20
    assert names[-1] == "numpy"
    assert len(names) > 1 or os.environ.get("LIPDB_REQUIRE_GL") != "1"
    for name in names[:-1]:
        first, second = _picture(LIPDB_GL=name), _picture(LIPDB_GL=name)
        assert (first == second).all(), name
        assert np.abs(first - numpys).mean() < 1.5, name


def test_the_best_library_is_taken_unless_another_is_named() -> None:
    names, chosen = _run(BACKEND).stdout.splitlines()
    assert chosen == names.split()[0]
    assert _run(BACKEND, LIPDB_GL="numpy").stdout.splitlines()[1] == "numpy"


def test_an_opengl_that_is_too_old_is_left_for_numpy_unless_opengl_is_required() -> None:
    # Mesa pretends to be old, and gives no context of the version that pyrender asks for.
    old = {"MESA_GL_VERSION_OVERRIDE": "2.1", "MESA_GLSL_VERSION_OVERRIDE": "120"}
    assert _run(BACKEND, **old).stdout.splitlines()[1] == "numpy"
    required = _run(BACKEND, LIPDB_REQUIRE_GL="1", **old)
    assert required.returncode != 0
    assert "MissingToolError" in required.stderr


@pytest.mark.parametrize(
    ("environment", "words"),
    [
        ({"LIPDB_GL": "numpy", "LIPDB_REQUIRE_GL": "1"}, "LIPDB_REQUIRE_GL=1, but"),
        ({"LIPDB_GL": "directx"}, "choose egl, osmesa or numpy"),
    ],
)
def test_a_backend_that_can_not_be_is_an_error_that_says_what_to_do(environment: dict[str, str], words: str) -> None:
    run = _run(BACKEND, **environment)
    assert run.returncode != 0
    assert "MissingToolError" in run.stderr
    assert words in run.stderr


def test_work_on_the_opengl_thread_is_done_in_order_on_one_thread_and_errors_come_back() -> None:
    import threading

    names = {on_gl_thread(lambda: threading.current_thread().name) for _ in range(5)}
    assert len(names) == 1
    assert threading.current_thread().name not in names
    with pytest.raises(ZeroDivisionError):
        on_gl_thread(lambda: 1 / 0)


def test_the_thread_that_owns_opengl_may_ask_for_itself() -> None:
    """Python may close an abandoned film there, when it collects garbage in the middle of a call."""
    assert on_gl_thread(lambda: on_gl_thread(lambda: threading.current_thread().name)).startswith("lipdb-gl")
