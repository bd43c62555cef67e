"""How fast exact counting is, next to phonemizer, on the same text, with as many processes.

    python benchmarks/coverage_exact.py TEXT [TEXT...] [--processes 2] [--repeat 3]

Every way runs *repeat* times in turn, each in a process of its own, so that whatever else the machine does hits all of them; the
best time of each counts. Processor time is that of all processes together: on a machine that does other things as well it says
more than the clock.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

from processes import Run, measured

VOICE = "en-us"
BARE = "phonemizer's bare wrapper"
WHOLE = "phonemizer.phonemize"
EXACT = "lipdb, exact"
WAYS = (WHOLE, BARE, EXACT)
FEW = 2000  # Lines are enough for it: it needs a millisecond for each.


def bare(lines: Sequence[str]) -> int:
    """Call phonemizer's own wrapper around espeak-ng, and nothing else."""
    from lipdb.speech.phonemes import load

    wrapper = load()
    wrapper.set_voice(VOICE)
    return sum(len(wrapper.text_to_phonemes(line)) for line in lines)


def bare_in_processes(lines: Sequence[str], processes: int) -> None:
    """The same, some lines in each process, which is started in the quickest way there is."""
    from lipdb.speech.phonemes import load

    load()
    pieces = [lines[k::processes] for k in range(processes)]
    with ProcessPoolExecutor(processes, mp_context=get_context("fork")) as pool:
        sum(pool.map(bare, pieces))


def whole_phonemizer(lines: Sequence[str], processes: int) -> None:
    """All of phonemizer, as people call it."""
    from lipdb.speech.phonemes import load

    load()  # tells phonemizer where the library is
    from phonemizer import phonemize

    phonemize(list(lines), language=VOICE, backend="espeak", njobs=processes, preserve_punctuation=True)


def exact(file: Path, processes: int) -> None:
    """An exact scan into an empty archive."""
    from lipdb.coverage.archive import Archive
    from lipdb.coverage.exact import ExactCounter
    from lipdb.coverage.executors import Workers
    from lipdb.coverage.scan import count_corpus
    from lipdb.curated.folder import read_folder
    from lipdb.paths import data_dir
    from lipdb.speech.espeak import espeak_voice

    counter = ExactCounter(espeak_voice(read_folder(Path(data_dir("phonesets"))), "en").raw())
    with tempfile.TemporaryDirectory() as folder, Workers(processes) as crew:
        count_corpus([str(file)], counter, crew, Archive(Path(folder)))


def work(way: str, file: Path, processes: int) -> None:
    """Do what is measured."""
    if way == EXACT:
        exact(file, processes)
        return
    lines = file.read_text().splitlines()
    if way == BARE:
        bare_in_processes(lines, processes)
    else:
        whole_phonemizer(lines[:FEW], processes)


def main() -> None:
    """Measure and print."""
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("texts", nargs="+", type=Path)
    options.add_argument("--processes", type=int, default=2)
    options.add_argument("--repeat", type=int, default=3)
    options.add_argument("--way", choices=WAYS, help="only do this, without measuring it")
    chosen = options.parse_args()
    if chosen.way:
        work(chosen.way, chosen.texts[0], chosen.processes)
        return
    lines = list(dict.fromkeys(line for text in chosen.texts for line in text.read_text().splitlines() if line.strip()))
    found: dict[str, list[Run]] = {way: [] for way in WAYS}
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "text.txt"
        file.write_text("\n".join(lines))
        for _ in range(chosen.repeat):
            for way in WAYS:
                found[way].append(measured([sys.executable, __file__, str(file), "--processes", str(chosen.processes), "--way", way]))
    print(f"{len(lines)} different lines, {chosen.processes} processes")
    print(f"{'':28}{'lines/s':>10}{'of bare':>10}{'µs of processor a line':>25}{'of bare':>10}")
    best = {way: (min(run.wall for run in runs), min(run.processor for run in runs)) for way, runs in found.items()}
    count = {way: min(FEW, len(lines)) if way == WHOLE else len(lines) for way in WAYS}
    speed = {way: count[way] / best[way][0] for way in WAYS}
    each = {way: best[way][1] / count[way] * 1e6 for way in WAYS}
    for way in WAYS:
        print(f"{way:28}{speed[way]:>10,.0f}{speed[way] / speed[BARE]:>10.0%}{each[way]:>25.0f}{each[BARE] / each[way]:>10.0%}")


if __name__ == "__main__":
    main()
