"""Digits in Chinese text are read as Chinese numbers."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lipdb.speech.chinese_numbers import cardinal, spell_numbers

VALUES = {c: i for i, c in enumerate("零一二三四五六七八九")} | {"十": 10, "百": 100, "千": 1000}


def _value(spoken: str) -> int:
    """What a Chinese number below 10**16 means, worked out the other way round: by its characters."""
    total = part = digit = 0
    for c in spoken:
        if c in "万亿":
            part += digit
            total = (total + part) * 10**8 if c == "亿" else total + part * 10**4
            part = digit = 0
        elif VALUES[c] >= 10:
            part += (digit or 1) * VALUES[c]
            digit = 0
        else:
            digit = VALUES[c]
    return total + part + digit


@pytest.mark.parametrize(
    ("digits", "spoken"),
    [
        ("0", "零"),
        ("10", "十"),
        ("12", "十二"),
        ("20", "二十"),
        ("105", "一百零五"),
        ("110", "一百一十"),
        ("1001", "一千零一"),
        ("10000", "一万"),
        ("10010", "一万零一十"),
        ("100000", "十万"),
        ("1000000", "一百万"),
        ("100000000", "一亿"),
        ("100000001", "一亿零一"),
    ],
)
def test_whole_numbers(digits: str, spoken: str):
    assert cardinal(digits) == spoken


@given(st.integers(0, 10**12 - 1))
def test_a_spoken_number_means_the_number(number: int):
    assert _value(cardinal(str(number))) == number


@given(st.integers(0, 10**12 - 1))
def test_zero_is_never_said_twice_in_a_row_or_at_the_end(number: int):
    spoken = cardinal(str(number))
    assert "零零" not in spoken
    assert spoken == "零" or not spoken.endswith("零")


@pytest.mark.parametrize(
    ("text", "spoken"),
    [
        ("2024年", "二零二四年"),
        ("1998年到2003年", "一九九八年到二零零三年"),
        ("20年", "二十年"),
        ("2年", "两年"),
        ("2月", "二月"),
        ("3.5", "三点五"),
        ("50%", "百分之五十"),
        ("1/2", "二分之一"),
        ("9:05", "九点零五分"),
        ("8:00", "八点"),
        ("2024-01-15", "二零二四年一月十五日"),
        ("2个人，12个人", "两个人，十二个人"),
        ("3-5天", "三到五天"),
        ("$3.5", "三点五美元"),
        ("¥100", "一百元"),
        ("25℃", "二十五摄氏度"),
        ("100km", "一百公里"),
        ("-5度", "负五度"),
        ("007", "零零七"),
        ("13812345678", "一三八一二三四五六七八"),
        ("1,234,567.89", "一百二十三万四千五百六十七点八九"),
        ("没有数字", "没有数字"),
    ],
)
def test_numbers_in_text(text: str, spoken: str):
    assert spell_numbers(text) == spoken


@given(st.text(st.sampled_from("0123456789.,:/-%$年个 km℃"), max_size=30))
def test_no_digit_is_left(text: str):
    assert not any(c.isascii() and c.isdecimal() for c in spell_numbers(text))
