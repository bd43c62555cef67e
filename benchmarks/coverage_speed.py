"""How fast a corpus is counted, exactly and fast, with an empty cache and a full one, and how fast Polars and DuckDB are beside it.

usage: python benchmarks/coverage_speed.py FOLDER --english SEED [--chinese SEED] [--sizes 1 10 100 200 1000] [--rounds 3]

Texts are grown from the seeds into FOLDER (`benchmarks/corpus_text.py`) and stay there. Each run is the whole command
``lipdb coverage scan`` in a process of its own: start, reading, counting, what is written. *cold* is with an empty cache,
*warm* with the voice's answers kept and opened once, but no counts. The peers do the part of the work that they can do: they cut
the text into words, count the different words, and count how the last label of one and the first of the next meet, with a lexicon
that is ready; they know no pauses, no context and no voice.

Of several rounds the best counts. MB/s are of the clock; as the machine may be shared, the processor's seconds stand beside
them, of all processes together, and memory is that of the largest process. What would take longer than five minutes is
left out.
"""

from __future__ import annotations

import argparse
import os
import shutil
import sys
from collections.abc import Callable
from pathlib import Path

import corpus_text
from processes import Run, measured

EXACT_UP_TO = 10
"""MB; more would take longer than five minutes."""


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--english", type=Path, required=True)
    parser.add_argument("--chinese", type=Path)
    parser.add_argument("--sizes", type=int, nargs="+", default=[1, 10, 100, 200, 1000], help="MB")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--only", nargs="+", help="names of runs, such as fast polars")
    given = parser.parse_args()
    given.folder.mkdir(parents=True, exist_ok=True)
    print("| text | run | MB/s | processor, s | memory, MB | load |\n|---|---|---:|---:|---:|---:|")
    for language, seed in (("en", given.english), ("cmn", given.chinese)):
        for size in given.sizes if seed else ():
            text = grown(given.folder, language, seed, size)
            for name, prepare, command in runs(given.folder, language, text, size):
                if given.only is None or name.split(",")[0] in given.only:
                    best = min((run(prepare, command) for _ in range(1 if size >= 1000 else given.rounds)), key=lambda one: one.wall)
                    load = os.getloadavg()[0]
                    row = (
                        f"{language} {size} MB",
                        name,
                        f"{size / best.wall:.1f}",
                        f"{best.processor:.1f}",
                        f"{best.memory:.0f}",
                        f"{load:.1f}",
                    )
                    print(f"| {' | '.join(row)} |", flush=True)


def grown(folder: Path, language: str, seed: Path, size: int) -> Path:
    """The text of *size* MB, made unless it is there."""
    text = folder / f"{language}-{size}.txt"
    if not text.exists():
        sentences = seed.read_text(encoding="utf-8").splitlines()
        with text.with_suffix(".part").open("wb") as out:
            out.writelines(corpus_text.grow(sentences, size * 10**6, characters=language == "cmn"))
        text.with_suffix(".part").rename(text)
    return text


def runs(folder: Path, language: str, text: Path, size: int) -> list[tuple[str, Callable[[], None], list[str]]]:
    """Names, what is done before each, and commands."""
    cache = folder / "cache"

    def cold() -> None:
        shutil.rmtree(cache, ignore_errors=True)

    def uncounted() -> None:
        shutil.rmtree(cache / "coverage", ignore_errors=True)

    def warm() -> None:
        few = folder / f"{language}-few.txt"
        with text.open("rb") as lines:
            few.write_bytes(lines.readline())
        run(uncounted, scan(few, "fast"))  # The first scan after one that asked joins its answers.
        uncounted()

    def scan(corpus: Path, mode: str) -> list[str]:
        out = str(folder / "out.parquet")
        return [sys.executable, "-m", "lipdb", "coverage", "scan", str(corpus), "--language", language, "-o", out, "--mode", mode]

    found = [("fast, cold", cold, scan(text, "fast")), ("fast, warm", warm, scan(text, "fast"))]
    if size <= EXACT_UP_TO:
        found.insert(0, ("exact", uncounted, scan(text, "exact")))
    if language == "en":
        lexicon = folder / "peers.parquet"
        for peer in ("polars", "duckdb"):
            peer_command = [sys.executable, str(Path(__file__).with_name("coverage_peers.py")), peer, str(text), str(lexicon)]
            found.append((peer, lambda: join_lexicon(cache, lexicon), peer_command))
    return found


def join_lexicon(cache: Path, lexicon: Path) -> None:
    """What the voice answered, for the peers: words with their first and last labels."""
    import pyarrow as pa
    import pyarrow.compute as pc
    import pyarrow.parquet as pq

    table = pa.concat_tables([pq.read_table(file) for file in sorted(cache.glob("lexicon/en-*/*.parquet"))])
    table = table.filter(pc.not_equal(table["reading"], "")).group_by("word").aggregate([("reading", "min")])
    labels = pc.split_pattern(table["reading_min"], " ").to_pylist()
    columns = {"word": table["word"], "first": [run[0] for run in labels], "last": [run[-1] for run in labels]}
    pq.write_table(pa.table(columns), lexicon)


def run(prepare: Callable[[], None], command: list[str]) -> Run:
    """Prepare, run *command*, and measure it."""
    prepare()
    folder = Path(command[command.index("-o") + 1]).parent if "-o" in command else None
    environment = {**os.environ, "LIPDB_CACHE": str(folder / "cache"), "LIPDB_HOME": str(folder / "home")} if folder else dict(os.environ)
    return measured(command, environment)


if __name__ == "__main__":
    main()
