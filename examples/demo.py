"""The main job: an English and a Mandarin line on the human head and on the crab, as video, mesh and table."""

import sys
import time
from concurrent.futures import ProcessPoolExecutor
from itertools import product
from pathlib import Path

import lipdb

LINES = {
    "hello": ("en", "Hello world! My little crab can finally speak."),
    "nihao": ("cmn", "你好，世界！小螃蟹会说话了。"),
}
CHARACTERS = ("robin", "crab")
SUFFIXES = (".mp4", ".glb", ".csv")


def perform(name: str, character: str, folder: Path) -> list[Path]:
    """Say one line on one face; the files that it made."""
    language, text = LINES[name]
    with lipdb.open() as db:
        take = db.animate(db.say(text, language=language), character=character)
    paths = [folder / f"{name}-{character}{suffix}" for suffix in SUFFIXES]
    for path in paths:
        take.save(path)
    return paths


def main(folder: Path) -> None:
    """Every line on every face, two at a time, and what was done."""
    folder.mkdir(parents=True, exist_ok=True)
    started = time.perf_counter()
    with lipdb.open() as db:
        db.store.upgrade()  # rows of newer shipped text that nobody has edited follow
        for language, text in LINES.values():
            schedule = db.say(text, language=language).schedule
            print(f"{db.language(language)['name']}: {text}  ({schedule.duration:.1f} s, {len(schedule.phones)} phones)", flush=True)
    with ProcessPoolExecutor(2) as pool:
        for paths in pool.map(perform, *zip(*product(LINES, CHARACTERS), strict=True), [folder] * 4):
            print(f"  wrote {' '.join(map(str, paths))}", flush=True)
    print(f"Done in {time.perf_counter() - started:.1f} s. Open {folder}/hello-robin.mp4, or say something of your own:")
    print('  .venv/bin/lipdb say "How are you?" --character crab -o how.mp4')
    print("See it, look for gaps and edit it in the browser:")
    print("  .venv/bin/lipdb dashboard")


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "demo"))
