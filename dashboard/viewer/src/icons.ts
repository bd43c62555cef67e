// Icons as drawings: signs of a font look different, or are missing, on other machines.

const PATHS = {
  play: "M5 3l14 9-14 9z",
  pause: "M5 3h5v18H5zM14 3h5v18h-5z",
  start: "M4 4h3v16H4zM20 4v16L8 12z",
  back: "M17 4v16L6 12z",
  on: "M7 4v16l11-8z",
  undo: "M9 4L2 10l7 6v-4h5a4 4 0 0 1 0 8h-3v3h3a7 7 0 0 0 0-14H9z",
  redo: "M15 4l7 6-7 6v-4h-5a4 4 0 0 0 0 8h3v3h-3a7 7 0 0 1 0-14h5z",
};

export function icon(name: keyof typeof PATHS): SVGSVGElement {
  const drawing = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  drawing.setAttribute("viewBox", "0 0 24 24");
  drawing.setAttribute("aria-hidden", "true");
  drawing.classList.add("icon");
  const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
  path.setAttribute("d", PATHS[name]);
  drawing.append(path);
  return drawing;
}
