// The row of buttons under the faces, and the keys that do the same.

import { icon, type IconName } from "./icons";
import { VIEWS, type ViewName } from "./views";

const SPEEDS = [0.25, 0.5, 0.75, 1];

/** What buttons and keys can do. */
export interface Acts {
  toggle(): void;
  start(): void;
  end(): void;
  step(frames: number): void;
  phone(way: 1 | -1): void;
  speed(value: number): void;
  loop(): void;
  mute(): void;
  zoom(factor: number): void;
  look(view: ViewName): void;
}

/** What the row shows of the player's state. */
export interface Shown {
  /** null lets stand what stands. */
  time: number | null;
  duration: number;
  playing: boolean;
  looping: boolean;
  muted: boolean;
  hushed: boolean;
  sounding: boolean;
}

function button(face: IconName | null, text: string, title: string, act: () => void): HTMLButtonElement {
  const made = document.createElement("button");
  made.type = "button";
  if (face) made.append(icon(face));
  if (text) made.append(text);
  made.title = title;
  made.setAttribute("aria-label", title.replace(/ \(.*\)$/, ""));
  made.addEventListener("click", act);
  return made;
}

function group(label: string, buttons: HTMLElement[]): HTMLElement {
  const made = document.createElement("span");
  made.className = `group ${label.toLowerCase()}`;
  made.setAttribute("role", "group");
  made.setAttribute("aria-label", label);
  made.append(...buttons);
  return made;
}

const press = (each: HTMLElement, on: boolean): void => each.setAttribute("aria-pressed", String(on));

export class Controls {
  readonly root = document.createElement("div");
  /** Stands over the faces. */
  readonly look: HTMLElement;
  private readonly time = document.createElement("span");
  private readonly play: HTMLButtonElement;
  private readonly loop: HTMLButtonElement;
  private readonly mute: HTMLButtonElement;
  private readonly views: [ViewName, HTMLButtonElement][];
  private told = "";
  private last = "";

  constructor(private readonly acts: Acts) {
    this.root.className = "controls";
    this.time.className = "clock";
    this.play = button("play", "Play", "Play or pause (space)", () => acts.toggle());
    this.play.className = "play";
    this.loop = button("loop", "", "Loop the word here, or the stretch chosen in the lanes (L)", () => acts.loop());
    this.mute = button("sound", "", "Sound on or off (M)", () => acts.mute());
    this.mute.className = "mute";
    const speeds = SPEEDS.map((speed) =>
      button(null, `${speed}×`, `Play at ${speed} of the speed`, () => {
        speeds.forEach((each, k) => press(each, SPEEDS[k] === speed));
        acts.speed(speed);
      }),
    );
    speeds.forEach((each, k) => press(each, SPEEDS[k] === 1));
    const names = Object.keys(VIEWS) as ViewName[];
    this.views = names.map((name, k) => [name, button(null, name, `Look from: ${name} (${k + 1})`, () => this.turn(name))]);
    this.views.forEach(([name, each]) => press(each, name === "front"));
    const space = document.createElement("span");
    space.className = "space";
    this.root.append(
      group("Playback", [
        this.play,
        button("start", "", "To the start (Home)", () => acts.start()),
        button("back", "", "One frame back (←)", () => acts.step(-1)),
        button("on", "", "One frame on (→)", () => acts.step(1)),
        this.loop,
        this.mute,
      ]),
      this.time,
      group("Speed", speeds),
      space,
      group("Zoom", [
        button("out", "", "Show more time (-)", () => acts.zoom(2)),
        button("in", "", "Show less time (+)", () => acts.zoom(0.5)),
      ]),
    );
    this.look = group("View", this.views.map(([, each]) => each));
  }

  private turn(view: ViewName): void {
    this.views.forEach(([name, each]) => press(each, name === view));
    this.acts.look(view);
  }

  /** Only a mesh can be seen from several sides. */
  turnable(yes: boolean): void {
    this.look.hidden = !yes;
  }

  show(now: Shown): void {
    const time = now.time === null ? this.told : `${now.time.toFixed(2)} s of ${now.duration.toFixed(2)} s`;
    if (time !== this.told) this.time.textContent = this.told = time;
    const key = [now.playing, now.looping, now.muted, now.hushed, now.sounding].join();
    if (key === this.last) return;
    this.last = key;
    const what = now.playing ? "Pause" : "Play";
    this.play.setAttribute("aria-label", what);
    this.play.replaceChildren(icon(now.playing ? "pause" : "play"), what);
    press(this.loop, now.looping);
    press(this.mute, !now.muted);
    this.mute.disabled = !now.sounding;
    this.mute.classList.toggle("asks", now.hushed);
    this.mute.replaceChildren(icon(now.muted ? "silence" : "sound"), now.hushed ? "Turn on the sound" : "");
  }

  /** Do what a key stands for; the browser keeps all others. */
  key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === " " && event.target instanceof HTMLButtonElement) return; // presses that button
    const { acts } = this;
    const phonewise = event.shiftKey;
    const keys: Record<string, () => void> = {
      " ": () => acts.toggle(),
      ArrowLeft: () => (phonewise ? acts.phone(-1) : acts.step(-1)),
      ArrowRight: () => (phonewise ? acts.phone(1) : acts.step(1)),
      Home: () => acts.start(),
      End: () => acts.end(),
      l: () => acts.loop(),
      m: () => acts.mute(),
      "+": () => acts.zoom(0.5),
      "-": () => acts.zoom(2),
      "0": () => acts.zoom(0),
      ...Object.fromEntries(this.views.map(([name], k) => [String(k + 1), () => this.turn(name)])),
    };
    const act = keys[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  }
}
