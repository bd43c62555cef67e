"""Draw the picture of the README: the three faces saying "Hello world", into docs/img/faces.png."""

from pathlib import Path

import numpy as np
from PIL import Image

import lipdb
from lipdb.render.film import stills
from lipdb.schedule import MICROSECONDS

TARGET = Path(__file__).parent.parent / "docs" / "img" / "faces.png"
WORDS = "Hello world"
SHOWN = ("h", "l", "oU", "w", "3`", "_")
FACES = ("robin", "crab", "flat")
CELL = 200


def main() -> None:
    """One row a face, one column a phone."""
    with lipdb.open() as db:
        line = db.say(WORDS)
        edges = np.array(line.schedule.edges) / MICROSECONDS
        middle = {phone.symbol: time for phone, time in zip(line.schedule.phones, (edges[:-1] + edges[1:]) / 2, strict=True)}
        times = np.array([middle[symbol] for symbol in SHOWN])
        rows = [np.hstack(list(stills(db.animate(line, character=name), times, size=(CELL, CELL)))) for name in FACES]
    Image.fromarray(np.vstack(rows)).save(TARGET, optimize=True)
    print(f"wrote {TARGET}")


if __name__ == "__main__":
    main()
