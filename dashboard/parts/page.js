if (!window.lipdbUnsaved) {
  // A button does once what it does: the second click of a double click is none, nor is one while the page still does what the first asked.
  // Streamlit would begin anew beside what is under way, or click what has come to stand there meanwhile: Undo, which then takes back an undo.
  let busy = null;
  const running = () => document.querySelector('[data-testid="stApp"]')?.dataset.testScriptState === "running";
  document.addEventListener("click", (event) => {
    const button = event.target.closest?.('[data-testid="stButton"] button, [data-testid="stFormSubmitButton"] button');
    if (!button) return;
    if (event.detail > 1 || (button === busy && running())) {
      event.stopPropagation();
      event.preventDefault();
    } else {
      busy = button;
    }
  }, true);

  // Who leaves is asked first while something is unsaved: parts/leaving.py says whether it is.
  let held = false;
  window.lipdbUnsaved = (unsaved) => { held = unsaved; };
  window.addEventListener("beforeunload", (event) => {
    if (held) event.preventDefault();
  });
}
