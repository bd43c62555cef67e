if (!window.lipdbListens) {
  window.lipdbListens = true;

  // A button does once what it does: the second click of a double click is none. Streamlit would begin anew beside what is under way, or
  // click what has come to stand there meanwhile: Undo, which then takes back an undo.
  document.addEventListener("click", (event) => {
    if (event.detail < 2 || !event.target.closest?.('[data-testid="stButton"] button, [data-testid="stFormSubmitButton"] button')) return;
    event.stopPropagation();
    event.preventDefault();
  }, true);

  // Who leaves is asked first while something is unsaved: parts/leaving.js has heard whether it is, at times before this is here.
  window.addEventListener("beforeunload", (event) => {
    if (window.lipdbUnsaved?.unsaved.length) event.preventDefault();
  });

  // Who has lost the server is told Streamlit's own command, which starts no dashboard.
  new MutationObserver(() => {
    const block = document.querySelector('body > [data-testid="stDialog"] [data-testid="stErrorCodeBlock"]');
    const command = block?.querySelector("code");
    if (!command?.textContent.startsWith("streamlit run")) return;
    block.previousElementSibling.textContent = "The dashboard does not answer. If it has ended, start it again as you did before; then this page goes on:";
    command.textContent = "lipdb dashboard";
    block.querySelector("button").hidden = true; // it would copy the other
  }).observe(document.body, { childList: true });

  // Streamlit takes nothing that is longer than a field may be, without a word.
  document.addEventListener("input", ({ target: field }) => {
    if (!field.closest?.('[data-testid="stTextInput"], [data-testid="stTextArea"]')) return;
    const { value } = field;
    field.setCustomValidity("");
    setTimeout(() => {
      if (field.value.length >= value.length) return;
      field.setCustomValidity(`${value.length} letters are more than this field takes.`);
      field.reportValidity();
    });
  }, true);
}
