// The rows of the lanes: what stands in each, how tall it is, and how it is drawn.

import { type Loaded, type Span, type StageData, type Track } from "./data";

/** The stretch of time that is seen, and where it lies on the canvas. */
export interface Axis {
  from: number;
  to: number;
  left: number;
  right: number;
}

export function xOf(axis: Axis, time: number): number {
  return axis.left + ((time - axis.from) / (axis.to - axis.from)) * (axis.right - axis.left);
}

/** The colours of the page's theme, and its letters. */
export interface Theme {
  ink: string;
  line: string;
  font: string;
  dark: boolean;
}

/** A row of the lanes. Beside it stand its name, and what changes with time: at most as wide as `widest`. */
export interface Row {
  name: string;
  height: number;
  draw(pen: CanvasRenderingContext2D, top: number, axis: Axis, theme: Theme): void;
  value?(time: number): string;
  widest?: string;
}

/** Okabe and Ito's colours, which people with any kind of colour vision can tell apart; on a dark page the dark ones are lighter. */
const COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#8c6d1f"];
const LIGHTER: Record<string, string> = { "#0072b2": "#3d9ad6", "#8c6d1f": "#b8963e" };
const STEPS = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 30, 60, 120, 300];
const STILL = 0.005; // a weight that nobody sees

export function timeRow(): Row {
  return {
    name: "seconds",
    height: 20,
    draw(pen, top, axis, { ink, line }) {
      const span = axis.to - axis.from;
      const most = Math.max((axis.right - axis.left) / 60, 2);
      const step = STEPS.find((each) => span / each <= most) ?? 600;
      pen.textAlign = "center";
      for (let k = Math.ceil(axis.from / step); k * step <= axis.to; k++) {
        const x = xOf(axis, k * step);
        const text = `${+(k * step).toFixed(2)}`;
        pen.fillStyle = ink;
        pen.fillText(text, Math.min(x, axis.right - pen.measureText(text).width / 2), top + 9);
        pen.fillStyle = line;
        pen.fillRect(x, top + 16, 1, pen.canvas.height);
      }
    },
  };
}

export function waveRow(peaks: Int8Array, rate: number): Row {
  const height = 44;
  return {
    name: "sound",
    height,
    draw(pen, top, axis, { ink }) {
      const middle = top + height / 2;
      const scale = (height / 2 - 2) / 127;
      const seconds = (axis.to - axis.from) / (axis.right - axis.left);
      pen.fillStyle = ink;
      pen.globalAlpha = 0.7;
      for (let x = axis.left; x < axis.right; x++) {
        const first = Math.floor((axis.from + (x - axis.left) * seconds) * rate);
        const last = Math.min(Math.max(first + Math.ceil(seconds * rate), first + 1), peaks.length / 2);
        let [low, high] = [0, 0];
        for (let k = first; k < last; k++) {
          low = Math.min(low, peaks[2 * k]);
          high = Math.max(high, peaks[2 * k + 1]);
        }
        pen.fillRect(x, middle - high * scale, 1, Math.max((high - low) * scale, 1));
      }
      pen.globalAlpha = 1;
    },
  };
}

export function spanRow(name: string, spans: Span[]): Row {
  const height = 20;
  return {
    name,
    height,
    draw(pen, top, axis, { ink, line }) {
      pen.textAlign = "center";
      pen.strokeStyle = line;
      pen.fillStyle = ink;
      for (const [start, end, text] of spans) {
        if (end < axis.from || start > axis.to) continue;
        const x = Math.max(xOf(axis, start), axis.left);
        const wide = Math.min(xOf(axis, end), axis.right) - x;
        pen.strokeRect(x, top + 0.5, wide, height - 1);
        // Squeezed by a third letters can still be read; by more they only smear. Zoomed in, they stand there.
        if (wide > 0.67 * pen.measureText(text).width) pen.fillText(text, x + wide / 2, top + height / 2, wide - 1);
      }
    },
  };
}

export function titleRow(text: string): Row {
  return {
    name: "",
    height: 20,
    draw(pen, top, axis, { ink }) {
      pen.textAlign = "left";
      pen.fillStyle = ink;
      pen.fillText(text, axis.left, top + 12);
    },
  };
}

/** One pose of one or two tracks: the first filled, the second dashed. A pose that never moves stays low. */
export function poseRow(name: string, colour: string, columns: { track: Track; k: number }[]): Row {
  const moves = columns.some(({ track, k }) => largest(track, k) > STILL);
  const height = moves ? 30 : 15;
  return {
    name,
    height,
    draw(pen, top, axis, { line, dark }) {
      const shade = (dark && LIGHTER[colour]) || colour;
      const floor = top + height - 3;
      pen.fillStyle = line;
      pen.fillRect(axis.left, floor, axis.right - axis.left, 1);
      if (!moves) return;
      columns.forEach(({ track, k }, second) => {
        const first = Math.max(Math.floor(axis.from * track.fps) - 1, 0);
        const last = Math.min(Math.ceil(axis.to * track.fps) + 1, track.frames - 1);
        pen.beginPath();
        for (let f = first; f <= last; f++) {
          const weight = track.values[f * track.names.length + k];
          pen.lineTo(xOf(axis, f / track.fps), floor - (height - 6) * weight);
        }
        pen.strokeStyle = shade;
        pen.lineWidth = 1.5;
        pen.setLineDash(second ? [3, 3] : []);
        pen.stroke();
        if (second) return;
        pen.lineTo(xOf(axis, last / track.fps), floor);
        pen.lineTo(xOf(axis, first / track.fps), floor);
        pen.fillStyle = shade + "33";
        pen.fill();
      });
      pen.setLineDash([]);
      pen.lineWidth = 1;
    },
    value(time) {
      const shown = columns.map(({ track, k }) => weightAt(track, k, time));
      return shown.some((weight) => weight >= STILL) ? shown.map((weight) => weight.toFixed(2)).join(" ") : "";
    },
    widest: moves ? columns.map(() => "0.00").join(" ") : "",
  };
}

function largest(track: Track, k: number): number {
  let found = 0;
  for (let f = k; f < track.values.length; f += track.names.length) found = Math.max(found, track.values[f]);
  return found;
}

function weightAt(track: Track, k: number, time: number): number {
  const frame = Math.min(Math.max(Math.round(time * track.fps), 0), track.frames - 1);
  return track.values[frame * track.names.length + k] ?? 0;
}

const same = (a: ArrayLike<unknown>, b: ArrayLike<unknown>): boolean => a.length === b.length && Array.prototype.every.call(a, (x, k) => x === b[k]);

/** The rows of poses: two faces share them when they have the same poses, and share the line too when nothing differs. */
function poseRows(faces: Loaded[]): Row[] {
  const groups: Loaded[][] = [];
  for (const one of faces) {
    const group = groups.find(([first]) => same(first.poses.names, one.poses.names));
    if (!group) groups.push([one]);
    else if (!group.some(({ poses }) => same(poses.values, one.poses.values))) group.push(one);
  }
  return groups.flatMap((group) => {
    const titles = group.map(({ face }) => face.title);
    const rows = group[0].poses.names.map((name, k) =>
      poseRow(name, COLOURS[k % COLOURS.length], group.map(({ poses }) => ({ track: poses, k }))),
    );
    const title = group.length > 1 ? `${titles[0]}, and dashed: ${titles.slice(1).join(", ")}` : titles[0];
    return groups.length > 1 || group.length > 1 ? [titleRow(title), ...rows] : rows;
  });
}

/** All rows of a line, from the time down to the poses. */
export function rowsOf(data: StageData, faces: Loaded[], peaks: Int8Array): Row[] {
  const rows = [timeRow()];
  if (peaks.length) rows.push(waveRow(peaks, data.peak_rate));
  for (const name of ["words", "phones", "common"] as const) if (data[name].length) rows.push(spanRow(name, data[name]));
  return data.compact ? rows : [...rows, ...poseRows(faces)];
}
