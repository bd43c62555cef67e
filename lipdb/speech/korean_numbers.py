"""Digits in Korean text, written out in Hangul as they are read.

Koreans count with two sets of numerals: native ones in front of most counters (세 명, 열두 시), Sino-Korean ones else.
"""

from __future__ import annotations

import re

DIGITS = "영일이삼사오육칠팔구"
_UNITS = ("", "십", "백", "천")
_GROUPS = ("", "만", "억", "조", "경")
_TELEPHONE = DIGITS.replace("영", "공")
_ONES = ("", "한", "두", "세", "네", "다섯", "여섯", "일곱", "여덟", "아홉")
_TENS = ("", "열", "스물", "서른", "마흔", "쉰", "예순", "일흔", "여든", "아흔")
LONGEST_NUMBER = 20
# Counters of the native numerals; in front of 살 (years of age) they go to 99, in front of 시 (o'clock) to 12, else to 20.
_COUNTERS = (
    "시간|가지|마리|그루|송이|켤레|군데|사람|개월(?!)|살|시(?!속|가)|개(?!월)|명|번|병|잔|권|장|대|벌|채|그릇|곳|달(?!러)|통|척|쌍|줄"
)
_HIGHEST = {"살": 99, "시": 12}
_MONTHS = {"6": "유", "10": "시"}
_CURRENCIES = {"₩": "원", "￦": "원", "$": "달러", "€": "유로", "¥": "엔", "£": "파운드"}
_MEASURES = {
    "%": "퍼센트", "℃": "도", "°C": "도", "°": "도", "km": "킬로미터", "kg": "킬로그램", "cm": "센티미터", "mm": "밀리미터",
    "m": "미터", "g": "그램", "GB": "기가바이트", "MB": "메가바이트",
}  # fmt: skip
_NUMBER = r"\d+(?:,\d{3})+(?:\.\d+)?|\d+(?:\.\d+)?"


def spell_numbers(text: str) -> str:
    """*text* with every number in Hangul, in as many words between spaces as before.

    Numbers with a leading zero, telephones and what follows a point are read digit by digit; dates, times of day,
    fractions, ranges, per cent, currencies and common units as a person says them.
    """
    for pattern, spell in _RULES:
        text = pattern.sub(spell, text)
    return text


def sino(digits: str) -> str:
    """The whole number that *digits* write, in Sino-Korean: ``1234`` is 천이백삼십사."""
    digits = digits.lstrip("0")
    if not digits:
        return DIGITS[0]
    if len(digits) > LONGEST_NUMBER:
        return _one_by_one(digits)
    groups = [digits[max(0, end - 4) : end] for end in range(len(digits), 0, -4)]
    spoken = [_group(group) + name for group, name in zip(groups, _GROUPS, strict=False) if int(group)]
    return re.sub("^일만", "만", "".join(reversed(spoken)))


def native(number: int) -> str:
    """*number*, 1 to 99, in native numerals as they stand in front of a counter: 3 is 세, 20 is 스무."""
    return "스무" if number == 20 else _TENS[number // 10] + _ONES[number % 10]


def _group(digits: str) -> str:
    spoken = ""
    for digit, unit in zip(digits, reversed(_UNITS[: len(digits)]), strict=True):
        if digit != "0":
            spoken += ("" if digit == "1" and unit else DIGITS[int(digit)]) + unit
    return spoken


def _one_by_one(digits: str, names: str = DIGITS) -> str:
    return "".join(names[int(digit)] for digit in digits)


def _number(written: str) -> str:
    whole, _, fraction = written.replace(",", "").partition(".")
    spoken = _one_by_one(whole, _TELEPHONE) if len(whole) > 1 and whole[0] == "0" else sino(whole)
    return spoken + (f"점{_one_by_one(fraction)}" if fraction else "")


def _counted(match: re.Match[str]) -> str:
    number, gap, counter = int(match[1]), match[2], match[3]
    highest = _HIGHEST.get(counter, 20)
    return f"{native(number) if 0 < number <= highest else sino(match[1])}{gap}{counter}"


def _telephone(match: re.Match[str]) -> str:
    return "".join(_one_by_one(part, _TELEPHONE) for part in match[0].split("-"))


def _date(match: re.Match[str]) -> str:
    return f"{sino(match[1])}년{_month(match[2])}월{sino(match[3])}일"


def _month(digits: str) -> str:
    return _MONTHS.get(digits.lstrip("0"), sino(digits))


def _clock(match: re.Match[str]) -> str:
    hour, minute = int(match[1]), int(match[2])
    return f"{native(hour) if 0 < hour <= _HIGHEST['시'] else sino(match[1])}시" + (f"{sino(str(minute))}분" if minute else "")


_RULES = tuple(
    (re.compile(pattern, re.ASCII), spell)
    for pattern, spell in (
        (r"(?<![\d-])0\d{1,2}-\d{3,4}-\d{4}(?![\d-])", _telephone),
        (r"(?<!\d)(\d{4})[-/.](\d{1,2})[-/.](\d{1,2})(?!\d)", _date),
        (r"(?<![\d:])(\d{1,2}):([0-5]\d)(?![\d:])", _clock),
        (r"(?<![\d/])(\d{1,3})/(\d{1,3})(?![\d/])", lambda m: f"{sino(m[2])}분의{sino(m[1])}"),
        (rf"(?<![\w.])[-−](?={_NUMBER})", lambda _: "마이너스"),
        (rf"({_NUMBER})[~∼～–-](?={_NUMBER})", lambda m: f"{_number(m[1])}에서"),
        (r"(?<![\d.])(1[0-2]|0?[1-9])(?=월)", lambda m: _month(m[1])),
        (rf"({_NUMBER})(?=\s?대\s?\d)", lambda m: _number(m[1])),  # a score, no counted cars
        (rf"(?<![\d.,])([1-9]\d?)(\s?)({_COUNTERS})", _counted),
        (rf"([₩￦$€¥£])({_NUMBER})([만억]?)", lambda m: _number(m[2]) + m[3] + _CURRENCIES[m[1]]),
        (rf"({_NUMBER})(%|℃|°C|°|km|kg|cm|mm|m|g|GB|MB)(?![A-Za-z])", lambda m: _number(m[1]) + _MEASURES[m[2]]),
        (_NUMBER, lambda m: _number(m[0])),
    )
)  # fmt: skip
