// One clock for sound, faces and lanes: the audio element, or the wall clock for a line without sound.

export class Clock {
  duration = 0;
  speed = 1;
  /** The stretch that is played over and over, in seconds; null plays everything once. */
  loop: [number, number] | null = null;
  private silent: { from: number; at: number } | null = null;
  private still = 0;

  constructor(private readonly audio: HTMLAudioElement) {
    audio.preservesPitch = true;
    audio.addEventListener("ended", () => (this.still = this.duration));
  }

  /** Take other sound; a URL that is the same keeps the position. */
  load(url: string | null, duration: number): void {
    this.duration = duration;
    if ((this.audio.dataset.url ?? "") === (url ?? "")) return;
    this.pause();
    this.still = 0;
    this.audio.dataset.url = url ?? "";
    if (url) this.audio.src = url;
    else this.audio.removeAttribute("src");
  }

  private get sounding(): boolean {
    return Boolean(this.audio.dataset.url);
  }

  get playing(): boolean {
    return this.sounding ? !this.audio.paused && !this.audio.ended : this.silent !== null;
  }

  /** Seconds from the start of the line. */
  get time(): number {
    if (this.sounding) return this.playing ? this.audio.currentTime : this.still;
    return this.silent ? this.silent.from + ((performance.now() - this.silent.at) / 1000) * this.speed : this.still;
  }

  seek(time: number): void {
    this.still = Math.min(Math.max(time, 0), this.duration);
    if (this.sounding) this.audio.currentTime = this.still;
    if (this.silent) this.silent = { from: this.still, at: performance.now() };
  }

  async play(): Promise<void> {
    const [start, end] = this.loop ?? [0, this.duration];
    if (this.time < start - 1e-3 || this.time >= end - 1e-3) this.seek(start);
    if (!this.sounding) {
      this.silent = { from: this.still, at: performance.now() };
      return;
    }
    this.audio.currentTime = this.still;
    this.audio.playbackRate = this.speed;
    await this.audio.play().catch(() => undefined); // a browser may want a click first; the button stays at "play"
  }

  pause(): void {
    this.still = Math.min(this.time, this.duration);
    if (this.sounding) this.audio.pause();
    this.silent = null;
  }

  setSpeed(speed: number): void {
    if (this.silent) this.silent = { from: this.time, at: performance.now() };
    this.speed = speed;
    this.audio.playbackRate = speed;
  }

  /** Keep within the loop or the line; called once a drawn frame. */
  tick(): void {
    if (!this.playing) return;
    const end = this.loop ? this.loop[1] : this.duration;
    if (this.time < end) return;
    if (this.loop) this.seek(this.loop[0]);
    else if (!this.sounding) {
      this.pause();
      this.still = this.duration;
    }
  }
}
