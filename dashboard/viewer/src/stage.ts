// The stage: one or two faces, sound, and lanes under them, all on one clock.

import { Clock } from "./clock";
import { Controls } from "./controls";
import { loaded, Track, type Loaded, type StageData } from "./data";
import { Faces } from "./faces";
import { bytes } from "./files";
import { Lanes } from "./lanes";
import { mounted } from "./mount";

interface Component {
  data: StageData;
  parentElement: HTMLElement | ShadowRoot;
  setStateValue(name: string, value: unknown): void;
  setTriggerValue(name: string, value: unknown): void;
}

const LATELY = 0.1; // how much of the mean the last frame makes
const LEGIBLE = 90; // milliseconds: numbers that change more often nobody reads, and each costs a layout

function element(name: string, role = ""): HTMLDivElement {
  const made = document.createElement("div");
  made.className = name;
  if (role) made.setAttribute("role", role);
  return made;
}

/** Everything that stays while Streamlit reruns. The element of class `stage` holds it as `lipdb`, for people who measure. */
export class Stage {
  readonly clock: Clock;
  private readonly audio = document.createElement("audio");
  private readonly faces = new Faces((why) => this.complain(why));
  private readonly trouble = element("trouble", "status");
  private readonly controls: Controls;
  private readonly lanes: Lanes;
  private readonly watcher: ResizeObserver;
  private poses = new Track();
  private now = new Float32Array(0);
  private id = "";
  private drawn = -1;
  private changed = true;
  private component: Component | null = null;
  private request = 0;
  private last = 0;
  private told = 0;
  private written = 0;
  private ran = false;
  /** Milliseconds between frames, and what faces and lanes take of it on the processor: means of the last ones played. */
  private readonly pace = { frame: 0, faces: 0, lanes: 0 };

  constructor(private readonly root: HTMLElement) {
    root.setAttribute("role", "group");
    root.setAttribute("aria-label", "Player");
    this.clock = new Clock(this.audio, () => this.complain("The sound could not be loaded; the line plays without it. Reload the page."));
    this.lanes = new Lanes({
      seek: (time) => this.clock.seek(time),
      select: (range) => this.repeat(range),
      pick: (time) => this.component?.setTriggerValue("pick", Math.round(time * 1e4) / 1e4),
    });
    this.controls = new Controls({
      toggle: () => (this.clock.playing ? this.clock.pause() : this.clock.play()),
      start: () => this.clock.seek(this.clock.loop?.[0] ?? 0),
      end: () => this.clock.seek(this.clock.loop?.[1] ?? this.clock.duration),
      step: (frames) => this.step(frames),
      phone: (way) => this.clock.seek(this.lanes.phoneBeside(this.clock.time, way)),
      speed: (value) => this.clock.setSpeed(value),
      loop: () => this.lanes.choose(this.clock.loop ? null : this.lanes.around(this.clock.time)),
      mute: () => this.mute(),
      zoom: (factor) => this.zoom(factor),
      look: (view) => this.faces.look(view),
    });
    const scene = element("scene");
    scene.append(this.faces.root, this.controls.look);
    root.replaceChildren(scene, this.controls.root, this.trouble, this.lanes.root, this.audio);
    root.addEventListener("keydown", (event) => this.controls.key(event));
    this.watcher = new ResizeObserver(() => this.resize());
    this.watcher.observe(root);
    this.tick(0);
  }

  private complain(why: string): void {
    this.trouble.textContent = why;
    this.changed = true;
  }

  private repeat(range: [number, number] | null): void {
    this.clock.loop = range;
    this.changed = true;
  }

  private mute(): void {
    this.clock.mute();
    this.changed = true;
  }

  private zoom(factor: number): void {
    this.lanes.zoom(factor, this.clock.time);
    this.changed = true;
  }

  private step(frames: number): void {
    this.clock.pause();
    this.clock.seek((Math.round(this.clock.time * this.poses.fps) + frames) / this.poses.fps);
  }

  update(component: Component): void {
    this.component = component;
    const { data } = component;
    if (data.id === this.id) return;
    this.id = data.id;
    void this.take(data);
  }

  private async take(data: StageData): Promise<void> {
    for (const face of data.faces) if (face.kind === "mesh") void bytes(face.url).catch(() => {}); // the largest file: ask for it first
    try {
      const [peaks, ...faces] = await Promise.all([
        data.peaks ? bytes(data.peaks) : new ArrayBuffer(0),
        ...data.faces.map((face) => loaded(face, data.fps)),
      ]);
      if (data.id === this.id) this.show(data, faces, new Int8Array(peaks)); // else another line was asked for meanwhile
    } catch (error) {
      if (data.id !== this.id) return;
      this.id = "";
      this.complain(`The line could not be loaded (${error instanceof Error ? error.message : String(error)}). Reload the page.`);
    }
  }

  private show(data: StageData, faces: Loaded[], peaks: Int8Array): void {
    this.trouble.textContent = "";
    this.root.classList.toggle("compact", data.compact ?? false);
    this.poses = faces[0].poses;
    this.now = new Float32Array(this.poses.names.length);
    const other = this.clock.load(data.audio, data.duration);
    this.clock.loop = data.loop ?? (other ? null : this.clock.loop);
    this.faces.show(faces);
    this.controls.turnable(this.faces.turnable);
    this.lanes.show(data, faces, peaks, this.clock.loop);
    this.changed = true;
    if (data.autoplay && other) void this.begin(data.id);
  }

  /** Play a new line once its faces stand, unless the visitor was quicker or wants nothing to move by itself. */
  private async begin(id: string): Promise<void> {
    if (matchMedia("(prefers-reduced-motion: reduce)").matches) return;
    await this.faces.ready;
    if (id !== this.id || this.clock.playing || this.clock.time > 0) return;
    performance.mark("lipdb speaks");
    this.clock.play();
  }

  private resize(): void {
    this.faces.resize();
    this.lanes.resize();
    this.changed = true;
  }

  private tick(now: number): void {
    this.request = requestAnimationFrame((next) => this.tick(next));
    this.clock.tick();
    const { time, playing } = this.clock;
    const passed = now - this.last;
    this.last = now;
    this.changed ||= playing !== this.ran; // the last numbers of what played may not have been written
    this.ran = playing;
    const legible = !playing || now - this.written > LEGIBLE;
    if (legible) this.written = now;
    this.controls.show({
      time: legible ? time : null,
      playing,
      duration: this.clock.duration,
      looping: this.clock.loop !== null,
      muted: this.clock.muted,
      hushed: this.clock.hushed,
      sounding: this.clock.sounding,
    });
    if (now - this.told > 500) {
      this.told = now;
      this.lanes.tell(time);
    }
    if (time === this.drawn && !this.changed && !this.faces.dirty) {
      this.faces.rest();
      return;
    }
    const began = performance.now();
    this.faces.draw(time, playing);
    const between = performance.now();
    this.poses.at(time, this.now);
    this.lanes.at(time, legible);
    this.drawn = time;
    this.changed = false;
    this.root.dispatchEvent(new CustomEvent("lipdb-time", { bubbles: true, composed: true, detail: { stage: this.component?.data.name, time } }));
    if (playing) this.measure(passed, between - began, performance.now() - between);
  }

  private measure(frame: number, faces: number, lanes: number): void {
    for (const [name, value] of Object.entries({ frame, faces, lanes }) as ["frame" | "faces" | "lanes", number][]) {
      this.pace[name] += (this.pace[name] ? LATELY : 1) * (value - this.pace[name]);
    }
  }

  /** What is shown now: for tests, and for people who measure. */
  get state(): { time: number; playing: boolean; hushed: boolean; poses: Record<string, number>; faces: unknown[]; pace: object; painted: number } {
    return {
      time: this.drawn,
      playing: this.clock.playing,
      hushed: this.clock.hushed,
      poses: Object.fromEntries(this.poses.names.map((name, k) => [name, this.now[k]])),
      faces: this.faces.state,
      pace: { ...this.pace },
      painted: this.lanes.painted,
    };
  }

  dispose(): void {
    cancelAnimationFrame(this.request);
    this.watcher.disconnect();
    this.clock.pause();
    this.id = "";
    this.faces.dispose();
  }
}

export default mounted("stage", (root) => {
  const stage = new Stage(root);
  (root as HTMLElement & { lipdb?: Stage }).lipdb = stage;
  return stage;
});
