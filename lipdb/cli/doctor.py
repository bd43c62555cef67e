"""``lipdb doctor``: what is installed, what works, and how to mend the rest."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from importlib.metadata import PackageNotFoundError, version
from typing import Any

import click

from lipdb.cli.options import Options, json_option, print_listing
from lipdb.errors import LipdbError, MissingToolError

PACKAGES = (
    *("numpy", "scipy", "pandas", "pyarrow", "sqlalchemy", "alembic", "phonemizer", "espeakng-loader", "pypinyin"),
    *("pyrender", "pillow", "resvg-py", "av", "streamlit"),
)


@click.command(short_help="Show what is installed, what works, and how to mend the rest.")
@json_option
@click.pass_obj
def doctor(options: Options, as_json: bool) -> None:
    """Show what is installed, what works, and how to mend the rest. Exit code 8 when something is missing or broken.

    \b
    Example:
      lipdb doctor --json
    """
    rows = [*_packages(), *(_try(part, check, options) for part, check in CHECKS.items())]
    print_listing(rows, as_json=as_json, columns=("part", "state", "detail"))
    if any(row["state"] != "ok" for row in rows):
        sys.exit(MissingToolError.exit_code)


def _packages() -> Iterator[dict[str, Any]]:
    yield {"part": "python", "state": "ok", "detail": sys.version.split()[0]}
    for package in PACKAGES:
        try:
            yield {"part": package, "state": "ok", "detail": version(package)}
        except PackageNotFoundError:
            yield {"part": package, "state": "missing", "detail": f"mend it with: pip install {package}"}


def _try(part: str, check: Callable[[Options], str], options: Options) -> dict[str, Any]:
    try:
        return {"part": part, "state": "ok", "detail": check(options)}
    except LipdbError as error:
        return {"part": part, "state": "missing" if isinstance(error, MissingToolError) else "broken", "detail": str(error)}


def _database(options: Options) -> str:
    with options.open(remind=False) as db:
        waits = "; newer curated text waits: lipdb db upgrade" if db.store.outdated else ""
        return f"{db.store.describe()}, revision {db.store.revision}{waits}"


def _voice(options: Options) -> str:
    speakers: dict[str, list[str]] = {}
    with options.open(remind=False) as db:
        for row in db.languages():
            speakers.setdefault(db.voice(row["language"]).version.split(";")[0], []).append(row["language"])
    return "; ".join(f"{version}: {', '.join(languages)}" for version, languages in speakers.items())


def _pictures(_: Options) -> str:
    from lipdb.render.gl import backend

    return backend()


def _plugins(_: Options) -> str:
    from lipdb import plugins

    plugins.exporters()
    others = [
        f"{entry.name} ({entry.dist.name} {entry.dist.version})"
        for entry in plugins.installed()
        if entry.dist and entry.name != plugins.OWN
    ]
    return ", ".join(others) or "none but lipdb's own"


CHECKS: dict[str, Callable[[Options], str]] = {"plug-ins": _plugins, "database": _database, "voices": _voice, "pictures": _pictures}
