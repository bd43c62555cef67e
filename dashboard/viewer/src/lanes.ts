// Waveform, words, phones and pose curves over one time axis, with the playhead on top.

import { spanAt, type Loaded, type Span, type StageData } from "./data";
import { Playhead } from "./playhead";
import { rowsOf, xOf, type Axis, type Row, type Theme } from "./rows";

const NARROW = 4; // pixels that a pointer may move and still be a click
const SHORTEST = 0.02; // seconds of a loop
const CLOSEST = 0.1; // seconds that fill the lanes
const MARKED = "#e69f0055";
const [LEAST, MOST] = [84, 168]; // pixels beside the lanes
const EDGE = 4; // pixels around names and values

export type Range = [start: number, end: number];

export interface LaneEvents {
  seek(time: number): void;
  select(range: Range | null): void;
  pick(time: number): void;
}

/** Whether `colour`, as a browser computes it, is nearer to white than to black: letters are so on a dark page. */
function bright(colour: string): boolean {
  const [red = 0, green = 0, blue = 0] = (colour.match(/[\d.]+/g) ?? []).map(Number);
  return red + green + blue > 382;
}

/** What stays is painted when it changes; what moves (`Playhead`) stands over it, and over all what the pointer hits. */
export class Lanes {
  readonly root = document.createElement("div");
  private readonly still = document.createElement("canvas");
  private readonly chosen = document.createElement("div");
  private readonly playhead = new Playhead();
  private readonly over = document.createElement("div");
  private data: StageData | null = null;
  private rows: Row[] = [];
  private theme: Theme = { ink: "#222", line: "#ccc", font: "12px sans-serif", dark: false };
  private axis: Axis = { from: 0, to: 1, left: LEAST, right: LEAST + 1 };
  private selection: Range | null = null;
  private shown = 0;
  private pressed: { x: number; time: number; selects: boolean; moved: boolean } | null = null;
  /** Times that all has been painted anew. */
  painted = 0;

  constructor(private readonly events: LaneEvents) {
    this.root.className = "lanes";
    this.over.className = "over";
    this.over.tabIndex = 0;
    this.over.setAttribute("role", "slider");
    this.over.setAttribute("aria-label", "Time");
    this.over.setAttribute("aria-valuemin", "0");
    this.chosen.className = "chosen";
    this.root.append(this.still, this.chosen, this.playhead.values, this.playhead.line, this.over);
    this.over.addEventListener("pointerdown", (event) => this.press(event));
    this.over.addEventListener("pointermove", (event) => this.drag(event));
    this.over.addEventListener("pointerup", (event) => this.release(event));
    this.over.addEventListener("pointercancel", () => (this.pressed = null));
    this.over.addEventListener("dblclick", (event) => this.chooseWord(event));
    this.over.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    // The colour of letters changes with the page's theme, and a change of it takes a (very short) transition.
    this.root.addEventListener("transitionend", () => {
      this.paint();
      this.at(this.shown, true); // while nothing plays, nobody else asks
    });
  }

  show(data: StageData, faces: Loaded[], peaks: Int8Array, selection: Range | null): void {
    const longer = this.data?.duration !== data.duration;
    this.data = data;
    this.rows = rowsOf(data, faces, peaks);
    this.axis.left = this.beside();
    if (longer) [this.axis.from, this.axis.to] = [0, Math.max(data.duration, CLOSEST)];
    this.selection = selection;
    this.over.setAttribute("aria-valuemax", data.duration.toFixed(2));
    this.resize();
  }

  /** Drawn by the processor, as it changes seldom: so it is a part of the page, not a layer that every frame of the screen has to blend. */
  private get pen(): CanvasRenderingContext2D | null {
    return this.still.getContext("2d", { willReadFrequently: true });
  }

  /** How wide the names are with the values beside them. */
  private beside(): number {
    const { pen } = this;
    if (!pen) return LEAST;
    this.readTheme();
    pen.font = this.theme.font;
    const wide = (text: string): number => (text ? pen.measureText(text).width + 2 * EDGE : 0);
    const most = Math.max(...this.rows.map(({ name, widest }) => wide(name) + wide(widest ?? "")));
    return Math.min(Math.max(Math.ceil(most), LEAST), MOST);
  }

  private get height(): number {
    return this.rows.reduce((sum, row) => sum + row.height, 0) + 2;
  }

  resize(): void {
    const width = this.root.clientWidth;
    const ratio = Math.min(devicePixelRatio, 2);
    this.root.style.height = `${this.height}px`;
    this.axis.right = Math.max(width, this.axis.left + 1);
    this.still.width = Math.round(width * ratio);
    this.still.height = Math.round(this.height * ratio);
    this.pen?.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.playhead.resize(this.axis.left, this.height, ratio);
    this.paint();
  }

  private time(event: MouseEvent): number {
    const { from, to, left, right } = this.axis;
    const x = event.clientX - this.over.getBoundingClientRect().left;
    return Math.min(Math.max(from + ((x - left) / (right - left)) * (to - from), 0), this.data?.duration ?? 0);
  }

  private press(event: PointerEvent): void {
    if (event.button) return;
    this.over.setPointerCapture(event.pointerId);
    const ruler = event.clientY - this.over.getBoundingClientRect().top < (this.rows[0]?.height ?? 0);
    this.pressed = { x: event.clientX, time: this.time(event), selects: ruler || event.shiftKey, moved: false };
    this.events.seek(this.pressed.time);
  }

  private drag(event: PointerEvent): void {
    if (!this.pressed) return;
    this.pressed.moved ||= Math.abs(event.clientX - this.pressed.x) > NARROW;
    if (!this.pressed.moved) return;
    const time = this.time(event);
    if (this.pressed.selects) this.choose([Math.min(time, this.pressed.time), Math.max(time, this.pressed.time)]);
    else this.events.seek(time);
  }

  private release(event: PointerEvent): void {
    if (this.pressed && !this.pressed.moved && event.detail < 2) this.events.pick(this.pressed.time);
    this.pressed = null;
  }

  /** Loop the word, phone or common phone that was hit; anywhere else, loop nothing. */
  private chooseWord(event: MouseEvent): void {
    let y = event.clientY - this.over.getBoundingClientRect().top;
    const row = this.rows.find(({ height }) => (y -= height) < 0);
    const spans = this.data?.[row?.name as "words"];
    this.choose(Array.isArray(spans) ? this.spanOf(spans, this.time(event)) : null);
  }

  private spanOf(spans: Span[], time: number): Range | null {
    const k = spanAt(spans, time);
    return k < 0 ? null : [spans[k][0], spans[k][1]];
  }

  /** The word at `time`, else the whole line: what a loop begins with. */
  around(time: number): Range {
    const whole: Range = [0, this.data?.duration ?? 0];
    return this.spanOf(this.data?.words ?? [], time) ?? whole;
  }

  /** Where the phone before or after `time` begins. */
  phoneBeside(time: number, way: 1 | -1): number {
    const starts = [0, ...(this.data?.common ?? []).flatMap(([start, end]) => [start, end])];
    const found = starts.filter((start) => (way > 0 ? start > time + 1e-3 : start < time - 1e-3));
    return way > 0 ? Math.min(...found, this.data?.duration ?? 0) : Math.max(...found, 0);
  }

  choose(range: Range | null): void {
    this.selection = range && range[1] - range[0] > SHORTEST ? range : null;
    this.mark();
    this.events.select(this.selection);
  }

  /** Zoom around the pointer; without Ctrl the page scrolls as always. */
  private wheel(event: WheelEvent): void {
    if (!event.ctrlKey) return;
    event.preventDefault();
    this.zoom(Math.exp(event.deltaY / 400), this.time(event));
  }

  /** Show `factor` times as much, with `at` staying where it is; 0 shows everything. */
  zoom(factor: number, at: number): void {
    if (!this.data) return;
    const whole = Math.max(this.data.duration, CLOSEST);
    const { from, to } = this.axis;
    const span = factor ? Math.min(Math.max((to - from) * factor, CLOSEST), whole) : whole;
    this.scroll(at - (at - from) * (span / (to - from)), span, whole);
  }

  private scroll(from: number, span: number, whole: number): void {
    this.axis.from = Math.max(0, Math.min(from, whole - span));
    this.axis.to = this.axis.from + span;
    this.paint();
  }

  private readTheme(): void {
    const style = getComputedStyle(this.root);
    const read = (name: string, fallback: string): string => style.getPropertyValue(name).trim() || fallback;
    this.theme = {
      ink: style.color || "#222",
      line: read("--st-border-color", "#ccc"),
      font: `12px ${style.fontFamily || "sans-serif"}`,
      dark: bright(style.color),
    };
  }

  private paint(): void {
    const { pen } = this;
    if (!pen || !this.data) return;
    this.painted += 1;
    this.readTheme();
    const { left, right } = this.axis;
    pen.clearRect(0, 0, right, this.height);
    pen.textBaseline = "middle";
    pen.font = this.theme.font;
    pen.textAlign = "left";
    pen.fillStyle = this.theme.ink;
    let top = 0;
    for (const { name, height, widest } of this.rows) {
      pen.fillText(name, EDGE, top + height / 2, left - 2 * EDGE - (widest ? pen.measureText(widest).width + EDGE : 0));
      top += height;
    }
    pen.save();
    pen.beginPath();
    pen.rect(left - 12, 0, right - left + 12, this.height);
    pen.clip();
    pen.fillStyle = MARKED;
    for (const [start, end] of this.data.marks ?? []) pen.fillRect(xOf(this.axis, start), 0, xOf(this.axis, end) - xOf(this.axis, start), this.height);
    top = 0;
    for (const row of this.rows) {
      row.draw(pen, top, this.axis, this.theme);
      top += row.height;
    }
    pen.restore();
    this.mark();
    this.playhead.anew();
  }

  private mark(): void {
    const [start, end] = (this.selection ?? [0, 0]).map((each) => Math.min(Math.max(xOf(this.axis, each), this.axis.left), this.axis.right));
    this.chosen.style.left = `${start}px`;
    this.chosen.style.width = `${end - start}px`;
  }

  /** Show where the playhead stands, and the weights there if they are `legible` now. */
  at(time: number, legible: boolean): void {
    if (!this.data) return;
    this.shown = time;
    const { from, to } = this.axis;
    const [span, whole] = [to - from, Math.max(this.data.duration, CLOSEST)];
    if ((time > to || time < from) && span < whole - 1e-6) this.scroll(time - span * 0.1, span, whole);
    this.playhead.stand(xOf(this.axis, time));
    if (legible) this.playhead.write(time, this.rows, this.axis.left - EDGE, this.theme);
  }

  /** Tell people who hear the page where time stands. */
  tell(time: number): void {
    const now = ["words", "phones"].map((name) => {
      const spans = this.data?.[name as "words"] ?? [];
      return spans[spanAt(spans, time)]?.[2] ?? "";
    });
    this.over.setAttribute("aria-valuenow", time.toFixed(2));
    this.over.setAttribute("aria-valuetext", [`${time.toFixed(2)} seconds`, ...now.filter(Boolean)].join(", "));
  }
}
