"""A line can be spoken by another voice than the language's own: the same phones, another sound."""

import pytest

from lipdb.cli import cli
from lipdb.errors import InputError
from lipdb.sound import read_wav


@pytest.mark.parametrize(("language", "text"), [("en", "Bob may go."), ("fr", "Le chat dort."), ("cmn", "你好")])
def test_another_timbre_says_the_same_phones(db, language, text) -> None:
    own, other = db.voices(language)[:2]
    assert own == db.language(language)["voice"]
    mine, theirs = db.say(text, language=language), db.say(text, language=language, voice=other)
    assert [phone.symbol for phone in mine.schedule.phones] == [phone.symbol for phone in theirs.schedule.phones]
    assert mine.sound.samples.tobytes() != theirs.sound.samples.tobytes()


def test_the_language_s_own_voice_is_the_default(db) -> None:
    mine, same = db.say("Bob"), db.say("Bob", voice=db.voices("en")[0])
    assert mine.sound.samples.tobytes() == same.sound.samples.tobytes()


def test_a_language_that_there_is_not_has_no_voices(db) -> None:
    with pytest.raises(InputError, match="no language"):
        db.voices("xx")


def test_the_command_line_speaks_with_the_voice_that_it_is_given(db, tmp_path) -> None:
    for voice in ("en-us", "en-us+f2"):
        file = tmp_path / f"{voice}.wav"
        cli.main(["--db", db.store.where, "say", "Bob", "--voice", voice, "-o", str(file)], standalone_mode=False)
        spoken = db.say("Bob", voice=voice).sound.samples
        assert read_wav(file).samples[: len(spoken)].tolist() == spoken.tolist()
