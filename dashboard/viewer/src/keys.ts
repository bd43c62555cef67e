// The curve editor: a lane for each pose, its keys over normalised time, to be dragged, added and taken away.

export type Key = [time: number, weight: number];

interface Lane {
  pose: string;
  keys: Key[];
  /** The curve of the layer below, drawn thin; null when this pose has none there. */
  below: Key[] | null;
  /** What the engine makes of the curve for phones of these lengths: normalised time and weight. */
  drawn: Key[];
}

interface KeysData {
  id: string;
  left: string;
  right: string;
  lanes: Lane[];
  locked: boolean;
}

interface Component {
  data: KeysData;
  parentElement: HTMLElement | ShadowRoot;
  setStateValue(name: string, value: unknown): void;
}

const WIDTH = 760;
const HEIGHT = 84;
const NAME = 76;
const PAD = 9;
const GRID = 0.05;
const CLOSE = 0.004;

function svg<K extends keyof SVGElementTagNameMap>(tag: K, attributes: Record<string, string | number> = {}): SVGElementTagNameMap[K] {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, String(value));
  return made;
}

function round(value: number): number {
  return Math.round(value * 1000) / 1000;
}

/** One pose's keys and how they are drawn. */
class LaneView {
  readonly root = svg("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, class: "lane", role: "group" });
  keys: Key[] = [];
  private lane: Lane | null = null;
  private handles: SVGCircleElement[] = [];
  private readonly line = svg("polyline", { class: "line" });
  private readonly hit = svg("polyline", { class: "hit" });

  constructor(
    private readonly pose: string,
    private readonly changed: (done: boolean) => void,
    private readonly snap: () => boolean,
    private readonly locked: () => boolean,
  ) {
    this.root.setAttribute("aria-label", `Curve of ${pose}`);
    this.hit.addEventListener("pointerdown", (event) => this.add(event));
    this.root.addEventListener("dblclick", (event) => {
      if (event.target === this.root && !this.keys.length) this.add(event);
    });
  }

  private x(time: number): number {
    return NAME + PAD + time * (WIDTH - NAME - 2 * PAD);
  }

  private y(weight: number): number {
    return HEIGHT - PAD - weight * (HEIGHT - 2 * PAD);
  }

  private points(keys: Key[]): string {
    return keys.map(([time, weight]) => `${this.x(time).toFixed(1)},${this.y(weight).toFixed(1)}`).join(" ");
  }

  private place(event: MouseEvent): Key {
    const box = this.root.getBoundingClientRect();
    const time = (((event.clientX - box.left) / box.width) * WIDTH - NAME - PAD) / (WIDTH - NAME - 2 * PAD);
    const weight = (HEIGHT - PAD - ((event.clientY - box.top) / box.height) * HEIGHT) / (HEIGHT - 2 * PAD);
    const snapped = (value: number): number => (this.snap() && !event.altKey ? Math.round(value / GRID) * GRID : value);
    return [round(Math.min(Math.max(snapped(time), 0), 1)), round(Math.min(Math.max(snapped(weight), 0), 1))];
  }

  show(lane: Lane, keys: Key[]): void {
    this.lane = lane;
    this.keys = keys.map(([time, weight]) => [time, weight]);
    this.paint();
  }

  private paint(): void {
    const parts: SVGElement[] = [];
    const name = svg("text", { x: 4, y: HEIGHT / 2, class: "pose" });
    name.textContent = this.pose;
    parts.push(name);
    for (const weight of [0, 0.5, 1]) {
      parts.push(svg("line", { x1: this.x(0), x2: this.x(1), y1: this.y(weight), y2: this.y(weight), class: "grid" }));
    }
    for (const time of [0, 0.25, 0.5, 0.75, 1]) {
      const border = time === 0.5 ? "grid border" : "grid";
      parts.push(svg("line", { x1: this.x(time), x2: this.x(time), y1: this.y(0), y2: this.y(1), class: border }));
    }
    if (this.lane?.below) parts.push(svg("polyline", { points: this.points(this.lane.below), class: "below" }));
    if (this.lane?.drawn.length) {
      const ends: Key[] = [[this.lane.drawn[0][0], 0], ...this.lane.drawn, [this.lane.drawn[this.lane.drawn.length - 1][0], 0]];
      parts.push(svg("polygon", { points: this.points(ends), class: "drawn" }));
    }
    this.handles = this.keys.map((_, k) => this.handle(k));
    this.root.replaceChildren(...parts, this.line, this.hit, ...this.handles);
    this.move();
  }

  /** Put line and handles where the keys are. */
  private move(): void {
    for (const line of [this.line, this.hit]) line.setAttribute("points", this.points(this.keys));
    this.handles.forEach((handle, k) => {
      handle.setAttribute("cx", this.x(this.keys[k][0]).toFixed(1));
      handle.setAttribute("cy", this.y(this.keys[k][1]).toFixed(1));
      handle.setAttribute("aria-label", `Key at ${this.keys[k][0]}, weight ${this.keys[k][1]}`);
    });
  }

  private handle(k: number): SVGCircleElement {
    const made = svg("circle", { r: 6, class: "key", tabindex: this.locked() ? -1 : 0, role: "slider" });
    made.dataset.index = String(k);
    made.addEventListener("pointerdown", (event) => {
      event.stopPropagation();
      if (!this.locked()) this.grab(event, k);
    });
    made.addEventListener("dblclick", (event) => {
      event.stopPropagation();
      this.remove(k);
    });
    made.addEventListener("keydown", (event) => this.nudge(event, k));
    return made;
  }

  private grab(event: PointerEvent, k: number, added = false): void {
    const handle = this.handles[k];
    const before = JSON.stringify(this.keys);
    handle.setPointerCapture(event.pointerId);
    handle.focus();
    handle.onpointermove = (moved) => {
      const [time, weight] = this.place(moved);
      this.put(k, time, weight);
    };
    handle.onpointerup = handle.onpointercancel = () => {
      handle.onpointermove = handle.onpointerup = handle.onpointercancel = null;
      if (added || JSON.stringify(this.keys) !== before) this.changed(true);
    };
  }

  /** Move a key, between its neighbours. */
  private put(k: number, time: number, weight: number): void {
    const low = k ? this.keys[k - 1][0] + CLOSE : 0;
    const high = k < this.keys.length - 1 ? this.keys[k + 1][0] - CLOSE : 1;
    this.keys[k] = [round(Math.min(Math.max(time, low), high)), round(Math.min(Math.max(weight, 0), 1))];
    this.move();
    this.changed(false);
  }

  private add(event: MouseEvent): void {
    if (this.locked()) return;
    const made = this.place(event);
    if (this.keys.some(([time]) => Math.abs(time - made[0]) < CLOSE)) return;
    const k = this.keys.filter(([time]) => time < made[0]).length;
    this.keys.splice(k, 0, made);
    this.paint();
    if (event instanceof PointerEvent && event.type === "pointerdown") this.grab(event, k, true);
    else this.changed(true);
  }

  private remove(k: number): void {
    if (this.locked()) return;
    this.keys.splice(k, 1);
    this.paint();
    this.handles[Math.min(k, this.handles.length - 1)]?.focus();
    this.changed(true);
  }

  private nudge(event: KeyboardEvent, k: number): void {
    if (this.locked()) return;
    if (event.key === "Delete" || event.key === "Backspace") {
      event.preventDefault();
      this.remove(k);
      return;
    }
    const size = event.shiftKey ? GRID : 0.01;
    const steps: Record<string, Key> = { ArrowLeft: [-size, 0], ArrowRight: [size, 0], ArrowUp: [0, size], ArrowDown: [0, -size] };
    const step = steps[event.key];
    if (!step) return;
    event.preventDefault();
    this.put(k, this.keys[k][0] + step[0], this.keys[k][1] + step[1]);
    this.changed(true);
  }
}

type Curves = Record<string, Key[]>;

class Editor {
  private component: Component | null = null;
  private views = new Map<string, LaneView>();
  private id = "";
  private past: Curves[] = [];
  private future: Curves[] = [];
  private saved: Curves = {};
  private snapping = true;
  private readonly lanes = document.createElement("div");
  private readonly head = document.createElement("div");
  private readonly undo: HTMLButtonElement;
  private readonly redo: HTMLButtonElement;

  constructor(root: HTMLElement) {
    const button = (text: string, title: string, act: () => void): HTMLButtonElement => {
      const made = document.createElement("button");
      made.type = "button";
      made.textContent = text;
      made.title = title;
      made.addEventListener("click", act);
      return made;
    };
    this.undo = button("Undo", "Take back the last change (Ctrl+Z)", () => this.travel(this.past, this.future));
    this.redo = button("Redo", "Do it again (Ctrl+Y)", () => this.travel(this.future, this.past));
    const snap = button("Snap", "Keep keys on a grid of 0.05; hold Alt to move freely", () => {
      this.snapping = !this.snapping;
      snap.setAttribute("aria-pressed", String(this.snapping));
    });
    snap.setAttribute("aria-pressed", "true");
    const bar = document.createElement("div");
    bar.className = "bar";
    const hint = document.createElement("span");
    hint.className = "hint";
    hint.textContent = "Drag a key. Click a line to add one, double-click a key (or Delete) to take it away.";
    bar.append(this.undo, this.redo, snap, hint);
    this.head.className = "head";
    root.replaceChildren(bar, this.head, this.lanes);
    root.addEventListener("keydown", (event) => this.key(event));
  }

  private key(event: KeyboardEvent): void {
    if (!(event.ctrlKey || event.metaKey)) return;
    const name = event.key.toLowerCase();
    const back = name === "z" && !event.shiftKey;
    if (!back && name !== "y" && name !== "z") return;
    event.preventDefault();
    event.stopPropagation();
    if (back) this.travel(this.past, this.future);
    else this.travel(this.future, this.past);
  }

  private curves(): Curves {
    return Object.fromEntries([...this.views].map(([pose, view]) => [pose, view.keys.map(([t, w]) => [t, w] as Key)]));
  }

  update(component: Component): void {
    this.component = component;
    const { data } = component;
    const fresh = data.id !== this.id;
    if (fresh) {
      this.id = data.id;
      [this.past, this.future] = [[], []];
      this.views = new Map(
        data.lanes.map(({ pose }) => [
          pose,
          new LaneView(pose, (done) => this.changed(done), () => this.snapping, () => this.component?.data.locked ?? true),
        ]),
      );
      this.lanes.replaceChildren(...[...this.views.values()].map((view) => view.root));
      this.head.innerHTML = "";
      for (const [phone, length] of [[data.left, 0.25], [data.right, 0.75]] as const) {
        const name = document.createElement("span");
        name.textContent = phone;
        name.style.left = `${(100 * (NAME + PAD + length * (WIDTH - NAME - 2 * PAD))) / WIDTH}%`;
        this.head.append(name);
      }
    }
    for (const lane of data.lanes) {
      const view = this.views.get(lane.pose);
      view?.show(lane, fresh ? lane.keys : view.keys);
    }
    if (fresh) this.saved = this.curves();
    this.buttons();
  }

  private changed(done: boolean): void {
    if (!done) return;
    this.past.push(this.saved);
    this.future = [];
    this.send();
  }

  private travel(from: Curves[], to: Curves[]): void {
    const target = from.pop();
    if (!target || !this.component) return;
    to.push(this.saved);
    for (const lane of this.component.data.lanes) this.views.get(lane.pose)?.show(lane, target[lane.pose] ?? []);
    this.send();
  }

  private send(): void {
    this.saved = this.curves();
    this.buttons();
    this.component?.setStateValue("curves", { id: this.id, curves: this.saved });
  }

  private buttons(): void {
    this.undo.disabled = !this.past.length;
    this.redo.disabled = !this.future.length;
  }
}

const EDITORS = new WeakMap<object, Editor>();

export default function (component: Component): void {
  const { parentElement } = component;
  let editor = EDITORS.get(parentElement);
  if (!editor) {
    const root = parentElement.querySelector<HTMLElement>(".keys");
    if (!root) throw new Error("the page has no element of class keys");
    editor = new Editor(root);
    EDITORS.set(parentElement, editor);
  }
  editor.update(component);
}
