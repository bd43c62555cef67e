// What moves over the lanes: the line at the instant that is shown, and the weights beside the names.
// Each stands on a small layer of its own, so that a frame costs what changes and not the whole of the lanes.

import { type Row, type Theme } from "./rows";

const LINE = 2; // pixels

/** `Lanes` puts its elements over what stays, and says where and when. */
export class Playhead {
  readonly line = document.createElement("div");
  readonly values = document.createElement("canvas");
  private x = NaN;
  private written = "";

  constructor() {
    this.line.className = "playhead";
    this.line.style.width = `${LINE}px`;
    this.values.className = "values";
  }

  /** Make room for the values: `width` x `height` pixels, `ratio` of the screen's in each. */
  resize(width: number, height: number, ratio: number): void {
    this.values.style.width = `${width}px`;
    this.values.width = Math.round(width * ratio);
    this.values.height = Math.round(height * ratio);
    this.values.getContext("2d")?.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.anew();
  }

  /** Forget what is shown: theme, rows or axis have changed. */
  anew(): void {
    this.x = NaN;
    this.written = "";
  }

  /** Put the line to `middle` pixels. */
  stand(middle: number): void {
    const x = Math.round(middle - LINE / 2);
    if (x !== this.x) this.line.style.transform = `translateX(${x}px)`;
    this.x = x;
  }

  /** Write the values of `rows` at `time` beside them, so that they end at `right` pixels. */
  write(time: number, rows: Row[], right: number, theme: Theme): void {
    const pen = this.values.getContext("2d");
    const texts = rows.map(({ value }) => value?.(time) ?? "");
    const written = texts.join("\n");
    if (!pen || written === this.written) return;
    this.written = written;
    pen.clearRect(0, 0, this.values.width, this.values.height);
    pen.font = theme.font;
    pen.fillStyle = theme.ink;
    pen.textAlign = "right";
    pen.textBaseline = "middle";
    let top = 0;
    rows.forEach(({ height }, k) => {
      if (texts[k]) pen.fillText(texts[k], right, top + height / 2);
      top += height;
    });
  }
}
