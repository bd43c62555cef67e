// The stage: one or two faces, sound, and lanes under them, all on one clock.

import { Clock } from "./clock";
import { floats, Track, type FaceData, type StageData } from "./data";
import { icon } from "./icons";
import { Lanes } from "./lanes";
import { MeshView, VIEWS } from "./mesh";
import { PictureView } from "./pictures";

interface Component {
  data: StageData;
  parentElement: HTMLElement | ShadowRoot;
  setStateValue(name: string, value: unknown): void;
  setTriggerValue(name: string, value: unknown): void;
}

type View = MeshView | PictureView;
const SPEEDS = [0.25, 0.5, 0.75, 1];

function button(face: string | SVGElement, title: string, act: () => void): HTMLButtonElement {
  const made = document.createElement("button");
  made.type = "button";
  made.append(face);
  made.title = title;
  made.setAttribute("aria-label", typeof face === "string" ? face : title);
  made.addEventListener("click", act);
  return made;
}

/** Everything that stays while Streamlit reruns. The element of class `stage` holds it as `lipdb`, for people who measure. */
export class Stage {
  readonly clock: Clock;
  private readonly audio = document.createElement("audio");
  private readonly faces = document.createElement("div");
  private readonly trouble = document.createElement("div");
  private readonly time = document.createElement("span");
  private readonly play: HTMLButtonElement;
  private readonly lanes: Lanes;
  private readonly watcher: ResizeObserver;
  private views: View[] = [];
  private kinds = "";
  private track = new Track([], new Float32Array(0), 60);
  private now = new Float32Array(0);
  private id = "";
  private drawn = -1;
  private request = 0;
  private angles = VIEWS.front;
  private component: Component | null = null;
  /** Frames drawn in the last second. */
  rate = 0;
  private frames = 0;
  private since = performance.now();

  constructor(private readonly root: HTMLElement) {
    root.tabIndex = 0;
    this.clock = new Clock(this.audio);
    this.faces.className = "faces";
    this.trouble.className = "trouble";
    this.trouble.setAttribute("role", "status");
    this.time.className = "clock";
    this.lanes = new Lanes({
      seek: (time) => this.clock.seek(time),
      select: (range) => (this.clock.loop = range),
      pick: (time) => this.component?.setTriggerValue("pick", Math.round(time * 1e4) / 1e4),
    });
    this.play = button("Play", "Play or pause (space)", () => this.toggle());
    this.play.className = "play";
    root.replaceChildren(this.faces, this.controls(), this.trouble, this.lanes.root, this.audio);
    root.addEventListener("keydown", (event) => this.key(event));
    this.watcher = new ResizeObserver(() => this.resize());
    this.watcher.observe(root);
    this.tick();
  }

  private controls(): HTMLElement {
    const row = document.createElement("div");
    row.className = "controls";
    const speeds = SPEEDS.map((speed) => button(`${speed}×`, `Play at ${speed} of the speed`, () => choose(speed)));
    const views = Object.entries(VIEWS).map(([name, angles]) => button(name, `Look from: ${name}`, () => look(name, angles)));
    const choose = (speed: number): void => {
      this.clock.setSpeed(speed);
      speeds.forEach((each, k) => each.setAttribute("aria-pressed", String(SPEEDS[k] === speed)));
    };
    const look = (name: string, angles: number[]): void => {
      this.angles = angles;
      this.views.forEach((view) => view.look(angles));
      views.forEach((each) => each.setAttribute("aria-pressed", String(each.textContent === name)));
    };
    choose(1);
    look("front", VIEWS.front);
    const space = document.createElement("span");
    space.className = "space";
    row.append(
      this.play,
      button(icon("start"), "To the start (Home)", () => this.clock.seek(this.clock.loop?.[0] ?? 0)),
      button(icon("back"), "One frame back (←)", () => this.step(-1)),
      button(icon("on"), "One frame on (→)", () => this.step(1)),
      this.time,
      ...speeds,
      space,
      ...views,
    );
    return row;
  }

  private toggle(): void {
    if (this.clock.playing) this.clock.pause();
    else void this.clock.play();
  }

  private step(frames: number): void {
    this.clock.pause();
    this.clock.seek((Math.round(this.clock.time * this.track.fps) + frames) / this.track.fps);
  }

  private label(): void {
    const what = this.clock.playing ? "Pause" : "Play";
    if (this.play.getAttribute("aria-label") === what && this.play.childElementCount) return;
    this.play.setAttribute("aria-label", what);
    this.play.replaceChildren(icon(this.clock.playing ? "pause" : "play"), ` ${what}`);
  }

  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const acts: Record<string, () => void> = {
      " ": () => this.toggle(),
      ArrowLeft: () => this.step(-1),
      ArrowRight: () => this.step(1),
      Home: () => this.clock.seek(0),
      End: () => this.clock.seek(this.clock.duration),
    };
    const act = acts[event.key];
    if (!act || (event.key === " " && event.target instanceof HTMLButtonElement)) return;
    event.preventDefault();
    act();
  }

  update(component: Component): void {
    this.component = component;
    const { data } = component;
    if (data.id === this.id) return;
    const [begins, stays] = [!this.id, this.clock.duration === data.duration];
    this.id = data.id;
    this.root.classList.toggle("compact", data.compact ?? false);
    this.trouble.textContent = "";
    this.track = new Track(data.poses, floats(data.weights), data.fps);
    this.now = new Float32Array(data.poses.length);
    this.clock.load(data.audio, data.duration);
    this.clock.loop = data.loop ?? (stays ? this.clock.loop : null);
    this.show(data.faces, data.fps);
    this.lanes.show(data, this.clock.loop);
    this.drawn = -1;
    if (begins && data.autoplay) void this.clock.play();
  }

  private show(faces: FaceData[], fps: number): void {
    const kinds = faces.map((face) => face.kind).join(" ");
    if (kinds !== this.kinds) {
      this.views.forEach((view) => view.dispose());
      this.kinds = kinds;
      this.views = faces.map((face) => this.make(face));
      this.faces.replaceChildren(
        ...this.views.map((view) => {
          const figure = document.createElement("figure");
          figure.className = "face";
          figure.style.margin = "0";
          figure.append(view.canvas, document.createElement("figcaption"));
          return figure;
        }),
      );
    }
    faces.forEach((face, k) => {
      const view = this.views[k];
      if (view instanceof MeshView && face.kind === "mesh") view.show(face, fps);
      if (view instanceof PictureView && face.kind === "pictures") view.show(face);
      view.look(this.angles);
      view.canvas.setAttribute("aria-label", face.title);
      const caption = view.canvas.nextElementSibling;
      if (caption) caption.textContent = face.title;
    });
    this.resize();
  }

  private make(face: FaceData): View {
    if (face.kind === "mesh") {
      return new MeshView((why) => {
        this.trouble.textContent = why;
      });
    }
    const view = new PictureView();
    view.canvas.className = "pictures";
    return view;
  }

  private resize(): void {
    this.views.forEach((view) => view.resize(view.canvas.clientWidth, view.canvas.clientHeight));
    this.lanes.resize();
    this.drawn = -1;
  }

  private tick(): void {
    this.request = requestAnimationFrame(() => this.tick());
    this.clock.tick();
    const time = this.clock.time;
    this.label();
    const dirty = this.views.some((view) => view.dirty);
    if (time === this.drawn && !dirty) return;
    this.drawn = time;
    this.views.forEach((view) => view.draw(time));
    this.lanes.playhead(time, this.track.at(time, this.now));
    this.time.textContent = `${time.toFixed(2)} s of ${this.clock.duration.toFixed(2)} s`;
    this.frames += 1;
    const passed = performance.now() - this.since;
    if (passed > 1000) {
      this.rate = (this.frames * 1000) / passed;
      this.frames = 0;
      this.since = performance.now();
    }
  }

  /** What is shown now: for tests, and for people who measure. */
  get state(): { time: number; playing: boolean; rate: number; poses: Record<string, number>; faces: unknown[] } {
    return {
      time: this.drawn,
      playing: this.clock.playing,
      rate: this.rate,
      poses: Object.fromEntries(this.track.names.map((name, k) => [name, this.now[k]])),
      faces: this.views.map((view) => (view instanceof MeshView ? view.state : { shown: view.shown })),
    };
  }

  dispose(): void {
    cancelAnimationFrame(this.request);
    this.watcher.disconnect();
    this.clock.pause();
    this.views.forEach((view) => view.dispose());
  }
}

const STAGES = new WeakMap<object, Stage>();

export default function (component: Component): () => void {
  const { parentElement } = component;
  let stage = STAGES.get(parentElement);
  if (!stage) {
    const root = parentElement.querySelector<HTMLElement>(".stage");
    if (!root) throw new Error("the page has no element of class stage");
    stage = new Stage(root);
    STAGES.set(parentElement, stage);
    (root as HTMLElement & { lipdb?: Stage }).lipdb = stage;
  }
  stage.update(component);
  return () => {
    STAGES.get(parentElement)?.dispose();
    STAGES.delete(parentElement);
  };
}
