// From where a face is seen, and where each view of it stands.

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
