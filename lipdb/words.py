"""Numbers in sentences for people."""

from __future__ import annotations


def counted(number: int, one: str, several: str = "") -> str:
    """*number* of *one*, or of *several* (*one* with an s) when it is not a single one: ``1 row``, ``1,200 rows``."""
    return f"{number:,} {one if number == 1 else several or f'{one}s'}"
