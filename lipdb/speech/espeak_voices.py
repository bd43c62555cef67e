"""Choose a voice of libespeak-ng by the codes that people write.

A voice has a name, a file and language codes. The library finds it by name and file; phonemizer, which says phones without
sound, by its first language code. They differ for some: French is ``fr-fr`` in a file ``fr``.
"""

from __future__ import annotations

import ctypes

TIMBRES = ("f2", "f3", "f5", "m3", "m7", "Andy", "grandma", "whisper")
"""Some of espeak-ng's variants of every voice, those that sound least alike."""


class _Voice(ctypes.Structure):
    """The head of espeak_VOICE of espeak-ng's speak_lib.h. *languages* begins with a byte of priority."""

    _fields_ = (("name", ctypes.c_char_p), ("languages", ctypes.c_char_p), ("identifier", ctypes.c_char_p))


def set_voice(library: ctypes.CDLL, voice: str) -> bool:
    """Make *library* speak with *voice*: a name, a file, or a first language code. Whether there is such a voice."""
    code, plus, timbre = voice.encode().partition(b"+")
    return library.espeak_SetVoiceByName(voice.encode()) == 0 or any(
        library.espeak_SetVoiceByName(identifier + plus + timbre) == 0 for identifier in _speaking(library, code)
    )


def _speaking(library: ctypes.CDLL, code: bytes) -> list[bytes]:
    """The files of the voices whose first language is *code*."""
    library.espeak_ListVoices.restype = ctypes.POINTER(ctypes.POINTER(_Voice))
    voices = library.espeak_ListVoices(None)
    found, index = [], 0
    while voices[index]:
        voice = voices[index].contents
        if voice.languages[1:] == code:
            found.append(voice.identifier)
        index += 1
    return found
