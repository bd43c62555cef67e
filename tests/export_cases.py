"""Small performances for the tests of exporters."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from lipdb.characters.character import Character
from lipdb.characters.links import identity_links
from lipdb.characters.mesh import Mesh, Part
from lipdb.curves.through import Link
from lipdb.line import Line
from lipdb.performance import Performance
from lipdb.schedule import Phone, Schedule
from lipdb.sound import Sound
from lipdb.track import Track

POSES = ("open", "W", "PBM")


def _track() -> Track:
    """A second of opening and closing, with the lips pressed in the middle for three frames."""
    time = np.arange(60) / 60
    weights = np.stack([np.sin(np.pi * time * 3) ** 2, 0.3 * np.sin(np.pi * time), np.zeros(60)], axis=1)
    weights[29:32] = [0.0, 0.0, 1.0]
    return Track(weights, POSES, 60.0)


def _sound() -> Sound:
    """A second of a rising tone: unlike itself at any other moment."""
    time = np.arange(16000) / 16000
    return Sound((6000 * np.sin(2 * np.pi * (150 + 400 * time) * time)).astype(np.int16), 16000)


def _line() -> Line:
    phones = [(0.0, 0.3, "_"), (0.3, 0.45, "bmp"), (0.45, 0.7, "aa"), (0.7, 1.0, "bmp")]
    intervals = [(start, end, Phone(name, (name,), "common")) for start, end, name in phones]
    return Line(Schedule.from_intervals(intervals, language="en"), _sound(), "Bob", {"r": ("er",)})


def _mesh() -> Mesh:
    """A square with a square mouth that opens downwards."""
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], float)
    faces = np.array([[0, 1, 2], [0, 2, 3]])
    lip = np.where(corners[:, 1:2] < 0, [0.0, -0.5, 0.0], 0.0)
    mouth = Part("mouth", corners * 0.3 + [0, -0.3, 0.1], faces, np.full((4, 3), 0.1), shapes={"open": lip, "W": corners * [-0.1, 0.02, 0]})
    head = Part("head", corners, faces, np.tile([0.8, 0.6, 0.5], (4, 1)), shapes={"W": corners * [0, 0.02, 0]})
    return Mesh("square", (head, mouth))


def mesh_performance() -> Performance:
    """The square saying Bob."""
    character = Character("square", "Square", "facefx", "mesh.glb", identity_links(POSES), ("PBM",))
    # What reading the character's mesh.glb would find.
    vars(character)["mesh"] = _mesh()
    line = _line()
    return Performance(_track(), character, line.sound, line)


def flat_performance(folder: Path) -> Performance:
    """A mouth of three ellipses saying Bob; *folder* takes its pictures."""
    (folder / "flat" / "pictures").mkdir(parents=True)
    for name, height in (("A", 2), ("D", 40), ("X", 6)):
        svg = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100"><ellipse cx="50" cy="50" rx="30" ry="{height}"/></svg>'
        (folder / "flat" / "pictures" / f"{name}.svg").write_text(svg)
    links = (Link("PBM", "A", 1.0, "sum", ()), Link("open", "D", 1.0, "sum", ()))
    line = _line()
    return Performance(_track(), Character("flat", "Flat", "facefx", "pictures", links, ("A",), folder / "flat"), line.sound, line)
