// Waveform, words, phones and pose curves over one time axis, with the playhead on top.

import { floats, peaks, Track, type Span, type StageData } from "./data";

const NAMES = 84; // width of the column of names
const HEIGHTS = { wave: 44, spans: 20, pose: 30, axis: 18 };
/** Okabe and Ito's colours, which people with any kind of colour vision can tell apart. */
const COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#8c6d1f"];
const MARKED = "#e69f0055";

export interface LaneEvents {
  seek(time: number): void;
  select(range: [number, number] | null): void;
  pick(time: number): void;
}

export class Lanes {
  readonly root = document.createElement("div");
  private readonly still = document.createElement("canvas");
  private readonly moving = document.createElement("canvas");
  private data: StageData | null = null;
  private track = new Track([], new Float32Array(0), 60);
  private wave: Int8Array = new Int8Array(0);
  private selection: [number, number] | null = null;
  private from = 0;
  private to = 1;
  private pressed: { x: number; time: number } | null = null;

  constructor(private readonly events: LaneEvents) {
    this.root.className = "lanes";
    this.root.tabIndex = -1;
    this.moving.className = "over";
    this.root.append(this.still, this.moving);
    this.moving.addEventListener("pointerdown", (event) => this.press(event));
    this.moving.addEventListener("pointermove", (event) => this.drag(event));
    this.moving.addEventListener("pointerup", (event) => this.release(event));
    this.moving.addEventListener("dblclick", () => this.choose(null));
    this.moving.addEventListener("wheel", (event) => this.zoom(event), { passive: false });
  }

  show(data: StageData, selection: [number, number] | null = null): void {
    this.data = data;
    this.track = data.compact ? new Track([], new Float32Array(0), data.fps) : new Track(data.poses, floats(data.weights), data.fps);
    this.wave = peaks(data.peaks);
    [this.from, this.to] = [0, Math.max(data.duration, 0.1)];
    this.selection = selection;
    this.resize();
  }

  get height(): number {
    const { wave, spans, pose, axis } = HEIGHTS;
    return axis + (this.wave.length ? wave : 0) + this.rows.length * spans + this.track.names.length * pose;
  }

  /** The rows of spans that have anything to show. */
  private get rows(): [string, Span[]][] {
    const { words = [], phones = [], common = [] } = this.data ?? {};
    return Object.entries({ words, phones, common }).filter(([, spans]) => spans.length);
  }

  resize(): void {
    const width = this.root.clientWidth;
    const ratio = Math.min(devicePixelRatio, 2);
    this.root.style.height = `${this.height}px`;
    for (const canvas of [this.still, this.moving]) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(this.height * ratio);
      canvas.getContext("2d")?.setTransform(ratio, 0, 0, ratio, 0, 0);
    }
    this.paint();
  }

  private x(time: number): number {
    return NAMES + ((time - this.from) / (this.to - this.from)) * (this.root.clientWidth - NAMES);
  }

  private time(event: PointerEvent | WheelEvent): number {
    const box = this.moving.getBoundingClientRect();
    const part = (event.clientX - box.left - NAMES) / (box.width - NAMES);
    return Math.min(Math.max(this.from + part * (this.to - this.from), 0), this.data?.duration ?? 0);
  }

  private press(event: PointerEvent): void {
    this.moving.setPointerCapture(event.pointerId);
    this.pressed = { x: event.clientX, time: this.time(event) };
    this.events.seek(this.pressed.time);
  }

  private drag(event: PointerEvent): void {
    if (!this.pressed) return;
    const time = this.time(event);
    if (event.shiftKey) this.events.seek(time);
    else if (Math.abs(event.clientX - this.pressed.x) > 4) {
      this.choose([Math.min(time, this.pressed.time), Math.max(time, this.pressed.time)]);
    }
  }

  private release(event: PointerEvent): void {
    if (this.pressed && Math.abs(event.clientX - this.pressed.x) <= 4) this.events.pick(this.pressed.time);
    this.pressed = null;
  }

  private choose(range: [number, number] | null): void {
    this.selection = range && range[1] - range[0] > 0.02 ? range : null;
    this.events.select(this.selection);
    this.paint();
  }

  /** Zoom around the pointer; without Ctrl the page scrolls as always. */
  private zoom(event: WheelEvent): void {
    if (!event.ctrlKey || !this.data) return;
    event.preventDefault();
    const at = this.time(event);
    const factor = Math.exp(event.deltaY / 400);
    const span = Math.min(Math.max((this.to - this.from) * factor, 0.1), this.data.duration);
    this.from = Math.max(0, Math.min(at - (at - this.from) * (span / (this.to - this.from)), this.data.duration - span));
    this.to = this.from + span;
    this.paint();
  }

  private colour(name: string, fallback: string): string {
    return getComputedStyle(this.root).getPropertyValue(name).trim() || fallback;
  }

  private paint(): void {
    const pen = this.still.getContext("2d");
    if (!pen || !this.data) return;
    const width = this.root.clientWidth;
    const ink = this.colour("--st-text-color", "#222");
    const line = this.colour("--st-border-color", "#ccc");
    pen.clearRect(0, 0, width, this.height);
    pen.font = "12px system-ui, sans-serif";
    pen.textBaseline = "middle";
    for (const [start, end] of this.data.marks ?? []) {
      pen.fillStyle = MARKED;
      pen.fillRect(this.x(start), 0, this.x(end) - this.x(start), this.height);
    }
    if (this.selection) {
      pen.fillStyle = this.colour("--st-primary-color", "#0072b2") + "22";
      pen.fillRect(this.x(this.selection[0]), 0, this.x(this.selection[1]) - this.x(this.selection[0]), this.height);
    }
    let top = this.axis(pen, ink, line);
    if (this.wave.length) top = this.waveform(pen, top, ink);
    for (const [name, spans] of this.rows) {
      top = this.spans(pen, top, name, spans, ink, line);
    }
    this.track.names.forEach((name, k) => {
      top = this.curve(pen, top, name, k, ink, line);
    });
  }

  private axis(pen: CanvasRenderingContext2D, ink: string, line: string): number {
    const span = this.to - this.from;
    const step = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 30, 60].find((s) => span / s <= 14) ?? 120;
    pen.fillStyle = ink;
    pen.strokeStyle = line;
    pen.textAlign = "center";
    for (let k = Math.ceil(this.from / step); k * step <= this.to; k++) {
      const x = this.x(k * step);
      pen.fillText(`${+(k * step).toFixed(2)}`, x, 8);
      pen.beginPath();
      pen.moveTo(x, 14);
      pen.lineTo(x, this.height);
      pen.globalAlpha = 0.4;
      pen.stroke();
      pen.globalAlpha = 1;
    }
    this.name(pen, "seconds", 8, ink);
    return HEIGHTS.axis;
  }

  private name(pen: CanvasRenderingContext2D, text: string, y: number, ink: string): void {
    pen.textAlign = "left";
    pen.fillStyle = ink;
    pen.fillText(text, 4, y, NAMES - 10);
  }

  private waveform(pen: CanvasRenderingContext2D, top: number, ink: string): number {
    const middle = top + HEIGHTS.wave / 2;
    const steps = this.wave.length / 2;
    const rate = steps / (this.data?.duration || 1);
    this.name(pen, "sound", middle, ink);
    pen.fillStyle = ink;
    pen.globalAlpha = 0.7;
    for (let x = NAMES; x < this.root.clientWidth; x++) {
      const time = (pixel: number): number => this.from + ((pixel - NAMES) / (this.root.clientWidth - NAMES)) * (this.to - this.from);
      const first = Math.floor(time(x) * rate);
      const last = Math.min(Math.max(Math.floor(time(x + 1) * rate), first + 1), steps);
      let [low, high] = [0, 0];
      for (let k = Math.max(first, 0); k < last; k++) {
        low = Math.min(low, this.wave[2 * k]);
        high = Math.max(high, this.wave[2 * k + 1]);
      }
      const scale = (HEIGHTS.wave / 2 - 2) / 127;
      pen.fillRect(x, middle - high * scale, 1, Math.max((high - low) * scale, 1));
    }
    pen.globalAlpha = 1;
    return top + HEIGHTS.wave;
  }

  private spans(pen: CanvasRenderingContext2D, top: number, name: string, spans: Span[], ink: string, line: string): number {
    const middle = top + HEIGHTS.spans / 2;
    this.name(pen, name, middle, ink);
    pen.textAlign = "center";
    pen.strokeStyle = line;
    for (const [start, end, text] of spans) {
      if (end < this.from || start > this.to) continue;
      const [x, wide] = [Math.max(this.x(start), NAMES), this.x(end) - Math.max(this.x(start), NAMES)];
      pen.strokeRect(x, top + 0.5, wide, HEIGHTS.spans - 1);
      pen.fillStyle = ink;
      if (wide > 5) pen.fillText(text, x + wide / 2, middle, wide - 2);
    }
    return top + HEIGHTS.spans;
  }

  private curve(pen: CanvasRenderingContext2D, top: number, name: string, k: number, ink: string, line: string): number {
    const floor = top + HEIGHTS.pose - 3;
    const tall = HEIGHTS.pose - 6;
    this.name(pen, name, top + HEIGHTS.pose / 2, ink);
    pen.strokeStyle = line;
    pen.beginPath();
    pen.moveTo(NAMES, floor);
    pen.lineTo(this.root.clientWidth, floor);
    pen.stroke();
    const colour = COLOURS[k % COLOURS.length];
    const first = Math.max(Math.floor(this.from * this.track.fps) - 1, 0);
    const last = Math.min(Math.ceil(this.to * this.track.fps) + 1, this.track.frames - 1);
    pen.save();
    pen.beginPath();
    pen.rect(NAMES, top, this.root.clientWidth - NAMES, HEIGHTS.pose);
    pen.clip();
    pen.beginPath();
    pen.moveTo(this.x(first / this.track.fps), floor);
    for (let f = first; f <= last; f++) {
      pen.lineTo(this.x(f / this.track.fps), floor - tall * this.track.values[f * this.track.names.length + k]);
    }
    pen.strokeStyle = colour;
    pen.lineWidth = 1.5;
    pen.stroke();
    pen.lineTo(this.x(last / this.track.fps), floor);
    pen.fillStyle = colour + "33";
    pen.fill();
    pen.restore();
    pen.lineWidth = 1;
    return top + HEIGHTS.pose;
  }

  /** The playhead, and the weights under it beside the names. */
  playhead(time: number, weights: Float32Array): void {
    const pen = this.moving.getContext("2d");
    if (!pen || !this.data) return;
    if (time > this.to || time < this.from) {
      const span = this.to - this.from;
      if (span < this.data.duration - 1e-6) {
        this.from = Math.max(0, Math.min(time - span * 0.1, this.data.duration - span));
        this.to = this.from + span;
        this.paint();
      }
    }
    const width = this.root.clientWidth;
    pen.clearRect(0, 0, width, this.height);
    const x = this.x(time);
    pen.fillStyle = this.colour("--st-primary-color", "#0072b2");
    pen.fillRect(x - 0.75, 0, 1.5, this.height);
    pen.font = "11px system-ui, sans-serif";
    pen.textAlign = "right";
    pen.textBaseline = "middle";
    let top = this.height - this.track.names.length * HEIGHTS.pose;
    weights.subarray(0, this.track.names.length).forEach((weight) => {
      if (weight >= 0.005) pen.fillText(weight.toFixed(2), NAMES - 4, top + HEIGHTS.pose / 2);
      top += HEIGHTS.pose;
    });
  }
}
