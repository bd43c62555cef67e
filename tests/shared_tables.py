"""The shared tables that every language leans on, without curves, so that reading them is quick."""

import shutil
from pathlib import Path

from lipdb.paths import data_dir

SHIPPED = data_dir("phonesets")


def copy_shared_tables(folder: Path) -> Path:
    """Copy them into *folder*, and what shipped languages are called, which they mention."""
    shared = (SHIPPED / name for name in ("common.tsv", "ipa.tsv", "marks.tsv", "sources.tsv"))
    for file in (*shared, *SHIPPED.glob("*/language.tsv")):
        copy = folder / file.relative_to(SHIPPED)
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(file, copy)
    return folder


def copy_workspace(folder: Path) -> Path:
    """Copy all that ships into *folder* but the languages that nothing else mentions: a workspace that is filled quickly."""
    rows = [line.split("\t") for line in (SHIPPED / "common.tsv").read_text("utf-8").splitlines()]
    mentioned = {row[rows[0].index("language")] for row in rows[1:]} | {"en"}
    others = {file.parent.name for file in SHIPPED.glob("*/language.tsv")} - mentioned
    shutil.copytree(SHIPPED, folder, ignore=lambda where, _: others if Path(where) == SHIPPED else ())
    return folder
