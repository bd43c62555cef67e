"""Part of the package build: make the dashboard's viewer, and go on without it where that can't be."""

from __future__ import annotations

import runpy
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class ViewerHook(BuildHookInterface):  # type: ignore[type-arg]
    """Builds `dashboard/viewer/dist` and puts it into the wheel."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:  # noqa: ARG002
        """Build what is not up to date; a failure is a warning, and the dashboard says then what is missing."""
        if self.target_name != "wheel":
            return
        viewer = Path(self.root) / "dashboard" / "viewer"
        builder = runpy.run_path(str(viewer / "build.py"))
        if not builder["up_to_date"]():
            try:
                builder["build"]()
            except builder["NotBuiltError"] as reason:
                self.app.display_warning(f"the dashboard's viewer is not built: {reason}")
        if builder["DIST"].is_dir():
            build_data["force_include"][str(builder["DIST"])] = "lipdb/_data/dashboard/viewer/dist"
