// Faces that stand on no page just now: the next page begins with their drawing context, shaders and mesh.
// To make those anew takes half a second where the processor draws.

import { MeshView } from "./mesh";

const MOST = 2; // as many as a page has; browsers allow sixteen contexts at a time

const QUIET = 500; // milliseconds in which nobody does anything, and nothing moves, before a second view is made

let spare: MeshView[] = [];
let doubled = false;
let touched = 0;
for (const act of ["keydown", "pointerdown", "pointermove"]) window.addEventListener(act, () => (touched = performance.now()), true);

/** A view to stand on a page: a spare one, if there is one the one with the face at `url`. Throws as `MeshView` does; see there for `failed`. */
export function taken(url: string, failed: (why: string) => void): MeshView {
  const usable = spare.filter((view) => view.whole);
  const found = usable.find((view) => view.shows(url)) ?? usable[0];
  if (!found) return new MeshView(failed);
  spare = spare.filter((view) => view !== found);
  found.failed = failed;
  found.arrive();
  return found;
}

/** Make a second view like this one ready, once, for pages that have two. It takes a moment, so nothing is done before all is quiet: ask again. */
export function double(view: MeshView): void {
  if (doubled || !view.whole || performance.now() - Math.max(touched, view.drawn) < QUIET) return;
  doubled = true;
  (window.requestIdleCallback ?? setTimeout)(() => void view.twin().then(left));
}

/** Keep a view that has left its page, or end it where there are enough. */
export function left(view: MeshView): void {
  view.failed = () => {};
  if (spare.length < MOST && view.whole) spare.push(view);
  else view.dispose();
}
