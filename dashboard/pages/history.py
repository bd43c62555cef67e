"""History: who changed what, when and why; what it did to curves, drawn as curves; and a way to take it back."""

from __future__ import annotations

import streamlit as st
from parts.compare import draw_versions
from parts.lines import changes_of, state
from parts.pairs import open_pair
from parts.session import as_typed, database, shown_errors, undo, visitor

from lipdb.curves.changed import ChangedPair, changed_pairs
from lipdb.errors import InputError, LipdbError
from lipdb.store.history import Change, Revision
from lipdb.store.search import Wanted, changes_named
from lipdb.words import counted

ANY = "any"
MOST, MOST_ROWS, MOST_PAIRS = 200, 1000, 500
TOLD = "history_told"


def pair_of(text: str) -> tuple[str, str] | None:
    """The pair that *text* names, as in ``l-ow``; None for none. Raises `InputError`."""
    if not text.strip():
        return None
    parts = text.split("-") if "-" in text else text.split()
    if len(parts) != 2 or not all(part.strip() for part in parts):
        raise InputError(f"a pair is two common phones, as in l-ow; {text!r} is not")
    return parts[0].strip(), parts[1].strip()


def asked() -> Wanted:
    """What the visitor looks for."""
    db = database()
    languages = {row["language"]: row["name"] for row in db.languages()}
    characters = {row["character"]: row["title"] or row["character"] for row in db.characters()}
    given = st.query_params
    columns = st.columns([2, 2, 2, 2, 2, 3])

    def select(column: int, label: str, options: list[str], key: str, titles: dict[str, str] | None = None) -> str:
        start = given.get(key, "")
        index = options.index(start) + 1 if start in options else 0
        chosen = columns[column].selectbox(
            label,
            [ANY, *options],
            index=index,
            key=f"history_{key}",
            persist_state="session",
            format_func=lambda name: (titles or {}).get(name, name),
        )
        return "" if chosen == ANY else chosen

    kind = select(0, "Table", db.store.kinds(), "table")
    author = select(1, "Person", db.store.authors(), "person")
    language = select(2, "Language", sorted(languages), "language", languages)
    character = select(3, "Character", sorted(characters), "character", characters)
    pair = columns[4].text_input("Pair", given.get("pair", ""), key="history_pair", persist_state="session", placeholder="l-ow")
    words = columns[5].text_input("Words in the note", key="history_words", persist_state="session")
    return Wanted(author, words.strip(), kind, language, character, pair_of(pair))


def choose(revisions: list[Revision]) -> Revision:
    """The table of *revisions*, and the one that the visitor chose: at first the newest."""
    rows = [
        {
            "revision": one.number,
            "when (UTC)": one.time.replace("T", " ").rstrip("Z"),
            "who": one.author,
            "rows": one.rows,
            "why": one.note,
        }
        for one in revisions
    ]
    numbers = [one.number for one in revisions]
    given = st.query_params.get("revision", "")
    first = numbers.index(int(given)) if given.isdecimal() and int(given) in numbers else 0
    picked = st.dataframe(
        rows,
        hide_index=True,
        height=min(38 + 35 * len(rows), 320),
        # What is pinned keeps its width: the room that is left is for the note.
        column_config={
            "revision": st.column_config.NumberColumn(width=70, pinned=True),
            "when (UTC)": st.column_config.TextColumn(width=150, pinned=True),
            "who": st.column_config.TextColumn(width=120, pinned=True),
            "rows": st.column_config.NumberColumn(width=60, pinned=True, format="localized"),
            "why": st.column_config.TextColumn(width=360),
        },
        on_select="rerun",
        selection_mode="single-row",
        selection_default={"selection": {"rows": [first]}},
        key=f"history_table_{numbers[0]}_{numbers[-1]}_{len(numbers)}",
    )
    return revisions[picked.selection.rows[0] if picked.selection.rows else first]


def take_back(one: Revision) -> None:
    """The button that undoes a revision, for those who may; what came of it."""
    if told := st.session_state.pop(TOLD, ""):
        st.success(told, icon=":material/undo:")
    if not visitor().editor or one.number == 1:
        return
    why, button = st.columns([4, 1], vertical_alignment="bottom")
    note = why.text_input("Why take it back?", key=f"history_why_{one.number}", placeholder=f"Undo revision {one.number}")
    if not button.button("Undo", icon=":material/undo:", key=f"history_undo_{one.number}", width="stretch"):
        return
    try:
        made = undo(one.number, note=note.strip())
    except LipdbError as error:
        st.error(str(error), icon=":material/error:")
        return
    nothing = f"Nothing of revision {one.number} is left to undo."
    st.session_state[TOLD] = f"Revision {made} takes revision {one.number} back. It can be undone too." if made else nothing
    st.rerun()


def show_curves(one: Revision, pairs: list[ChangedPair]) -> None:
    """A changed pair as curves before and after, and the way to its editor."""
    if len(pairs) > MOST_PAIRS:
        st.caption(f"The first {MOST_PAIRS:,} of {len(pairs):,} pairs; name a pair above to see another one.")
    names = [f"{pair.pair}, {pair.layer}, {pair.pose_set}" for pair in pairs[:MOST_PAIRS]]
    left, right = st.columns([2, 3], vertical_alignment="bottom")
    chosen = left.selectbox("Pair", range(len(names)), format_func=names.__getitem__, key=f"history_pair_of_{one.number}")
    pair = pairs[chosen]
    if right.button(f"Open {pair.pair} in Curves", icon=":material/timeline:", key=f"history_open_{one.number}"):
        open_in_curves(pair)
    if pair.inherits:
        st.caption("Where this layer has no curve of its own, the one is drawn that it takes from the layers below.")
        draw_versions(pair.filled(state(one.number - 1).records, state(one.number).records), "before", "after")
    else:
        draw_versions({pose: (before, after) for pose, (before, after) in pair.poses.items() if before and after}, "before", "after")


def open_in_curves(pair: ChangedPair) -> None:
    """Go to the pair in the page Curves, at the layer in which it changed."""
    place = {"language": pair.language, "character": pair.character, "kind": pair.layer.partition(":")[0]}
    open_pair(pair.left, pair.right, **{name: value for name, value in place.items() if value})


def show_rows(one: Revision, changes: list[Change]) -> None:
    """Every row of *changes* before and after."""
    if len(changes) > MOST_ROWS:
        st.caption(f"The first {MOST_ROWS:,} of {len(changes):,} rows; choose a table or a pair above to see others.")
    kinds = {(True, False): "added", (False, True): "removed", (False, False): "changed"}
    rows = [
        {"row": f"{change.path} {' '.join(change.key)}", "": kinds[change.before is None, change.after is None], **change.to_row()}
        for change in changes[:MOST_ROWS]
    ]
    # A table in the place of another revision's would keep its widths; in a container of another key it is a new one.
    with st.container(key=f"history_rows_{one.number}"):
        st.dataframe([{name: row[name] for name in ("row", "", "before", "after")} for row in rows], hide_index=True)


with shown_errors():
    wanted = asked()
    revisions = database().store.find(wanted, limit=MOST)
    if not revisions:
        st.info("No change is like this. Choose “any” where you chose something, and empty what you typed.")
        st.stop()
    one = choose(revisions)
    st.subheader(f"Revision {one.number}: {as_typed(one.note) or 'no note'}")
    st.caption(f"{as_typed(one.author)}, {one.time.replace('T', ' at ').rstrip('Z')} UTC")
    take_back(one)
    every = changes_of(database(), one.number)
    changes = changes_named(wanted, every)
    if len(changes) < len(every):
        st.caption(f"{len(changes):,} of this revision's {len(every):,} rows are as chosen above; only these are shown.")
    pairs = changed_pairs(changes) if one.number > 1 else []
    if pairs:
        as_curves, as_rows = st.tabs([f"Curves of {counted(len(pairs), 'pair')}", counted(len(changes), "row")])
        with as_curves:
            show_curves(one, pairs)
        with as_rows:
            show_rows(one, changes)
    else:
        show_rows(one, changes)
