"""Number things by their 64-bit keys: a hash table of numpy arrays that answers for a million keys at once."""

from __future__ import annotations

from typing import Self

import numpy as np
from numpy.typing import NDArray

Keys = NDArray[np.uint64]
Numbers = NDArray[np.int64]

UNKNOWN = -1
_SPARE = 3  # Slots for each key: two in three looks find their key at once even when the table is full.
_KEY, _NUMBER = 0, 1


class Codes:
    """Keys, none of them 0, numbered from 0 in the order in which they came."""

    def __init__(self) -> None:
        self._count = 0
        self._slots = _free(1 << 12)

    def __len__(self) -> int:
        return self._count

    @property
    def slots(self) -> Keys:
        """The table, of shape (slots, 2): a key, 0 where there is none, and its number; beside each other as they are in memory."""
        return self._slots

    @classmethod
    def of(cls, slots: Keys, count: int) -> Self:
        """The *count* keys of a table that `slots` gave."""
        codes = cls()
        codes._slots, codes._count = slots, count
        return codes

    def find(self, keys: Keys) -> Numbers:
        """The number of each of *keys*, `UNKNOWN` for those that are new."""
        places = _first_slots(keys, len(self._slots))
        found = self._slots.take(places, axis=0)
        result = found[:, _NUMBER].astype(np.int64)
        open = np.flatnonzero(found[:, _KEY] != keys)
        open = open[found[open, _KEY] != 0]
        while open.size:  # Another key is there: look at the next slot.
            places[open] = (places[open] + 1) & (len(self._slots) - 1)
            there = self._slots.take(places[open], axis=0)
            result[open] = there[:, _NUMBER].astype(np.int64)
            open = open[(there[:, _KEY] != keys[open]) & (there[:, _KEY] != 0)]
        return result

    def add(self, keys: Keys) -> Numbers:
        """The numbers of *keys*, which are new and different from each other."""
        total, slots = self._count + len(keys), self._slots
        if total * _SPARE > len(slots):
            old = slots[slots[:, _KEY] != 0]
            slots = _free(1 << (total * 2 * _SPARE - 1).bit_length())
            _insert(slots, old)
        elif not slots.flags.writeable:  # others read it too
            slots = slots.copy()
        added = np.arange(self._count, total)
        _insert(slots, np.stack([keys, added.astype(np.uint64)], axis=1))
        self._slots, self._count = slots, total
        return added


def _free(size: int) -> Keys:
    return np.stack([np.zeros(size, np.uint64), np.full(size, UNKNOWN).astype(np.uint64)], axis=1)


def _first_slots(keys: Keys, size: int) -> NDArray[np.int64]:
    """The slot at which each key is looked for first: its topmost bits, the best mixed ones."""
    return (keys >> np.uint64(64 - (size.bit_length() - 1))).view(np.int64)


def _insert(slots: Keys, new: Keys) -> None:
    places, keys = _first_slots(new[:, _KEY], len(slots)), new[:, _KEY]
    rest = np.arange(len(new))
    while rest.size:
        free = rest[slots[places[rest], _KEY] == 0]
        slots[places[free]] = new[free]  # Of several for one slot the last stays.
        rest = rest[slots[places[rest], _KEY] != keys[rest]]
        places[rest] = (places[rest] + 1) & (len(slots) - 1)
