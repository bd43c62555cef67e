// The curve editor: a lane for each pose, its keys over normalised time, to be dragged, added and taken away.

import { copy, normalised, same, type Curves, type KeysData } from "./curve";
import { icon } from "./icons";
import { LaneView, PAD } from "./lane";
import { mounted } from "./mount";

interface Component {
  data: KeysData;
  parentElement: HTMLElement | ShadowRoot;
  setStateValue(name: string, value: unknown): void;
}

const HELP = "Drag a key. Click a line, or double-click a lane, for a new one; double-click a key, or Delete, takes it away. Arrows move it by 0.01. Each lane goes from 0 to 1.";
const LOCKED = "You may look, but not change.";
/** Milliseconds after the last of several quick changes until they are sent. */
const PAUSE = 120;
/** Of more poses than these, those at rest are shown when they are asked for. */
const FEW = 12;

class Editor {
  private component: Component | null = null;
  private views = new Map<string, LaneView>();
  private id = "";
  private token = "";
  private past: Curves[] = [];
  private future: Curves[] = [];
  private now: Curves = {};
  private snapping = true;
  private timer = 0;
  private lengths: [number, number] = [0, 0];
  private readonly lanes = document.createElement("div");
  private readonly head = document.createElement("div");
  private readonly hint = document.createElement("span");
  private readonly undo: HTMLButtonElement;
  private readonly redo: HTMLButtonElement;
  private readonly all: HTMLButtonElement;
  private readonly rest: HTMLButtonElement;
  private readonly watcher: ResizeObserver;
  private readonly playhead = document.createElement("div");
  private readonly below: HTMLButtonElement;
  private readonly follower = (event: Event): void => this.follow((event as CustomEvent<{ stage: string; time: number }>).detail);
  private readonly listener = (event: KeyboardEvent): void => this.key(event);

  constructor(private readonly root: HTMLElement) {
    this.undo = this.button("Undo", "Take back the last change (Ctrl+Z)", () => this.travel(this.past, this.future), icon("undo"));
    this.redo = this.button("Redo", "Do it again (Ctrl+Y)", () => this.travel(this.future, this.past), icon("redo"));
    this.all = this.button("Reset pair", "Leave every pose to the layer below", () => this.reset());
    const toggle = (face: string, title: string, act: (on: boolean) => void): HTMLButtonElement => {
      const made = this.button(face, title, () => {
        const on = made.getAttribute("aria-pressed") !== "true";
        made.setAttribute("aria-pressed", String(on));
        act(on);
      });
      made.setAttribute("aria-pressed", "true");
      return made;
    };
    const snap = toggle("Snap", "Keep keys on a grid of 0.05; hold Alt to move freely", (on) => (this.snapping = on));
    this.below = toggle("", "", (on) => this.lanes.classList.toggle("plain", !on));
    this.rest = toggle("Poses at rest", "Show the poses that this pair leaves at rest", (on) => this.lanes.classList.toggle("moving", !on));
    const bar = document.createElement("div");
    bar.className = "bar";
    this.hint.className = "hint";
    bar.append(this.undo, this.redo, snap, this.below, this.rest, this.all);
    this.head.className = "head";
    this.playhead.className = "playhead";
    this.playhead.hidden = true;
    this.lanes.className = "lanes";
    root.replaceChildren(bar, this.head, this.lanes, this.hint);
    // On the whole page: a key that was focused and is taken away would take its keyboard with it.
    document.addEventListener("keydown", this.listener);
    document.addEventListener("lipdb-time", this.follower);
    this.watcher = new ResizeObserver(() => this.show());
    this.watcher.observe(root);
  }

  private button(face: string, title: string, act: () => void, sign?: SVGElement): HTMLButtonElement {
    const made = document.createElement("button");
    made.type = "button";
    made.append(...(sign ? [sign, " "] : []), face);
    made.title = title;
    made.addEventListener("click", act);
    return made;
  }

  private key(event: KeyboardEvent): void {
    const writing = event.composedPath()[0] instanceof HTMLElement && (event.composedPath()[0] as HTMLElement).matches("input, textarea");
    if (!(event.ctrlKey || event.metaKey) || writing) return;
    const name = event.key.toLowerCase();
    const back = name === "z" && !event.shiftKey;
    if (!back && name !== "y" && name !== "z") return;
    event.preventDefault();
    if (back) this.travel(this.past, this.future);
    else this.travel(this.future, this.past);
  }

  private get locked(): boolean {
    return this.component?.data.locked ?? true;
  }

  update(component: Component): void {
    this.component = component;
    const { data } = component;
    if (data.id !== this.id) this.begin(data);
    this.show();
    if (data.given && data.given.token !== this.token) {
      this.token = data.given.token;
      this.step(copy({ ...this.now, ...data.given.curves }));
    }
  }

  /** Another curve: forget what was done to the one before. */
  private begin(data: KeysData): void {
    clearTimeout(this.timer);
    this.id = data.id;
    this.token = data.given?.token ?? "";
    this.all.textContent = data.pair ? "Reset pair" : "All straight";
    this.all.title = data.pair ? "Leave every pose to the layer below" : "Let every weight through as it is";
    this.below.textContent = data.pair ? "Layer below" : "Straight";
    this.below.title = data.pair ? "Show the curve of the layer below, dashed" : "Show the straight line, dashed";
    this.rest.hidden = !data.pair;
    [this.past, this.future] = [[], []];
    this.now = copy(Object.fromEntries(data.lanes.map(({ pose, keys }) => [pose, keys])));
    const few = !data.pair || data.lanes.length <= FEW;
    this.rest.setAttribute("aria-pressed", String(few));
    this.lanes.classList.toggle("moving", !few);
    const events = {
      changed: () => this.step(this.curves()),
      snapping: () => this.snapping,
      locked: () => this.locked,
      holds: () => !this.component?.data.pair,
      silent: () => this.component?.data.silent ?? ([false, false] as [boolean, boolean]),
    };
    this.views = new Map(data.lanes.map(({ pose }) => [pose, new LaneView(pose, events)]));
    this.lanes.replaceChildren(...[...this.views.values()].map((view) => view.root), this.playhead);
    if (data.pair) this.lengths = [...data.pair.lengths];
    const names = data.pair && [data.pair.left, data.pair.right].map((phone, k) => this.name(phone, k));
    const axis = document.createElement("span");
    axis.className = "axis";
    axis.textContent = data.axis ?? "";
    this.head.replaceChildren(document.createElement("span"), ...(names ?? [axis]));
  }

  /** A phone over its half of the lanes, with how long it lasts. */
  private name(phone: string, k: number): HTMLElement {
    const made = document.createElement("label");
    if (phone === "_") {
      made.append("silence");
      return made;
    }
    const length = document.createElement("input");
    Object.assign(length, { type: "number", min: "0.01", max: "1", step: "0.01", value: String(this.lengths[k]) });
    length.title = "How long it lasts in what is drawn and played; it begins with what is usual for this pair";
    length.setAttribute("aria-label", `Seconds that ${phone} lasts`);
    length.addEventListener("change", () => {
      const value = Number(length.value);
      if (!(value >= 0.01 && value <= 1)) {
        length.value = String(this.lengths[k]);
        return;
      }
      this.lengths[k] = value;
      this.component?.setStateValue("lengths", { id: this.id, lengths: this.lengths });
    });
    made.append(phone, length, "s");
    return made;
  }

  /** Everything as it is now. */
  private show(): void {
    if (!this.component) return;
    const { data } = this.component;
    const width = Math.max(this.root.clientWidth - this.names, 200);
    for (const lane of data.lanes) this.views.get(lane.pose)?.show(lane, this.now[lane.pose] ?? null, width);
    this.undo.disabled = this.locked || !this.past.length;
    this.redo.disabled = this.locked || !this.future.length;
    this.all.disabled = this.locked || Object.values(this.now).every((keys) => keys === null);
    this.hint.textContent = this.locked ? LOCKED : HELP;
  }

  /** The width of the column of names. */
  private get names(): number {
    return this.lanes.querySelector<HTMLElement>(".lane:not(.still) .name, .name")?.offsetWidth ?? 0;
  }

  /** The playhead of the stage that plays the pair, over the lanes. */
  private follow({ stage, time }: { stage: string; time: number }): void {
    const playing = this.component?.data.pair?.playing;
    if (!playing || stage !== playing.stage) return;
    const at = normalised(time, playing.span);
    this.playhead.hidden = at === null;
    if (at !== null) this.playhead.style.left = `${this.names + PAD + at * (this.root.clientWidth - this.names - 2 * PAD)}px`;
  }

  private curves(): Curves {
    return copy(Object.fromEntries([...this.views].map(([pose, view]) => [pose, view.keys])));
  }

  /** One change that can be undone. */
  private step(curves: Curves): void {
    if (this.locked || same(curves, this.now)) return;
    this.past.push(this.now);
    this.future = [];
    this.go(curves);
  }

  private reset(): void {
    this.step(Object.fromEntries(Object.keys(this.now).map((pose) => [pose, null])));
  }

  private travel(from: Curves[], to: Curves[]): void {
    const target = this.locked ? undefined : from.pop();
    if (!target) return;
    to.push(this.now);
    this.go(target);
  }

  private go(curves: Curves): void {
    this.now = curves;
    this.show();
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.component?.setStateValue("curves", { id: this.id, taken: this.token, curves: this.now }), PAUSE);
  }

  dispose(): void {
    clearTimeout(this.timer);
    this.watcher.disconnect();
    document.removeEventListener("keydown", this.listener);
    document.removeEventListener("lipdb-time", this.follower);
  }
}

export default mounted("keys", (root) => new Editor(root));
