"""Bad input gets one line that says what is wrong and where, and never a line that moves otherwise than it says."""

import copy
import io
import json
import wave
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import lipdb
from lipdb.errors import InputError, LipdbError, OutputError, PhonesetError, ScheduleError, StoreError, UnknownSymbolError
from lipdb.files import whole_file
from lipdb.sound import read_wav
from lipdb.store import Store
from lipdb.store.engines import database_url

CURVE = {"left": "h", "right": "ah", "pose": "open", "keys": "0:0 0.5:1 1:0", "warp": "border"}
GRID = """File type = "ooTextFile"
Object class = "TextGrid"

0
{end}
<exists>
1
"IntervalTier"
"phones"
0
{end}
2
0
0.5
"HH"
0.5
{end}
"{label}"
"""


@pytest.fixture(scope="module")
def performance(db: lipdb.Database, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """What `lipdb say "Hello" -o hello.json` writes."""
    file = tmp_path_factory.mktemp("line") / "hello.json"
    db.animate(db.say("Hello")).save(file)
    document: dict[str, Any] = json.loads(file.read_text("utf-8"))
    return document


def set_phone(**cells: Any) -> Callable[[dict[str, Any]], None]:
    return lambda document: document["line"]["schedule"]["phones"][1].update(cells)


def set_line(**parts: Any) -> Callable[[dict[str, Any]], None]:
    return lambda document: document["line"].update(parts)


def set_curve(pose_set: str = "facefx", **cells: Any) -> Callable[[dict[str, Any]], None]:
    return set_line(curves={pose_set: [{**CURVE, **cells}]})


def refused(db: lipdb.Database, file: Path, kind: type[LipdbError] = InputError) -> str:
    with pytest.raises(kind) as error:
        db.animate(db.sync(file))
    message = str(error.value)
    assert "\n" not in message
    assert str(file) in message
    return message


@pytest.mark.parametrize(
    ("edit", "complaint"),
    [
        (set_phone(start=float("nan")), "not a number"),
        (set_phone(end=float("inf")), "not a number"),
        (set_phone(end=-1), "end must come after its start"),
        (set_phone(start=0.3, end=0.3), "end must come after its start"),
        (set_phone(end=1e300), "beyond a day"),
        (set_phone(end=1e6), "beyond a day"),
        (set_phone(start="soon"), "'soon'"),
        (set_phone(tone=float("inf")), "not a schedule"),
        (set_phone(word=7), "of word 7, but there are 1"),
        (set_phone(symbol="\ud800"), "not JSON"),
        (lambda document: document["line"]["schedule"]["phones"][1].pop("symbol"), "'symbol'"),
        (lambda document: document["line"]["schedule"]["phones"].clear(), "no phones"),
        (lambda document: document["line"]["schedule"].update(language="eng"), "did you mean 'en'"),
        (lambda document: document["line"]["schedule"].update(notation="sampi"), "'sampi'"),
        (lambda document: document.update(line=None), "not a line"),
        (lambda document: document.update(format="lipdb performance 99"), "format"),
        (set_line(mapping={"h": "bpm"}), "did you mean 'bmp'"),
        (set_line(mapping={"hh": "h"}), "no phone 'hh'"),
        (set_line(mapping=["h"]), "mapping"),
        (set_curve(pose="opn"), "did you mean 'open'"),
        (set_curve(left="bpm"), "did you mean 'bmp'"),
        (set_curve(right=5), "'5'"),
        (set_curve("facefix"), "did you mean 'facefx'"),
        (set_curve(keys="0:0 0.5:7 1:0"), "weight 7 is not between 0 and 1"),
        (set_curve(keys="0:0 5:0.5"), "time 5 is not between 0 and 1"),
        (set_curve(keys="0:nan"), "not between 0 and 1"),
        (set_curve(keys=[[0, 1]]), "curves"),
        (set_curve(warp="round"), "'round'"),
        (set_curve(pose=["open"]), "curves"),
    ],
)
def test_a_lines_json_that_was_edited_badly_says_what_is_wrong(
    db: lipdb.Database, performance: dict[str, Any], tmp_path: Path, edit: Callable[[dict[str, Any]], None], complaint: str
) -> None:
    document = copy.deepcopy(performance)
    edit(document)
    file = tmp_path / "edited.json"
    file.write_text(json.dumps(document), "utf-8")
    assert complaint in refused(db, file)


def test_a_symbol_that_somebody_wrote_into_a_lines_json_must_be_known(
    db: lipdb.Database, performance: dict[str, Any], tmp_path: Path
) -> None:
    document = copy.deepcopy(performance)
    set_phone(symbol="qqq")(document)
    file = tmp_path / "edited.json"
    file.write_text(json.dumps(document), "utf-8")
    assert "'qqq' (1x" in refused(db, file, UnknownSymbolError)
    assert db.sync(file, allow_unknown=True).schedule.phones[1].common


@pytest.mark.parametrize("content", [b"", b"[1]", b"{", b"[" * 100_000, b"\xff\xfe{\0}\0", b'{"format": ' + b"9" * 5000 + b"}"])
def test_a_file_that_is_no_json_of_ours_says_so(db: lipdb.Database, tmp_path: Path, content: bytes) -> None:
    file = tmp_path / "broken.json"
    file.write_bytes(content)
    refused(db, file)


def test_a_byte_order_mark_in_front_of_json_does_no_harm(db: lipdb.Database, performance: dict[str, Any], tmp_path: Path) -> None:
    file = tmp_path / "notepad.json"
    file.write_text(json.dumps(performance), "utf-8-sig")
    assert db.sync(file).text == "Hello"


json_values = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=5), inner, max_size=3),
    max_leaves=5,
)


@settings(max_examples=150, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.data(), json_values)
def test_whatever_stands_in_a_lines_json_it_moves_or_is_refused(
    db: lipdb.Database, performance: dict[str, Any], tmp_path: Path, data: st.DataObject, value: Any
) -> None:
    document = copy.deepcopy(performance)
    set_curve()(document)
    part: Any = document["line"]
    while True:
        key = data.draw(st.sampled_from(sorted(part) if isinstance(part, dict) else range(len(part))))
        if not (isinstance(part[key], dict | list) and part[key] and data.draw(st.booleans())):
            break
        part = part[key]
    part[key] = value
    file = tmp_path / "edited.json"
    file.write_text(json.dumps(document), "utf-8")
    try:
        weights = db.animate(db.sync(file)).track.weights
    except LipdbError as error:
        assert str(file) in str(error) or "\n" not in str(error)
    else:
        assert ((weights >= 0) & (weights <= 1)).all()


def sound(rate: int = 16_000, width: int = 2, frames: int = 16_000) -> bytearray:
    made = io.BytesIO()
    with wave.open(made, "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(width)
        file.setframerate(rate)
        file.writeframes(bytes(width * frames))
    return bytearray(made.getvalue())


def patched(raw: bytearray, at: int, new: bytes) -> bytes:
    raw[at : at + len(new)] = new
    return bytes(raw)


@pytest.mark.parametrize(
    ("content", "complaint"),
    [
        (b"", "cut off"),
        (b"hello", "cut off"),
        (bytes(sound()[:30]), "cut off"),
        (b"OggS" + bytes(100), "not a PCM wave file"),
        (patched(sound(), 20, b"\x03\0"), "not a PCM wave file"),
        (patched(sound(), 22, b"\0\0"), "channels"),
        (patched(sound(), 24, bytes(4)), "0 samples"),
        (patched(sound(), 24, b"\xff\xff\xff\xee"), "4009754623 samples"),
        (patched(sound(), 34, b"\x40\0"), "64 bits"),
    ],
)
def test_audio_that_is_no_wave_file_says_so(tmp_path: Path, content: bytes, complaint: str) -> None:
    file = tmp_path / "a.wav"
    file.write_bytes(content)
    with pytest.raises(InputError, match=complaint) as error:
        read_wav(file)
    assert str(file) in str(error.value)


def test_a_recording_much_shorter_than_its_phones_is_remarked_upon(db: lipdb.Database, tmp_path: Path) -> None:
    (tmp_path / "a.TextGrid").write_text(GRID.format(end=1, label="AY1"), "utf-8")
    (tmp_path / "short.wav").write_bytes(sound(frames=100))
    (tmp_path / "whole.wav").write_bytes(sound())
    (note,) = db.sync(tmp_path / "a.TextGrid", audio=tmp_path / "short.wav").notes
    assert "ends at 0.01 s, but its phones at 1.00 s" in note
    assert not db.sync(tmp_path / "a.TextGrid", audio=tmp_path / "whole.wav").notes


def test_an_unknown_symbol_names_its_file_and_is_not_shown_at_full_length(db: lipdb.Database, tmp_path: Path) -> None:
    file = tmp_path / "a.TextGrid"
    file.write_text(GRID.format(end=1, label="x" * 100_000), "utf-8")
    assert len(refused(db, file, UnknownSymbolError)) < 500


def test_a_phone_of_three_months_is_no_phone(db: lipdb.Database, tmp_path: Path) -> None:
    file = tmp_path / "a.TextGrid"
    file.write_text(GRID.format(end=9e6, label="AY1"), "utf-8")
    refused(db, file, ScheduleError)


def test_text_with_broken_unicode_can_be_saved(db: lipdb.Database, tmp_path: Path) -> None:
    take = db.animate(db.say("hi \udcff there"))
    take.save(tmp_path / "a.json")
    take.save(tmp_path / "a.parquet")
    assert db.sync(tmp_path / "a.json").text == "hi ? there"


@pytest.mark.parametrize("fps", [0, -5, float("nan"), float("inf"), 1e9])
def test_a_frame_rate_that_cant_be_played_is_refused(db: lipdb.Database, fps: float) -> None:
    with pytest.raises(InputError, match="frames a second"):
        db.animate(db.say("hi"), fps=fps)


def test_a_file_name_that_the_disk_does_not_take_is_refused(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="too long"), whole_file(tmp_path / ("x" * 300)):
        pass
    assert not list(tmp_path.iterdir())


def test_the_home_folder_of_nobody_is_a_folder_that_is_not_there(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(StoreError, match="not there"):
        lipdb.open("~no_such_user/lip.db")


def test_a_sqlite_address_takes_no_options(tmp_path: Path) -> None:
    with pytest.raises(StoreError, match="takes no options"):
        database_url(f"sqlite:///{tmp_path}/a.db?mode=ro")


def test_curated_text_that_names_what_is_not_there_makes_no_database(tmp_path: Path) -> None:
    shipped = Path(lipdb.__file__).parent.parent / "phonesets"
    for file in shipped.rglob("*.tsv"):
        copied = tmp_path / "text" / file.relative_to(shipped)
        copied.parent.mkdir(parents=True, exist_ok=True)
        copied.write_bytes(file.read_bytes())
    phones = tmp_path / "text" / "en" / "phones.tsv"
    lines = phones.read_text("utf-8").split("\n")
    number = next(i for i, line in enumerate(lines) if "\tbmp\t" in line)
    column = lines[number].index("\tbmp\t") + 2
    lines[number] = lines[number].replace("\tbmp\t", "\tbpm\t")
    phones.write_text("\n".join(lines), "utf-8")
    with pytest.raises(PhonesetError) as error:
        Store.open(tmp_path / "a.db", tmp_path / "text")
    assert str(error.value) == f"en/phones.tsv:{number + 1}:{column}: common phone 'bpm' does not exist; did you mean 'bmp'?"
    assert not (tmp_path / "a.db").exists()
