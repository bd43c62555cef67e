// One pose of the curve editor: its keys, the layer below, and what the engine makes of them.

import { added, GRID, held, moved, rested, round, type Key, type Lane } from "./curve";
import { icon } from "./icons";

/** Pixels of a lane over time, and of one from weights to weights. */
const HEIGHTS = [50, 120];
export const PAD = 7;
const SIZE = 6;
const ZERO: Key[] = [[0, 0], [1, 0]];

function svg<K extends keyof SVGElementTagNameMap>(tag: K, attributes: Record<string, string | number> = {}): SVGElementTagNameMap[K] {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  set(made, attributes);
  return made;
}

function set(element: Element, attributes: Record<string, string | number>): void {
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
}

export interface LaneEvents {
  /** A change has come to its end: one step to undo. */
  changed(): void;
  snapping(): boolean;
  locked(): boolean;
  silent(): [boolean, boolean];
  /** Whether the first and the last key hold beyond them; else the curve is at rest there. */
  holds(): boolean;
}

export class LaneView {
  readonly root = document.createElement("div");
  /** Keys of the edited layer; null while the layer below counts. */
  keys: Key[] | null = null;
  private lane: Lane | null = null;
  private width = 600;
  private handles: SVGCircleElement[] = [];
  private held: { k: number; before: string; added: boolean; pointer: number } | null = null;
  private readonly plot = svg("svg", { class: "plot", role: "group" });
  private readonly grid = svg("g", { class: "grid" });
  private readonly drawn = svg("polygon", { class: "drawn" });
  private readonly below = svg("polyline", { class: "below" });
  private readonly line = svg("polyline", { class: "line" });
  private readonly hit = svg("polyline", { class: "hit" });
  private readonly dots = svg("g");
  private readonly value = svg("text", { class: "value" });
  private readonly state = document.createElement("span");
  private readonly reset = document.createElement("button");

  constructor(readonly pose: string, private readonly events: LaneEvents) {
    this.root.className = "lane";
    this.root.dataset.pose = pose;
    const name = document.createElement("span");
    name.className = "pose";
    name.textContent = pose;
    this.state.className = "state";
    this.reset.type = "button";
    this.reset.className = "reset";
    this.reset.append(icon("undo"));
    this.reset.addEventListener("click", () => this.replace(null));
    const head = document.createElement("div");
    head.className = "name";
    head.append(name, this.state, this.reset);
    this.plot.setAttribute("aria-label", `Curve of ${pose}`);
    this.plot.append(this.grid, this.drawn, this.below, this.line, this.hit, this.dots, this.value);
    this.plot.addEventListener("pointerdown", (event) => this.press(event));
    this.plot.addEventListener("pointermove", (event) => this.drag(event));
    for (const end of ["pointerup", "pointercancel"] as const) this.plot.addEventListener(end, () => this.release());
    this.plot.addEventListener("dblclick", (event) => this.doubled(event));
    this.root.append(head, this.plot);
  }

  /** The keys that count: the layer's own, or those below. */
  get counting(): Key[] {
    return this.keys ?? this.lane?.below ?? [];
  }

  show(lane: Lane, keys: Key[] | null, width: number): void {
    this.lane = lane;
    this.width = width;
    if (!this.held) this.keys = keys;
    this.frame();
    this.paint();
  }

  private get height(): number {
    return HEIGHTS[Number(this.events.holds())];
  }

  private x(time: number): number {
    return PAD + time * (this.width - 2 * PAD);
  }

  private y(weight: number): number {
    return this.height - PAD - weight * (this.height - 2 * PAD);
  }

  private points(keys: Key[]): string {
    return keys.map(([time, weight]) => `${this.x(time).toFixed(1)},${this.y(weight).toFixed(1)}`).join(" ");
  }

  private place(event: MouseEvent): Key {
    const box = this.plot.getBoundingClientRect();
    const snapped = (value: number): number => (this.events.snapping() && !event.altKey ? Math.round(value / GRID) * GRID : value);
    const time = (event.clientX - box.left - PAD) / (this.width - 2 * PAD);
    const weight = (this.height - PAD - (event.clientY - box.top)) / (this.height - 2 * PAD);
    return [round(snapped(time)), round(snapped(weight))];
  }

  /** What does not change while keys are dragged. */
  private frame(): void {
    set(this.plot, { width: this.width, height: this.height });
    const across = [0, 0.5, 1].map((weight) => svg("line", { x1: this.x(0), x2: this.x(1), y1: this.y(weight), y2: this.y(weight) }));
    const up = [0, 0.25, 0.5, 0.75, 1].map((time) => {
      const line = svg("line", { x1: this.x(time), x2: this.x(time), y1: this.y(0), y2: this.y(1) });
      if (time === 0.5 && !this.events.holds()) line.classList.add("border");
      return line;
    });
    this.grid.replaceChildren(...across, ...up);
    const { drawn, below, from, note } = this.lane ?? { drawn: [], below: [], from: "", note: "" };
    const ends: Key[] = drawn.length ? [[drawn[0][0], 0], ...drawn, [drawn[drawn.length - 1][0], 0]] : [];
    this.drawn.setAttribute("points", this.points(ends));
    this.below.setAttribute("points", this.points(below));
    this.root.title = note;
    this.reset.title = `Back to ${from}`;
    this.reset.setAttribute("aria-label", `Reset ${this.pose} to ${from}`);
  }

  /** Line and handles where the keys are. */
  private paint(): void {
    const keys = this.counting;
    const own = this.keys !== null;
    this.root.classList.toggle("own", own);
    this.root.classList.toggle("still", !keys.length && !this.lane?.below.length);
    this.reset.hidden = !own || this.events.locked();
    this.state.textContent = this.lane?.note ? "overridden" : own ? (keys.length ? "" : "zero") : (this.lane?.from ?? "");
    const whole = this.events.holds() ? held(keys) : keys;
    for (const line of [this.line, this.hit]) line.setAttribute("points", this.points(whole.length ? whole : ZERO));
    while (this.handles.length > keys.length) this.handles.pop()?.remove();
    while (this.handles.length < keys.length) this.handles.push(this.handle(this.handles.length));
    this.handles.forEach((handle, k) => {
      const [time, weight] = keys[k];
      set(handle, {
        cx: this.x(time).toFixed(1),
        cy: this.y(weight).toFixed(1),
        tabindex: this.events.locked() ? -1 : 0,
        "aria-label": `${this.pose}: key ${k + 1} of ${keys.length}`,
        "aria-valuetext": `time ${time}, weight ${weight}`,
        "aria-valuenow": weight,
      });
    });
    const k = this.held?.k ?? -1;
    this.value.textContent = keys[k] ? `${keys[k][0]} : ${keys[k][1]}` : "";
    if (keys[k]) {
      const right = keys[k][0] > 0.85;
      set(this.value, { x: this.x(keys[k][0]) + (right ? -12 : 12), y: Math.max(this.y(keys[k][1]), 14), "text-anchor": right ? "end" : "start" });
    }
  }

  private handle(k: number): SVGCircleElement {
    const made = svg("circle", { r: SIZE, class: "key", role: "slider", "aria-valuemin": 0, "aria-valuemax": 1 });
    made.dataset.index = String(k);
    made.addEventListener("keydown", (event) => this.nudge(event, k));
    this.dots.append(made);
    return made;
  }

  private index(target: EventTarget | null): number {
    return target instanceof SVGCircleElement ? Number(target.dataset.index) : -1;
  }

  private press(event: PointerEvent): void {
    if (this.events.locked() || event.button) return;
    let k = this.index(event.target);
    const before = JSON.stringify(this.keys);
    const fresh = k < 0 && event.target === this.hit ? this.add(event) : -1;
    k = Math.max(k, fresh);
    if (k < 0) return;
    event.preventDefault();
    this.plot.setPointerCapture(event.pointerId);
    this.held = { k, before, added: fresh >= 0, pointer: event.pointerId };
    this.handles[k].focus();
    this.paint();
  }

  private drag(event: PointerEvent): void {
    if (!this.held || event.pointerId !== this.held.pointer) return;
    this.put(moved(this.counting, this.held.k, this.place(event)));
  }

  private release(): void {
    if (!this.held) return;
    const { before } = this.held;
    this.held = null;
    this.paint();
    if (JSON.stringify(this.keys) !== before) this.events.changed();
  }

  private doubled(event: MouseEvent): void {
    if (this.events.locked()) return;
    const k = this.index(event.target);
    if (k >= 0) this.remove(k);
    else if (event.target !== this.hit && this.add(event) >= 0) this.events.changed();
  }

  private put(keys: Key[]): void {
    this.keys = rested(keys, this.events.silent());
    this.paint();
  }

  /** A new key where the pointer is; its index, -1 where there is no room. */
  private add(event: MouseEvent): number {
    const found = added(this.counting, this.place(event));
    if (!found) return -1;
    this.put(found[0]);
    return found[1];
  }

  private remove(k: number): void {
    const place = Math.min(k, this.counting.length - 2);
    const left = this.counting.filter((_, i) => i !== k);
    this.replace(this.events.holds() && !left.length ? null : left);
    this.handles[place]?.focus();
  }

  /** Other keys as one step; null for those of the layer below. */
  private replace(keys: Key[] | null): void {
    if (keys) this.put(keys);
    else {
      this.keys = null;
      this.paint();
    }
    this.events.changed();
  }

  private nudge(event: KeyboardEvent, k: number): void {
    if (this.events.locked() || event.ctrlKey || event.metaKey) return;
    const size = event.shiftKey ? GRID : 0.01;
    const steps: Record<string, Key> = { ArrowLeft: [-size, 0], ArrowRight: [size, 0], ArrowUp: [0, size], ArrowDown: [0, -size] };
    const step = steps[event.key];
    const away = event.key === "Delete" || event.key === "Backspace";
    if (!step && !away) return;
    event.preventDefault();
    event.stopPropagation();
    if (away) this.remove(k);
    else {
      const [time, weight] = this.counting[k];
      this.put(moved(this.counting, k, [time + step[0], weight + step[1]]));
      this.events.changed();
    }
  }
}
