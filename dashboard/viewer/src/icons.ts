// Icons as drawings: signs of a font look different, or are missing, on other machines.

const PATHS = {
  play: "M5 3l14 9-14 9z",
  pause: "M5 3h5v18H5zM14 3h5v18h-5z",
  start: "M4 4h3v16H4zM20 4v16L8 12z",
  back: "M17 4v16L6 12z",
  on: "M7 4v16l11-8z",
  loop: "M7 6h10a5 5 0 0 1 0 12h-1v-2.5h1a2.5 2.5 0 0 0 0-5H8v3L2 7.5 8 2zM9 18H7A5 5 0 0 1 3 16l2-2c.5 1 1.200 1.500 2 1.500h2z",
  sound: "M3 9h4l6-5v16l-6-5H3zM16 8a5 5 0 0 1 0 8zM18 4a9 9 0 0 1 0 16v-2.500a6.500 6.500 0 0 0 0-11z",
  silence: "M3 9h4l6-5v16l-6-5H3zM15.500 9.500l1.500-1.500 2 2 2-2 1.500 1.500-2 2 2 2-1.500 1.500-2-2-2 2-1.500-1.500 2-2z",
  undo: "M9 4L2 10l7 6v-4h5a4 4 0 0 1 0 8h-3v3h3a7 7 0 0 0 0-14H9z",
  redo: "M15 4l7 6-7 6v-4h-5a4 4 0 0 0 0 8h3v3h-3a7 7 0 0 1 0-14h5z",
  out: "M4 10h16v4H4z",
  in: "M4 10h6V4h4v6h6v4h-6v6h-4v-6H4z",
};

export type IconName = keyof typeof PATHS;

export function icon(name: IconName): SVGSVGElement {
  const drawing = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  drawing.setAttribute("viewBox", "0 0 24 24");
  drawing.setAttribute("aria-hidden", "true");
  drawing.classList.add("icon");
  const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
  path.setAttribute("d", PATHS[name]);
  drawing.append(path);
  return drawing;
}
