// What Python sends to the stage, and how its packed arrays are read.

/** A stretch of time in seconds with what is written on it. */
export type Span = [start: number, end: number, text: string];

/** A face to draw: a mesh with morph targets, or pictures of which one shows at a time. */
export type FaceData = { name: string; title: string } & (
  | { kind: "mesh"; url: string; shapes: string[]; weights: string }
  | { kind: "pictures"; pictures: Record<string, string>; cues: Span[] }
);

export interface StageData {
  id: string;
  fps: number;
  duration: number;
  audio: string | null;
  peaks: string;
  words: Span[];
  phones: Span[];
  common: Span[];
  poses: string[];
  weights: string;
  faces: FaceData[];
  /** The stretch to play over and over, in seconds; the visitor may choose another. */
  loop?: [number, number];
  /** Begin to play as soon as there is something to see. */
  autoplay?: boolean;
  /** Smaller faces, and no lanes of poses. */
  compact?: boolean;
  /** Stretches of time to point out in the lanes, in seconds. */
  marks?: [number, number][];
}

/** Weights of `names`, `frames` x `names.length`, at `fps` frames a second; frame k is at k / fps seconds. */
export class Track {
  readonly frames: number;

  constructor(readonly names: string[], readonly values: Float32Array, readonly fps: number) {
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

function bytes(base64: string): Uint8Array {
  return Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
}

/** Little-endian 32-bit floats. */
export function floats(base64: string): Float32Array {
  return new Float32Array(bytes(base64).buffer);
}

/** Signed bytes: the lowest and the highest sample of each step of a waveform, in turn. */
export function peaks(base64: string): Int8Array {
  return new Int8Array(bytes(base64).buffer);
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
