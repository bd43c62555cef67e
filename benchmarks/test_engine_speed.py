"""How fast the engine is, and how fast a peer is in the same run.

usage: pytest benchmarks/test_engine_speed.py -s

Speech is eleven phones a second of random common phones with short pauses, played with the shipped curves over the nine
facefx poses at 60 frames a second. The peer is openfacefx, its weights without its key reduction, on the same phones; its
tests are skipped only where it is not installed (pip install openfacefx). Times are processor time, so that work beside
it does not count, and the best of several rounds. A machine is as fast as its neighbours let it, so a baseline stands in the
same run: 18 calls of np.interp, which a minute of nine poses would need if every pair were looked up so (two pairs cover every
instant). The last lines printed are the table of docs/benchmarks.md.
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
TAKE, LINE, BATCH = "{} min in one take, a minute", "3 s line alone", "16,000 lines of 3.6 s in one call"
AIMS = {TAKE.format(1): 1.0, TAKE.format(60): 1.0, TAKE.format(600): 1.0, LINE: 1.0, BATCH: 1500.0}
"""What each is meant to cost at most, in milliseconds on two cores of its own."""
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
    print("\n\n| what | aim | lipdb | in np.interp | openfacefx | ratio |\n|---|---:|---:|---:|---:|---:|")
    for what, aim in AIMS.items():
        if what in found:
            peer = found.get(f"peer {what}")
            beside = f"{peer:.1f} ms | {peer / found[what]:.0f}" if peer else " | "
            print(f"| {what} | {aim:g} ms | {found[what]:.2f} ms | {found[what] / found['baseline']:.1f} | {beside} |")
    print(f"\nnp.interp, 18 calls for a minute: {found['baseline']:.2f} ms")


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


def test_the_baseline(benchmark: BenchmarkFixture, rows: dict[str, float]) -> None:
    """A minute of frames out of 330 pairs with five keys each, 18 times."""
    frames, times = np.arange(3600) / 60, np.sort(np.random.default_rng(0).uniform(0, 60, 330 * 5))
    weights = np.random.default_rng(1).random(330 * 5)
    benchmark.pedantic(lambda: [np.interp(frames, times, weights) for _ in range(18)], rounds=300, warmup_rounds=5)
    rows["baseline"] = benchmark.stats.stats.min * 1e3


@pytest.mark.parametrize(("minutes", "rounds"), [(1, 3000), (60, 20), (600, 3)])
def test_a_take_costs_the_same_a_minute_whatever_its_length(
    benchmark: BenchmarkFixture, rows: dict[str, float], table: CurveTable, rules: PoseSet, minutes: int, rounds: int
) -> None:
    """One minute, one hour and ten hours."""
    edges, phones = speech(table, minutes * 60)
    track = benchmark.pedantic(animate, (table, rules, edges, phones), rounds=rounds, warmup_rounds=1)
    rows[TAKE.format(minutes)] = benchmark.stats.stats.min * 1e3 / minutes
    assert len(track.weights) >= minutes * 3600


def test_a_line_of_three_seconds(benchmark: BenchmarkFixture, rows: dict[str, float], table: CurveTable, rules: PoseSet) -> None:
    """What calling numpy costs shows here."""
    edges, phones = speech(table, 3)
    track = benchmark.pedantic(animate, (table, rules, edges, phones), rounds=1000, warmup_rounds=5)
    rows[LINE] = benchmark.stats.stats.min * 1e3
    assert len(track.weights) >= 180


def test_sixteen_thousand_lines_in_one_call(benchmark: BenchmarkFixture, rows: dict[str, float], table: CurveTable, rules: PoseSet) -> None:
    """Constraints and closures included, and no loop over lines."""
    lines = [speech(table, 3.6, seed) for seed in range(16_000)]
    tracks = benchmark.pedantic(animate_lines, (table, rules, lines), rounds=5, warmup_rounds=1)
    rows[BATCH] = benchmark.stats.stats.min * 1e3
    assert len(tracks) == 16_000


@pytest.mark.parametrize(
    ("what", "seconds", "rounds", "times"),
    [
        (TAKE.format(1), 60, 3, 1),
        (LINE, 3, 50, 1),
        (BATCH, 3.6, 50, 16_000),  # the peer takes one line a call; one is measured
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
