"""Tune the articulation parameters on recorded lips, and say how well they follow words that they were not tuned on.

usage: python benchmarks/tune_targets.py --data FOLDER [--shrink 0.15] [--halves] [--folds 4] [--write]

Starts from benchmarks/articulation (values chosen by knowledge alone) and prints opening_r and width_r before and
after. With --halves, each half of the sentences is predicted with numbers tuned on the other half. With --folds, the
words of the recording are dealt into that many groups; the lips during the words of one group are predicted with
numbers tuned without any of them, so no pair of phones within those words was heard. With --write, the tuned numbers
go into targets/ and timing/ of the curated data, marked as fitted to source grid_s1; then run `lipdb curves generate`.
A fit takes some minutes.
"""

from __future__ import annotations

import argparse
from collections import Counter
from datetime import UTC, datetime
from pathlib import Path

import numpy as np
from articulation_space import Space
from grid_lips import Recording, english
from lip_fit import Floats, Lips, fit, lips_only
from numpy.typing import NDArray

from lipdb.curated.folder import read_folder, write_folder
from lipdb.curated.schema import table_of
from lipdb.curated.tsv import Records, Row, canonical_row
from lipdb.curves.generate import Targets
from lipdb.paths import phonesets_dir

ARTICULATION = Path(__file__).parent / "articulation"
PATHS = ("targets/facefx.tsv", "timing/facefx.tsv")
Ints = NDArray[np.int64]
FITTED = {"origin": "fitted", "source": "grid_s1", "licence": "CC-BY-4.0", "author": "lipdb"}


def word_groups(lips: Lips, count: int) -> Ints:
    """The group of the word that is said at every frame; words are dealt into *count* groups of about as many frames."""
    group, load = {}, [0] * count
    for word, frames in sorted(Counter(lips.word.tolist()).items(), key=lambda item: (-item[1], item[0])):
        group[word] = int(np.argmin(load))
        load[group[word]] += frames
    return np.array([group[word] for word in lips.word])


def held_out(lips: Lips, space: Space, groups: Ints, *, shrink: float) -> Floats:
    """Lips predicted at every frame with numbers tuned without the frames of its group, shape ``(F, 2)``."""
    predicted = np.empty_like(lips.truth)
    for group in np.unique(groups):
        x = fit(lips, space, shrink=shrink, mask=(groups != group).astype(float))
        predicted[groups == group] = lips.predicted(space.targets(x))[groups == group]
    return predicted


def tuned_rows(start: Records, space: Space, x: Floats) -> dict[str, dict[tuple[str, ...], Row]]:
    """The tables of *start* with the numbers *x* in them, changed rows marked as fitted."""
    tables = {path: {key: dict(row) for key, row in start[path].items()} for path in PATHS}
    now = datetime.now(UTC).strftime("%Y-%m-%dT%H:%M:%SZ")
    for number, value in zip(space.numbers, x, strict=True):
        phone = space.start.phones[number.phone]
        timed = number.field in ("lead", "release")
        row = tables[PATHS[1]][(phone,)] if timed else tables[PATHS[0]][phone, space.start.poses[number.pose]]
        row |= {number.field: f"{np.exp(value) if number.field == 'insistence' else value:.3f}", "time": now, **FITTED}
    return {path: {key: _canonical(path, row) for key, row in rows.items()} for path, rows in tables.items()}


def _canonical(path: str, row: Row) -> Row:
    table = table_of(path)
    assert table is not None
    return canonical_row(table, row)


def main() -> None:
    """Read the command line, tune, print the scores."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--data", type=Path, required=True, help="folder with phones.csv.gz and mouth_25fps.csv.gz")
    parser.add_argument("--phonesets", type=Path, help="curated data; the shipped ones by default")
    parser.add_argument("--shrink", type=float, default=0.15, help="how strongly numbers are held to their articulatory start")
    parser.add_argument("--folds", type=int, default=0, help="groups of words for cross-validation; 0: none")
    parser.add_argument("--halves", action="store_true", help="tune on each half of the sentences and score on the other")
    parser.add_argument("--write", action="store_true", help="write the tuned numbers into the curated data")
    options = parser.parse_args()
    folder = phonesets_dir(options.phonesets)
    start = read_folder(ARTICULATION)
    records = {**read_folder(folder), **start}
    phoneset, _, pose_set = english(records)
    recording = Recording.read(options.data, phoneset)
    targets = Targets.from_records(records, "facefx")
    lips = Lips(recording, lips_only(pose_set))
    space = Space(targets, lips.phones)
    _say("before tuning", lips.scores(lips.predicted(targets)))
    x = np.round(fit(lips, space, shrink=options.shrink), 3)
    _say("tuned", lips.scores(lips.predicted(space.targets(x))))
    if options.write:
        write_folder(tuned_rows(start, space, x), folder)
    if options.halves:
        _say("other sentences", lips.scores(held_out(lips, space, lips.sentence % 2, shrink=options.shrink)))
    if options.folds:
        _say("other words", lips.scores(held_out(lips, space, word_groups(lips, options.folds), shrink=options.shrink)))


def _say(what: str, scores: tuple[float, float]) -> None:
    print(f"{what:20s}opening_r {scores[0]:.3f}  width_r {scores[1]:.3f}", flush=True)


if __name__ == "__main__":
    main()
