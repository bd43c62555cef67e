"""``python -m lipdb`` is ``lipdb``."""

from lipdb.cli import main

main()
