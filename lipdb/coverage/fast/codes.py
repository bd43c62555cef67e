"""Number things by their 64-bit keys: a hash table of numpy arrays that answers for a million keys at once."""

from __future__ import annotations

from typing import Self

import numpy as np
from numpy.typing import NDArray

Keys = NDArray[np.uint64]
Numbers = NDArray[np.int32]

UNKNOWN = -1
_SPARE = 3  # Slots for each key: two in three looks find their key at once even when the table is full.


class Codes:
    """Keys, none of them 0, numbered from 0 in the order in which they came."""

    def __init__(self) -> None:
        self._count = 0
        self._slots = np.zeros(1 << 12, np.uint64), np.full(1 << 12, UNKNOWN, np.int32)

    def __len__(self) -> int:
        return self._count

    @property
    def slots(self) -> tuple[Keys, Numbers]:
        """The table: by slot the key, 0 where there is none, and its number."""
        return self._slots

    @classmethod
    def of(cls, keys: Keys, numbers: Numbers, count: int) -> Self:
        """The *count* keys of a table that `slots` gave."""
        codes = cls()
        codes._slots, codes._count = (keys, numbers), count
        return codes

    def find(self, keys: Keys) -> Numbers:
        """The number of each of *keys*, `UNKNOWN` for those that are new."""
        held, numbers = self._slots
        slots = _first_slots(keys, len(held))
        found = held[slots]
        result = numbers[slots]
        open = np.flatnonzero(found != keys)
        open = open[found[open] != 0]
        while open.size:  # Another key is there: look at the next slot.
            slots[open] = (slots[open] + 1) & (len(held) - 1)
            there = held[slots[open]]
            result[open] = numbers[slots[open]]
            open = open[(there != keys[open]) & (there != 0)]
        return result

    def add(self, keys: Keys) -> Numbers:
        """The numbers of *keys*, which are new and different from each other."""
        total = self._count + len(keys)
        held, numbers = self._slots
        if total * _SPARE > len(held):
            size = 1 << (total * 2 * _SPARE - 1).bit_length()
            old, old_numbers = held[held != 0], numbers[held != 0]
            held, numbers = np.zeros(size, np.uint64), np.full(size, UNKNOWN, np.int32)
            _insert(held, numbers, old, old_numbers)
        elif not held.flags.writeable:  # others read it too
            held, numbers = held.copy(), numbers.copy()
        added = np.arange(self._count, total, dtype=np.int32)
        _insert(held, numbers, keys, added)
        self._slots, self._count = (held, numbers), total
        return added


def _first_slots(keys: Keys, size: int) -> NDArray[np.int64]:
    """The slot at which each key is looked for first: its topmost bits, the best mixed ones."""
    return (keys >> np.uint64(64 - (size.bit_length() - 1))).view(np.int64)


def _insert(held: Keys, numbers: Numbers, keys: Keys, new: Numbers) -> None:
    slots = _first_slots(keys, len(held))
    rest = np.arange(len(keys))
    while rest.size:
        free = rest[held[slots[rest]] == 0]
        held[slots[free]] = keys[free]  # Of several for one slot the last stays.
        placed = free[held[slots[free]] == keys[free]]
        numbers[slots[placed]] = new[placed]
        rest = rest[held[slots[rest]] != keys[rest]]
        slots[rest] = (slots[rest] + 1) & (len(held) - 1)
