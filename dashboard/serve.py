"""Start Streamlit on app.py: what `lipdb dashboard` runs.

Streamlit takes a folder called pages/ for the pages of an app of its old kind, until app.py has run once. Whoever came to a
new server by a link to a page would get that page alone, without what app.py puts around it: navigation, name, sign-in.
"""

import sys

from streamlit.runtime.pages_manager import PagesManager
from streamlit.web.cli import main

if __name__ == "__main__":
    PagesManager.uses_pages_directory = False
    sys.exit(main())
