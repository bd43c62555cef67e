"""Start Streamlit on app.py: what `lipdb dashboard` runs. Arguments are those of `streamlit`.

Streamlit takes a folder called pages/ for the pages of an app of its old kind, until app.py has run once. Whoever came to a
new server by a link to a page would get that page alone, without what app.py puts around it: navigation, name, sign-in.
"""

import gc
import os
import signal
import sys
from contextlib import suppress
from importlib import import_module
from logging import ERROR, getLogger
from pkgutil import iter_modules
from threading import Thread
from time import sleep

from parts.looks import BLUE, INK
from streamlit.runtime.pages_manager import PagesManager
from streamlit.web.cli import main

OPTIONS = {
    f"theme.{theme}.{name}": colours[theme]
    for name, colours in (("primaryColor", BLUE), ("textColor", INK), ("codeTextColor", INK))
    for theme in colours
} | {"runner.magicEnabled": "false"}  # pages say what they show; to look for what they leave unsaid costs their first visit
SLOW_TO_IMPORT = ("PIL.Image", "pandas", "pyarrow"), ("altair", "streamlit.dataframe_util")
"""What the front page waits for, and what the others wait for."""
FIRST_FACE = 5
"""Seconds in which the first visitor's page has the processor for itself, before the rest is made ready."""
LOOK, PATIENCE = 0.5, 3
"""Seconds between two looks at who started the server, and that it gets to end by itself when they are gone."""
UNUSED = "rfc3987_syntax"
"""Where it is installed, jsonschema loads it for addresses that no chart has; its grammar takes two seconds to read."""


def prepare() -> None:
    """Do what the first page needs while the browser still opens: import, say the example, build the face."""
    front, others = SLOW_TO_IMPORT
    for name in front:
        import_module(name)
    from parts.lines import EXAMPLES
    from parts.session import shared

    from lipdb.database import DEFAULT_LANGUAGE
    from lipdb.errors import LipdbError
    from lipdb.preview import preview

    with suppress(LipdbError):  # the pages say what is wrong
        db = shared()
        preview([db.animate(db.say(EXAMPLES[DEFAULT_LANGUAGE]))], lambda _content, _media: "")
    for name in others:
        import_module(name)
    keep_for_good()
    sleep(FIRST_FACE)
    prepare_others()
    keep_for_good()


def keep_for_good() -> None:
    """Take what is ready out of the search for garbage, which Streamlit begins after every run: a quarter of a second went to it."""
    gc.collect()
    gc.freeze()


def prepare_others() -> None:
    """Do what the first visit of each other page would wait for: import what it is made of, read the sentences and the shipped rows."""
    import parts

    # It would warn that there is no page on which to show that this takes a moment.
    getLogger("streamlit.runtime.scriptrunner_utils.script_run_context").setLevel(ERROR)
    for module in iter_modules(parts.__path__):
        import_module(f"parts.{module.name}")
    from parts.corpora import sentences
    from parts.lines import changes_of
    from parts.pairs import Choice, every_pair, examples, heard
    from parts.session import shared

    from lipdb.database import DEFAULT_CHARACTER, DEFAULT_LANGUAGE
    from lipdb.errors import LipdbError

    with suppress(LipdbError):
        examples(shared(), DEFAULT_LANGUAGE, DEFAULT_CHARACTER)
        sentences(shared(), DEFAULT_LANGUAGE)
        every_pair(DEFAULT_LANGUAGE, DEFAULT_CHARACTER, shared().store.revision)
        changes_of(shared(), 1)
        first = Choice()
        heard(first.left, first.right, language=first.language, character=first.character)


def end_with_starter() -> None:
    """End when the process that has started this one is gone without having ended it: it was killed.

    Windows goes on naming it as the parent; there the server stays.
    """
    starter = os.getppid()
    while os.getppid() == starter:
        sleep(LOOK)
    os.kill(os.getpid(), signal.SIGTERM)
    sleep(PATIENCE)  # it waits for open pages to go away
    os._exit(1)


if __name__ == "__main__":
    Thread(target=end_with_starter, daemon=True).start()
    PagesManager.uses_pages_directory = False
    sys.modules.setdefault(UNUSED, None)  # type: ignore[arg-type]
    Thread(target=prepare, daemon=True).start()
    sys.exit(main([*sys.argv[1:], *(f"--{name}={value}" for name, value in OPTIONS.items())]))
