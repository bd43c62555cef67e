([session, unsaved]) => {
  const before = window.lipdbUnsaved ?? { session, unsaved };
  window.lipdbUnsaved = { session, unsaved };
  const lost = before.session === session ? [] : before.unsaved.filter((name) => !unsaved.includes(name));
  if (!lost.length) return;
  const note = document.createElement("div");
  note.className = "lipdb-lost";
  note.role = "alert";
  note.textContent = `The dashboard was restarted, or could not be reached for some minutes. What was not saved is gone: ${lost.join(", ")}. `;
  const close = document.createElement("button");
  close.textContent = "Close";
  close.onclick = () => note.remove();
  note.append(close);
  document.body.append(note);
}
