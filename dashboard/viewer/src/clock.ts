// One clock for sound, faces and lanes: the audio element, or the wall clock where there is no sound (or no more of it).

import { address } from "./files";

export class Clock {
  duration = 0;
  speed = 1;
  /** The stretch that is played over and over, in seconds. */
  loop: [number, number] | null = null;
  /** Play all of it over and over. */
  around = false;
  /** The browser wants a click before it lets anything sound. */
  hushed = false;
  private silent: { from: number; at: number } | null = null;
  private still = 0;
  private url = "";

  constructor(
    private readonly audio: HTMLAudioElement,
    broken: () => void,
  ) {
    audio.preservesPitch = true;
    audio.preload = "auto";
    audio.addEventListener("ended", () => this.ended());
    audio.addEventListener("error", () => {
      if (!this.url) return;
      this.pause();
      this.url = "";
      broken();
    });
  }

  /** Take other sound; whether it is another line. A URL that is the same keeps the position. */
  load(url: string | null, duration: number): boolean {
    const same = (url ?? "") === this.url && (this.url !== "" || duration === this.duration);
    this.duration = duration;
    if (same) return false;
    this.pause();
    this.still = 0;
    this.url = url ?? "";
    if (url) this.audio.src = address(url);
    else this.audio.removeAttribute("src");
    return true;
  }

  get sounding(): boolean {
    return this.url !== "";
  }

  get muted(): boolean {
    return this.hushed || this.audio.muted;
  }

  get playing(): boolean {
    return this.silent !== null || (this.sounding && !this.audio.paused && !this.audio.ended);
  }

  private get span(): [number, number] {
    return this.loop ?? [0, this.duration];
  }

  private get repeats(): boolean {
    return this.around || this.loop !== null;
  }

  /** Seconds from the start of the line. */
  get time(): number {
    if (this.silent) return this.silent.from + ((performance.now() - this.silent.at) / 1000) * this.speed;
    return this.playing ? this.audio.currentTime : this.still;
  }

  seek(time: number): void {
    const playing = this.playing;
    this.still = Math.min(Math.max(time, 0), this.duration);
    if (this.sounding) this.audio.currentTime = this.still;
    if (playing) this.start();
  }

  play(): void {
    const [start, end] = this.span;
    const time = this.time;
    this.still = time < start - 1e-3 || time >= end - 1e-3 ? start : time;
    this.start();
  }

  /** Go on from where time stands: with the sound, or without it where it has ended or may not be heard. */
  private start(): void {
    const over = Number.isFinite(this.audio.duration) && this.still >= this.audio.duration;
    if (!this.sounding || this.hushed || over) {
      this.audio.pause();
      this.goSilently();
      return;
    }
    this.silent = null;
    if (Math.abs(this.audio.currentTime - this.still) > 1e-3) this.audio.currentTime = this.still;
    this.audio.playbackRate = this.speed;
    this.audio.play().catch((error: unknown) => {
      if (!(error instanceof DOMException) || error.name !== "NotAllowedError") return;
      this.hushed = true;
      this.goSilently();
    });
  }

  private goSilently(): void {
    this.silent = { from: this.still, at: performance.now() };
  }

  /** Sound on or off; the visitor's own click, so the browser allows it. */
  mute(): void {
    if (!this.hushed) {
      this.audio.muted = !this.audio.muted;
      return;
    }
    const playing = this.playing;
    this.still = Math.min(this.time, this.duration);
    this.hushed = false;
    if (playing) this.start();
  }

  pause(): void {
    this.still = Math.min(this.time, this.duration);
    this.silent = null;
    if (this.sounding) this.audio.pause();
  }

  setSpeed(speed: number): void {
    if (this.silent) this.silent = { from: this.time, at: performance.now() };
    this.speed = speed;
    this.audio.playbackRate = speed;
  }

  private ended(): void {
    this.still = this.audio.duration;
    if (this.still < this.duration - 0.02) this.goSilently();
    else if (this.repeats) this.again();
    else this.still = this.duration;
  }

  private again(): void {
    this.still = this.span[0];
    this.start();
  }

  /** Keep within the loop or the line; called once a drawn frame. */
  tick(): void {
    if (!this.playing) return;
    const [, end] = this.span;
    if (this.time < end) return;
    if (this.repeats) {
      this.again();
    } else {
      this.pause();
      this.still = this.duration;
    }
  }
}
