"""`lipdb curves generate`: the folder's curves made again, or checked."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from click.testing import CliRunner

from lipdb.cli import cli
from lipdb.curated.folder import read_folder
from lipdb.errors import CurveError

SHIPPED = Path(__file__).parent.parent / "phonesets"
CURVES = "curves/facefx.tsv"


@pytest.fixture
def folder(tmp_path):
    return Path(shutil.copytree(SHIPPED, tmp_path / "phonesets"))


def run(folder, *arguments):
    result = CliRunner().invoke(cli, ["--phonesets", str(folder), "curves", "generate", *arguments])
    if result.exception and not isinstance(result.exception, SystemExit):
        raise result.exception
    return result


def edit(folder, path, old, new):
    text = (folder / path).read_text("utf-8")
    assert old in text
    (folder / path).write_text(text.replace(old, new, 1), "utf-8", newline="\n")


def test_the_shipped_folder_passes_the_check(folder):
    assert run(folder, "--check").exit_code == 0


def test_generating_again_changes_no_byte(folder):
    before = (folder / CURVES).read_bytes()
    assert "0 changed" in run(folder).stderr
    assert (folder / CURVES).read_bytes() == before


def test_a_changed_target_fails_the_check_until_the_curves_are_made_again(folder):
    row = next(line for line in (folder / "targets/facefx.tsv").read_text("utf-8").splitlines() if line.startswith("eh\topen\t"))
    cells = row.split("\t")
    edit(folder, "targets/facefx.tsv", row, "\t".join([*cells[:2], "0.2345", *cells[3:]]))
    with pytest.raises(CurveError, match="lipdb curves generate"):
        run(folder, "--check")
    before = read_folder(folder)[CURVES]
    run(folder, "--author", "ann")
    after = read_folder(folder)[CURVES]
    changed = {key for key in before if before[key] != after[key]}
    assert changed
    assert {after[key]["author"] for key in changed} == {"ann"}
    assert all("eh" in key[:2] and key[2] == "open" for key in changed)
    assert run(folder, "--check").exit_code == 0


def test_an_authored_curve_stays(folder):
    row = next(line for line in (folder / CURVES).read_text("utf-8").splitlines() if line.startswith("d\tah\topen\t"))
    mine = row.replace("generated", "authored").replace(row.split("\t")[3], "0:0 0.5:0.111 1:0")
    edit(folder, CURVES, row, mine)
    run(folder)
    assert mine in (folder / CURVES).read_text("utf-8")
    assert run(folder, "--check").exit_code == 0


def test_pairs_can_be_added_to_a_characters_table(folder):
    path = "characters/crab/curves/crab.tsv"
    assert ("f", "th", "smile") not in read_folder(folder)[path]
    run(folder, "--table", path, "--pair", "f-th", "--pair", "th-_")
    rows = read_folder(folder)[path]
    assert {key[2] for key in rows if key[:2] == ("f", "th")} == {pose for (pose,) in read_folder(folder)["poses/crab.tsv"]}
    assert run(folder, "--check").exit_code == 0


@pytest.mark.parametrize("arguments", [["--pair", "a-b"], ["--table", "curves/facefx.tsv"], ["--table", CURVES, "--pair", "ab"]])
def test_half_an_answer_is_a_wrong_use(folder, arguments):
    assert run(folder, *arguments).exit_code == 2
