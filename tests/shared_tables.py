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
