"""TextGrids in every form that Praat writes become schedules; everything else is refused in one line."""

from __future__ import annotations

import struct
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from lipdb.errors import InputError, ScheduleError
from lipdb.schedule import Schedule
from lipdb.speech.praat import parse_textgrid
from lipdb.speech.textgrid import read_textgrid

Entries = list[tuple[float, float, str]]
PHONES: Entries = [(0, 0.1, ""), (0.1, 0.25, "ʃ"), (0.25, 0.4, "i:"), (0.4, 0.5, "#")]
WORDS: Entries = [(0, 0.1, "#"), (0.1, 0.4, 'sh"e'), (0.4, 0.5, "#")]


def _quoted(text: str) -> str:
    return '"' + text.replace('"', '""') + '"'


def _short(tiers: dict[str, Entries], *, header: str = "ooTextFile", end: float = 0.5) -> str:
    lines = [f'File type = "{header}"', 'Object class = "TextGrid"', "", "0", str(end), "<exists>", str(len(tiers))]
    for name, entries in tiers.items():
        lines += ['"IntervalTier"', _quoted(name), "0", str(end), str(len(entries))]
        for start, stop, label in entries:
            lines += [str(start), str(stop), _quoted(label)]
    return "\n".join(lines) + "\n"


def _long(tiers: dict[str, Entries], *, end: float = 0.5) -> str:
    lines = ['File type = "ooTextFile"', 'Object class = "TextGrid"', "", "xmin = 0 ", f"xmax = {end} ", "tiers? <exists> "]
    lines += [f"size = {len(tiers)} ", "item []: "]
    for n, (name, entries) in enumerate(tiers.items(), 1):
        lines += [f"    item [{n}]:", '        class = "IntervalTier" ', f"        name = {_quoted(name)} ", "        xmin = 0 "]
        lines += [f"        xmax = {end} ", f"        intervals: size = {len(entries)} "]
        for k, (start, stop, label) in enumerate(entries, 1):
            lines += [f"        intervals [{k}]:", f"            xmin = {start} ", f"            xmax = {stop} "]
            lines += [f"            text = {_quoted(label)} "]
    return "\n".join(lines) + "\n"


def _binary(tiers: dict[str, Entries], *, end: float = 0.5) -> bytes:
    def text(value: str) -> bytes:
        wide = value.encode("utf-16-be")
        return struct.pack(">h", len(value)) + value.encode() if value.isascii() else struct.pack(">hH", -1, len(wide) // 2) + wide

    raw = b"ooBinaryFile\x08TextGrid" + struct.pack(">dd?i", 0, end, True, len(tiers))
    for name, entries in tiers.items():
        raw += b"\x0cIntervalTier" + text(name) + struct.pack(">ddi", 0, end, len(entries))
        for start, stop, label in entries:
            raw += struct.pack(">dd", start, stop) + text(label)
    return raw


TIERS = {"words": WORDS, "phones": PHONES}


def _read(tmp_path: Path, content: str | bytes, *, tier: str | None = None) -> Schedule:
    path = tmp_path / "line.TextGrid"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return read_textgrid(path, tier=tier)


def _error(tmp_path: Path, content: str | bytes, *, tier: str | None = None) -> str:
    with pytest.raises(InputError) as caught:
        _read(tmp_path, content, tier=tier)
    assert "\n" not in str(caught.value)
    assert "line.TextGrid" in str(caught.value)
    return str(caught.value)


def test_phones_with_their_words_and_times(tmp_path: Path):
    schedule = _read(tmp_path, _long(TIERS))
    assert schedule.edges == (0, 100_000, 250_000, 400_000, 500_000)
    assert [phone.symbol for phone in schedule.phones] == ["_", "ʃ", "i:", "#"]
    assert [phone.word for phone in schedule.phones] == [-1, 0, 0, -1]
    assert schedule.words == ('sh"e',)


LONG, SHORT = _long(TIERS), _short(TIERS)


@pytest.mark.parametrize(
    "raw",
    [
        pytest.param(SHORT.encode(), id="short"),
        pytest.param(_short(TIERS, header="ooTextFile short").replace("Object class = ", "").encode(), id="old short"),
        pytest.param(b"\xef\xbb\xbf" + LONG.encode(), id="UTF-8 with a mark"),
        pytest.param(LONG.encode("utf-16"), id="UTF-16 of this machine"),
        pytest.param(b"\xff\xfe" + LONG.encode("utf-16-le"), id="UTF-16 LE"),
        pytest.param(b"\xfe\xff" + SHORT.encode("utf-16-be"), id="UTF-16 BE"),
        pytest.param(LONG.encode("utf-16-be"), id="UTF-16 BE without a mark"),
        pytest.param(SHORT.encode("utf-16-le"), id="UTF-16 LE without a mark"),
        pytest.param(LONG.encode("utf-32"), id="UTF-32"),
        pytest.param(LONG.replace("\n", "\r\n").encode(), id="Windows line ends"),
        pytest.param(LONG.replace("\n", "\r").encode(), id="old Mac line ends"),
        pytest.param(SHORT.replace("\n", " ").encode(), id="one line"),
        pytest.param(LONG.replace("xmin", "! a comment, 12 <flag>\nxmin").encode(), id="comments"),
        pytest.param(_binary(TIERS), id="binary"),
    ],
)
def test_every_form_gives_the_same_schedule(tmp_path: Path, raw: bytes):
    assert _read(tmp_path, raw) == _read(tmp_path, LONG)


def test_text_of_an_old_windows_or_mac_is_read(tmp_path: Path):
    text = _long({"phones": [(0, 0.5, "é")]})
    assert _read(tmp_path, text.encode("latin-1")).phones[0].symbol == "é"
    assert _read(tmp_path, text.replace("\n", "\r").encode("mac-roman")).phones[0].symbol == "é"


@pytest.mark.parametrize("form", ["short_textgrid", "long_textgrid"])
def test_what_praatio_writes_is_read(tmp_path: Path, form: str):
    from praatio import textgrid

    grid = textgrid.Textgrid()
    grid.addTier(textgrid.IntervalTier("phones", [entry for entry in PHONES if entry[2]], 0, 0.5))
    grid.save(str(tmp_path / "other.TextGrid"), form, includeBlankSpaces=True)
    assert read_textgrid(tmp_path / "other.TextGrid") == _read(tmp_path, _long({"phones": PHONES}))


@pytest.mark.parametrize("name", ["phones", "Phones", "phone", "PhonAlign", "MAU", "Alice - phones", " phones "])
def test_the_tier_of_phones_is_found_by_its_name(tmp_path: Path, name: str):
    schedule = _read(tmp_path, _short({"IPU": [(0, 0.5, "hello")], name: PHONES}))
    assert len(schedule.phones) == 4


@pytest.mark.parametrize("name", ["words", "Word", "TokensAlign", "ORT-MAU"])
def test_the_tier_of_words_is_found_by_its_name(tmp_path: Path, name: str):
    assert _read(tmp_path, _short({"MAU": PHONES, name: WORDS})).words == ('sh"e',)


def test_phones_without_a_tier_of_words_have_no_words(tmp_path: Path):
    schedule = _read(tmp_path, _short({"phones": PHONES}))
    assert schedule.words == ()
    assert {phone.word for phone in schedule.phones} == {-1}


def test_a_named_tier_wins(tmp_path: Path):
    tiers = {"phones": PHONES, "Mine": [(0.0, 0.5, "a")]}
    assert [phone.symbol for phone in _read(tmp_path, _short(tiers), tier="Mine").phones] == ["a"]
    assert [phone.symbol for phone in _read(tmp_path, _short(tiers), tier="mine").phones] == ["a"]


def test_words_come_from_the_same_speaker(tmp_path: Path):
    tiers = {"Ann - words": [(0.0, 0.5, "ann")], "Bob - words": [(0.0, 0.5, "bob")], "Bob - phones": PHONES}
    assert _read(tmp_path, _short(tiers)).words == ("bob",)


def test_gaps_between_intervals_are_silence(tmp_path: Path):
    schedule = _read(tmp_path, _short({"phones": [(0.1, 0.2, "a"), (0.3, 0.5, "b")]}))
    assert [phone.symbol for phone in schedule.phones] == ["a", "_", "b"]


def test_a_label_is_data_and_stays_on_one_line(tmp_path: Path):
    labels = ["a\n b", "../../etc/passwd", 'class = "x" 12']
    entries = [(k / 10, (k + 1) / 10, label) for k, label in enumerate(labels)]
    assert [phone.symbol for phone in _read(tmp_path, _long({"phones": entries})).phones] == ["a b", *labels[1:]]


def test_no_tier_of_phones_names_the_tiers_and_the_option(tmp_path: Path):
    message = _error(tmp_path, _short({"IPU": WORDS, "IPU-2": WORDS}))
    assert "no tier of phones" in message
    assert "'IPU', 'IPU-2'" in message
    assert "--tier" in message


def test_a_tier_that_is_not_there_is_named(tmp_path: Path):
    assert "no tier 'fones'; its tiers are 'words', 'phones'" in _error(tmp_path, LONG, tier="fones")


def test_several_speakers_need_a_choice(tmp_path: Path):
    message = _error(tmp_path, _short({"Ann - phones": PHONES, "Bob - phones": PHONES}))
    assert "several tiers could be the phones: 'Ann - phones', 'Bob - phones'" in message


@pytest.mark.parametrize(
    ("entries", "message"),
    [
        ([(0, 0.3, "a"), (0.2, 0.5, "b")], "interval 2 ('b') starts at 0.2 s, before the one in front of it ends (0.3 s)"),
        ([(0, 0.3, "a"), (0.3, 0.1, "b")], "interval 2 ('b') lasts from 0.3 to 0.1 s"),
        ([(0.3, 0.5, "a"), (0, 0.3, "b")], "interval 2 ('b') starts at 0 s"),
        ([(0, 0, "a"), (0, 0.5, "b")], "interval 1 ('a') lasts from 0 to 0 s"),
        ([(-0.5, 0.5, "a")], "interval 1 ('a') starts before 0"),
        ([(0, float("nan"), "a")], "interval 1 ('a') has a time that is no number"),
        ([(0, float("inf"), "a")], "no number"),
        ([(0, 1e300, "a")], "no number"),
    ],
)
@pytest.mark.parametrize("write", [_long, _short, _binary])
def test_times_that_cannot_be_are_a_schedule_error(tmp_path: Path, entries: Entries, message: str, write):
    content = write({"phones": entries})
    assert message in _error(tmp_path, content)
    with pytest.raises(ScheduleError):
        _read(tmp_path, content)


def test_a_tier_of_points_is_refused(tmp_path: Path):
    text = 'File type = "ooTextFile"\nObject class = "TextGrid"\n\n0\n1\n<exists>\n1\n"TextTier"\n"phones"\n0\n1\n1\n0.5\n"a"\n'
    assert "'phones' has points" in _error(tmp_path, text)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("", "the file is empty"),
        (" \n", "the file is empty"),
        ("hello", "not a Praat text file"),
        ('"hello"', "not a Praat text file"),
        (LONG.replace('"TextGrid"', '"Collection"'), "holds a Praat 'Collection'"),
        (LONG.replace('"IntervalTier"', '"PitchTier"', 1), "unknown class 'PitchTier'"),
        (LONG.replace("size = 4", "size = 5"), "the file ends before the time of entry 5 of 5 in tier 'phones'"),
        (LONG.replace("size = 3", "size = 4"), "stands where the time of entry 4 of 4 in tier 'words' should be"),
        (LONG.replace("size = 4", "size = 3"), "more in the file than the 2 tiers"),
        (LONG.replace("size = 4", "size = 1e999"), "the size of tier 'phones' is inf"),
        (LONG.replace("size = 4", "size = -1"), "the size of tier 'phones' is -1"),
        (LONG.replace("size = 4", "size = 2.5"), "is 2.5"),
        (LONG.replace("size = 4", "size = 99999999999"), "the file ends before"),
        (LONG.replace("<exists>", "<absent>"), "no tier of phones; its tiers are none"),
        (LONG[:-30], "the file ends before"),
        (LONG.replace("xmax = 0.25", 'xmax = "x"'), "line 39: text 'x' stands where the end of entry 2 of 4"),
        (b"\xff\xfe" + LONG.encode("utf-16-le") + b"\x00\xd8\x00", "broken UTF-16-LE text at byte"),
        (b"RIFF\x00\x00\x00\x00WAVE\x00", "not a text file"),
        (_binary(TIERS)[:-3], "the file ends before the label of entry 4 of 4"),
        (_binary(TIERS) + b"x", "more in the file"),
        (b"ooBinaryFile", "the file ends before"),
        (_short({"phones": []}), "tier 'phones' is empty"),
    ],
)
def test_a_damaged_file_says_what_and_where(tmp_path: Path, content: str | bytes, message: str):
    assert message in _error(tmp_path, content)


def test_every_cut_of_a_file_is_refused(tmp_path: Path):
    for raw in (LONG.rstrip().encode(), SHORT.rstrip().encode(), _binary(TIERS)):
        for end in range(0, len(raw), 3):
            _error(tmp_path, raw[:end])


def test_a_file_that_is_not_there_or_a_folder_is_refused(tmp_path: Path):
    for path in (tmp_path / "none.TextGrid", tmp_path):
        with pytest.raises(InputError, match="can't be read"):
            read_textgrid(path)


@given(st.binary(max_size=400))
def test_any_bytes_are_tiers_or_an_input_error(raw: bytes):
    try:
        parse_textgrid(raw, name="x")
    except InputError as error:
        assert "\n" not in str(error)


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=400)
@given(data=st.data())
def test_any_damage_to_a_file_gives_a_schedule_or_an_input_error(tmp_path: Path, data: st.DataObject):
    raw = bytearray(data.draw(st.sampled_from([LONG.encode(), SHORT.encode(), LONG.encode("utf-16"), _binary(TIERS)])))
    for _ in range(data.draw(st.integers(1, 4))):
        at = data.draw(st.integers(0, len(raw) - 1))
        junk = data.draw(st.binary(max_size=8) | st.sampled_from([b'"', b"1e999", b"nan", b"-", b"\n", b"<", b"!"]))
        raw[at : at + data.draw(st.integers(0, 6))] = junk
        if not raw:
            break
    try:
        schedule = _read(tmp_path, bytes(raw))
    except InputError as error:
        assert "\n" not in str(error)
    else:
        assert len(schedule.edges) == len(schedule.phones) + 1
        assert all("\n" not in phone.symbol for phone in schedule.phones)


_LABELS = st.text(st.characters(exclude_categories=["Cs", "Cc"]), max_size=6)


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=100)
@given(lengths=st.lists(st.integers(1, 500), min_size=1, max_size=20), data=st.data())
def test_any_labels_and_times_are_read_back_from_every_form(tmp_path: Path, lengths: list[int], data: st.DataObject):
    entries, start = [], 0
    for length in lengths:
        entries.append((start / 1000, (start + length) / 1000, data.draw(_LABELS)))
        start += length
    long, short, binary = (_read(tmp_path, write({"phones": entries}, end=start / 1000)) for write in (_long, _short, _binary))
    assert long == short == binary
    assert [phone.symbol for phone in long.phones] == [" ".join(label.split()) or "_" for _, _, label in entries]
    assert long.edges == tuple(round(t * 1e6) for t in [0, *(end for _, end, _ in entries)])
