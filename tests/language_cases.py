"""What the tests of the languages share: words as common phones, lips that close, the phones of the sample sentences."""

from __future__ import annotations

import lipdb


def phones(db: lipdb.Database, language: str, text: str) -> list[str]:
    """The phones of *text* as the voice says it, pauses left out; a label that no table knows is an error."""
    phoneset = db.phoneset(language)
    voice = db.voice(language)
    labels = [label for phrase in voice.phrases(text) for word in phrase for label in word]
    parts = {label: phoneset.symbols.parts(label, voice.notation) for label in labels}
    assert all(parts.values()), [label for label, found in parts.items() if not found]
    return [phone for label in labels for phone in parts[label]]


def common(db: lipdb.Database, language: str, text: str) -> str:
    """The common phones of *text* as the voice says it, in a row."""
    phoneset = db.phoneset(language)
    return " ".join(name for phone in phones(db, language, text) for name in phoneset.mapping(phone).common)


def check_speaks(db: lipdb.Database, language: str, text: str) -> lipdb.Line:
    """Speak *text*: every symbol is known to the language itself, and the lips close on every p, b and m of 60 ms or more."""
    line = db.say(text, language=language)
    assert {phone.layer for phone in line.schedule.phones} <= {f"language:{language}", "common"}
    assert not [phone.symbol for phone in line.schedule.phones if phone.symbol.startswith("[")]
    assert line.sound is not None
    track = db.animate(line).track
    closed = track.pose("PBM")
    closures = [
        closed[(track.times >= start / 1e6 - 1 / 120) & (track.times <= end / 1e6 + 1 / 120)].max()
        for phone, start, end in zip(line.schedule.phones, line.schedule.edges, line.schedule.edges[1:], strict=False)
        if phone.common == ("bmp",) and end - start >= 60_000
    ]
    assert closures
    assert min(closures) >= 0.88
    return line


def missing_in_sample(db: lipdb.Database, language: str) -> set[str]:
    """The phones of the language that its sample sentences lack, as the voice reads them."""
    sentences = [row["sentence"] for row in db.records[f"{language}/sentences.tsv"].values()]
    assert len(sentences) >= 180
    found = {phone for sentence in sentences for phone in phones(db, language, sentence)}
    return set(db.phoneset(language).symbols.phones) - found
