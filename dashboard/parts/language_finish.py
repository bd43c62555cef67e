"""Steps 3 to 5 of adding a language: common phones of its own, the check, and where it is kept."""

from __future__ import annotations

import os

import pandas as pd
import streamlit as st
from parts.language_review import common_titles
from parts.language_work import STEPS, Work, digest, go, hear, told
from parts.session import database, writable

from lipdb.errors import InputError
from lipdb.languages.keep import ready_workspace, save_rows, save_text, zipped
from lipdb.languages.new import require_sentences
from lipdb.languages.trial import Checked, Cost, check_records, cost, price
from lipdb.paths import workspace_dir
from lipdb.schedule import SILENCE
from lipdb.store.cells import flat
from lipdb.words import counted

MINUTES = 5
"""What an artist needs for a pair."""
LONG = 100
"""Letters of a finding that a page of 1280 has room for."""
NOTHING = "none: it is unlike all others"


def step_common(mine: Work) -> None:
    """What the language's common phones cost, and new ones if it needs them."""
    draft = mine.draft
    trial = mine.trial()
    with told():
        found = _cost(mine, trial.records)
        _show_cost(found, draft.row["name"])
    for name in list(draft.common):
        left, right = st.columns([4, 1])
        row = draft.common[name]
        users = ", ".join(one.phone.ipa for one in draft.entries.values() if name in one.common) or "no phone yet"
        left.write(f"**{name}**, typically {row['ipa']}, {'a kind of ' + row['kind_of'] if row['kind_of'] else 'unlike others'}: {users}")
        if right.button("Take back", key=mine.key(f"drop_{name}")):
            draft.drop_common(name)
            for one in draft.entries:
                st.session_state.pop(mine.key(f"common_{one}"), None)
            st.rerun()
    extra = price(trial.records, draft.code)
    st.write(
        f"Does {draft.row['name']} have a sound that looks like no common phone? One more would bring up to **{extra} pairs** "
        f"({extra * MINUTES / 60:.1f} hours of drawing at {MINUTES} minutes a pair). As a kind of another common phone it begins with that "
        "one's curves, so nothing has to be drawn before it speaks, and other languages stay as they are."
    )
    with st.expander("A new common phone", expanded=not draft.common, icon=":material/add:"):
        _new_common(mine)
    if st.button("Next: check", type="primary", icon=":material/arrow_forward:", key=mine.key("next_check")):
        go(STEPS[3])
        st.rerun()


def _cost(mine: Work, records: object) -> Cost:
    kept = st.session_state.setdefault("languages_costs", {})
    mark = digest(mine.own())
    if mark not in kept:
        kept.clear()
        with st.spinner("Counting pairs…"):
            kept[mark] = cost(records, mine.draft.code)  # type: ignore[arg-type]
    found: Cost = kept[mark]
    return found


def _show_cost(found: Cost, name: str) -> None:
    part = found.part
    for column, label, value, help_text in zip(
        st.columns(4),
        ("Pairs of its phones", "Taken over", "New", "New that begin with curves"),
        (part.pairs, found.shared, len(part.new), part.inherited),
        (
            "Ordered pairs of the common phones that its phones map to, without pauses",
            f"Another language has both phones of the pair: {', '.join(found.donors)}",
            "No other language has them; somebody should draw them",
            "New pairs that use a coarser phone's curves until somebody draws their own",
        ),
        strict=True,
    ):
        column.metric(label, value, help=help_text)
    if not part.new:
        st.caption(f":material/check: {name} speaks with what is there; nothing has to be drawn.")
    if found.own:
        rows = [{"common phone": one.phone, "kind of": one.kind_of, "pairs": one.pairs, "inherited": one.inherited} for one in found.own]
        st.dataframe(rows, hide_index=True)


def _new_common(mine: Work) -> None:
    draft, records = mine.draft, database().records
    coarser = [key[0] for key in records["common.tsv"] if key[0] != SILENCE]
    with st.form(mine.key("common_form"), border=False):
        one, two, three, four = st.columns([1, 1, 1, 2])
        name = one.text_input("Name", key=mine.key("c_name"), max_chars=8, placeholder="bp")
        kind = two.selectbox("It is a", ["consonant", "vowel"], key=mine.key("c_kind"))
        ipa = three.text_input("Typical sound (IPA)", key=mine.key("c_ipa"), max_chars=4, placeholder="ɸ")
        kind_of = four.selectbox(
            "A kind of",
            [NOTHING, *coarser],
            index=None,
            format_func=common_titles(),
            key=mine.key("c_of"),
            placeholder="whose curves it begins with",
        )
        phones = st.multiselect("Phones that map to it", [entry.phone.ipa for entry in draft.in_order()], key=mine.key("c_phones"))
        left, right = st.columns(2)
        example = left.text_input("Example words", key=mine.key("c_example"), max_chars=80)
        comment = right.text_input("How it differs to the eye", key=mine.key("c_comment"), max_chars=200)
        if not st.form_submit_button("Add the common phone", icon=":material/add:"):
            return
    with told():
        if kind_of is None:
            raise InputError(f"{name or 'it'}: say which common phone it is a kind of, or that it is unlike all others")
        of = "" if kind_of == NOTHING else kind_of
        draft.add_common(name.strip(), kind=kind, ipa=ipa.strip(), kind_of=of, example=example, comment=comment, records=records)
        for phone in phones:
            entry = draft.entries[phone]
            draft.decide(phone, common=[name.strip()], example=entry.example, spelt=entry.spelt, note=comment or entry.note)
            st.session_state.pop(mine.key(f"common_{phone}"), None)
        st.rerun()


def step_check(mine: Work) -> None:
    """The conformance kit, as for every language that ships."""
    draft = mine.draft
    with told():
        show_checked(_checked(mine), draft.row["name"], key=mine.key("findings"))
    with (
        st.expander(f"Sample sentences ({len(draft.sentences)})", icon=":material/notes:"),
        st.form(mine.key("sentences_form"), border=False),
    ):
        text = st.text_area("One or more a line", "\n".join(draft.sentences), key=mine.key("sentences"), height=200)
        if st.form_submit_button("Take these"):
            with told():
                draft.sentences = require_sentences(text, draft.source, database().records)
                st.rerun()
    if st.button("Next: save", type="primary", icon=":material/arrow_forward:", key=mine.key("next_save")):
        go(STEPS[4])
        st.rerun()


def _checked(mine: Work) -> Checked:
    own = mine.own()
    mark = digest(own)
    if mine.checked is None or mine.checked[0] != mark:
        with st.spinner("The voice reads the sample; every row is checked…"):
            mine.checked = mark, check_records(mine.draft.code, mine.trial().records)
    return mine.checked[1]


def show_checked(checked: Checked, name: str, *, key: str) -> None:
    """The findings of the kit: what must be mended first, then what a person should look at."""
    notes = len(checked.findings) - checked.errors
    if checked.errors:
        count = counted(checked.errors, "thing is", "things are")
        st.error(f"{count} wrong with {name}: mend the rows below.", icon=":material/error:")
    else:
        st.success(f"{name} is in order; {counted(notes, 'note')} for a person to look at.", icon=":material/check_circle:")
    if checked.report.coverage is not None:
        st.caption(f":material/analytics: {checked.report.coverage}.")
    if checked.findings:
        rows = pd.DataFrame([one.to_row() for one in checked.findings])
        rows["kind"] = rows["kind"].map({"error": "✕ error", "note": "note"})
        st.dataframe(
            rows,
            hide_index=True,
            key=key,
            # What is pinned keeps its width: the room that is left is for the sentence.
            column_config={
                "kind": st.column_config.TextColumn("", width=70, pinned=True),
                "table": st.column_config.TextColumn(width=110, pinned=True),
                "row": st.column_config.TextColumn(width=120, pinned=True),
                "what": st.column_config.TextColumn(width=690),
            },
        )
        if rows["what"].str.len().max() > LONG:
            st.caption("Double-click a row to read all of it.")


def step_save(mine: Work) -> None:
    """Keep it as text for review, load it into the database, and hear it."""
    draft, own = mine.draft, mine.own()
    doubtful = sum(one.doubtful for one in draft.entries.values())
    if doubtful:
        marked = counted(doubtful, "phone is", "phones are")
        st.caption(f":material/visibility: {marked} still marked `review:`; that is kept in the comments.")
    left, right = st.columns(2, gap="large")
    with left:
        st.subheader("As text, for review with git")
        _save_text(mine, own)
    with right:
        st.subheader("Into the database, to speak")
        _save_rows(mine, own)


def _save_text(mine: Work, own: dict) -> None:  # type: ignore[type-arg]
    folder, code = workspace_dir(os.environ.get("LIPDB_PHONESETS")), mine.draft.code
    rows = ", ".join(f"{path.rpartition('/')[2]} ({len(rows)})" for path, rows in sorted(own.items()))
    st.write(f"A folder `{code}` in the workspace `{folder}`: {rows}. Nothing that is there is overwritten.")
    if st.button("Write the folder", type="primary", icon=":material/folder:", key=mine.key("save_text"), disabled=bool(mine.files)):
        with told():
            db, _ = writable()
            made = ready_workspace(folder, db.store)
            # A workspace that was just made from the database has the language already if it was loaded first.
            there = sorted((folder / code).glob("*.tsv")) if made else []
            mine.files = there or save_text(code, own, folder)
            st.rerun()
    st.download_button("Download as zip", zipped(own), f"{code}.zip", on_click="ignore", key=mine.key("zip"), icon=":material/download:")
    if mine.files:
        st.success(f"Written: {', '.join(str(file.relative_to(folder)) for file in mine.files)}.", icon=":material/check_circle:")
        st.write("What to do next, in a terminal:")
        st.code(
            f"cd {folder}\n# review it, then commit\ngit add -A . && git diff --cached\n"
            f"# check it again after edits\nlipdb language check {code} .\n# bring edits of the text into the database\nlipdb db load .",
            language="sh",
        )


def _save_rows(mine: Work, own: dict) -> None:  # type: ignore[type-arg]
    draft = mine.draft
    st.write(f"One revision, which History can take back. Then {draft.row['name']} is a language on every page.")
    if st.button(
        "Load into the database", type="primary", icon=":material/database:", key=mine.key("save_rows"), disabled=bool(mine.revision)
    ):
        with told():
            db, author = writable()
            note = f"Add the language {draft.row['name']} ({draft.code})"
            mine.revision = save_rows(flat(own), db.store, author=author, note=note, seen=mine.seen)
            st.rerun()
    if mine.revision:
        st.success(f"Revision {mine.revision}: {draft.row['name']} speaks.", icon=":material/check_circle:")
        sample = min(draft.sentences, key=len, default=next(iter(draft.entries.values())).example)
        text = st.text_input("Say", sample, key=mine.key("say"), max_chars=200)
        hear(database(), f"saved {mine.revision}", text, draft.code, key=mine.key("hear_saved"))
        if st.button("Open in Say", icon=":material/record_voice_over:", key=mine.key("open_say")):
            st.session_state["say_open"] = draft.code
            st.switch_page("pages/say.py")
