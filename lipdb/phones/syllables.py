"""Written syllables, such as pinyin, to the phones that they are made of."""

from __future__ import annotations

from collections.abc import Container, Iterable, Mapping
from dataclasses import dataclass
from typing import Self

_SPELLINGS = str.maketrans({"v": "ü"})
_RHOTIC = "r"


@dataclass(frozen=True, slots=True)
class Syllables:
    """The legal syllables of a language: spelling -> initial (may be none) and final."""

    phones: Mapping[str, tuple[str, ...]]

    @classmethod
    def from_rows(cls, rows: Iterable[Mapping[str, str]]) -> Self:
        """The syllables of a table's rows."""
        return cls({row["syllable"]: tuple(part for part in (row["initial"], row["final"]) if part) for row in rows})

    def split(self, text: str, known: Container[str]) -> tuple[str, ...]:
        """The phones of the syllable *text* without its tone; nothing when it is no legal syllable.

        ``v`` and ``u:`` are ü, and a final r that is not part of a listed syllable (huar, wanr) colours the final: its phone
        is the final's name and ``+r``, which must be in *known*.
        """
        plain = text.lower().replace("u:", "ü").translate(_SPELLINGS)
        if plain in self.phones:
            return self.phones[plain]
        base = self.phones.get(plain.removesuffix(_RHOTIC)) if plain.endswith(_RHOTIC) else None
        if base and (coloured := f"{base[-1]}+{_RHOTIC}") in known:
            return (*base[:-1], coloured)
        return ()
