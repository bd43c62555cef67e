"""What processes that count have from the start: their server imports this module, and they are forked from it.

What is left out here each of them makes for itself when it comes to it, while everybody waits.
"""

from __future__ import annotations

import gc
from contextlib import suppress
from importlib import import_module

from lipdb.coverage import exact, scan  # noqa: F401
from lipdb.coverage.fast import counter  # noqa: F401
from lipdb.coverage.fast.words import kind_of_codes
from lipdb.coverage.plain_arrow import without_pandas
from lipdb.coverage.speaker import named_signs
from lipdb.errors import LipdbError
from lipdb.speech import espeak, libespeak, phonemes  # noqa: F401

gc.disable()  # Nothing of what comes now, and is imported after it, is garbage; those that are forked enable it.
without_pandas()
for module in ("pyarrow.acero", "numpy.ma", "encodings.utf_16_le", "email.parser"):  # imported only when something of them is used
    import_module(module)
kind_of_codes()
named_signs()
with suppress(LipdbError, ImportError, OSError, RuntimeError):  # Whoever needs the library says what is wrong with it.
    libespeak.espeak_version()
    phonemes.load()
