"""A thirteenth language: its folder is made from a voice and a text, checked, corrected as text, and spoken."""

import functools
import json

import pytest
from shared_tables import SHIPPED, copy_shared_tables, copy_workspace

from lipdb.curated.folder import read_folder
from lipdb.errors import InputError, PhonesetError
from lipdb.languages.conformance import check_language
from lipdb.languages.labels import read_espeak
from lipdb.languages.new import new_language
from lipdb.languages.precedent import judged, precedents
from lipdb.languages.text import chosen, script_in, sentences_of, words_of
from lipdb.languages.xsampa import xsampa
from lipdb.phones.labels import read_label
from lipdb.phones.phoneset import PhoneSet
from lipdb.speech.espeak_list import espeak_voices, known_voice, letters_of, script_of

# Written for these tests.
TEXTS = {
    "pl": "Dzień dobry, nazywam się Zofia. Chrząszcz brzmi w trzcinie.\nWczoraj kupiłem świeży chleb i trzy gruszki. Czy możesz mi pomóc?\n"
    "Dżdżownica pełznie po ziemi. Gęś i kaczka pływają po jeziorze.",
    "tr": "Merhaba, benim adım Ayşe. Bugün hava çok güzel.\nÇocuklar bahçede top oynuyor."
    " Yarın denize gideceğiz. Dağın arkasında bir köy var.",
    "el": "Καλημέρα, με λένε Μαρία. Τα παιδιά παίζουν στην αυλή.\nΧθες πήγαμε στη θάλασσα. Δεν ξέρω πού είναι το σχολείο.",
    "vi": "Xin chào, tôi tên là Lan. Hôm nay trời rất đẹp.\nQuyển sách nằm ở trên bàn. Người nông dân thu hoạch lúa.",
    "sw": "Habari ya asubuhi, jina langu ni Amina. Watoto wanacheza mpira.\nNg'ombe anakula nyasi. Mbwa amelala chini ya mti.",
    "ka": "გამარჯობა, მე მქვია ნინო. დღეს კარგი ამინდია.\nწიგნი მაგიდაზე დევს. არ ვიცი, სად არის სკოლა.",
    "ne": "नमस्ते, मेरो नाम आशा हो। आज मौसम राम्रो छ।\nकिताब टेबुल माथि छ। केटाकेटी आँगनमा खेल्दैछन्।",
    "fi": "Hyvää huomenta, minun nimeni on Aino. Lapset leikkivät pihalla.\nYö oli pitkä ja tuoksui suolaiselta. Kirja on pöydällä.",
    "am": "ሰላም፣ ስሜ አልማዝ ነው። ዛሬ አየሩ ጥሩ ነው።\nመጽሐፉ ጠረጴዛው ላይ ነው።",
}
SCRIPTS = {"pl": "Latn", "tr": "Latn", "el": "Grek", "vi": "Latn", "sw": "Latn", "ka": "Geor", "ne": "Deva", "fi": "Latn", "am": "Ethi"}


@pytest.fixture(scope="session")
def records(tmp_path_factory):
    return read_folder(copy_shared_tables(tmp_path_factory.mktemp("shared")))


@pytest.fixture
def make(tmp_path, records):
    """Make a language in the test's own folder."""

    def made(code, **options):
        given = {"voice": code, "text": TEXTS.get(code), "source": "user", "author": "anna"} | options
        return new_language(code, tmp_path, records=records, **given)

    return made


def rows(folder, name):
    return read_folder(folder.parent)[f"{folder.name}/{name}.tsv"]


@pytest.mark.parametrize("code", TEXTS)
def test_a_new_language_passes_the_kit_at_once(make, tmp_path, records, code):
    made = make(code)
    report = check_language(code, tmp_path, base=SHIPPED)
    assert [str(error) for error in report.errors] == []
    assert report.coverage.phones == report.coverage.phones_heard == len(made.phones) > 15
    assert rows(made.folder, "language")[(code,)]["script"] == SCRIPTS[code]
    assert [row["sentence"] for row in rows(made.folder, "sentences").values()] == sorted(sentences_of(TEXTS[code]))


def test_every_phone_is_a_proposal_with_a_reason_and_a_word_of_the_text(make):
    made = make("pl")
    phones = rows(made.folder, "phones")
    assert {row["origin"] for row in phones.values()} == {"generated"}
    assert {row["author"] for row in phones.values()} == {"anna"}
    assert {row["source"] for row in phones.values()} == {"espeak"}
    assert all(row["comment"].endswith(")") for row in phones.values())
    assert all(row["example"] in TEXTS["pl"] for row in phones.values())
    assert {phone: phones[phone,]["common"] for phone in ("ʃ", "tɕ", "dʒ", "m", "ɛ", "w")} == {
        "ʃ": "sh", "tɕ": "sh", "dʒ": "sh", "m": "bmp", "ɛ": "eh", "w": "w",
    }  # fmt: skip


def test_what_most_other_languages_do_is_proposed_before_the_rule(make, records):
    def row(common, origin="authored"):
        return {"phone": "r", "ipa": "r", "common": common, "origin": origin}

    def proposed(**languages):
        known = {f"{code}/phones.tsv": {("r",): row(*cells)} for code, cells in languages.items()}
        return judged("r", {**records, **known}, precedents({**records, **known}))

    rule = proposed()
    assert rule.common == ("r",)
    two = proposed(aa=["d"], bb=["d"])
    assert (two.common, two.second, two.review) == (("d",), ("r",), False)
    assert two.reason.startswith("like aa, bb; by the rule r: ")
    assert proposed(aa=["d"]) == rule  # one language may be a special case
    assert proposed(aa=["d"], bb=["d", "generated"]) == rule  # a rule is no second voice
    assert proposed(aa=["d"], bb=["d"], cc=["r"], dd=["r"]) == rule  # no most
    torn = proposed(aa=["d"], bb=["d"], cc=["r"])
    assert (torn.common, torn.review) == (("d",), True)


def test_what_the_second_opinion_doubts_waits_for_review(make):
    made = make("pl")
    (doubted,) = (row for row in rows(made.folder, "phones").values() if row["phone"] == "r")
    assert doubted["comment"].startswith("review: ")
    assert next(phone for phone in made.phones if phone.ipa == "r").review


def test_labels_affricates_and_x_sampa_are_aliases_of_one_phone(make):
    aliases = rows(make("pl").folder, "aliases")
    assert (
        aliases["espeak", "tɕ"]["phones"]
        == aliases["ipa", "t͡ɕ"]["phones"]
        == aliases["xsampa", r"ts\\".replace("\\\\", "\\")]["phones"]
        == "tɕ"
    )


def test_tone_and_length_are_no_phones_of_their_own(make):
    folder = make("vi").folder
    labels = {symbol: row["phones"] for (notation, symbol), row in rows(folder, "aliases").items() if notation == "espeak"}
    assert labels["aː"] == "a"
    assert labels["aːɜ"] == "a"  # how espeak writes the third tone
    assert not [label for label in labels if set(label) & set("0123456789")]
    assert not [phone for (phone,) in rows(folder, "phones") if set(phone) & set("ː0123456789ɜ")]
    symbols = PhoneSet.from_records(read_folder(folder.parent), "vi").symbols
    assert symbols.parts("aː6", "espeak") == ("a",)
    assert read_label("aː6", "espeak").tone == 6


@pytest.mark.parametrize(
    ("label", "segments"),
    [
        ("tʃ", "tʃ"), ("aɪə", "aɪə"), ("ɑːɹ", "ɑ ɹ"), ("əl", "ə l"), ("ph", "pʰ"), ("tɕh", "tɕʰ"), ("t`", "tʼ"), ("ʔœ", "ʔ œ"),
        ("sx", "s x"), ("mb", "mb"), ("pf", "pf"), ("əə", "ə"), ("kw", "k w"), ("ɯᵝɯᵝ", "ɯᵝ"), ("m̩", "m̩"), ("ɡ͡b", "ɡ͡b"), ("N", "ŋ"),
        ("1", ""),
    ],
)  # fmt: skip
def test_a_label_is_one_phone_or_several(label, segments):
    assert " ".join(read_espeak(label, tonal=False).segments) == segments


def test_a_third_tone_is_told_from_a_vowel_by_the_language():
    assert read_espeak("aɜ", tonal=True).segments == ("a",)
    assert read_espeak("ɜ", tonal=True).segments == ("ɜ",)
    assert read_espeak("aɜ", tonal=False).segments == ("aɜ",)


@pytest.mark.parametrize(("segment", "spelled"), [("tʃ", "tS"), ("ɲ", "J"), ("ɛ̃", "E~"), ("tʰ", "t_h"), ("ǁ", "|\\|\\"), ("☃", "")])
def test_x_sampa_follows_the_chart(records, segment, spelled):
    assert xsampa(segment, records) == spelled


def test_without_a_text_the_voice_reads_numbers_and_letters(make):
    made = make("ka", text=None)
    assert len(made.phones) > 25
    assert made.sentences == 0
    assert not (made.folder / "sentences.tsv").exists()
    assert any(note.startswith("no text: ") for note in made.notes)


def test_a_text_of_numbers_and_a_script_that_nothing_is_known_of_are_no_trouble(make):
    assert len(make("pl", text="1 2 3\n15 000").phones) > 10
    assert len(make("sw", text=None, script="Tfng").phones) > 10


def test_sentences_that_the_voice_cannot_read_are_left_out_and_counted(make):
    made = make("ka", text=TEXTS["ka"] + "\nThis is English.\nЭто по-русски.\n")
    assert made.sentences == 4
    assert any(note.startswith("2 of 6 sentences are left out") for note in made.notes)


def test_of_a_large_text_the_sentences_with_most_pairs_are_taken():
    said = {
        "every pair, and at a good length": ((("a", "b"), ("c", "d")),),
        "one pair only": ((("a", "b"),),),
        "another sentence": ((("d", "e"),),),
    }
    assert chosen(said, 2) == ["every pair, and at a good length", "another sentence"]
    assert len(chosen(said, 99)) == 3


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"voice": "pll"}, "espeak-ng has no voice 'pll'; did you mean pl"),
        ({"text": ""}, "text: there is no word in it"),
        ({"text": "!!! ... 🎉"}, "text: there is no word in it"),
        ({"text": TEXTS["ka"], "script": "Latn"}, "can read none of it; 4 of 4 sentences are left out: 'გამარჯობა' at"),
        ({"text": TEXTS["ka"]}, "can read none of it; 4 of 4 sentences are left out: the voice reads words"),
        ({"source": "novel"}, "no source 'novel'; name the row of sources.tsv that says whose text it is"),
        ({"script": "Klingon"}, "'Klingon' is no script"),
    ],
)  # fmt: skip
def test_nonsense_is_refused_in_one_line_and_leaves_nothing_behind(make, tmp_path, options, message):
    with pytest.raises(InputError, match=message) as error:
        make("pl", **options)
    assert "\n" not in str(error.value)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("code", ["POL", "polish", "x/y", "..", "", "pl-PL"])
def test_a_code_that_is_none_is_refused(make, code):
    with pytest.raises(InputError, match="is no code of a language"):
        make(code, voice="pl")


def test_a_language_that_is_there_is_never_overwritten(make, tmp_path):
    make("pl")
    before = {file: file.read_bytes() for file in tmp_path.rglob("*.tsv")}
    with pytest.raises(InputError, match="pl is there already; edit it, or choose another code"):
        make("pl")
    assert {file: file.read_bytes() for file in tmp_path.rglob("*.tsv")} == before
    with pytest.raises(InputError, match="language 'en' is there already"):
        make("en", voice="pl", text=TEXTS["pl"])


def test_curated_data_that_lack_a_source_are_an_error_and_nothing_is_written(tmp_path, records):
    poor = {**records, "sources.tsv": {key: row for key, row in records["sources.tsv"].items() if key != ("espeak",)}}
    with pytest.raises(PhonesetError, match="source 'espeak' does not exist"):
        new_language("pl", tmp_path, records=poor, voice="pl", text=TEXTS["pl"], source="user", author="anna")
    assert list(tmp_path.iterdir()) == []


def test_sentences_end_at_the_marks_of_any_script_and_at_lines():
    text = "One. “Two!” Three?\nनमस्ते। आज\n早晨。今日好！\n3.5 Mio. \n\n ... \nOne."
    assert sentences_of(text) == ("One.", "“Two!”", "Three?", "नमस्ते।", "आज", "早晨。", "今日好！", "3.5 Mio.")


def test_words_keep_their_marks_and_lose_punctuation():
    assert words_of(["«हूँ»। (हैं)", "l'été, 25 l'été"]) == ["l'été", "हूँ", "हैं"]
    assert words_of(["今日好！好"]) == ["好", "今", "日"]


@pytest.mark.parametrize(
    ("text", "script"), [("Это OK", "Cyrl"), ("今日は天気がいい", "Jpan"), ("今天天气好", "Hans"), ("안녕 金", "Kore"), ("... 12", "")]
)
def test_the_script_of_a_text_is_that_of_most_letters(text, script):
    assert script_in(text) == script


@pytest.mark.parametrize(
    ("voice", "script"), [("pl", "Latn"), ("el", "Grek"), ("hi", "Deva"), ("ko", "Kore"), ("sr", "Cyrl"), ("cmn", "Hans")]
)
def test_the_script_of_a_voice_is_the_one_it_reads_by_its_own_rules(voice, script):
    assert script_of(voice) == script
    assert letters_of(script)


def test_a_voice_that_espeak_lacks_is_refused_with_those_near():
    assert espeak_voices()["pl"] == "Polish"
    assert known_voice("pl") == "pl"
    with pytest.raises(InputError, match="did you mean"):
        known_voice("pl-PL")


@pytest.fixture
def lipdb(invoke, tmp_path, monkeypatch):
    """Run ``lipdb`` on a database and a folder of curated text of its own: exit code, output, errors."""
    workspace = copy_workspace(tmp_path / "text")
    monkeypatch.setenv("LIPDB_AUTHOR", "anna")
    return functools.partial(invoke, "--db", tmp_path / "a.db", "--phonesets", workspace)


def test_from_nothing_to_a_speaking_character(lipdb, tmp_path):
    text, workspace = tmp_path / "polish.txt", tmp_path / "text"
    text.write_text(TEXTS["pl"], "utf-8")
    code, out, err = lipdb("language", "new", "pl", "--from-espeak", "pl", "--text", text, "--source", "user", "--json")
    assert code == 0, err
    told = json.loads(out)
    assert told["folder"] == str(workspace / "pl")
    assert {phone["phone"] for phone in told["phones"]} >= {"ʃ", "tɕ", "r"}
    assert "lipdb language check pl" in err

    assert lipdb("language", "check", "pl")[0] == 0

    # A person decides what the rule was not sure of.
    phones = workspace / "pl" / "phones.tsv"
    before = phones.read_text("utf-8")
    (row,) = (line for line in before.splitlines() if line.startswith("r\t"))
    cells = row.split("\t")
    cells[3], cells[5], cells[10] = "l", "authored", "A test of what a person may decide"
    phones.write_text(before.replace(row, "\t".join(cells)), "utf-8")
    code, out, err = lipdb("language", "check", "pl")
    assert code == 0, out
    assert "review: r maps to l here, articulation says r" in out

    code, out, err = lipdb("phones", "rano", "-l", "pl", "--json")
    assert code == 0, err
    assert [(phone["symbol"], phone["common"], phone["layer"]) for phone in json.loads(out) if phone["symbol"] == "r"] == [
        ("r", ["l"], "language:pl")
    ]
    film = tmp_path / "hello.csv"
    code, out, err = lipdb("say", "Dzień dobry, chrząszczu!", "-l", "pl", "-o", film)
    assert code == 0, err
    assert film.stat().st_size > 1000


def test_the_text_may_come_from_a_pipe_and_needs_a_source(lipdb, tmp_path):
    code, _, err = lipdb("language", "new", "pl", "--from-espeak", "pl", "--text", "-")
    assert (code, err.startswith("lipdb: whose text is it?")) == (2, True)
    words = ("language", "new", "pl", "--from-espeak", "pl", "--text", "-", "--source", "user", "-o", tmp_path / "own")
    code, out, err = lipdb(*words, stdin=TEXTS["pl"].encode("utf-8"))
    assert code == 0, err
    assert out.startswith("phone\tlabels\tcommon\tconfidence\theard\texample\treview\n")
    assert (tmp_path / "own" / "pl" / "sentences.tsv").is_file()


def test_a_text_that_is_no_utf8_is_one_line(lipdb, tmp_path):
    file = tmp_path / "latin2.txt"
    file.write_bytes("Dzień dobry".encode("latin2"))
    code, _, err = lipdb("language", "new", "pl", "--from-espeak", "pl", "--text", file, "--source", "user")
    assert (code, err) == (4, f"lipdb: {file}: no UTF-8 text (byte 5); save it as UTF-8\n")
