"""The store: the only place that knows SQL."""

from lipdb.store.conflict import EditConflictError, Versions
from lipdb.store.database import Store
from lipdb.store.edit import Edit
from lipdb.store.history import Change, Revision
from lipdb.store.merge import Merge
from lipdb.store.scans import Scan
from lipdb.store.shipped import Upgrade
from lipdb.store.text import Loaded

__all__ = ["Change", "Edit", "EditConflictError", "Loaded", "Merge", "Revision", "Scan", "Store", "Upgrade", "Versions"]
