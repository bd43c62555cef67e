"""Hangul as it is written to Hangul as it is said, and numbers in Korean text."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lipdb.speech.hangul import pronounced, spoken_syllables
from lipdb.speech.korean_numbers import native, sino, spell_numbers

# Words of the regulations on standard pronunciation, by article, and everyday ones.
SAID = {
    "neutral codas": """
    닦다 닥따, 키읔 키윽, 옷 옫, 웃다 욷따, 있다 읻따, 젖 젇, 빚다 빋따,
    꽃 꼳, 솥 솓, 앞 압, 덮다 덥따
    """,
    "two consonants": """
    넋 넉, 앉다 안따, 여덟 여덜, 넓다 널따, 외곬 외골, 핥다 할따, 값 갑,
    없다 업따, 닭 닥, 맑다 막따, 삶 삼, 밟다 밥따, 맑게 말께,
    넓죽하다 넙쭈카다
    """,
    "h": """
    놓고 노코, 좋던 조턴, 쌓지 싸치, 많고 만코, 닳지 달치, 각하 가카,
    먹히다 머키다, 좁히다 조피다, 꽂히다 꼬치다, 앉히다 안치다, 닿소 다쏘,
    싫소 실쏘, 놓는 논는, 않네 안네, 뚫네 뚤레, 낳은 나은, 많아 마나,
    싫어도 시러도, 못해 모태, 좋아요 조아요
    """,
    "linking": """
    깎아 까까, 옷이 오시, 있어 이써, 낮이 나지, 꽃을 꼬츨, 밭에 바테,
    앞으로 아프로, 넋이 넉씨, 앉아 안자, 닭을 달글, 젊어 절머, 값을 갑쓸,
    없어 업써, 강아지 강아지
    """,
    "palatal": """
    굳이 구지, 같이 가치, 밭이 바치, 벼훑이 벼훌치, 굳히다 구치다, 묻히다 무치다,
    붙여 부처, 맏형 마텽, 끝을 끄틀
    """,
    "nasal": """
    먹는 멍는, 국물 궁물, 깎는 깡는, 닫는 단는, 있는 인는, 밥물 밤물,
    없는 엄는, 흙만 흥만, 담력 담녁, 강릉 강능, 협력 혐녁, 독립 동닙,
    백리 뱅니, 합니다 함니다
    """,
    "lateral": """
    난로 날로, 신라 실라, 칼날 칼랄, 물난리 물랄리, 닳는 달른, 뚫는 뚤른,
    관련 괄련
    """,
    "tense": """
    국밥 국빱, 닭장 닥짱, 옷고름 옫꼬름, 꽃다발 꼳따발, 값지다 갑찌다, 얹다 언따,
    닮고 담꼬, 훑소 훌쏘, 떫지 떨찌, 학교 학꾜
    """,
    "vowels": """
    가져 가저, 다쳐 다처, 무늬 무니, 희망 히망, 의사 의사, 국민의 궁미늬,
    예의 예의, 시계 시계
    """,
}


@pytest.mark.parametrize("pairs", SAID.values(), ids=SAID.keys())
def test_words_are_said_as_the_regulations_have_it(pairs: str) -> None:
    wanted = dict(pair.split() for pair in pairs.split(","))
    assert {word: pronounced(word) for word in wanted} == wanted


def test_rules_stop_at_spaces_and_leave_all_else_alone() -> None:
    assert pronounced("못 해요? OK 12") == "몯 해요? OK 12"


@given(st.text(st.characters(min_codepoint=0xAC00, max_codepoint=0xD7A3), min_size=1, max_size=6))
def test_every_word_keeps_its_syllables_and_has_codas_that_can_be_said(word: str) -> None:
    said = spoken_syllables(word)
    assert len(said) == len(word)
    assert {syllable.coda for syllable in said} <= {"", "ㄱ", "ㄴ", "ㄷ", "ㄹ", "ㅁ", "ㅂ", "ㅇ"}


@pytest.mark.parametrize(
    ("digits", "said"),
    [
        ("0", "영"),
        ("10", "십"),
        ("16", "십육"),
        ("100", "백"),
        ("1234", "천이백삼십사"),
        ("10000", "만"),
        ("120000", "십이만"),
        ("100000000", "일억"),
    ],
)
def test_sino_korean_numerals(digits: str, said: str) -> None:
    assert sino(digits) == said


def test_native_numerals_stand_in_front_of_a_counter() -> None:
    assert [native(number) for number in (1, 3, 11, 20, 21, 99)] == ["한", "세", "열한", "스무", "스물한", "아흔아홉"]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("3명", "세명"),
        ("20살", "스무살"),
        ("35명", "삼십오명"),
        ("2시 30분", "두시 삼십분"),
        ("15시", "십오시"),
        ("10:30에", "열시삼십분에"),
        ("2024년 6월 10일", "이천이십사년 유월 십일"),
        ("10월", "시월"),
        ("2024-12-25", "이천이십사년십이월이십오일"),
        ("1,234원", "천이백삼십사원"),
        ("₩5만", "오만원"),
        ("3.14", "삼점일사"),
        ("50%", "오십퍼센트"),
        ("-5℃", "마이너스오도"),
        ("1/2", "이분의일"),
        ("3~5명", "삼에서다섯명"),
        ("3대 2", "삼대 이"),
        ("010-1234-5678", "공일공일이삼사오육칠팔"),
        ("6개월", "육개월"),
    ],
)
def test_numbers_are_read_as_koreans_say_them(text: str, said: str) -> None:
    assert spell_numbers(text) == said


@given(st.from_regex(r"[0-9,.:/~ 개명시월%₩$-]{0,12}", fullmatch=True))
def test_numbers_never_change_the_number_of_words(text: str) -> None:
    assert len(spell_numbers(text).split()) == len(text.split())
