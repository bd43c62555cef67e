"""OpenGL without a display: which library there is, pyrender mended to use it, and the one thread that may.

EGL is taken when libEGL and libGL are installed (Debian: libegl1, libgl1), else OSMesa (Debian's libosmesa6, or the wheel
`lavavu-osmesa`, which carries one), else none: then pictures are drawn with numpy. pyrender 0.1.45 needs three mends,
all of them here: the call that PyOpenGL 3.1.0 lacks for OSMesa, its window (pyglet asks for X11 at import), and
`np.infty`. An OpenGL context belongs to one thread, so everything that touches it goes through `on_gl_thread`.
"""

from __future__ import annotations

import ctypes
import ctypes.util
import os
import sys
import threading
import types
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from functools import cache
from queue import SimpleQueue
from typing import Any, ParamSpec, TypeVar

import numpy as np

from lipdb.errors import MissingToolError
from lipdb.interrupts import give

Arguments = ParamSpec("Arguments")
Result = TypeVar("Result")

HOW_TO_MEND = "install libegl1 and libgl1 (Debian), or `pip install --no-deps lavavu-osmesa`"
_EGL_PLATFORM_DEVICE = 0x313F
_OSMESA = {"DEPTH_BITS": 0x30, "STENCIL_BITS": 0x31, "ACCUM_BITS": 0x32, "PROFILE": 0x33, "CORE_PROFILE": 0x34}
_OSMESA |= {"COMPAT_PROFILE": 0x35, "CONTEXT_MAJOR_VERSION": 0x36, "CONTEXT_MINOR_VERSION": 0x37}

_here = threading.local()
_thread = ThreadPoolExecutor(1, "lipdb-gl", initializer=lambda: setattr(_here, "owns", True))


def on_gl_thread(function: Callable[Arguments, Result], *args: Arguments.args, **kwargs: Arguments.kwargs) -> Result:
    """What *function* returns, called on the thread that owns OpenGL.

    That thread itself may come here: Python closes an abandoned film on whatever thread collects its garbage.
    """
    if getattr(_here, "owns", False):
        return function(*args, **kwargs)
    done: SimpleQueue[Future[Result]] = SimpleQueue()
    give(_thread, done, function, *args, **kwargs)
    return done.get().result()


@cache
def backend() -> str:
    """What draws the pictures here: ``egl``, ``osmesa`` or ``numpy``; OpenGL only if it really starts.

    ``LIPDB_GL`` names one of them outright; ``LIPDB_REQUIRE_GL=1`` makes having no OpenGL a failure. Raises
    `MissingToolError`.
    """
    required = os.environ.get("LIPDB_REQUIRE_GL") == "1"
    chosen = _chosen()
    if chosen != "numpy":
        try:
            on_gl_thread(pyrender)
        except MissingToolError:
            if required or os.environ.get("LIPDB_GL"):
                raise
            return "numpy"
    elif required:
        raise MissingToolError(f"LIPDB_REQUIRE_GL=1, but there is no OpenGL library here; {HOW_TO_MEND}")
    return chosen


def _chosen() -> str:
    """The backend that ``LIPDB_GL`` names, else the best that has its library here."""
    wanted = os.environ.get("LIPDB_GL", "")
    if wanted not in ("", "egl", "osmesa", "numpy"):
        raise MissingToolError(f"LIPDB_GL={wanted}: there is no such backend; choose egl, osmesa or numpy")
    chosen = next((name for name in available() if wanted in ("", name)), None)
    if chosen is None:
        raise MissingToolError(f"LIPDB_GL={wanted}: its library is not here; {HOW_TO_MEND}, or unset LIPDB_GL")
    return chosen


def available() -> tuple[str, ...]:
    """The backends that this machine has, best first; numpy is always the last."""
    egl = ("egl",) if _egl_device() is not None else ()
    osmesa = ("osmesa",) if _osmesa_library() is not None else ()
    return (*egl, *osmesa, "numpy")


@cache
def _egl_device() -> int | None:
    """The first EGL device that really starts, or None. Asked through ctypes, because PyOpenGL binds itself only once."""
    names = [ctypes.util.find_library(name) for name in ("EGL", "GL")]
    if None in names:
        return None
    try:
        egl, _ = (ctypes.CDLL(name) for name in names)
    except OSError:
        return None
    egl.eglGetProcAddress.restype = ctypes.c_void_p
    query, display = (egl.eglGetProcAddress(name) for name in (b"eglQueryDevicesEXT", b"eglGetPlatformDisplayEXT"))
    if not query or not display:
        return None
    count, devices = ctypes.c_int(), (ctypes.c_void_p * 16)()
    query_devices = ctypes.CFUNCTYPE(ctypes.c_uint, ctypes.c_int, ctypes.c_void_p, ctypes.c_void_p)(query)
    get_display = ctypes.CFUNCTYPE(ctypes.c_void_p, ctypes.c_uint, ctypes.c_void_p, ctypes.c_void_p)(display)
    if not query_devices(len(devices), devices, ctypes.byref(count)):
        return None
    egl.eglInitialize.argtypes = [ctypes.c_void_p] * 3
    starts = (egl.eglInitialize(get_display(_EGL_PLATFORM_DEVICE, devices[i], None), None, None) for i in range(count.value))
    return next((i for i, started in enumerate(starts) if started), None)


@cache
def _osmesa_library() -> str | None:
    """The path or name of libOSMesa: the system's, or the one inside the wheel `lavavu-osmesa`."""
    system = ctypes.util.find_library("OSMesa")
    return system or next((path for path in _wheel_libraries() if "/libOSMesa" in path), None)


def _wheel_libraries() -> list[str]:
    from importlib.metadata import PackageNotFoundError, files

    try:
        return [str(file.locate()) for file in files("lavavu-osmesa") or [] if ".libs/" in str(file)]
    except PackageNotFoundError:
        return []


def _loads(path: str) -> bool:
    try:
        ctypes.CDLL(path, mode=ctypes.RTLD_GLOBAL)
    except OSError:
        return False
    return True


def _load_together(paths: list[str]) -> None:
    """Load libraries that need each other and do not say where the others are: again and again while any more load."""
    waiting = paths
    while waiting:
        still = [path for path in waiting if not _loads(path)]
        if len(still) == len(waiting):
            return
        waiting = still


def _mend_osmesa(library: str) -> None:
    """Let PyOpenGL find *library*, and give it the calls that its 3.1.0 lacks for OSMesa."""
    # Only now: loaded beside EGL's, its LLVM could get in the way.
    if library in _wheel_libraries():
        _load_together(_wheel_libraries())
    find = ctypes.util.find_library
    ctypes.util.find_library = lambda name: library if name == "OSMesa" else find(name)
    try:
        import OpenGL.contextdata
        import OpenGL.osmesa as osmesa
        import OpenGL.platform as platform
    finally:
        ctypes.util.find_library = find
    shared = ctypes.CDLL(library)
    create = shared.OSMesaCreateContextAttribs
    create.restype, create.argtypes = ctypes.c_void_p, [ctypes.c_void_p, ctypes.c_void_p]

    def create_context(attributes: Any, share: Any) -> Any:
        flat = np.ascontiguousarray(attributes, np.int32)
        return ctypes.cast(create(flat.ctypes.data, share), osmesa.OSMesaCreateContext.restype)

    osmesa.OSMesaCreateContextAttribs = create_context
    for name, value in _OSMESA.items():
        setattr(osmesa, f"OSMESA_{name}", value)
    # PyOpenGL keys a dict by the current context; the pointer it would get is not hashable.
    current = shared.OSMesaGetCurrentContext
    current.restype, current.argtypes = ctypes.c_void_p, []
    for place in (platform.PLATFORM, platform, OpenGL.contextdata.platform):
        place.GetCurrentContext = place.CurrentContextIsValid = lambda: current() or 0


@cache
def pyrender() -> Any:
    """The package pyrender, mended, with its one context made current. Call it on the OpenGL thread.

    Raises `MissingToolError` when the backend is numpy, or when the library is there and no context can be made.
    """
    kind = _chosen()
    if kind == "numpy":
        raise MissingToolError(f"there is no OpenGL library here; {HOW_TO_MEND}")
    os.environ["PYOPENGL_PLATFORM"] = kind
    vars(np).setdefault("infty", np.inf)
    window = types.ModuleType("pyrender.viewer")
    window.Viewer = None  # type: ignore[attr-defined]
    sys.modules.setdefault("pyrender.viewer", window)
    try:
        if kind == "osmesa":
            _mend_osmesa(_osmesa_library() or "OSMesa")
        import pyrender as package

        platform = _platform(kind)
        platform.init_context()
        platform.make_current()
    except Exception as error:
        why = f"{type(error).__name__}: {error}".splitlines()[0]
        raise MissingToolError(f"OpenGL ({kind}) can't start ({why}); {HOW_TO_MEND}, or set LIPDB_GL=numpy") from error
    _keep.append(platform)
    return package


_keep: list[Any] = []
"""The one context of this process; pyrender makes one a renderer, and ending any of them ends EGL for all."""


def _platform(kind: str) -> Any:
    """The way of pyrender to a context, without the window system."""
    if kind == "egl":
        from pyrender.platforms import egl

        return egl.EGLPlatform(1, 1, device=egl.get_device_by_index(_egl_device()))
    from pyrender.platforms.osmesa import OSMesaPlatform

    return OSMesaPlatform(1, 1)
