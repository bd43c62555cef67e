"""The engine: timed phones and bigram curves in, pose weights out. It needs numpy and nothing else.

`animate` plays one line, `animate_lines` many in one call. `stages` keeps what every stage made of a line, `explain`
tells what made the weights of one frame. The stages stand in modules of their own: `gather` (and stitch), `smooth`,
`finish` (constrain, limit speed), `limits` (the filters).
"""

from lipdb.engine.explain import Explanation, Laid, Stages, Story, explain, stages
from lipdb.engine.play import Tracks, animate, animate_lines
from lipdb.engine.table import CurveTable

__all__ = ["CurveTable", "Explanation", "Laid", "Stages", "Story", "Tracks", "animate", "animate_lines", "explain", "stages"]
