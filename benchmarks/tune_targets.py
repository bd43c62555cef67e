"""Tune the articulation parameters on recorded lips, and say how well they follow words that they were not tuned on.

usage: python benchmarks/tune_targets.py --data FOLDER [--shrink 0.15] [--folds 5] [--write]

Starts from benchmarks/articulation (values chosen by knowledge alone) and prints opening_r and width_r before and
after. With --folds, the words of the recording are dealt into that many groups; the lips during the words of one group
are predicted with parameters tuned without any of them, so no pair of phones within those words was heard. With --write, the tuned
numbers go into targets/ and timing/ of the curated data, marked as fitted to source grid_s1; then run
`lipdb curves generate`.
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

from lipdb.curated.folder import read_folder, write_folder
from lipdb.curated.schema import table_of
from lipdb.curated.tsv import Records, Row, canonical_row
from lipdb.curves.generate import Targets
from lipdb.paths import phonesets_dir

ARTICULATION = Path(__file__).parent / "articulation"
PATHS = ("targets/facefx.tsv", "timing/facefx.tsv")
FITTED = {"origin": "fitted", "source": "grid_s1", "licence": "CC-BY-4.0", "author": "lipdb"}


def by_word(lips: Lips, space: Space, *, shrink: float, folds: int) -> Floats:
    """Lips predicted during every word with numbers tuned without that word, shape ``(F, 2)``."""
    counts = Counter(lips.word.tolist())
    group, load = {}, [0] * folds
    for word, count in sorted(counts.items(), key=lambda item: (-item[1], item[0])):
        group[word] = int(np.argmin(load))
        load[group[word]] += count
    fold = np.array([group[word] for word in lips.word])
    predicted = np.empty_like(lips.truth)
    for k in range(folds):
        x = fit(lips, space, shrink=shrink, mask=(fold != k).astype(float))
        predicted[fold == k] = lips.predicted(space.targets(x))[fold == k]
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
    print("before tuning       opening_r {:.3f}  width_r {:.3f}".format(*lips.scores(lips.predicted(targets))), flush=True)
    x = np.round(fit(lips, space, shrink=options.shrink), 3)
    print("tuned               opening_r {:.3f}  width_r {:.3f}".format(*lips.scores(lips.predicted(space.targets(x)))), flush=True)
    if options.write:
        write_folder(tuned_rows(start, space, x), folder)
    if options.folds:
        predicted = by_word(lips, space, shrink=options.shrink, folds=options.folds)
        print("words not tuned on  opening_r {:.3f}  width_r {:.3f}".format(*lips.scores(predicted)), flush=True)


if __name__ == "__main__":
    main()
