// What Python sends to the curve editor and gets back, and what can be done with keys.

export type Key = [time: number, weight: number];

/** By pose: the keys of the edited layer, none for zero; null leaves the pose to the layer below. */
export type Curves = Record<string, Key[] | null>;

export interface Lane {
  pose: string;
  keys: Key[] | null;
  /** What counts where the edited layer says nothing, and the layer that it comes from. */
  below: Key[];
  from: string;
  /** Why an edit here may not be seen; empty when it is. */
  note: string;
  /** What the engine makes of the curve for phones of these lengths: normalised time and weight. */
  drawn: Key[];
}

export interface Pair {
  left: string;
  right: string;
  /** Seconds that the two phones last in what is drawn and played. */
  lengths: [number, number];
  /** The stage that plays the pair, and where it begins, its border and its end, in seconds. */
  playing: { stage: string; span: [number, number, number] };
}

export interface KeysData {
  /** Changes when another curve is to be edited; the editor then forgets what it had. */
  id: string;
  /** The pair of phones over whose time the curves go; without it they go over what `axis` names. */
  pair?: Pair;
  axis?: string;
  lanes: Lane[];
  locked: boolean;
  /** Whether the curve comes out of silence, or goes into it: it has to be at rest there. */
  silent: [boolean, boolean];
  /** Curves to take over as one step that can be undone, once for each token. */
  given?: { token: string; curves: Curves } | null;
}

export const GRID = 0.05;
/** Two keys are at least this far apart. */
const CLOSE = 0.004;
/** How far from the first key of an empty curve its feet stand. */
const FOOT = 0.25;

export function round(value: number): number {
  return Math.round(value * 1000) / 1000;
}

function within(value: number, low: number, high: number): number {
  return round(Math.min(Math.max(value, low), high));
}

export function copy(curves: Curves): Curves {
  return Object.fromEntries(Object.entries(curves).map(([pose, keys]) => [pose, keys && keys.map(([t, w]): Key => [t, w])]));
}

export function same(a: Curves, b: Curves): boolean {
  return JSON.stringify(a) === JSON.stringify(b);
}

/** Where `time` seconds are in the normalised time of a pair of phones that stands at `span`; null outside. */
export function normalised(time: number, [start, border, end]: [number, number, number]): number | null {
  if (time < start || time > end) return null;
  return time < border ? (time - start) / (border - start) / 2 : 0.5 + (time - border) / (end - border) / 2;
}

/** `keys` at rest where silence is. */
export function rested(keys: Key[], silent: [boolean, boolean]): Key[] {
  const last = keys.length - 1;
  return keys.map(([time, weight], k) => [time, (silent[0] && k === 0) || (silent[1] && k === last) ? 0 : weight]);
}

/** `keys` as a curve that keeps its first and last weight beyond them. */
export function held(keys: Key[]): Key[] {
  return keys.length ? [[0, keys[0][1]], ...keys, [1, keys[keys.length - 1][1]]] : [];
}

/** Key `k` moved to `to`, between its neighbours. */
export function moved(keys: Key[], k: number, to: Key): Key[] {
  const low = k ? keys[k - 1][0] + CLOSE : 0;
  const high = k < keys.length - 1 ? keys[k + 1][0] - CLOSE : 1;
  return keys.map((key, i) => (i === k ? [within(to[0], low, high), within(to[1], 0, 1)] : key));
}

/** `keys` with one at `at` more, and its index; null where there is no room. The first of all gets feet to stand on. */
export function added(keys: Key[], at: Key): [Key[], number] | null {
  const made: Key = [within(at[0], 0, 1), within(at[1], 0, 1)];
  if (!keys.length) {
    const feet = [made[0] - FOOT, made[0] + FOOT].map((time): Key => [within(time, 0, 1), 0]);
    const all = [feet[0], made, feet[1]].filter(([time], k) => k === 1 || Math.abs(time - made[0]) > CLOSE);
    return [all, all.indexOf(made)];
  }
  if (keys.some(([time]) => Math.abs(time - made[0]) < CLOSE)) return null;
  const k = keys.filter(([time]) => time < made[0]).length;
  return [[...keys.slice(0, k), made, ...keys.slice(k)], k];
}
