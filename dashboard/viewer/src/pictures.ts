// A flat mouth: one picture at a time.

import { spanAt, type Loaded, type Span } from "./data";
import { address } from "./files";

export class PictureView {
  readonly root = document.createElement("div");
  shown = "";
  dirty = true;
  readonly ready = Promise.resolve();
  private cues: Span[] = [];
  private images = new Map<string, HTMLImageElement>();
  private urls = "";

  constructor() {
    this.root.className = "pictures";
  }

  show({ face }: Loaded): void {
    if (face.kind !== "pictures") return;
    this.cues = face.cues;
    const urls = JSON.stringify(face.pictures);
    if (urls !== this.urls) {
      this.urls = urls;
      this.images = new Map(Object.entries(face.pictures).map(([shape, url]) => [shape, picture(shape, url)]));
      this.root.replaceChildren(...this.images.values());
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

  get state(): { shown: string } {
    return { shown: this.shown };
  }

  look(): void {}
  resize(): void {}
  dispose(): void {}
}

function picture(shape: string, url: string): HTMLImageElement {
  const image = new Image();
  image.src = address(url);
  image.alt = `mouth shape ${shape}`;
  image.hidden = true;
  return image;
}
