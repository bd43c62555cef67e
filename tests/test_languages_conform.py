"""Every language that ships keeps what every language promises: the conformance kit finds nothing wrong."""

from functools import cache

import pytest

from lipdb.languages.conformance import check_language
from lipdb.languages.report import Report
from lipdb.paths import data_dir

FOLDER = data_dir("phonesets")
LANGUAGES = sorted(file.parent.name for file in FOLDER.glob("*/language.tsv"))


@cache
def report(language: str) -> Report:
    return check_language(language, FOLDER, base=FOLDER)


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_shipped_language_passes_the_kit(language):
    assert [str(finding) for finding in report(language).errors] == []


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_sample_of_a_shipped_language_has_most_pairs_and_no_pair_lacks_a_curve(language):
    coverage = report(language).coverage
    assert coverage.sentences >= 180
    assert coverage.occurring / coverage.possible > 0.5
    assert set(coverage.origins) <= {"authored", "fitted", "imported", "generated"}
