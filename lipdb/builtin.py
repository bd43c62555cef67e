"""The voices, readers and exporters that come with lipdb; each imports what it needs when it is called."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from lipdb.plugins import Exporter, Reader, VoiceMaker, hookimpl

if TYPE_CHECKING:
    from lipdb.curated.tsv import Records
    from lipdb.schedule import Schedule
    from lipdb.speech.voice import Voice


@hookimpl
def lipdb_voices() -> Mapping[str, VoiceMaker]:
    """espeak-ng for any language it speaks, pinyin for Mandarin, kana for Japanese, Hangul for Korean, silence for any other."""
    return {"espeak": _espeak, "hangul": _hangul, "kana": _kana, "pinyin": _pinyin, "written": _written}


@hookimpl
def lipdb_readers() -> Mapping[str, Reader]:
    """Praat TextGrid."""
    return {".textgrid": _textgrid}


@hookimpl
def lipdb_exporters() -> Mapping[str, Exporter]:
    """Tracks, meshes, pictures, video and sprite cues."""
    from lipdb.export import EXPORTERS

    return EXPORTERS


def _espeak(records: Records, language: str) -> Voice:
    from lipdb.speech.espeak import espeak_voice

    return espeak_voice(records, language)


def _pinyin(records: Records, language: str) -> Voice:
    from lipdb.speech.mandarin import pinyin_voice

    return pinyin_voice(records, language)


def _hangul(records: Records, language: str) -> Voice:
    from lipdb.speech.korean import hangul_voice

    return hangul_voice(records, language)


def _kana(records: Records, language: str) -> Voice:
    from lipdb.speech.japanese import kana_voice

    return kana_voice(records, language)


def _written(records: Records, language: str) -> Voice:
    from lipdb.speech.written import written_voice

    return written_voice(records, language)


def _textgrid(path: Path, *, tier: str | None = None) -> Schedule:
    from lipdb.speech.textgrid import read_textgrid

    return read_textgrid(path, tier=tier)
