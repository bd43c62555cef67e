"""Digits in Chinese text, written out in Chinese characters as they are read."""

from __future__ import annotations

import re

DIGITS = "零一二三四五六七八九"
UNITS = ("", "十", "百", "千")
GROUPS = ("", "万", "亿", "万亿", "亿亿")
LONGEST_NUMBER = 20
# In front of these two of something is 两, not 二.
MEASURES = "个只条张本件位名台辆次天年块杯瓶家口间座支把双对种倍届部所"
CURRENCIES = {"¥": "元", "￥": "元", "$": "美元", "€": "欧元", "£": "英镑"}
MEASURED = {
    "km": "公里",
    "kg": "公斤",
    "cm": "厘米",
    "mm": "毫米",
    "m": "米",
    "km²": "平方公里",
    "m²": "平方米",
    "m³": "立方米",
    "g": "克",
    "℃": "摄氏度",
    "°C": "摄氏度",
    "°": "度",
}

_NUMBER = r"\d+(?:,\d{3})+(?:\.\d+)?|\d+(?:\.\d+)?"


def spell_numbers(text: str) -> str:
    """*text* with every number in Chinese characters.

    Years before 年, numbers with a leading zero and numbers of 11 digits and more (telephones) are read digit by digit;
    per cent, fractions, times, dates, ranges, currencies and common units as a person says them.
    """
    for pattern, spell in _RULES:
        text = pattern.sub(spell, text)
    return text


def cardinal(digits: str) -> str:
    """The whole number that *digits* write: ``105`` is 一百零五."""
    digits = digits.lstrip("0")
    if not digits:
        return DIGITS[0]
    if len(digits) > LONGEST_NUMBER:
        return one_by_one(digits)
    groups = [digits[max(0, end - 4) : end] for end in range(len(digits), 0, -4)]
    spoken = ""
    for group, name in reversed(list(zip(groups, GROUPS, strict=False))):
        part = _group(group)
        if part:
            skipped = spoken and (group[0] == "0" or spoken.endswith(DIGITS[0]))
            spoken = spoken.rstrip(DIGITS[0]) + (DIGITS[0] if skipped else "") + part + name
        elif spoken and not spoken.endswith(DIGITS[0]):
            spoken += DIGITS[0]
    spoken = spoken.rstrip(DIGITS[0])
    return spoken.removeprefix("一") if spoken.startswith("一十") else spoken


def one_by_one(digits: str) -> str:
    """Each digit by itself: ``2024`` is 二零二四."""
    return "".join(DIGITS[int(digit)] for digit in digits)


def _group(digits: str) -> str:
    spoken = ""
    for digit, unit in zip(digits, reversed(UNITS[: len(digits)]), strict=True):
        if digit != "0":
            spoken += DIGITS[int(digit)] + unit
        elif spoken and not spoken.endswith(DIGITS[0]):
            spoken += DIGITS[0]
    return spoken.rstrip(DIGITS[0])


def _number(written: str) -> str:
    whole, _, fraction = written.replace(",", "").partition(".")
    telephone = len(whole) >= 11 and "," not in written
    spoken = one_by_one(whole) if telephone or (len(whole) > 1 and whole[0] == "0") else cardinal(whole)
    return spoken + (f"点{one_by_one(fraction)}" if fraction else "")


def _clock(match: re.Match[str]) -> str:
    hour, minute, second = match.groups()
    spoken = f"{cardinal(hour)}点"
    if int(minute) or second:
        spoken += f"{'零' if minute[0] == '0' and int(minute) else ''}{cardinal(minute)}分"
    return spoken + (f"{cardinal(second)}秒" if second else "")


def _date(match: re.Match[str]) -> str:
    return f"{one_by_one(match[1])}年{cardinal(match[2])}月{cardinal(match[3])}日"


_RULES = tuple(
    (re.compile(pattern, re.ASCII), spell)
    for pattern, spell in (
        (r"(?<!\d)(\d{4})[-/.](\d{1,2})[-/.](\d{1,2})(?!\d)", _date),
        (r"(?<!\d)(\d{1,2}):(\d{2})(?::(\d{2}))?(?!\d)", _clock),
        (r"(?<![\d.])(?!1000)([12]\d{3})(?=年)(?!年前|年后|年间|年来)", lambda m: one_by_one(m[1])),
        (rf"({_NUMBER})%", lambda m: f"百分之{_number(m[1])}"),
        (r"(?<![\d/])(\d{1,4})/(\d{1,4})(?![\d/])", lambda m: f"{cardinal(m[2])}分之{cardinal(m[1])}"),
        (rf"([¥￥$€£])\s?({_NUMBER})([万亿]?)", lambda m: _number(m[2]) + m[3] + CURRENCIES[m[1]]),
        (rf"({_NUMBER})\s?([-~–—～])\s?(?={_NUMBER})", lambda m: f"{_number(m[1])}到"),
        (rf"({_NUMBER})\s?(km²|km|kg|cm|mm|m²|m³|m|g|℃|°C|°)(?![A-Za-z])", lambda m: _number(m[1]) + MEASURED[m[2]]),
        (rf"(?<![\d.])2(?=[{MEASURES}])", lambda _: "两"),
        (rf"(?<![\dA-Za-z一-鿿])[-−]({_NUMBER})", lambda m: f"负{_number(m[1])}"),
        (_NUMBER, lambda m: _number(m[0])),
    )
)
