"""How fast the engine is, and how fast a peer is in the same run.

usage: pytest benchmarks/test_engine_speed.py -s

Speech is eleven phones a second of random common phones with short pauses, played with the shipped curves over the nine
facefx poses at 60 frames a second. The peer is openfacefx, its weights without its key reduction, on the same phones; its
tests are skipped only where it is not installed (pip install openfacefx). Times are processor time, so that work beside
it does not count, and the best of several rounds. The last lines printed are the table of docs/benchmarks.md.
"""

from __future__ import annotations

import time
from collections.abc import Iterator

import numpy as np
import pytest
from pytest_benchmark.fixture import BenchmarkFixture

from lipdb.curated.folder import read_folder
from lipdb.curves.lookup import CurveBook
from lipdb.engine import CurveTable, animate, animate_lines
from lipdb.paths import phonesets_dir
from lipdb.poses import PoseSet

pytestmark = pytest.mark.benchmark(timer=time.process_time)

RATE = 11
ARPABET = {
    "_": "sil", "aa": "AA", "ae": "AE", "ah": "AH", "ao": "AO", "aw": "AW", "ay": "AY", "bmp": "M", "d": "D", "eh": "EH", "er": "ER",
    "f": "F", "h": "HH", "ih": "IH", "kg": "K", "l": "L", "ow": "OW", "oy": "OY", "r": "R", "sh": "SH", "th": "TH", "ue": "UW", "w": "W",
    "z": "Z",
}  # fmt: skip
Line = tuple[list[int], list[str]]


@pytest.fixture(scope="module")
def rows() -> Iterator[dict[str, float]]:
    """Milliseconds by what was measured; printed as a table in the end."""
    found: dict[str, float] = {}
    yield found
    print("\n\n| what | lipdb | openfacefx | ratio |\n|---|---:|---:|---:|")
    for what in (name for name in found if not name.startswith("peer ")):
        peer = found.get(f"peer {what}")
        beside = f"{peer:.1f} ms | {peer / found[what]:.0f}" if peer else " | "
        print(f"| {what} | {found[what]:.2f} ms | {beside} |")


@pytest.fixture(scope="module")
def rules() -> PoseSet:
    """The facefx poses."""
    return PoseSet.from_records(read_folder(phonesets_dir()), "facefx")


@pytest.fixture(scope="module")
def table() -> CurveTable:
    """The shipped curves of all common phones."""
    records = read_folder(phonesets_dir())
    return CurveBook.from_records(records, "facefx").table([phone for (phone,) in records["common.tsv"]])


def speech(table: CurveTable, seconds: float, seed: int = 0) -> Line:
    """Random phones, eleven a second, one in twelve a pause."""
    rng = np.random.default_rng(seed)
    count = round(seconds * RATE)
    numbers = rng.integers(1, len(table.phones), count)
    numbers[::12] = 0
    lengths = rng.uniform(0.5, 1.5, count)
    edges = np.rint(np.append(0, np.cumsum(lengths)) * seconds / lengths.sum() * 1e6).astype(int)
    return edges.tolist(), [table.phones[i] for i in numbers]


@pytest.mark.parametrize(("minutes", "rounds"), [(1, 200), (60, 7), (600, 3)])
def test_a_take_costs_at_most_a_millisecond_a_minute(
    benchmark: BenchmarkFixture, rows: dict[str, float], table: CurveTable, rules: PoseSet, minutes: int, rounds: int
) -> None:
    """One minute, one hour and ten hours cost the same a minute."""
    edges, phones = speech(table, minutes * 60)
    benchmark.pedantic(animate, (table, rules, edges, phones), rounds=rounds, warmup_rounds=1)
    rows[f"{minutes} min in one take, a minute"] = spent = benchmark.stats.stats.min * 1e3 / minutes
    assert spent <= 1


def test_a_line_of_three_seconds_costs_less_than_a_millisecond(
    benchmark: BenchmarkFixture, rows: dict[str, float], table: CurveTable, rules: PoseSet
) -> None:
    """What calling numpy costs shows here."""
    edges, phones = speech(table, 3)
    benchmark.pedantic(animate, (table, rules, edges, phones), rounds=1000, warmup_rounds=5)
    rows["3 s line alone"] = benchmark.stats.stats.min * 1e3
    assert benchmark.stats.stats.min < 1e-3


def test_sixteen_thousand_lines_cost_less_than_one_and_a_half_seconds(
    benchmark: BenchmarkFixture, rows: dict[str, float], table: CurveTable, rules: PoseSet
) -> None:
    """Constraints and closures included, and no loop over lines."""
    lines = [speech(table, 3.6, seed) for seed in range(16_000)]
    tracks = benchmark.pedantic(animate_lines, (table, rules, lines), rounds=5, warmup_rounds=1)
    rows["16,000 lines of 3.6 s in one call"] = benchmark.stats.stats.min * 1e3
    assert len(tracks) == 16_000
    assert benchmark.stats.stats.min < 1.5


@pytest.mark.parametrize(
    ("what", "seconds", "rounds", "times"),
    [
        ("1 min in one take, a minute", 60, 3, 1),
        ("3 s line alone", 3, 50, 1),
        ("16,000 lines of 3.6 s in one call", 3.6, 50, 16_000),  # the peer takes one line a call; one is measured
    ],
)
def test_the_peer_on_the_same_speech(
    benchmark: BenchmarkFixture, rows: dict[str, float], table: CurveTable, what: str, seconds: float, rounds: int, times: int
) -> None:
    """openfacefx: weights of its 15 visemes at 60 frames a second."""
    peer = pytest.importorskip("openfacefx", reason="openfacefx is not installed: pip install openfacefx")
    edges, phones = speech(table, seconds)
    segments = [
        peer.PhonemeSegment(ARPABET[phone], start / 1e6, end / 1e6) for start, end, phone in zip(edges, edges[1:], phones, strict=False)
    ]
    times_matrix = benchmark.pedantic(peer.build_viseme_curves, (segments,), {"fps": 60.0}, rounds=rounds, warmup_rounds=1)
    rows[f"peer {what}"] = benchmark.stats.stats.min * 1e3 * times
    assert len(times_matrix[0]) >= seconds * 60
