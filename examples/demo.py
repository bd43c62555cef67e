"""The main job: an English and a Mandarin line on the human head and on the crab, as video, mesh and table."""

import sys
import time
from pathlib import Path

import lipdb

LINES = {
    "hello": ("en", "Hello world! My little crab can finally speak."),
    "nihao": ("cmn", "你好，世界！小螃蟹会说话了。"),
}
CHARACTERS = ("robin", "crab")
SUFFIXES = (".mp4", ".glb", ".csv")


def main(folder: Path) -> None:
    """Write every line on every character into *folder*, and say what was done."""
    folder.mkdir(parents=True, exist_ok=True)
    started = time.perf_counter()
    with lipdb.open() as db:
        db.store.upgrade()  # rows of newer shipped text that nobody has edited follow
        for name, (language, text) in LINES.items():
            line = db.say(text, language=language)
            print(f"{text}  ({db.language(language)['name']}, {line.schedule.duration:.1f} s, {len(line.schedule.phones)} phones)")
            for character in CHARACTERS:
                take = db.animate(line, character=character)
                for suffix in SUFFIXES:
                    path = folder / f"{name}-{character}{suffix}"
                    take.save(path)
                    print(f"  wrote {path}", flush=True)
    print(f"Done in {time.perf_counter() - started:.1f} s. Open {folder}/hello-robin.mp4, or say something of your own:")
    print('  .venv/bin/lipdb say "How are you?" --character crab -o how.mp4')


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "demo"))
