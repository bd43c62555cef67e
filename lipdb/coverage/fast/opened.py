"""What a scan opens before it counts: what was learned of running speech, and the forms of all words that were ever asked for.

Both are kept beside the voice's answers and follow from nothing but these, the sentences and this program: a file that is missing
or damaged is made again.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
from collections.abc import Sequence
from pathlib import Path

from lipdb.coverage.fast.arrays_file import map_arrays, write_arrays
from lipdb.coverage.fast.context import Context
from lipdb.coverage.fast.forms import Forms
from lipdb.coverage.fast.learn import learn
from lipdb.coverage.fast.lexicon import Lexicon
from lipdb.coverage.fast.lexicon_files import answer_files, open_lexicon
from lipdb.errors import OutputError
from lipdb.files import whole_file
from lipdb.speech.voice import Voice

LEARNING = 1
"""Change it with anything that changes what is learned of the same sentences."""
FORMAT = 2
"""Change it with anything that changes the arrays of the same answers."""
_CONTEXT, _FORMS = "context-", "forms-"


def context_of(voice: Voice, sentences: Sequence[str], folder: Path | None) -> Context:
    """What *sentences* teach, from *folder* if it was learned before."""
    file = folder / f"{_CONTEXT}{_digest(LEARNING, *sentences)}.json" if folder else None
    if file is not None:
        with contextlib.suppress(OSError, ValueError, TypeError):
            return Context.from_json(json.loads(file.read_text(encoding="utf-8")))
    context = learn(Lexicon(voice), sentences)
    if file is not None:
        with contextlib.suppress(OSError, OutputError):
            file.parent.mkdir(parents=True, exist_ok=True)
            with whole_file(file) as temporary:
                temporary.write_text(json.dumps(context.to_json(), ensure_ascii=False), encoding="utf-8")
    return context


def keep_forms(voice: Voice, context: Context, folder: Path) -> None:
    """Make the forms of all words whose answers are in *folder*, so that those who open them need not."""
    file = _forms_file(context, folder)
    if not answer_files(folder) or file.exists():
        return
    forms = Forms(open_lexicon(voice, folder), context)
    with contextlib.suppress(OSError, OutputError):
        write_arrays(*forms.arrays(), file)
        for other in folder.glob(f"{_FORMS}*"):
            if other != file:
                other.unlink(missing_ok=True)


def open_forms(voice: Voice, context: Context, folder: Path | None) -> Forms:
    """The forms of all words whose answers are in *folder*."""
    if folder is not None:
        with contextlib.suppress(OSError, ValueError, KeyError):
            return Forms.of(voice, context, *map_arrays(_forms_file(context, folder)))
    return Forms(open_lexicon(voice, folder), context)


def _forms_file(context: Context, folder: Path) -> Path:
    return folder / f"{_FORMS}{_digest(FORMAT, context.digest, *(file.name for file in answer_files(folder)))}.arrow"


def _digest(*told: object) -> str:
    return hashlib.sha256(repr(told).encode()).hexdigest()[:16]
