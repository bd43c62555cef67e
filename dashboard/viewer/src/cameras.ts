// Where the cameras of a face stand: around all that moves, and where the visitor has turned them.

import { Box3, PerspectiveCamera, Vector3, type Camera } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { across, placed, SLIM, VIEWS, type Place } from "./views";

const FIELD = 24;

/** How much more than what moves is shown. */
const ROOM = 0.66;

/** One camera for each side from which a face is seen. */
export class Cameras {
  private readonly each = VIEWS.all.map(() => new PerspectiveCamera(FIELD, 1, 0.01, 1000));
  private readonly controls: OrbitControls;
  private angles: number[] = VIEWS.front;
  private centre = new Vector3();
  private radius = 1;
  private body = new Box3();

  /** What they see fills `root`, where it can be turned; `turned` hears when it was. */
  constructor(
    private readonly root: HTMLElement,
    private readonly turned: () => void,
  ) {
    this.controls = new OrbitControls(this.each[0], root);
    this.controls.enablePan = false;
    this.controls.addEventListener("change", turned);
    // Without Ctrl the wheel scrolls the page, as everywhere.
    root.addEventListener("wheel", (event) => (this.controls.enableZoom = event.ctrlKey), { capture: true, passive: true });
    root.addEventListener("dblclick", () => this.look(this.angles));
  }

  /** The camera of view `k`. */
  of(k: number): Camera {
    return this.each[k];
  }

  /** Stand where all that has `moved` fits with room around it: of a bust, the head; where nothing moves, the whole `body`. */
  frame(body: Box3, moved: Box3): void {
    this.body = body;
    const size = body.getSize(new Vector3()).length() / 2;
    (moved.isEmpty() ? body : moved).getCenter(this.centre);
    this.centre.z = (this.centre.z + body.getCenter(new Vector3()).z) / 2; // else the back of a head is cut off at its side
    this.radius = moved.isEmpty() ? size : Math.min(moved.getSize(new Vector3()).length() * ROOM, size);
    this.look(this.angles);
  }

  /** Look from these `angles`, a view for each. */
  look(angles: number[]): void {
    this.angles = angles;
    this.places.forEach(({ aspect }, k) => {
      const angle = (angles[k] * Math.PI) / 180;
      const camera = this.each[k];
      camera.position.set(Math.sin(angle), 0, Math.cos(angle)).multiplyScalar(this.distance(aspect)).add(this.centre);
      camera.lookAt(this.centre);
    });
    this.part();
    this.controls.target.copy(this.centre);
    this.controls.update();
    this.turned();
  }

  /** As far away as a picture of this shape needs. */
  private distance(aspect: number): number {
    const tall = (FIELD / 2) * (Math.PI / 180);
    return (this.radius / Math.sin(Math.atan(Math.tan(tall) * Math.min(aspect * SLIM, 1)))) * 0.86;
  }

  /** Where the views stand in `root`. */
  get places(): Place[] {
    return placed(this.angles.length, this.root.clientWidth || 1, this.root.clientHeight || 1);
  }

  /** Say for the lines between views how they stand. */
  private part(): void {
    const { places } = this;
    this.root.classList.toggle("row", places.length > 1 && places[0].bottom === 0);
    this.root.classList.toggle("pile", places[0].bottom > 0);
  }

  resize(): void {
    this.part();
    this.places.forEach(({ aspect }, k) => {
      const camera = this.each[k];
      if (aspect !== camera.aspect) camera.position.sub(this.centre).setLength(this.distance(aspect)).add(this.centre);
    });
  }

  /** Make the cameras ready for a picture in each of `places`; from where to where across, in pixels, the body is seen there. */
  aim(places: Place[]): [left: number, right: number] {
    places.forEach(({ aspect }, k) => {
      const camera = this.each[k];
      camera.aspect = aspect;
      camera.near = this.radius / 10;
      camera.far = this.radius * 100;
      camera.updateProjectionMatrix();
      camera.updateMatrixWorld();
    });
    return across(this.body, this.each, places);
  }

  dispose(): void {
    this.controls.dispose();
  }
}
