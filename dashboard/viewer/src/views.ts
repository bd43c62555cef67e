// From where a face is seen, and where each view of it stands.

import { Vector3, type Box3, type Camera } from "three";

/** Degrees around the head at which a view stands; the first one can be turned by hand. */
export const VIEWS = { front: [0], "¾": [38], side: [90], all: [0, 38, 90] } satisfies Record<string, number[]>;
export type ViewName = keyof typeof VIEWS;

/** How much taller than wide a head is. */
export const SLIM = 1.15;

/** A part of a canvas, in pixels. */
export interface Place {
  left: number;
  bottom: number;
  width: number;
  height: number;
  aspect: number;
}

/** The parts of a canvas for `count` views, in pixels: side by side, or the first of three above the others, whichever gives more room. */
export function placed(count: number, width: number, height: number): Place[] {
  const part = (left: number, bottom: number, across: number, up: number): Place => {
    const [w, h] = [across * width, up * height];
    return { left: left * width, bottom: bottom * height, width: w, height: h, aspect: w / h };
  };
  const row = Array.from({ length: count }, (_, k) => part(k / count, 0, 1 / count, 1));
  const pile = [part(0, 0.5, 1, 0.5), part(0, 0, 0.5, 0.5), part(0.5, 0, 0.5, 0.5)];
  const room = (places: Place[]): number => Math.min(...places.map((each) => Math.min(each.width * SLIM, each.height)));
  return count === pile.length && room(pile) > room(row) ? pile : row;
}

const STEP = 32; // pixels: whole ones of the screen at the usual ratios, and few steps while a face is turned
const CORNERS = [0, 1, 2, 3, 4, 5, 6, 7];

/** From where to where across, in pixels, `body` is seen in `places`, each through its camera. */
export function across(body: Box3, cameras: Camera[], places: Place[]): [left: number, right: number] {
  const whole = Math.max(...places.map(({ left, width }) => left + width));
  const seen: number[] = [];
  const corner = new Vector3();
  places.forEach(({ left, width }, k) => {
    for (const n of CORNERS) {
      corner.set((n & 1 ? body.max : body.min).x, (n & 2 ? body.max : body.min).y, (n & 4 ? body.max : body.min).z).project(cameras[k]);
      if (body.isEmpty() || Math.abs(corner.z) > 1) seen.push(left, left + width); // beside or behind the camera: it may be seen anywhere
      else seen.push(left + width * Math.min(Math.max((corner.x + 1) / 2, 0), 1));
    }
  });
  const [first, last] = [Math.min(...seen), Math.max(...seen)];
  return [Math.floor(first / STEP) * STEP, Math.min(Math.ceil(last / STEP) * STEP, whole)];
}
