"""Start Streamlit on app.py: what `lipdb dashboard` runs. Arguments are those of `streamlit`.

Streamlit takes a folder called pages/ for the pages of an app of its old kind, until app.py has run once. Whoever came to a
new server by a link to a page would get that page alone, without what app.py puts around it: navigation, name, sign-in.
"""

import os
import sys
from contextlib import suppress
from importlib import import_module
from threading import Thread
from time import sleep

from streamlit.runtime.pages_manager import PagesManager
from streamlit.web.cli import main

# Blue of Okabe and Ito, as in the charts; red, Streamlit's own, looks like danger on a button that saves.
THEME = {"theme.light.primaryColor": "#0072b2", "theme.dark.primaryColor": "#2a86c4"}
FRONT_PAGE, OTHER_PAGES = ("PIL.Image", "pandas", "pyarrow"), ("altair", "streamlit.dataframe_util")
"""What takes long to import."""
HEAD_START = 4.0
"""Seconds that the first visitor's page gets the processor for itself."""


def prepare() -> None:
    """Do what the first page needs while the browser still opens: import, start the voice, build the face."""
    import lipdb
    from lipdb.errors import LipdbError
    from lipdb.preview import preview

    for name in FRONT_PAGE:
        import_module(name)
    with suppress(LipdbError), lipdb.open(os.environ.get("LIPDB_URL"), phonesets=os.environ.get("LIPDB_PHONESETS")) as db:
        preview([db.animate(db.say("Hello!"))], lambda _content, _media: "")
    sleep(HEAD_START)
    for name in OTHER_PAGES:
        import_module(name)


if __name__ == "__main__":
    PagesManager.uses_pages_directory = False
    Thread(target=prepare, daemon=True).start()
    sys.exit(main([*sys.argv[1:], *(f"--{name}={value}" for name, value in THEME.items())]))
