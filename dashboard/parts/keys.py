"""The curve editor, and the unsaved edits of one visitor: they outlive page changes and never meet another visitor's."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from secrets import token_hex
from typing import Any

import streamlit as st
from parts.leaving import lost_by_leaving
from parts.session import Edited, database, visitor
from parts.viewer import component

from lipdb.curves.draft import Curves, Draft, Place
from lipdb.curves.keys import Keys
from lipdb.schedule import SILENCE

HELD = "curves_held"
MOST_HELD = 50
COMPONENT = "curves_keys"


@dataclass
class Held:
    """One pair in one visitor's hands: as it stood at revision *seen*, and the *curves* that they would like instead.

    The phones last *lengths* seconds where it is drawn and played. A new *token* makes the browser forget its own state
    and take this one; *given* are curves that it takes over as a step.
    """

    draft: Draft
    seen: int
    curves: Curves
    lengths: tuple[float, float]
    token: str = field(default_factory=token_hex)
    given: dict[str, Any] | None = None

    @property
    def changed(self) -> list[str]:
        """The poses with unsaved changes."""
        return self.draft.changed(self.curves)

    def edits(self) -> list[Edited]:
        """What saving does."""
        return [Edited(self.draft.place.table, key, row) for key, row in self.draft.rows(self.curves).items()]

    @property
    def unfinished(self) -> list[str]:
        """The poses that move as a program made them."""
        return self.draft.unfinished(self.curves)

    def acceptance(self) -> list[Edited]:
        """What saving does when the visitor accepts the pair as it is."""
        table = self.draft.place.table
        return [Edited(table, key, row, accepted=True) for key, row in self.draft.accepted(self.curves).items()]

    def give(self, curves: Curves) -> None:
        """Take over *curves* of some poses, as a step that the visitor can undo."""
        self.curves = {**self.curves, **curves}
        self.given = {"token": token_hex(), "curves": _plain(curves)}


def held(place: Place, lengths: Callable[[], tuple[float, float]]) -> Held:
    """The visitor's edits of *place*, begun when there are none, brought up to date when nothing is unsaved.

    The phones begin with *lengths*.
    """
    mine: dict[Place, Held] = st.session_state.setdefault(HELD, {})
    if place in mine:
        now = mine[place]
        _receive(now)
        if not now.changed and now.seen != database().store.revision:
            rebase(place, keep=False)
        return mine[place]
    mine[place] = _begun(place, lengths())
    clean = [other for other, one in mine.items() if other != place and not one.changed]
    for old in clean[: max(len(mine) - MOST_HELD, 0)]:
        del mine[old]
    return mine[place]


def _begun(place: Place, lengths: tuple[float, float]) -> Held:
    seen = database().store.revision  # before the records are read: what is saved in between is seen as a conflict
    draft = Draft.load(database().records, place)
    return Held(draft, seen, draft.curves, lengths)


def rebase(place: Place, *, keep: bool) -> None:
    """Go on from what is saved now, with the visitor's changes on top of it if they are to *keep* them."""
    mine: dict[Place, Held] = st.session_state[HELD]
    before, now = mine[place], _begun(place, mine[place].lengths)
    if keep:
        now.curves = before.curves
    if now.curves == before.curves:  # then what was done in the browser can still be undone there
        now.token, now.given = before.token, before.given
    mine[place] = now


def discard(place: Place) -> None:
    """Forget the visitor's changes of *place*."""
    st.session_state.get(HELD, {}).pop(place, None)


def unsaved() -> list[Place]:
    """Where the visitor has changes that are not saved."""
    return [place for place, one in st.session_state.get(HELD, {}).items() if one.changed]


@lost_by_leaving
def unsaved_pairs() -> list[str]:
    """The pairs of those places, for people."""
    return list(dict.fromkeys(f"curves of {place.pair}" for place in unsaved()))


def _receive(now: Held) -> None:
    """Take over what the browser has sent for this draft, unless it had not yet taken over what it was given."""
    state = st.session_state.get(COMPONENT) or {}
    sent, lengths = state.get("curves") or {}, state.get("lengths") or {}
    if sent.get("id") == now.token and (now.given is None or sent.get("taken") == now.given["token"]):
        now.curves = now.draft.read(sent["curves"])
    if lengths.get("id") == now.token:
        first, second = (float(length) for length in lengths["lengths"])
        now.lengths = first, second


def editor(now: Held, drawn: Mapping[str, Keys], *, stage: str, span: tuple[float, float, float]) -> None:
    """Show *now* to be edited, with what the engine has *drawn* of it.

    The player *stage* plays the pair from the first to the last of *span* seconds, with the border in the middle.
    """
    mount = component("keys")
    if mount is None:
        return
    place = now.draft.place
    lanes = [
        {
            "pose": pose,
            "keys": _plain(now.curves)[pose],
            "below": lane.below.curve.keys,
            "from": lane.below.layer,
            "note": f"{lane.hidden} has a curve of its own here, which wins" if lane.hidden else "",
            "drawn": drawn[pose],
        }
        for pose, lane in now.draft.lanes.items()
    ]
    data = {
        "id": now.token,
        "pair": {"left": place.left, "right": place.right, "lengths": now.lengths, "playing": {"stage": stage, "span": span}},
        "lanes": lanes,
        "locked": not visitor().editor,
        "silent": [place.left == SILENCE, place.right == SILENCE],
        "given": now.given,
    }
    mount(data=data, key=COMPONENT, on_curves_change=lambda: None, on_lengths_change=lambda: None)


def _plain(curves: Curves) -> dict[str, list[list[float]] | None]:
    return {pose: None if keys is None else [list(key) for key in keys] for pose, keys in curves.items()}
