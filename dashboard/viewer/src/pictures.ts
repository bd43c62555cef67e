// A flat mouth: one picture at a time.

import { spanAt, type FaceData, type Span } from "./data";

type PictureFace = Extract<FaceData, { kind: "pictures" }>;

export class PictureView {
  readonly canvas = document.createElement("div");
  shown = "";
  dirty = true;
  private cues: Span[] = [];
  private images = new Map<string, HTMLImageElement>();
  private urls = "";

  show(face: PictureFace): void {
    this.cues = face.cues;
    const urls = JSON.stringify(face.pictures);
    if (urls !== this.urls) {
      this.urls = urls;
      this.images = new Map(
        Object.entries(face.pictures).map(([shape, url]) => {
          const image = new Image();
          image.src = url;
          image.alt = shape;
          return [shape, image];
        }),
      );
      this.canvas.replaceChildren(...this.images.values());
    }
    this.shown = "";
    this.dirty = true;
  }

  draw(time: number): void {
    const last = this.cues.length - 1;
    const k = spanAt(this.cues, time);
    const shape = last < 0 ? "" : this.cues[k < 0 ? last : k][2];
    this.dirty = false;
    if (shape === this.shown) return;
    this.shown = shape;
    for (const [name, image] of this.images) image.hidden = name !== shape;
  }

  look(): void {}
  resize(): void {}
  dispose(): void {}
}
