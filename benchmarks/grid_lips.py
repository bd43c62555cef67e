"""Predict the lips of recorded sentences: phone times in, opening and width of Robin's mouth out.

usage: python benchmarks/grid_lips.py --data FOLDER -o predictions.csv [--phonesets FOLDER] [--targets FOLDER]

FOLDER holds phones.csv.gz (utt, start, end, phone, word, word_index; seconds, ARPAbet) and mouth_25fps.csv.gz (utt,
frame, inner_gap, inner_width). The result has a row a video frame: utt, frame, opening, width, measured between the
inner lips of the human head's mesh. With --targets, curves are generated from the parameters of that folder
(benchmarks/articulation: the values before tuning) instead of taken from the curated data. The measured lips are read
by `Recording` for tuning and scoring; the predictions never see them.
"""

from __future__ import annotations

import argparse
import csv
import gzip
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from lipdb import engine
from lipdb.characters.human import robin
from lipdb.characters.mouth import measure
from lipdb.curated.folder import read_folder
from lipdb.curated.tsv import Records
from lipdb.curves.lookup import CurveBook
from lipdb.files import whole_file
from lipdb.paths import phonesets_dir
from lipdb.phones.phoneset import PhoneSet
from lipdb.poses import PoseSet
from lipdb.schedule import Phone, Schedule

Floats = NDArray[np.float64]
FPS, FRAMES = 25, 75


@dataclass(frozen=True)
class Recording:
    """Sentences of one speaker: *names*, *schedules*, and measured *lips* (75, 2) of each, NaN where no face was found."""

    names: list[str]
    schedules: list[Schedule]
    lips: list[Floats]

    @classmethod
    def read(cls, folder: Path, phoneset: PhoneSet) -> Recording:
        """The sentences of *folder*, phones resolved to common phones."""
        rows = defaultdict(list)
        for row in _rows(folder / "phones.csv.gz"):
            rows[row["utt"]].append(row)
        lips = {utt: np.full((FRAMES, 2), np.nan) for utt in rows}
        for row in _rows(folder / "mouth_25fps.csv.gz"):
            if row["inner_gap"] and row["utt"] in lips and int(row["frame"]) < FRAMES:
                lips[row["utt"]][int(row["frame"])] = float(row["inner_gap"]), float(row["inner_width"])
        return cls(list(rows), [phoneset.resolve(_schedule(rows[utt]))[0] for utt in rows], [lips[utt] for utt in rows])


def _schedule(rows: Sequence[dict[str, str]]) -> Schedule:
    words = {int(row["word_index"]): row["word"] for row in rows}
    place = {index: n for n, index in enumerate(sorted(words))}
    phones = [(float(row["start"]), float(row["end"]), Phone(row["phone"].upper(), word=place[int(row["word_index"])])) for row in rows]
    return Schedule.from_intervals(phones, language="en", notation="arpabet", words=[words[index] for index in sorted(words)])


def _rows(path: Path) -> list[dict[str, str]]:
    with gzip.open(path, "rt", encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def predict(table: engine.CurveTable, pose_set: PoseSet, lines: Sequence[tuple[tuple[int, ...], tuple[str, ...]]]) -> Floats:
    """Opening and width of Robin's mouth, shape ``(lines, 75, 2)``."""
    tracks = engine.animate_lines(table, pose_set, lines, fps=FPS, frames=[FRAMES] * len(lines))
    mesh = robin()
    return np.array([np.stack(measure(mesh, track.weights, track.poses), axis=-1) for track in tracks])


def write(path: Path, names: Sequence[str], lips: Floats) -> None:
    """Write *lips* as the scorer reads them."""
    with whole_file(path) as temporary, temporary.open("w", encoding="utf-8", newline="") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(["utt", "frame", "opening", "width"])
        for name, frames in zip(names, lips, strict=True):
            out.writerows([name, k, f"{opening:.5f}", f"{width:.5f}"] for k, (opening, width) in enumerate(frames))


def english(records: Records) -> tuple[PhoneSet, CurveBook, PoseSet]:
    """What the sentences need of the curated data: English phones, the curves and the pose set."""
    book = CurveBook.from_records(records, "facefx", language="en")
    return PhoneSet.from_records(records, "en"), book, PoseSet.from_records(records, "facefx")


def main() -> None:
    """Read the command line, write the predictions."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--data", type=Path, required=True, help="folder with phones.csv.gz and mouth_25fps.csv.gz")
    parser.add_argument("-o", "--output", type=Path, required=True, help="CSV file to write")
    parser.add_argument("--phonesets", type=Path, help="curated data; the shipped ones by default")
    parser.add_argument("--targets", type=Path, help="generate the curves from the targets/ and timing/ of this folder")
    options = parser.parse_args()
    records = read_folder(phonesets_dir(options.phonesets))
    if options.targets:
        records = {path: rows for path, rows in records.items() if not path.endswith("curves/facefx.tsv")} | read_folder(options.targets)
    phoneset, book, pose_set = english(records)
    recording = Recording.read(options.data, phoneset)
    lines = [schedule.common() for schedule in recording.schedules]
    table = book.table({phone for _, phones in lines for phone in phones})
    write(options.output, recording.names, predict(table, pose_set, lines))


if __name__ == "__main__":
    main()
