"""Start Streamlit on app.py: what `lipdb dashboard` runs. Arguments are those of `streamlit`.

Streamlit takes a folder called pages/ for the pages of an app of its old kind, until app.py has run once. Whoever came to a
new server by a link to a page would get that page alone, without what app.py puts around it: navigation, name, sign-in.
"""

import os
import sys
from contextlib import suppress
from importlib import import_module
from threading import Thread

from streamlit.runtime.pages_manager import PagesManager
from streamlit.web.cli import main

SLOW_TO_IMPORT = ("pandas", "altair", "pyarrow", "streamlit.dataframe_util")


def prepare() -> None:
    """Do what the first page needs while the browser still opens: import, start the voice, build the face."""
    import lipdb
    from lipdb.errors import LipdbError
    from lipdb.preview import preview

    with suppress(LipdbError), lipdb.open(os.environ.get("LIPDB_URL"), phonesets=os.environ.get("LIPDB_PHONESETS")) as db:
        preview([db.animate(db.say("Hello!"))], lambda _content, _media: "")
    for name in SLOW_TO_IMPORT:
        import_module(name)


if __name__ == "__main__":
    PagesManager.uses_pages_directory = False
    Thread(target=prepare, daemon=True).start()
    sys.exit(main())
