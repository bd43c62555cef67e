"""The engine: timed phones and bigram curves in, pose weights out. It needs numpy and nothing else.

`animate` plays one line, `animate_lines` many in one call. The stages stand in modules of their own: `gather` (and
stitch), `smooth`, `finish` (constrain, limit speed, spline).
"""

from lipdb.engine.play import Tracks, animate, animate_lines
from lipdb.engine.table import CurveTable

__all__ = ["CurveTable", "Tracks", "animate", "animate_lines"]
