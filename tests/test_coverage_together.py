"""Several corpora and languages at once, what is left to do, and a script's lines: what the dashboard's coverage page shows."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lipdb.coverage.register import scan
from lipdb.coverage.reports.frequency import Frequency
from lipdb.coverage.reports.gaps import Outlook, gaps, outlook
from lipdb.coverage.reports.named import named_frequency
from lipdb.coverage.reports.script import decoded, read_script
from lipdb.coverage.reports.several import balanced, summed, together
from lipdb.errors import InputError
from lipdb.progress import reported

COUNTS = st.dictionaries(st.tuples(st.sampled_from("abc_"), st.sampled_from("abc_")), st.integers(1, 50))


def frequency(counts) -> Frequency:
    return Frequency.of((*pair, count) for pair, count in counts.items())


@given(COUNTS, COUNTS)
def test_corpora_of_one_language_add_up(one, other) -> None:
    both = summed([frequency(one), frequency(other)])
    assert dict(both.counts) == {pair: one.get(pair, 0) + other.get(pair, 0) for pair in {**one, **other}}
    assert both.scale == sum(one.values()) + sum(other.values())


@given(COUNTS, COUNTS, st.integers(2, 100))
def test_languages_weigh_the_same_whatever_the_size_of_their_corpora(one, other, times) -> None:
    small, large = frequency(other), frequency({pair: count * times for pair, count in other.items()})
    first, second = (balanced([frequency(one), each]) for each in (small, large))
    for pair in {**one, **other}:
        assert first.share(pair) == pytest.approx(second.share(pair))
    if one or other:
        assert first.shares.sum() == pytest.approx(1)
    if one and other:
        assert first.share(("a", "b")) == pytest.approx((frequency(one).share(("a", "b")) + small.share(("a", "b"))) / 2)


def test_one_language_keeps_its_counts_and_none_has_none() -> None:
    one = frequency({("a", "b"): 3})
    assert balanced([one, Frequency.of([])]) is one
    assert len(balanced([])) == 0


def uses_of(db, language, counts):
    return {use.pair: use for use in db.uses(counts, language=language)}


def redraw(db, table, pair, **changes) -> None:
    rows = [row for key, row in db.records["curves/facefx.tsv"].items() if key[:2] == pair]
    with db.edit(author="anna") as edit:
        for row in rows:
            edit.put(table, {**row, **changes})


def test_of_several_languages_a_pair_is_as_good_as_the_worst_of_them(own) -> None:
    counts = {("ah", "d"): 6.0, ("d", "ah"): 2.0}
    redraw(own, "en/curves/facefx.tsv", ("ah", "d"), keys="0:0 0.5:0.3 1:0")
    english, german = (uses_of(own, language, counts) for language in ("en", "de"))
    assert (english["ah", "d"].origin, english["ah", "d"].layer) == ("authored", "language:en")
    shown = {use.pair: use for use in together([english, german], frequency({("ah", "d"): 4}))}
    assert (shown["ah", "d"].origin, shown["ah", "d"].layer, shown["ah", "d"].count) == ("generated", "common", 4)
    assert shown["d", "ah"].count == 0
    redraw(own, "curves/facefx.tsv", ("ah", "d"), keys="0:0 0.5:0.4 1:0")
    everywhere = together([uses_of(own, language, counts) for language in ("en", "de")], frequency(counts))
    assert (everywhere[0].origin, everywhere[0].layer) == ("authored", "common")


def test_a_pair_is_done_when_everything_in_it_that_moves_the_face_is_drawn(own) -> None:
    rows = {key[2]: row for key, row in own.records["curves/facefx.tsv"].items() if key[:2] == ("ah", "d")}
    moving = [row for row in rows.values() if row["keys"]]
    assert 0 < len(moving) < len(rows)
    for done, row in enumerate(moving, 1):
        with own.edit(author="anna") as edit:
            edit.put("curves/facefx.tsv", {**row, "keys": "0:0 0.5:0.3 1:0"})
        (use,) = own.uses({("ah", "d"): 1.0}, language="en")
        assert (use.gap, use.origin) == ((True, "generated") if done < len(moving) else (False, "authored"))


def test_the_outlook_says_what_the_next_ones_change(db) -> None:
    uses = db.uses({("ah", "d"): 6.0, ("d", "ah"): 3.0, ("l", "ow"): 1.0}, language="en")
    assert outlook(uses, minutes=30, next=2) == Outlook(3, 3, 1.5, 0.0, 2, pytest.approx(90))
    assert outlook(uses, next=10).then == pytest.approx(gaps(uses)[-1].covered) == pytest.approx(100)
    assert outlook([]) == Outlook(0, 0, 0, 100, 0, 100)


SCRIPT = "Bob!\n\n  Mama  \n你好\nBob? Bob.\n"


def test_a_script_tells_which_of_its_lines_need_a_pair(db) -> None:
    script = read_script(SCRIPT, db.voice("en"), db.phoneset("en"))
    assert [(line.number, line.text) for line in script.lines] == [(1, "Bob!"), (3, "Mama"), (4, "你好"), (5, "Bob? Bob.")]
    assert [line.number for line in script.needing(("aa", "bmp"))][-1] == 5
    assert script.lines[0].pairs == {("_", "bmp"): 1, ("bmp", "aa"): 1, ("aa", "bmp"): 1, ("bmp", "_"): 1}
    assert script.lines[3].pairs == dict.fromkeys(script.lines[0].pairs, 2)
    assert [(line.number, line.left_out) for line in script.left_out] == [(4, "it has letters of another script than the language's")]
    assert not any("_" in pair for pair in script.frequency(silence=False).counts)


def test_a_script_counts_what_a_scan_of_it_counts(db, tmp_path) -> None:
    file = tmp_path / "script.txt"
    file.write_text(SCRIPT * 2 + "Well, Mr. Smith, the cat's hungry: 3 mice a day.\n")
    script = read_script(file.read_text(), db.voice("en"), db.phoneset("en"))
    done = scan(db, [str(file)], language="en", output=tmp_path / "script.parquet", workers=1, folder=tmp_path / "counts")
    assert named_frequency(db, done.scan.path).counts == script.frequency().counts


def test_a_long_script_tells_how_far_it_is(db) -> None:
    told = []
    with reported(lambda *step: told.append(step)):
        read_script("Bob.\n" * 250, db.voice("en"), db.phoneset("en"))
    assert told == [("reading", 100, 250), ("reading", 200, 250), ("reading", 250, 250)]


@pytest.mark.parametrize(
    ("text", "complaint"),
    [("你好\n", "no line that en can say; line 1: it has letters of another script"), (" \n\n", "no line that en can say; give text")],
)
def test_a_script_without_a_line_of_the_language_is_refused(db, text, complaint) -> None:
    with pytest.raises(InputError, match=complaint):
        read_script(text, db.voice("en"), db.phoneset("en"))


def test_text_is_read_in_the_encodings_that_editors_write() -> None:
    for encoding in ("utf-8", "utf-8-sig", "utf-16"):
        assert decoded("Šéf\n".encode(encoding)) == "Šéf\n"
    for raw in ("Šéf".encode("iso8859-2"), b"\0\1\2", b"\xff\xfe\x00"):
        with pytest.raises(InputError, match="save it as plain text in UTF-8"):
            decoded(raw)
