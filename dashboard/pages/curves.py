"""Curves: the curves of one phone pair, edited with the face, the sound and the engine's result beside them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import streamlit as st
from parts import pairs
from parts.conflict import Choice, ask_again, save_or_ask
from parts.keys import Held, discard, editor, held, rebase, unsaved
from parts.leaving import tell_browser
from parts.lines import played, spoken
from parts.saved import show_saved, tell
from parts.session import database, shown_errors, visitor
from parts.stage import stage

from lipdb.curated.tsv import Records
from lipdb.curves.draft import CHARACTER, COMMON, LANGUAGE, Draft, Place, overriding
from lipdb.curves.rehearse import Rehearsal, occurrences
from lipdb.performance import Performance
from lipdb.schedule import SILENCE

LOOP = "curves_loop"


def ask_layer(place: Place) -> Place:
    """Ask which layer is edited, and say what that will affect."""
    db = database()
    names = {
        COMMON: "All languages",
        LANGUAGE: db.language(place.language)["name"],
        CHARACTER: place.character,
    }
    buttons, reach = st.columns([4, 5], vertical_alignment="center")
    st.session_state["curves_kind"] = place.kind
    kind = buttons.segmented_control(
        "Edit and save for", list(names), required=True, format_func=names.__getitem__, key="curves_kind",
        on_change=pairs.picked, args=("kind",), label_visibility="collapsed",
    )  # fmt: skip
    place = replace(place, kind=kind or place.kind)
    everyone = f"every character of pose set {place.pose_set}"
    whom = {
        COMMON: f"every language, on {everyone}",
        LANGUAGE: f"{names[LANGUAGE]} only, on {everyone}",
        CHARACTER: f"{names[CHARACTER]} only, in every language",
    }
    hidden = overriding(db.records, place)
    own = "which has curves of its own" if len(hidden) == 1 else "which have curves of their own"
    but = f"; not {', '.join(name.partition(':')[2] for name in hidden)}, {own}" if hidden else ""
    reach.caption(f":material/layers: Saved for {whom[place.kind]}{but} (layer `{place.layer}`).")
    return place


def show_loop(place: Place, records: Records, loop: Rehearsal) -> None:
    """The pair alone on the face, over and over."""
    db = database()
    track = loop.play(place.book(records), db.pose_set(place.pose_set))
    who = db.character(place.character)
    stage(
        [Performance(track, who)],
        key=LOOP,
        loop=(0.0, loop.duration),
        autoplay=True,
        compact=True,
        marks=[(loop.start, loop.end)],
    )


def show_sentence(place: Place, records: Records) -> None:
    """A sentence that contains the pair, with the curves as they are now, saved or not."""
    found = pairs.examples(database(), place.language, place.character).containing(place.left, place.right)
    if not found:
        text = st.text_input("No sample sentence has this pair. Write one:", key=f"curves_text_{place.language}")
        if not text.strip():
            return
    else:
        key = f"curves_sentence_{place.pair}_{place.language}"
        number = st.session_state.get(key, 0) % len(found)
        text = found[number]
        said, button = st.columns([5, 1], vertical_alignment="center")
        said.write(f"“{text}”")
        button.button(
            "", key="curves_next", icon=":material/skip_next:", help=f"The next sentence with this pair ({number + 1} of {len(found)})",
            width="stretch", on_click=lambda: st.session_state.update({key: number + 1}),
        )  # fmt: skip
    line = spoken(text, place.language)
    book = place.book(records)
    own = {place.key(pose): book.find(*place.key(pose)).curve for pose in book.poses}
    heard = played(replace(line, curves={place.pose_set: own}), place.character)
    marks = [(max(start, 0.0), end) for start, _, end in occurrences(line.schedule, place.left, place.right)]
    stage([heard], key="curves_sentence", compact=True, marks=marks)


def copy_from(now: Held) -> None:
    """Take over curves of another pair, or of another layer."""
    place, db = now.draft.place, database()
    names = [key[0] for key in db.records["common.tsv"]]
    every = [f"{left}-{right}" for left in names for right in names if (left, right) != (SILENCE, SILENCE)]
    layers, poses = layers_of(place), list(now.draft.lanes)
    pair, layer, chosen = (f"curves_copy_{what}_{place.pose_set}_{place.pair}" for what in ("pair", "layer", "poses"))

    def take_over() -> None:
        left, _, right = st.session_state[pair].partition("-")
        source = layers[st.session_state[layer]].view(db.records)
        now.give({pose: source.find(left, right, pose).curve.keys for pose in st.session_state[chosen]})

    with st.popover("Copy from", icon=":material/content_copy:"):
        st.caption("Take over the curves of another pair, language or character.")
        st.selectbox("Pair", every, index=every.index(place.pair), key=pair)
        st.selectbox("As used by", list(layers), key=layer)
        st.multiselect("Poses", poses, default=poses, key=chosen)
        st.button("Copy", key="curves_copy", type="primary", on_click=take_over)


def layers_of(place: Place) -> dict[str, Place]:
    """The layers that a curve can be copied from, by what they are called."""
    db = database()
    there = [row for row in db.characters() if row["pose_set"] == place.pose_set]
    found = {"all (common)": replace(place, kind=COMMON)}
    found |= {row["name"]: replace(place, language=row["language"], kind=LANGUAGE) for row in db.languages()}
    return found | {row["title"] or row["character"]: replace(place, character=row["character"], kind=CHARACTER) for row in there}


def ask_save(now: Held) -> Callable[[], None] | None:
    """Copying, note and button; what is not saved yet. What saves, if the visitor has just asked for it."""
    if not visitor().editor:
        return None
    place = now.draft.place
    copying, saving = st.columns([3, 8], vertical_alignment="bottom")
    with copying:
        copy_from(now)
    with saving.form("curves_save", border=False):
        note, button, other = st.columns([4, 2, 3], vertical_alignment="bottom")
        text = note.text_input("Note for the history", key="curves_note", placeholder="why", max_chars=300)
        pressed = button.form_submit_button("Save", type="primary", disabled=not now.changed, width="stretch")
        made = ", ".join(now.unfinished)
        told = f"Nobody has drawn {made}. You have looked, and it is right: it becomes authored by you, and the pair leaves the to-do list."
        done = "Every curve that moves is drawn, fitted or accepted."
        accepted = other.form_submit_button("Accept as it is", disabled=not made, help=told if made else done, width="stretch")
    if now.changed:
        left, right = st.columns([3, 1], vertical_alignment="center")
        left.caption(f":material/edit: Not saved yet: {', '.join(now.changed)}.{overtaken(now)}")
        right.button("Discard", key="curves_discard", on_click=partial(discard, place), width="stretch")
    else:
        show_saved(place, key="curves")
    if not pressed and not accepted:
        return None
    what = f"{place.pair}: {', '.join(now.changed)}" if pressed else f"{place.pair}, accepted as it is"
    edits = now.edits() if pressed else now.acceptance()
    after = partial(saved, place, what if pressed else f"{what},")
    return partial(save_or_ask, edits, note=text.strip() or what, seen=now.seen, after=after)


def overtaken(now: Held) -> str:
    """What to say when somebody else has saved the pair since the visitor began."""
    place = now.draft.place
    if now.seen == database().store.revision or Draft.load(database().records, place).curves == now.draft.curves:
        return ""
    return " Somebody else has saved this pair meanwhile; when you save you see both versions, and choose."


def saved(place: Place, what: str, choice: Choice, revision: int | None) -> None:
    """Go on from what is saved now."""
    rebase(place, keep=choice == "edit")
    if choice == "chosen":
        what = f"{place.pair}, row by row as chosen,"
    if choice != "edit":
        done = f"Saved {what} to {place.layer} as revision {revision}." if revision else "Theirs stays; nothing of yours had to be saved."
        tell(place, done, revision)
        st.rerun()


def show_sources(now: Held) -> None:
    """Where each curve comes from."""
    with st.expander("Where these curves come from", key="curves_sources", on_change="rerun") as sources:
        if not sources.open:
            return
        rows = [
            {
                "pose": pose,
                "layer": now.draft.place.layer if lane.own else lane.below.where,
                "origin": curve.origin,
                "author": curve.author,
                "when (UTC)": curve.time[:16].replace("T", " "),
                "source": curve.source,
                "comment": curve.comment,
                "seen instead": lane.hidden,
            }
            for pose, lane in now.draft.lanes.items()
            for curve in [lane.own or lane.below.curve]
        ]
        said = [column for column in rows[0] if any(row[column] for row in rows)]  # else empty columns push others out
        st.dataframe(rows, hide_index=True, column_order=said)


@st.fragment
def work(place: Place) -> None:
    """The part of the page that runs again with every key that is moved."""
    with shown_errors():
        now = held(place, lambda: pairs.usual(place))
        tell_browser()
        records = now.draft.applied(database().records, now.curves)
        loop = Rehearsal.of(place.left, place.right, now.lengths)
        left, right = st.columns([3, 2], gap="medium")
        with left:
            drawn = loop.drawn(place.view(records), database().pose_set(place.pose_set))
            editor(now, drawn, stage=LOOP, span=(loop.start, loop.border, loop.end))
            save = ask_save(now)
            answer = st.container()
            show_sources(now)
        with right:
            show_loop(place, records, loop)
            show_sentence(place, records)
        if save:
            with answer, shown_errors():  # which stops: so it comes when all else is there
                save()


with shown_errors():
    ask_again()
    place = ask_layer(pairs.ask())
    others = [other.pair for other in unsaved() if other != place]
    if others:
        st.caption(f":material/edit: Not saved yet elsewhere: {', '.join(dict.fromkeys(others))}.")
    work(place)
