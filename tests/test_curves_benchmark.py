"""The benchmark against real lips: it reads a recording, writes what the scorer takes, and the fit finds what it should."""

from __future__ import annotations

import csv
import gzip
import sys
from dataclasses import replace
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest

from lipdb.curated.folder import read_folder
from lipdb.curves.generate import Targets

ROOT = Path(__file__).parent.parent
SENTENCES = {
    "one": [("b", "bob"), ("aa", "bob"), ("b", "bob"), ("iy", "eats"), ("t", "eats"), ("s", "eats")],
    "two": [("f", "four"), ("ao", "four"), ("r", "four"), ("m", "moons"), ("uw", "moons"), ("n", "moons"), ("z", "moons")],
}


@pytest.fixture
def benchmark_modules(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / "benchmarks"))
    return {name: import_module(name) for name in ("grid_lips", "lip_fit", "articulation_space", "tune_targets")}


@pytest.fixture
def data(tmp_path):
    with gzip.open(tmp_path / "phones.csv.gz", "wt", encoding="utf-8", newline="") as file:
        out = csv.writer(file)
        out.writerow(["utt", "start", "end", "phone", "word", "word_index"])
        for utt, phones in SENTENCES.items():
            words = list(dict.fromkeys(word for _, word in phones))
            out.writerows([utt, 0.5 + 0.12 * n, 0.62 + 0.12 * n, phone, word, words.index(word)] for n, (phone, word) in enumerate(phones))
    with gzip.open(tmp_path / "mouth_25fps.csv.gz", "wt", encoding="utf-8", newline="") as file:
        out = csv.writer(file)
        out.writerow(["utt", "frame", "inner_gap", "inner_width"])
        out.writerows([utt, k, 0.01 * (k % 7) if k != 40 else "", 0.5 + 0.01 * (k % 5)] for utt in SENTENCES for k in range(75))
    return tmp_path


def rows(path):
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


@pytest.mark.parametrize("more", [[], ["--targets", str(ROOT / "benchmarks" / "articulation")]])
def test_predictions_have_a_row_a_frame_and_close_on_b(benchmark_modules, data, monkeypatch, more):
    monkeypatch.setattr(sys, "argv", ["grid_lips.py", "--data", str(data), "-o", str(data / "out.csv"), *more])
    benchmark_modules["grid_lips"].main()
    found = rows(data / "out.csv")
    assert [(row["utt"], int(row["frame"])) for row in found] == [(utt, k) for utt in SENTENCES for k in range(75)]
    opening = np.array([float(row["opening"]) for row in found[:75]])
    assert min(opening[13:16]) == 0
    assert opening.max() > 0.1
    assert opening[:6].max() == opening[45:].max() == 0


def test_the_fit_finds_lips_that_other_numbers_made(benchmark_modules, data):
    records = {**read_folder(ROOT / "phonesets"), **read_folder(ROOT / "benchmarks" / "articulation")}
    phoneset, _, pose_set = benchmark_modules["grid_lips"].english(records)
    recording = benchmark_modules["grid_lips"].Recording.read(data, phoneset)
    start = Targets.from_records(records, "facefx")
    lip_fit = benchmark_modules["lip_fit"]
    lips = lip_fit.Lips(recording, lip_fit.lips_only(pose_set))
    space = benchmark_modules["articulation_space"].Space(start, ["ao"])
    x = space.x0.copy()
    x[[number.field == "target" and number.start == 0.38 for number in space.numbers]] = 0.2
    lips.truth = lips.predicted(space.targets(x))
    before = lips.scores(lips.predicted(start))
    after = lips.scores(lips.predicted(space.targets(lip_fit.fit(lips, space, shrink=1e-4, steps=((0.3, 4), (0.1, 4))))))
    assert lips.scores(lips.truth) == pytest.approx((1, 1))
    assert before[0] < 0.995
    assert 1 - after[0] < 0.5 * (1 - before[0])


def test_tuned_rows_name_the_recording_and_leave_other_rows_alone(benchmark_modules):
    start = read_folder(ROOT / "benchmarks" / "articulation")
    targets = Targets.from_records(start, "facefx")
    space = benchmark_modules["articulation_space"].Space(targets, ["ao"])
    made = benchmark_modules["tune_targets"].tuned_rows(start, space, space.x0)
    fitted = {(path, key) for path, table in made.items() for key, row in table.items() if row["origin"] == "fitted"}
    assert {key[0] for _, key in fitted} == {"ao", "_"}
    assert all(made[path][key] == start[path][key] for path in start for key in start[path] if (path, key) not in fitted)
    again = Targets.from_records(made, "facefx")
    for field in ("target", "glide", "insistence", "lead", "release"):
        assert getattr(again, field) == pytest.approx(getattr(targets, field), abs=1e-3)
    assert replace(again, sources={}).phones == targets.phones
