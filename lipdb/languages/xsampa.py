"""IPA segments in X-SAMPA, by the chart of letters (``ipa.tsv``) and the marks of X-SAMPA."""

from __future__ import annotations

import unicodedata

from lipdb.curated.tsv import Records

# Wells 1995: Computer-coding the IPA. Marks that show stress, tone or ties have no place in a segment.
_MARKS = {
    "ː": ":", "ʰ": "_h", "ʱ": "_t", "ʲ": "_j", "ʷ": "_w", "ˠ": "_G", "ˤ": "_?\\", "ʼ": "_>", "ⁿ": "_n", "ˡ": "_l", "˞": "`",
    "\u0303": "~", "\u0329": "=", "\u030d": "=", "\u032a": "_d", "\u033a": "_a", "\u033b": "_m", "\u033c": "_N", "\u0325": "_0",
    "\u030a": "_0",
    "\u032c": "_v", "\u0324": "_t", "\u0330": "_k", "\u0308": '_"', "\u033d": "_x", "\u031f": "_+", "\u0320": "_-", "\u031d": "_r",
    "\u031e": "_o", "\u0318": "_A", "\u0319": "_q", "\u0339": "_O", "\u031c": "_c", "\u032f": "_^", "\u031a": "_}", "\u0306": "_X",
    "\u0361": "", "\u035c": "",
}  # fmt: skip


def xsampa(segment: str, records: Records) -> str:
    """*segment* in X-SAMPA; nothing when a sign of it has no spelling there."""
    letters = {row["phone"]: row["xsampa"].split()[0] for row in records.get("ipa.tsv", {}).values() if row["xsampa"]}
    written = ""
    for sign in unicodedata.normalize("NFD", segment).replace("c\u0327", "ç"):
        spelled = letters.get(sign, _MARKS.get(sign))
        if spelled is None:
            return ""
        written += spelled
    return written
