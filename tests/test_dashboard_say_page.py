"""The front page without a browser: what is asked, what is shown, what is said when something is wrong."""

import functools
import io
import json
import os
import shutil
import wave

import page_cases
import pytest
from page_cases import behind_pages
from streamlit.dataframe_util import convert_arrow_bytes_to_pandas_df

from lipdb.engine.explain import STAGES


@pytest.fixture(scope="module")
def db(as_shipped, tmp_path_factory):
    """One database for all tests, so that its faces are drawn once."""
    with pytest.MonkeyPatch.context() as patch, behind_pages(shutil.copy(as_shipped, tmp_path_factory.mktemp("say")), patch) as database:
        yield database


@pytest.fixture
def start(db):
    """Opens the page as a new visitor."""
    return functools.partial(page_cases.page, "say")


@pytest.fixture
def page(start):
    return start()


def messages(page) -> list[str]:
    assert not page.exception, page.exception[0].message
    return [*(error.value for error in page.error), *(info.value for info in page.info)]


def players(page) -> list:
    return [one.proto for one in page.get("bidi_component") if one.proto.component_name.endswith("stage")]


def test_the_page_opens_with_a_sentence_to_hear(page) -> None:
    assert messages(page) == []
    assert page.text_input[0].value == "Hello! Bob may find five blue whales."
    assert len(players(page)) == 1


def test_each_language_has_an_example_and_voices_of_its_own(page) -> None:
    languages = page.selectbox(key="say_language").options
    assert {"English", "Mandarin Chinese"} <= set(languages)
    page.selectbox(key="say_language").set_value("cmn").run()
    assert messages(page) == []
    assert any("一" <= letter <= "鿿" for letter in page.text_input[0].value)
    assert page.selectbox(key="say_voice_cmn").options[:2] == ["cmn-latn-pinyin", "cmn-latn-pinyin, f2"]


def test_without_a_sentence_the_page_says_what_to_do(page) -> None:
    page.text_input[0].set_value(" ").run()
    (message,) = messages(page)
    assert message.startswith("Write a sentence")
    assert players(page) == []


def test_text_in_another_language_is_answered_with_what_to_do(page) -> None:
    page.text_input[0].set_value("你好").run()
    (message,) = messages(page)
    assert "language" in message
    page.text_input[0].set_value("Hello").run()
    assert messages(page) == []


def test_markup_in_a_sentence_is_no_markup(page) -> None:
    page.text_input[0].set_value("<b>Bob</b> **may** :red[go] <script>alert(1)</script>").run()
    assert messages(page) == []
    assert len(players(page)) == 1
    assert not [one.value for one in page.markdown if "Bob" in one.value]


def test_the_stages_come_when_they_are_asked_for(page) -> None:
    assert not page.get("vega_lite_chart")
    page.session_state["say_tab"] = "Stages of the engine"
    page.run()
    assert messages(page) == []
    assert len(page.get("vega_lite_chart")) == 1


def test_every_stage_that_an_instant_can_name_can_be_seen(page) -> None:
    page.session_state["say_tab"] = "Stages of the engine"
    page.run()
    stages = page.session_state["say_stages"]
    assert set(STAGES) <= set(stages)
    data = json.dumps(json.loads(page.get("vega_lite_chart")[0].proto.spec)["layer"][-1]["encoding"]["color"])
    assert all(f'"{stage}"' in data for stage in STAGES)


def test_names_of_phones_do_not_run_into_each_other_in_the_chart_of_a_long_line(page) -> None:
    page.text_input[0].set_value("She sells sea shells by the sea shore, and nobody ever asks her why on earth she does.").run()
    page.session_state["say_tab"] = "Stages of the engine"
    page.run()
    chart = page.get("vega_lite_chart")[0].proto
    _, text, lines = json.loads(chart.spec)["layer"]
    (data,) = (one.data.data for one in chart.datasets if one.name == text["data"]["name"])
    names = convert_arrow_bytes_to_pandas_df(data).sort_values("seconds")
    first, last = lines["encoding"]["x"]["scale"]["domain"]
    half = names.phone.str.len() * 3 / 930 * (last - first)  # a letter has 6 pixels; on a window of 1280 the plot has 930
    assert len(names) > 10
    assert ((names.seconds + half).to_numpy()[:-1] <= (names.seconds - half).to_numpy()[1:]).all()


def test_the_stages_of_all_poses_stand_in_one_plot_that_keeps_to_the_width_of_the_page(page) -> None:
    page.session_state["say_tab"] = "Stages of the engine"
    page.run()
    page.selectbox(key="say_pose").set_value("all").run()
    assert messages(page) == []
    chart = json.loads(page.get("vega_lite_chart")[0].proto.spec)
    *_, lines = chart["layer"]
    poses = page.selectbox(key="say_pose").options[1:]
    floors = lines["encoding"]["y"]["axis"]
    assert len(floors["values"]) == len(poses)
    assert all(f"'{pose}'" in floors["labelExpr"] for pose in poses)


def test_a_mesh_format_of_a_flat_mouth_is_answered_in_a_line(page) -> None:
    page.session_state["say_tab"] = "Download"
    page.selectbox(key="say_character").set_value("flat").run()
    page.selectbox(key="say_format").set_value(".glb").run()
    assert messages(page) == ["character 'flat' has pictures and no mesh; write .tsv or .mp4 instead of .glb"]


@pytest.mark.parametrize("suffix", [".csv", ".json", ".cues.json", ".wav", ".tsv"])
def test_a_format_can_be_downloaded(page, suffix) -> None:
    page.session_state["say_tab"] = "Download"
    page.run()
    page.selectbox(key="say_format").set_value(suffix).run()
    assert messages(page) == []
    assert [button.proto.label for button in page.get("download_button")] == [f"Download line{suffix}"]


def test_a_film_is_made_on_request(page) -> None:
    page.session_state["say_tab"] = "Download"
    page.selectbox(key="say_character").set_value("flat").run()
    page.text_input[0].set_value("Bob").run()
    page.selectbox(key="say_format").set_value(".mp4").run()
    assert not page.get("download_button")
    page.button(key="say_draw").click().run()
    assert messages(page) == []
    assert [button.proto.label for button in page.get("download_button")] == ["Download line.mp4"]


def test_nobody_beside_is_a_choice_and_no_empty_field_to_be_cleared(page) -> None:
    page.selectbox(key="say_character").set_value("crab").run()
    beside = page.selectbox(key="say_beside")
    assert beside.options[beside.index] == "nobody"
    assert beside.proto.HasField("default")


def test_a_character_stands_beside_itself_as_it_was_before_an_edit(db, start) -> None:
    curve = db.book("facefx", language="en").find("l", "ow", "W").curve
    with db.edit(author="anna", note="Round earlier") as changes:
        changes.put("curves/facefx.tsv", {**curve.row(("l", "ow", "W")), "keys": "0:0 0.3:0.9 1:0"})
    page = start()
    beside = page.selectbox(key="say_beside")
    assert "as it was at revision 1" in beside.options
    beside.set_value(("robin", 1)).run()
    assert messages(page) == []
    (player,) = players(page)
    titles = [face["title"] for face in json.loads(player.json)["faces"]]
    assert titles == ["Robin, a human head", "Robin, a human head, at revision 1"]


def grid(phone: str = "m") -> bytes:
    lines = ['File type = "ooTextFile"', 'Object class = "TextGrid"', "", "0", "1", "<exists>", "1", '"IntervalTier"', '"phones"']
    return "\n".join([*lines, "0", "1", "2", "0", "0.5", f'"{phone}"', "0.5", "1", '"A"', ""]).encode()


def sound() -> bytes:
    with io.BytesIO() as buffer:
        with wave.open(buffer, "wb") as file:
            file.setnchannels(1)
            file.setsampwidth(2)
            file.setframerate(16_000)
            file.writeframes(bytes(32_000))
        return buffer.getvalue()


def test_a_recording_with_its_phones_is_read(start) -> None:
    from parts.lines import recorded

    line = recorded(grid(), ".textgrid", sound(), "en", 1)
    assert [phone.common for phone in line.schedule.phones] == [("bmp",), ("aa",)]
    assert line.sound.duration == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("aligned", "suffix", "audio", "answer"),
    [
        (b"milk, eggs", ".textgrid", None, "the aligned file: not a Praat text file"),
        (os.urandom(3000) + b"\0", ".textgrid", None, "the aligned file: "),
        (b"", ".textgrid", None, "the aligned file: the file is empty"),
        (grid()[:70], ".textgrid", None, "the aligned file: "),
        (b"[1, 2", ".json", None, "the aligned file: not JSON"),
        (b'{"format": "lipdb line 1"}', ".json", None, "not a schedule"),
        (grid(), ".textgrid", b"RIFF, says who?", "the recording: not a PCM wave file"),
        (grid(), ".textgrid", b"", "the recording: not a PCM wave file"),
        (grid("QQQ"), ".textgrid", None, "unknown symbol"),
        (b"x" * 40_000_000, ".textgrid", None, "larger than 20 MB"),
        (grid(), ".textgrid", b"x" * 40_000_000, "larger than 20 MB"),
    ],
    ids=["text", "noise", "empty", "cut", "json", "no schedule", "no wave", "empty wave", "unknown", "large", "large wave"],
)
def test_an_upload_that_is_not_what_it_seems_is_answered_in_a_line(start, aligned, suffix, audio, answer) -> None:
    from parts.lines import recorded

    from lipdb.errors import InputError

    with pytest.raises(InputError, match=answer) as caught:
        recorded(aligned, suffix, audio, "en", 1)
    told = str(caught.value)
    assert "\n" not in told
    assert "/tmp" not in told
    assert "upload" not in told


def test_unknown_symbols_can_be_mapped_by_articulation(start) -> None:
    from parts.lines import recorded

    line = recorded(grid("QQQ"), ".textgrid", None, "en", 1, allow_unknown=True)
    assert "QQQ" in line.notes[0]


def test_a_text_that_is_too_long_is_told_how_long_it_may_be(page) -> None:
    page.text_input(key="say_text_en").set_value("a" * 100_000).run()
    assert messages(page) == ["the text has 100,000 letters; give up to 2,000 at once here, and a longer one to `lipdb say`"]
