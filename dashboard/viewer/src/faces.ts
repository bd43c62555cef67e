// The faces of a stage, side by side: each a mesh, or pictures.

import { type FaceData, type Loaded } from "./data";
import { MeshView } from "./mesh";
import { PictureView } from "./pictures";
import { double, left, taken } from "./spare";
import { VIEWS, type ViewName } from "./views";

type View = MeshView | PictureView;

function leave(view: View): void {
  if (view instanceof MeshView) left(view);
  else view.dispose();
}

export class Faces {
  readonly root = document.createElement("div");
  private views: View[] = [];
  private kinds = "";
  private view: ViewName = "front";

  /** `complain` hears why a face is not to be seen; "" takes it back. */
  constructor(private readonly complain: (why: string) => void) {
    this.root.className = "faces";
  }

  show(faces: Loaded[]): void {
    const kinds = faces.map(({ face }) => face.kind).join(" ");
    if (kinds !== this.kinds) {
      this.dispose();
      this.kinds = kinds;
      this.root.replaceChildren(...faces.map(({ face }) => this.stand(face)));
    }
    [...this.root.children].forEach((figure, k) => {
      const { title } = faces[k].face;
      figure.firstElementChild?.setAttribute("role", "img");
      figure.firstElementChild?.setAttribute("aria-label", `${title}, speaking`);
      if (figure.lastElementChild) figure.lastElementChild.textContent = title;
    });
    this.views.forEach((view, k) => view.show(faces[k]));
    this.resize();
    this.look(this.view);
  }

  private stand(face: FaceData): HTMLElement {
    const figure = document.createElement("figure");
    figure.className = "face";
    const view = this.make(face);
    if (view) this.views.push(view);
    const blank = document.createElement("div");
    blank.className = "pictures";
    figure.append(view?.root ?? blank, document.createElement("figcaption"));
    return figure;
  }

  private make(face: FaceData): View | null {
    if (face.kind === "pictures") return new PictureView();
    try {
      return taken(face.url, this.complain);
    } catch {
      this.complain("This browser draws no 3D (WebGL is off or not there): turn on hardware acceleration, or choose the flat mouth.");
      return null;
    }
  }

  look(view: ViewName): void {
    this.view = view;
    this.views.forEach((each) => each.look(VIEWS[view]));
  }

  resize(): void {
    this.views.forEach((view) => view.resize());
  }

  /** Only a mesh can be seen from several sides. */
  get turnable(): boolean {
    return this.views.some((view) => view instanceof MeshView);
  }

  /** Kept when all of them stand, or say why they do not. */
  get ready(): Promise<unknown> {
    return Promise.all(this.views.map((view) => view.ready));
  }

  /** Whether one has to be drawn anew though time stands still. */
  get dirty(): boolean {
    return this.views.some((view) => view.dirty);
  }

  draw(time: number, playing: boolean): void {
    this.views.forEach((view) => view.draw(time, playing));
  }

  /** Nothing moves: there is time for what can wait. */
  rest(): void {
    for (const view of this.views) {
      if (!(view instanceof MeshView)) continue;
      view.rest();
      double(view);
    }
  }

  /** What each of them shows: for tests, and for people who measure. */
  get state(): unknown[] {
    return this.views.map((view) => view.state);
  }

  dispose(): void {
    this.views.forEach(leave);
    this.views = [];
  }
}
