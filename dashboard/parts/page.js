if (!window.lipdbUnsaved) {
  // A button does once what it does: the second click of a double click is none. Streamlit would begin anew beside what is under way, or
  // click what has come to stand there meanwhile: Undo, which then takes back an undo.
  document.addEventListener("click", (event) => {
    if (event.detail < 2 || !event.target.closest?.('[data-testid="stButton"] button, [data-testid="stFormSubmitButton"] button')) return;
    event.stopPropagation();
    event.preventDefault();
  }, true);

  // Who leaves is asked first while something is unsaved: parts/leaving.py says whether it is.
  let held = false;
  window.lipdbUnsaved = (unsaved) => { held = unsaved; };
  window.addEventListener("beforeunload", (event) => {
    if (held) event.preventDefault();
  });
}
