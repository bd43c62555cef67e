"""The page Coverage without a browser: what it counts, colours, lists and refuses."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

import pytest
from page_cases import DASHBOARD, behind_pages
from streamlit.testing.v1 import AppTest

from lipdb.coverage.register import scan

SCENE = "Bob!\n\nMama\n你好\n"


@pytest.fixture
def db(as_shipped, tmp_path, monkeypatch):
    """A database of its own that the page works on."""
    with behind_pages(shutil.copy(as_shipped, tmp_path), monkeypatch) as database:
        yield database


def coverage_page(db, **session: Any) -> AppTest:
    page = AppTest.from_file(str(DASHBOARD / "pages" / "coverage.py"), default_timeout=60)
    page.session_state["visitor"] = "anna"
    for name, value in session.items():
        page.session_state[name] = value
    return shown(page.run())


def shown(page: AppTest) -> AppTest:
    assert not page.exception
    return page


def metrics(page: AppTest) -> dict[str, str]:
    return {one.label: one.value for one in page.metric}


def table(page: AppTest, key: str) -> Any:
    return page.dataframe(key=key).value


def chart(page: AppTest, number: int = 0) -> dict[str, Any]:
    return json.loads(page.get("vega_lite_chart")[number].proto.spec)


def draw(db, table: str, *pairs: tuple[str, str], origin: str = "authored") -> None:
    """Every pose that moves in *pairs*, as if somebody had drawn it."""
    with db.edit(author="anna") as edit:
        for row in db.records["curves/facefx.tsv"].values():
            if (row["left"], row["right"]) in pairs and row["keys"]:
                edit.put(table, {**row, "keys": "0:0 0.5:0.3 1:0", "origin": origin})


def counted(db, folder: Path, text: str, *, language: str = "en", title: str = "A story") -> Any:
    file = folder / "story.txt"
    file.write_text(text)
    return scan(
        db, [str(file)], language=language, output=folder / "story.parquet", scheduler="threads", folder=folder / "kept", title=title
    ).scan


def test_without_a_scan_the_example_sentences_are_counted(db) -> None:
    page = coverage_page(db)
    assert page.multiselect[1].value == ["en example sentences"]
    found, of = metrics(page)["Pairs that occur"].split(" of ")
    assert (int(found) > 300, of) == (True, "483")


def test_the_matrix_shows_the_newest_scan_and_what_its_pairs_use(db, tmp_path) -> None:
    one = counted(db, tmp_path, "Bob.\n" * 3)
    draw(db, "curves/facefx.tsv", ("bmp", "aa"))
    page = coverage_page(db)
    assert page.multiselect[1].value == [f"en {one.id}"]
    assert metrics(page) == {"Pairs that occur": "4 of 483", "Covered by hand": "25.0 %"}
    sums = next(one.value for one in page.markdown if one.value.startswith("| origin "))
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in sums.replace("\N{NO-BREAK SPACE}", " ").splitlines()]
    assert cells[2:] == [["authored", "1", "25.0 %"], ["generated", "3", "75.0 %"]]
    page.multiselect[1].set_value([f"en {one.id}", "en example sentences"]).run()
    assert int(metrics(shown(page))["Pairs that occur"].split(" of ")[0]) > 300


def test_colours_are_by_frequency_origin_or_layer(db) -> None:
    draw(db, "en/curves/facefx.tsv", ("bmp", "aa"))
    for colouring, legend in (("Origin", ["authored", "generated"]), ("Layer", ["common", "language:en"])):
        page = coverage_page(db, coverage_colouring=colouring)
        assert chart(page)["encoding"]["color"]["scale"]["domain"] == legend
    assert chart(coverage_page(db))["encoding"]["color"]["condition"]["scale"]["type"] == "log"


def test_silence_can_be_left_out_as_in_the_paper(db) -> None:
    page = coverage_page(db)
    page.toggle(key="coverage_silence").set_value(False).run()
    assert metrics(shown(page))["Pairs that occur"].endswith(" of 441")


def test_several_languages_are_one_matrix_in_which_they_weigh_the_same(db) -> None:
    draw(db, "de/curves/facefx.tsv", ("d", "ah"))
    page = coverage_page(db, coverage_languages=["en", "de"], coverage_view="Frequency")
    rows = table(page, "coverage_table")
    assert "count" not in rows
    page = coverage_page(db, coverage_languages=["de"], coverage_view="To do")
    assert "d-ah" not in list(table(page, "coverage_to_do").pair)
    page = coverage_page(db, coverage_languages=["en", "de"], coverage_view="To do")
    assert "d-ah" in list(table(page, "coverage_to_do").pair)


def test_table_two_stands_beside_the_papers(db) -> None:
    page = coverage_page(db, coverage_view="Frequency", coverage_silence=False)
    rows = table(page, "coverage_table")
    assert (len(rows), rows.pair[0], rows.paper[0]) == (21, "ah-d", "4.62")
    assert "cover 99.1 %" in page.markdown[0].value
    page.toggle(key="coverage_every").set_value(True).run()
    assert len(table(shown(page), "coverage_table")) > 300


def test_the_list_says_what_to_draw_next_and_what_ten_pairs_change(db) -> None:
    page = coverage_page(db, coverage_view="To do")
    told, rows = metrics(page), table(page, "coverage_to_do")
    assert told["Pairs to draw"] == f"{len(rows)} of {len(rows)}"
    assert told["Hours left"] == f"{len(rows) * 5 / 60:.1f}"
    assert told["Covered by hand today"] == "0.0 %"
    assert told["After the next 10"] == f"{rows.covered[9]:.1f} %"
    page.number_input(key="coverage_minutes").set_value(6.0).run()
    assert metrics(shown(page))["Hours left"] == f"{len(rows) / 10:.1f}"
    left, right = rows.pair[0].split("-")
    draw(db, "curves/facefx.tsv", (left, right))
    after = coverage_page(db, coverage_view="To do")
    assert table(after, "coverage_to_do").pair[0] == rows.pair[1]
    assert metrics(after)["Covered by hand today"] == f"{rows.percent[0]:.1f} %"


def test_when_everything_is_drawn_the_list_says_so(db, tmp_path) -> None:
    counted(db, tmp_path, "Bob.\n")
    draw(db, "curves/facefx.tsv", ("_", "bmp"), ("bmp", "aa"), ("aa", "bmp"), ("bmp", "_"))
    page = coverage_page(db, coverage_view="To do")
    assert "Nothing is left to draw" in page.success[0].value


def test_a_script_says_what_it_lacks_and_where(db) -> None:
    draw(db, "curves/facefx.tsv", ("_", "bmp"), ("bmp", "aa"))
    page = coverage_page(db, coverage_view="Your script")
    assert "Paste a scene" in page.info[0].value
    page.text_area(key="coverage_script").set_value(SCENE).run()
    assert shown(page).subheader[0].value == "This scene: 6 pairs, 2 authored or fitted"
    rows = table(page, "coverage_missing").set_index("pair")
    assert (rows.lines["aa-bmp"], rows["count"]["aa-bmp"]) == ("1, 3", 2)
    assert rows.lines["bmp-_"] == "1"
    lines = page.dataframe[1].value.set_index("line")
    assert sorted(lines.missing[1]) == ["aa-bmp", "bmp-_"]
    assert any("line 4 is left out" in one.value for one in page.caption)
    draw(db, "curves/facefx.tsv", ("aa", "bmp"), ("bmp", "_"), ("bmp", "ah"), ("ah", "_"), ("aa", "_"))
    assert "Every pair of this script" in shown(page.run()).success[0].value


@pytest.mark.parametrize(
    ("text", "complaint"), [("你好\n", "no line that en can say"), ("Bob. " * 250_000, "count it under Corpora")], ids=["language", "size"]
)
def test_a_script_that_can_not_be_read_is_answered_with_what_to_do(db, text, complaint) -> None:
    page = coverage_page(db, coverage_view="Your script", coverage_script=text)
    assert complaint in page.error[0].value
    assert not page.get("progress")


def test_a_scan_of_an_older_mapping_is_marked_and_can_be_counted_again(db, tmp_path) -> None:
    one = counted(db, tmp_path, "Bob.\n")
    row = next(row for row in db.records["en/phones.tsv"].values() if row["common"] == "aa")
    with db.edit(author="anna") as edit:
        edit.put("en/phones.tsv", {**row, "common": "ah"})
    page = coverage_page(db)
    assert page.multiselect[1].value == ["en example sentences"]
    page = coverage_page(db, coverage_view="Corpora")
    assert table(page, "coverage_scans").state[0] == "stale"
    assert "A story (en) is stale" in page.warning[0].value
    page.button(key=f"coverage_again_{one.id}").click().run()
    assert "4 pairs in 1 of 1 lines" in shown(page).success[0].value
    assert table(page, "coverage_scans")[["corpus", "state"]].to_dict("records")[0] == {"corpus": "A story", "state": "current"}


def test_no_language_no_text_and_no_scan_are_answered_with_what_to_do(db) -> None:
    assert "Choose a language" in coverage_page(db, coverage_languages=[]).info[0].value
    page = coverage_page(db)
    page.multiselect[1].set_value([]).run()
    assert "No text is chosen" in shown(page).info[0].value
    assert "Nothing is counted in these languages yet" in coverage_page(db, coverage_view="Corpora").info[0].value


def test_counting_nothing_says_to_choose_a_file_first(db) -> None:
    page = coverage_page(db, coverage_view="Corpora")
    page.get("button")[-1].click().run()
    assert "choose a text file first" in shown(page).error[0].value


def test_a_page_that_is_left_comes_back_as_it_was(db) -> None:
    page = coverage_page(db)
    page.multiselect[0].set_value(["de"]).run()
    kept = page.session_state["coverage_kept"]
    again = coverage_page(db, coverage_kept=kept)
    assert again.multiselect[0].value == ["de"]
    gone = coverage_page(db, coverage_kept={**kept, "coverage_languages": ["de", "xx"], "coverage_character": "nobody"})
    assert (gone.multiselect[0].value, gone.selectbox(key="coverage_character").value) == (["de"], "robin")
