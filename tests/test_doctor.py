"""The doctor names what is installed and what works, and ends with 8 when something is missing or broken."""

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

import lipdb
from lipdb.cli import cli, doctor


def examined(*options: str) -> tuple[int, dict[str, dict[str, str]]]:
    result = CliRunner().invoke(cli, [*options, "doctor", "--json"])
    return result.exit_code, {row["part"]: row for row in json.loads(result.output)}


def test_all_is_well_where_everything_is_installed(db: lipdb.Database) -> None:
    code, parts = examined("--db", db.store.where)
    assert (code, {row["state"] for row in parts.values()}) == (0, {"ok"})
    assert parts["database"]["detail"].startswith(db.store.where)
    assert parts["voices"]["detail"].endswith("ar, cmn, de, en, es, fr, hi, it, ja, ko, pt, ru")


def test_what_is_missing_and_what_is_broken_are_told_apart(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "a.db").write_text("no database")
    monkeypatch.setattr(doctor, "PACKAGES", ("numpy", "no-such-package"))
    code, parts = examined("--db", str(tmp_path / "a.db"))
    assert code == 8
    assert parts["no-such-package"] == {
        "part": "no-such-package",
        "state": "missing",
        "detail": "mend it with: pip install no-such-package",
    }
    assert (parts["numpy"]["state"], parts["database"]["state"], parts["pictures"]["state"]) == ("ok", "broken", "ok")
    assert "not a database" in parts["database"]["detail"]
