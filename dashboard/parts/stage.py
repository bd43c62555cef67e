"""The player: faces, sound and lanes on one clock (dashboard/viewer)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from parts.viewer import component, link

from lipdb.preview import preview

if TYPE_CHECKING:
    from lipdb.performance import Performance


def stage(
    performances: Sequence[Performance],
    *,
    key: str,
    loop: tuple[float, float] | None = None,
    autoplay: bool = False,
    compact: bool = False,
    marks: Sequence[tuple[float, float]] = (),
) -> float | None:
    """Show *performances* of one line; the instant in seconds that the visitor has just clicked on, or None.

    *loop* is played over and over, at once with *autoplay*; *marks* are pointed out; *compact* has no lanes of poses.
    """
    mount = component("stage")
    if mount is None:
        return None
    data = preview(performances, link)
    options = {"loop": loop, "autoplay": autoplay, "compact": compact, "marks": list(marks)}
    data |= {name: value for name, value in options.items() if value} | {"id": f"{data['id']} {options}"}
    answer = mount(data=data, key=key, on_pick_change=lambda: None)
    return answer.get("pick")
