// What Python sends to the stage (lipdb/preview.py), and how it is read.

import { bytes } from "./files";

/** A stretch of time in seconds with what is written on it. */
export type Span = [start: number, end: number, text: string];

/** Who speaks: weights of its poses, and a mesh with morph targets, or pictures of which one shows at a time. */
export type FaceData = { name: string; title: string; poses: string[]; track: string } & (
  | { kind: "mesh"; url: string; shapes: string[]; weights: string }
  | { kind: "pictures"; pictures: Record<string, string>; cues: Span[] }
);

export interface StageData {
  id: string;
  fps: number;
  duration: number;
  audio: string | null;
  /** Lowest and highest sample of each step, `peak_rate` steps a second. */
  peaks: string | null;
  peak_rate: number;
  words: Span[];
  phones: Span[];
  common: Span[];
  faces: FaceData[];
  /** The stretch to play over and over, in seconds; the visitor may choose another. */
  loop?: [number, number];
  /** Begin by itself when there is a new line to hear. */
  autoplay?: boolean;
  /** Smaller faces, and no lanes of poses. */
  compact?: boolean;
  /** Who it is in the events `lipdb-time` that it sends whenever it draws another instant. */
  name?: string;
  /** Stretches of time to point out in the lanes, in seconds. */
  marks?: [number, number][];
}

/** Weights of `names`, `frames` x `names.length`, at `fps` frames a second; frame k is at k / fps seconds. */
export class Track {
  readonly frames: number;

  constructor(
    readonly names: string[] = [],
    readonly values: Float32Array = new Float32Array(0),
    readonly fps = 60,
  ) {
    this.frames = names.length ? values.length / names.length : 0;
  }

  /** The weights at `time` seconds, on the straight line between the two frames around it. */
  at(time: number, into: Float32Array): Float32Array {
    const width = this.names.length;
    if (!this.frames) return into.fill(0);
    const place = Math.min(Math.max(time * this.fps, 0), this.frames - 1);
    const first = Math.floor(place);
    const second = Math.min(first + 1, this.frames - 1);
    const part = place - first;
    for (let k = 0; k < width; k++) {
      into[k] = this.values[first * width + k] * (1 - part) + this.values[second * width + k] * part;
    }
    return into;
  }
}

/** The track behind `url`: little-endian 32-bit floats. */
export async function track(names: string[], url: string, fps: number): Promise<Track> {
  return new Track(names, new Float32Array(await bytes(url)), fps);
}

/** One face with what it needs before it can be drawn. */
export interface Loaded {
  face: FaceData;
  poses: Track;
  shapes: Track;
}

export async function loaded(face: FaceData, fps: number): Promise<Loaded> {
  const [poses, shapes] = await Promise.all([
    track(face.poses, face.track, fps),
    face.kind === "mesh" ? track(face.shapes, face.weights, fps) : new Track(),
  ]);
  return { face, poses, shapes };
}

/** The index of the span that `time` lies in, -1 for none; spans are in order and do not overlap. */
export function spanAt(spans: Span[], time: number): number {
  let low = 0;
  let high = spans.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (spans[middle][1] <= time) low = middle + 1;
    else high = middle;
  }
  return low < spans.length && spans[low][0] <= time ? low : -1;
}
