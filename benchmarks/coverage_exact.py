"""How fast exact counting is, next to phonemizer, on the same text, with as many processes.

    python benchmarks/coverage_exact.py TEXT [TEXT...] [--processes 2] [--repeat 3]

Every way runs *repeat* times in turn, so that whatever else the machine does hits all of them; the best time of each counts.
Processor time is that of all processes together: on a machine that does other things as well it says more than the clock.
"""

from __future__ import annotations

import argparse
import os
import tempfile
import time
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import lipdb
from lipdb.coverage.archive import Archive
from lipdb.coverage.exact import ExactCounter
from lipdb.coverage.executors import Workers
from lipdb.coverage.scan import count_corpus

VOICE = "en-us"
BARE = "phonemizer's bare wrapper"
WHOLE = "phonemizer.phonemize"
FEW = 2000  # Lines are enough for it: it needs a millisecond for each.


def bare(lines: Sequence[str]) -> int:
    """Call phonemizer's own wrapper around espeak-ng, and nothing else."""
    from lipdb.speech.phonemes import load

    wrapper = load()
    wrapper.set_voice(VOICE)
    return sum(len(wrapper.text_to_phonemes(line)) for line in lines)


def bare_in_processes(lines: Sequence[str], processes: int) -> None:
    """The same, some lines in each process."""
    pieces = [lines[k::processes] for k in range(processes)]
    with ProcessPoolExecutor(processes, mp_context=get_context("spawn")) as pool:
        sum(pool.map(bare, pieces))


def whole_phonemizer(lines: Sequence[str], processes: int) -> None:
    """All of phonemizer, as people call it."""
    from phonemizer import phonemize

    phonemize(list(lines), language=VOICE, backend="espeak", njobs=processes, preserve_punctuation=True)


def exact(file: Path, counter: ExactCounter, processes: int) -> None:
    """An exact scan into an empty archive."""
    with tempfile.TemporaryDirectory() as folder, Workers(processes) as crew:
        count_corpus([str(file)], counter, crew, Archive(Path(folder)))


def timed(work: Callable[[], None]) -> tuple[float, float]:
    """Seconds by the clock, and of the processors."""
    start, before = time.perf_counter(), os.times()
    work()
    after = os.times()
    return time.perf_counter() - start, sum(after[:4]) - sum(before[:4])


def main() -> None:
    """Measure and print."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("texts", nargs="+", type=Path)
    options.add_argument("--processes", type=int, default=2)
    options.add_argument("--repeat", type=int, default=3)
    chosen = options.parse_args()
    lines = list(dict.fromkeys(line for text in chosen.texts for line in text.read_text().splitlines() if line.strip()))
    from lipdb.speech.phonemes import load

    load()  # tells phonemizer where the library is
    with tempfile.TemporaryDirectory() as folder, lipdb.open(Path(folder) / "a.db") as db:
        file = Path(folder) / "text.txt"
        file.write_text("\n".join(lines))
        counter = ExactCounter(db.voice("en").raw())
        ways = {
            WHOLE: lambda: whole_phonemizer(lines[:FEW], chosen.processes),
            BARE: lambda: bare_in_processes(lines, chosen.processes),
            "lipdb, exact": lambda: exact(file, counter, chosen.processes),
        }
        found: dict[str, list[tuple[float, float]]] = {name: [] for name in ways}
        for _ in range(chosen.repeat):
            for name, work in ways.items():
                found[name].append(timed(work))
    print(f"{len(lines)} different lines, {file.name}, {chosen.processes} processes")
    best = {name: (min(clock for clock, _ in times), min(processor for _, processor in times)) for name, times in found.items()}
    bare_speed, bare_each = (len(lines) / best[BARE][0], best[BARE][1] / len(lines) * 1e6)
    print(f"{'':28}{'lines/s':>10}{'of bare':>10}{'µs of processor a line':>25}{'of bare':>10}")
    for name, (clock, processor) in best.items():
        count = min(FEW, len(lines)) if name == WHOLE else len(lines)
        speed, each = count / clock, processor / count * 1e6
        print(f"{name:28}{speed:>10,.0f}{speed / bare_speed:>10.0%}{each:>25.0f}{bare_each / each:>10.0%}")


if __name__ == "__main__":
    main()
