"""The conformance kit finds the mistakes that people make in the folder of a language, and says where."""

import functools
import json
import shutil

import pytest
from shared_tables import SHIPPED, copy_shared_tables

from lipdb.errors import InputError, PhonesetError
from lipdb.languages.conformance import check_language, tidy_language

OWN = "authored\tlipdb\tApache-2.0\tanna\t2026-11-22T00:00:00Z\t"
# A language of twelve phones in a notation of its own, which espeak's Hawaiian voice speaks.
PHONES = """
A vowel a aa aloha
E vowel e eh hele
H consonant h h hale
I vowel i ih pili
K consonant k kg makua
L consonant l l lani
M consonant m bmp makua
N consonant n d lani
O vowel o ow aloha
P consonant p bmp pua
U vowel u w pua
W consonant w w wai
"""
LABELS = "a:A ai:A_I au:A_U e:E ei:E_I h:H i:I k:K l:L m:M n:N o:O p:P u:U ui:U_I w:W"
SENTENCES = ("Aloha kakou e ka makua.", "He mea nui ka wai.", "Ke pili nei ka pua i ka lani.", "Ua hele au i ka hale.")


def lines(*rows):
    return "".join(f"{row}\n" for row in rows)


GOOD = {
    "language.tsv": lines(
        "language\tname\tnotation\tspeech\tvoice\tscript\tsource\tcomment", "xx\tTest language\tmine\tespeak\thaw\tLatn\tlipdb\t"
    ),
    "phones.tsv": lines(
        "phone\tkind\tipa\tcommon\texample\torigin\tsource\tlicence\tauthor\ttime\tcomment",
        *("\t".join(line.split()) + "\t" + OWN for line in PHONES.strip().splitlines()),
    ),
    "aliases.tsv": lines(
        "notation\tsymbol\tphones\tsource\tcomment",
        *(f"espeak\t{label}\t{phones.replace('_', ' ')}\tespeak\t" for label, phones in (pair.split(":") for pair in LABELS.split())),
    ),
    "sentences.tsv": lines("sentence\tsource\tcomment", *(f"{sentence}\tlipdb\t" for sentence in SENTENCES)),
}


@pytest.fixture(scope="session")
def base(tmp_path_factory):
    """The shared tables that every language leans on, without curves and other languages, so that reading is quick."""
    return copy_shared_tables(tmp_path_factory.mktemp("base"))


@pytest.fixture
def folder(tmp_path):
    """A folder that holds the good language only."""
    (tmp_path / "xx").mkdir()
    for name, text in GOOD.items():
        (tmp_path / "xx" / name).write_text(text, "utf-8", newline="\n")
    return tmp_path


def edit(folder, name, old, new):
    file = folder / "xx" / name
    text = file.read_text("utf-8")
    assert text.count(old) == 1
    file.write_text(text.replace(old, new), "utf-8", newline="")


@pytest.fixture
def found(folder, base):
    """What the kit finds in the folder: errors, or notes."""

    def check(*, notes=False):
        report = check_language("xx", folder, base=base)
        return [str(finding) for finding in (report.notes if notes else report.errors)]

    return check


def test_a_good_language_has_no_errors_and_its_coverage_is_reported(folder):
    report = check_language("xx", folder, base=SHIPPED)
    assert report.errors == ()
    coverage = report.coverage
    assert (coverage.sentences, coverage.phones, coverage.phones_heard) == (4, 12, 12)
    assert coverage.possible == 11**2 - 1
    assert coverage.occurring + len(coverage.missing) == coverage.possible
    assert sum(coverage.origins.values()) == coverage.occurring
    assert ("_", "aa") not in coverage.missing
    assert ("w", "w") in coverage.missing


def test_missing_pairs_are_a_note(folder, found):
    (note,) = found(notes=True)
    assert note.startswith("xx/sentences.tsv:1:1: ")
    assert "pairs of common phones and pauses occur in no sentence: " in note


BROKEN = {
    "a mapping to nothing": (
        "phones.tsv",
        "\tbmp\tpua",
        "\tbmb\tpua",
        "phones.tsv:11:15: common phone 'bmb' does not exist; did you mean 'bmp'?",
    ),
    "no mapping": ("phones.tsv", "\tbmp\tpua", "\t\tpua", "phones.tsv:11:15: common is empty"),
    "no example": ("phones.tsv", "kg\tmakua", "kg\t", "phones.tsv:6:18: example is empty"),
    "no source of that name": (
        "phones.tsv",
        "wai\tauthored\tlipdb",
        "wai\tauthored\tbook",
        "phones.tsv:13:30: source 'book' does not exist",
    ),
    "a row cut short": ("phones.tsv", "ow\taloha\tauthored", "ow\t", "phones.tsv:10:1: 10 cells where the header has 11"),
    "a phone twice": ("phones.tsv", "W\tcon", "U\tcon", "phones.tsv:13:1: U stands already in line 12"),
    "a header in other words": ("phones.tsv", "phone\tkind", "Phone\tkind", "phones.tsv:1:1: the header must be phone kind ipa"),
    "a phone named in a form that is never found": (
        "phones.tsv",
        "O\tvowel",
        "O\u0301\tvowel",
        "phones.tsv:10:1: 'O\u0301' read as a label of mine gives nothing",
    ),
    "an alias of no phone": ("aliases.tsv", "e\tE\t", "e\tÉ\t", "aliases.tsv:5:10: phone 'É' does not exist"),
    "an alias twice": ("aliases.tsv", "ei\tE I", "e\tE I", "aliases.tsv:6:1: espeak e stands already in line 5"),
    "the same sign twice": (
        "aliases.tsv",
        "espeak\tw\t",
        "espeak\tg\tP\tespeak\t\nespeak\tɡ\tK\tespeak\t\nespeak\tw\t",
        "aliases.tsv:18:8: 'ɡ' means two things: K here, P where it is written 'g'",
    ),
    "joined labels that mean something else": (
        "aliases.tsv",
        "espeak\ta\t",
        "cereproc\ta\tA\tlipdb\t\ncereproc\ta-e\tO\tlipdb\t\ncereproc\te\tE\tlipdb\t\nespeak\ta\t",
        "aliases.tsv:3:10: 'a-e' means two things: O as it stands, A E when it is taken apart",
    ),
    "IPA that is read as another phone": (
        "aliases.tsv",
        "espeak\tw\tW\tespeak\t\n",
        "espeak\tw\tW\tespeak\t\nipa\tk\tP\tlipdb\t\n",
        "phones.tsv:6:13: IPA 'k' is read as P, which looks like bmp and not like this row",
    ),
    "a label of the voice that nobody knows": (
        "aliases.tsv",
        "ui\tU I\tespeak\t\nespeak\tw\tW\tespeak\t\n",
        "w\tW\tespeak\t\n",
        "sentences.tsv:3:1: the voice says 'ui' here (1x in all), which only the common table knows (ui); give it a row",
    ),
    "a phone in no sentence": (
        "sentences.tsv",
        "Ke pili nei ka pua i ka lani.\tlipdb\t\n",
        "",
        "phones.tsv:11:1: 'P' occurs in no sentence of xx/sentences.tsv; write one with it",
    ),
    "a sentence in another script": (
        "sentences.tsv",
        "Ua hele au i ka hale.",
        "Ua hele au i ка hale.",
        "sentences.tsv:5:1: the voice can't read this: 'ка' at character 14 is written in Cyrillic letters",
    ),
    "no source of a sentence": ("sentences.tsv", "makua.\tlipdb", "makua.\tmine", "sentences.tsv:2:25: source 'mine' does not exist"),
    "a voice that espeak lacks": (
        "language.tsv",
        "\thaw\t",
        "\thawaii\t",
        "language.tsv:2:30: the voice can't be heard, so nothing that it says is checked: espeak-ng has no voice 'hawaii'",
    ),
    "no plug-in of that name": ("language.tsv", "\tespeak\t", "\tfestival\t", "language.tsv:2:23: the voice can't be heard"),
    "another language's code": ("language.tsv", "xx\tTest", "yy\tTest", "language.tsv:2:1: 'yy' stands in the folder of 'xx'"),
}


@pytest.mark.parametrize("mistake", BROKEN)
def test_a_mistake_is_found_with_its_file_line_and_column(folder, found, mistake):
    name, old, new, finding = BROKEN[mistake]
    edit(folder, name, old, new)
    errors = found()
    assert [error for error in errors if error.startswith(f"xx/{finding}")], errors


@pytest.mark.parametrize("name", GOOD)
def test_a_table_that_is_missing_or_empty_is_an_error_and_no_crash(folder, found, name):
    header = GOOD[name].split("\n")[0] + "\n"
    for text in (None, "", header, "\n\n"):
        file = folder / "xx" / name
        if text is None:
            file.unlink()
        else:
            file.write_text(text, "utf-8")
        errors = found()
        assert [error for error in errors if error.startswith(f"xx/{name}:1:1: ")], (text, errors)


@pytest.mark.parametrize(
    "change",
    [
        lambda text: text.replace("A\tvowel\ta\taa", "A vowel a aa"),
        lambda text: text.replace("\tauthored\t", "\tguessed\t"),
        lambda text: "",
        lambda text: None,
    ],
    ids=["one row", "all rows", "empty", "missing"],
)
def test_rows_of_phones_that_cannot_be_read_are_not_missed_by_the_aliases_as_well(folder, found, change):
    phones = folder / "xx" / "phones.tsv"
    text = change(phones.read_text())
    phones.unlink() if text is None else phones.write_text(text)
    assert {error.split(":")[0] for error in found()} == {"xx/phones.tsv"}


def test_bytes_that_are_no_text_are_a_finding(folder, found):
    (folder / "xx" / "phones.tsv").write_bytes(bytes(range(256)))
    assert [error for error in found() if error.startswith("xx/phones.tsv:1:1: can't be read as UTF-8 text")]


def test_a_file_that_is_no_table_is_a_finding(folder, found):
    (folder / "xx" / "phonse.tsv").write_text("x\n")
    assert "xx/phonse.tsv:1:1: no table has this name; see docs/data.md for the layout" in found()


def test_rows_in_any_order_are_found_where_they_stand(folder, found):
    header, *rows = GOOD["phones.tsv"].splitlines()
    text = lines(header, *reversed(rows)).replace("\tbmp\tpua", "\tbmb\tpua")
    (folder / "xx" / "phones.tsv").write_text(text)
    errors = found()
    assert [error for error in errors if error.startswith("xx/phones.tsv:4:15: common phone 'bmb'")]
    assert "xx/phones.tsv:2:1: not canonical from here on; --tidy writes it so" in errors


@pytest.mark.parametrize(
    ("change", "why"),
    [
        (lambda text: text.replace("\n", "\r\n"), " (its lines end with CR LF)"),
        (lambda text: "\ufeff" + text, " (it begins with a byte order mark)"),
        (lambda text: text[:-1], " (the last line has no end)"),
    ],
)
def test_text_of_another_editor_is_tidied(folder, found, change, why):
    for name, text in GOOD.items():
        (folder / "xx" / name).write_text(change(text), "utf-8", newline="")
    errors = found()
    assert len(errors) == len(GOOD)
    assert all(f": not canonical from here on{why}; --tidy writes it so" in error for error in errors)
    assert len(tidy_language("xx", folder)) == len(GOOD)
    assert found() == []
    assert all((folder / "xx" / name).read_bytes() == text.encode() for name, text in GOOD.items())


def test_text_that_cannot_be_read_is_not_tidied(folder):
    edit(folder, "aliases.tsv", "ei\tE I", "e\tE I")
    before = (folder / "xx" / "aliases.tsv").read_bytes()
    with pytest.raises(PhonesetError, match="aliases.tsv:6:1: espeak e stands already in line 5"):
        tidy_language("xx", folder)
    assert (folder / "xx" / "aliases.tsv").read_bytes() == before


def test_what_articulation_maps_otherwise_is_a_note(folder, found):
    edit(folder, "phones.tsv", "m\tbmp\tmakua", "m\tao\tmakua")
    assert found() == []
    assert [note for note in found(notes=True) if note.startswith("xx/phones.tsv:8:15: review: m maps to ao here, articulation says bmp")]


def test_a_row_that_waits_for_review_is_a_note(folder, found):
    edit(folder, "phones.tsv", "N\tconsonant\tn\td\tlani\t" + OWN, "N\tconsonant\tn\td\tlani\t" + OWN + "review: not heard often")
    assert found() == []
    assert [note for note in found(notes=True) if note.endswith(": review: not heard often")]


def test_a_phone_that_the_voice_does_not_say_in_its_example_is_a_note(folder, found):
    edit(folder, "phones.tsv", "P\tconsonant\tp\tbmp\tpua", "P\tconsonant\tp\tbmp\tmakua")
    assert found() == []
    assert "xx/phones.tsv:11:19: the voice does not say 'P' in makua" in found(notes=True)


def test_a_licence_that_no_source_has_is_a_note(folder, found):
    edit(folder, "phones.tsv", "bmp\tpua\t" + OWN, "bmp\tpua\t" + OWN.replace("Apache", "Apach"))
    assert found() == []
    assert "xx/phones.tsv:11:38: 'Apach-2.0' is the licence of no source; did you mean 'Apache-2.0'?" in found(notes=True)


def test_a_phone_whose_kind_is_not_that_of_its_ipa_is_a_note(folder, found):
    edit(folder, "phones.tsv", "P\tconsonant", "P\tvowel")
    assert found() == []
    assert "xx/phones.tsv:11:3: review: p begins with a consonant, but the row says vowel" in found(notes=True)


def test_a_phone_that_the_voice_can_not_say_is_a_note(folder, found):
    edit(folder, "phones.tsv", "W\tconsonant", "V\tconsonant\tv\tf\tWaikiki\t" + OWN + "\nW\tconsonant")
    assert found() == []
    assert [note for note in found(notes=True) if note.startswith("xx/phones.tsv:13:1: 'V' occurs in no sentence")]


def test_the_language_may_be_given_by_its_own_folder(folder, base):
    assert check_language("xx", folder / "xx", base=base).errors == ()


def test_a_whole_folder_has_shared_tables_of_its_own(folder, base):
    shutil.copytree(base, folder, dirs_exist_ok=True)
    assert check_language("xx", folder, base=SHIPPED).errors == ()
    sources = folder / "sources.tsv"
    sources.write_text(sources.read_text("utf-8").replace("\nespeak\t", "\neSpeak\t"), "utf-8")
    errors = check_language("xx", folder, base=SHIPPED).errors
    assert {error.message for error in errors} == {"source 'espeak' does not exist; did you mean 'eSpeak'?"}
    assert {error.file for error in errors} == {"xx/aliases.tsv"}


def test_a_language_or_a_folder_that_is_not_there_is_one_line(folder, base):
    with pytest.raises(InputError, match=r"no language 'yy' there \(there are: xx\); make it with `lipdb language new yy`"):
        check_language("yy", folder, base=base)
    with pytest.raises(InputError, match="no such folder"):
        check_language("yy", folder / "nowhere", base=base)
    with pytest.raises(InputError, match=r"'\.\./xx' is no code of a language"):
        check_language("../xx", folder / "xx", base=base)


@pytest.fixture
def command(invoke, base, folder):
    """Run ``lipdb language check xx`` on the folder: exit code, output, errors."""
    return functools.partial(invoke, "--phonesets", base, "language", "check", "xx", folder)


def test_the_command_ends_with_0_when_there_are_only_notes(folder, command, monkeypatch):
    monkeypatch.chdir(folder)
    code, out, err = command()
    assert code == 0
    assert out.startswith("xx/sentences.tsv:1:1: note: ")
    assert err.splitlines()[-1] == "xx: all is well; 1 note"
    assert "4 sentences with 12 of 12 phones and " in err


def test_the_command_ends_with_3_and_lists_what_is_wrong(folder, command):
    edit(folder, "phones.tsv", "\tbmp\tpua", "\tbmb\tpua")
    code, out, err = command()
    assert code == 3
    assert out.startswith(f"{folder}/xx/phones.tsv:11:15: common phone 'bmb' does not exist")
    assert err.splitlines()[-1] == f"lipdb: {folder}/xx: 1 finding; mend it, or see docs/languages.md"


def test_the_command_prints_json(folder, command):
    edit(folder, "aliases.tsv", "e\tE\t", "e\tÉ\t")
    code, out, _ = command("--json")
    told = json.loads(out)
    assert code == 3
    (error,) = told["errors"]
    assert (error["file"], error["line"], error["column"]) == ("xx/aliases.tsv", 5, 10)
    assert told["coverage"]["phones"] == 12
    assert "w-w" in told["coverage"]["pairs_missing"]


def test_the_command_tidies_first_when_it_is_asked_to(folder, command):
    file = folder / "xx" / "phones.tsv"
    file.write_text(GOOD["phones.tsv"].replace("\n", "\r\n"), newline="")
    code, _, err = command("--tidy")
    assert code == 0
    assert f"{file}: written" in err
