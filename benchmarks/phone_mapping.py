"""How often articulation gives the common phone that a phonetician would: rules, second opinion, and where they differ.

    python benchmarks/phone_mapping.py            # prints the scores, then every miss

`mapping/phonemes.tsv` lists phonemes by language with every answer that is accepted (`a|b`, several common phones joined by
`+`). List `design`: 216 phonemes of six languages, judged before the rules were written. List `wide`: 24 more sets, judged
by the author of the rules before they were run on them; it found gaps and then shaped the rules, so it says what is
covered and not how the rules do on what nobody thought of. As for `panphon`, there is no judgement: it is the share of
PanPhon's own segments on which the two opinions agree.
"""

from __future__ import annotations

import csv
from collections import Counter
from pathlib import Path

from lipdb.phones.articulation import classify
from lipdb.phones.second_opinion import opinions, segments

PHONEMES = Path(__file__).parent / "mapping" / "phonemes.tsv"


def second(segment: str) -> str:
    """The second opinion alone, one common phone; nothing when PanPhon does not know the segment."""
    return opinions(segment)[0].common if opinions(segment) else ""


def main() -> None:
    """Print the scores."""
    with PHONEMES.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file, delimiter="\t", quoting=csv.QUOTE_NONE))
    total, right, alone, missed = Counter[str](), Counter[str](), Counter[str](), list[str]()
    for row in rows:
        accepted, found = row["accepted"].split("|"), classify(row["ipa"])
        answer = "+".join(found.common) if found else ""
        total[row["list"]] += 1
        right[row["list"]] += answer in accepted
        alone[row["list"]] += second(row["ipa"]) in accepted
        if answer not in accepted:
            missed.append(f"{row['language']} {row['ipa']}: {answer or 'nothing'}, accepted {row['accepted']}")
    for name, count in total.items():
        kinds = len({row["ipa"] for row in rows if row["list"] == name})
        print(f"{name}: {count} phonemes ({kinds} segments); rules {right[name] / count:.1%}, PanPhon alone {alone[name] / count:.1%}")
    judged = [(found, second(segment)) for segment in segments() if (found := classify(segment)) and len(found.common) == 1]
    agree = sum(found.common == (other,) for found, other in judged)
    print(f"panphon: {len(judged)} segments with one common phone; both opinions agree on {agree / len(judged):.1%}")
    print("\n".join(missed))


if __name__ == "__main__":
    main()
