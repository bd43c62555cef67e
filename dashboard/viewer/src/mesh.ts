// A character's mesh, drawn from one or several sides.

import {
  ACESFilmicToneMapping, Box3, DirectionalLight, Group, Mesh, PerspectiveCamera, PMREMGenerator, Scene, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { RoomEnvironment } from "three/examples/jsm/environments/RoomEnvironment.js";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import { floats, Track, type FaceData } from "./data";
import { Morph } from "./morph";

/** Degrees around the head at which a view stands; the first one can be turned by hand. */
export const VIEWS: Record<string, number[]> = { front: [0], "¾": [38], side: [90], all: [0, 38, 90] };
const FIELD = 24;

/** How much more than what moves is shown. */
const ROOM = 0.66;

/** What a slow machine may leave of the picture's width and height, so that the mouth keeps moving. */
const COARSEST = 0.3;
const SLOW = 45; // milliseconds a frame: less than 22 a second
const GAP = 1500; // a longer wait is no slow frame, but none

/** Whether drawing keeps up, judged on the middle of eight frames in a row. */
class Pace {
  private last = 0;
  private waits: number[] = [];

  tooSlow(): boolean {
    const now = performance.now();
    const wait = now - this.last;
    this.last = now;
    if (wait > GAP) this.waits = [];
    else this.waits.push(wait);
    if (this.waits.length < 8) return false;
    const middle = [...this.waits].sort((a, b) => a - b)[4];
    this.waits = [];
    return middle > SLOW;
  }
}

type MeshFace = Extract<FaceData, { kind: "mesh" }>;

export class MeshView {
  readonly canvas = document.createElement("canvas");
  private weights = new Float32Array(0);
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly cameras = VIEWS.all.map(() => new PerspectiveCamera(FIELD, 1, 0.01, 1000));
  private readonly controls: OrbitControls;
  private model: Group | null = null;
  private moving: { part: Mesh; morph: Morph }[] = [];
  private url = "";
  private angles = VIEWS.front;
  private centre = new Vector3();
  private radius = 1;
  private track = new Track([], new Float32Array(0), 60);
  private pace = new Pace();
  private sharpness = 1;
  dirty = true;

  constructor(private readonly failed: (why: string) => void) {
    this.renderer = new WebGLRenderer({ canvas: this.canvas, antialias: true, alpha: true, preserveDrawingBuffer: true });
    this.renderer.toneMapping = ACESFilmicToneMapping;
    this.scene.environment = new PMREMGenerator(this.renderer).fromScene(new RoomEnvironment(), 0.04).texture;
    this.scene.environmentIntensity = 0.55;
    for (const [colour, strength, x, y, z] of [[0xfff0dc, 2.2, -1.5, 1.6, 2.4], [0xcfe0ff, 1.4, 1.2, 1.5, -2]]) {
      const light = new DirectionalLight(colour, strength);
      light.position.set(x, y, z);
      this.scene.add(light);
    }
    this.controls = new OrbitControls(this.cameras[0], this.canvas);
    this.controls.enablePan = false;
    this.controls.addEventListener("change", () => (this.dirty = true));
    this.canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
    this.canvas.addEventListener("webglcontextrestored", () => (this.dirty = true));
  }

  show(face: MeshFace, fps: number): void {
    this.track = new Track(face.shapes, floats(face.weights), fps);
    this.weights = new Float32Array(face.shapes.length);
    if (face.url === this.url) this.connect();
    else void this.load(face.url);
    this.dirty = true;
  }

  private async load(url: string): Promise<void> {
    this.url = url;
    try {
      const loaded = await new GLTFLoader().loadAsync(url);
      if (this.url !== url) return; // another face was asked for meanwhile
      if (this.model) this.scene.remove(this.model);
      this.model = loaded.scene;
      this.scene.add(this.model);
      this.moving = [];
      this.model.traverse((part) => {
        if (part instanceof Mesh && part.morphTargetInfluences) this.moving.push({ part, morph: new Morph(part) });
      });
      this.connect();
      this.frame();
    } catch (error) {
      this.failed(`The face could not be loaded (${error instanceof Error ? error.message : String(error)}). Reload the page.`);
    }
  }

  private connect(): void {
    this.moving.forEach(({ morph }) => morph.connect(this.track.names));
    this.dirty = true;
  }

  /** Put the cameras where all that moves fits with room around it: of a bust, the head. */
  private frame(): void {
    if (!this.model) return;
    const whole = new Box3().setFromObject(this.model);
    const moved = new Box3();
    this.model.updateMatrixWorld(true);
    const point = new Vector3();
    for (const { part, morph } of this.moving) {
      for (const at of morph.moved()) moved.expandByPoint(point.fromArray(at).applyMatrix4(part.matrixWorld));
    }
    const size = whole.getSize(new Vector3()).length() / 2;
    (moved.isEmpty() ? whole : moved).getCenter(this.centre);
    this.radius = moved.isEmpty() ? size : Math.min(moved.getSize(new Vector3()).length() * ROOM, size);
    this.look(this.angles);
  }

  look(angles: number[]): void {
    this.angles = angles;
    const distance = this.radius / Math.sin((FIELD / 2) * (Math.PI / 180)) * 0.86;
    this.cameras.forEach((camera, k) => {
      const angle = ((angles[k] ?? 0) * Math.PI) / 180;
      camera.position.set(Math.sin(angle), 0, Math.cos(angle)).multiplyScalar(distance).add(this.centre);
      camera.near = distance / 100;
      camera.far = distance * 10;
      camera.lookAt(this.centre);
    });
    this.controls.target.copy(this.centre);
    this.controls.update();
    this.dirty = true;
  }

  resize(width: number, height: number): void {
    const size = this.canvas;
    const ratio = Math.min(devicePixelRatio, 2) * this.sharpness;
    if (size.width === Math.round(width * ratio) && size.height === Math.round(height * ratio)) return;
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, false);
    this.dirty = true;
  }

  draw(time: number): void {
    if (this.pace.tooSlow() && this.sharpness > COARSEST) {
      this.sharpness = Math.max(this.sharpness * 0.7, COARSEST);
      this.resize(this.canvas.clientWidth, this.canvas.clientHeight);
    }
    this.track.at(time, this.weights);
    this.moving.forEach(({ morph }) => morph.apply(this.weights));
    const [width, height] = [this.canvas.clientWidth, this.canvas.clientHeight];
    const part = width / this.angles.length;
    this.renderer.setScissorTest(true);
    this.angles.forEach((_, k) => {
      const camera = this.cameras[k];
      camera.aspect = part / height;
      camera.updateProjectionMatrix();
      this.renderer.setViewport(k * part, 0, part, height);
      this.renderer.setScissor(k * part, 0, part, height);
      this.renderer.render(this.scene, camera);
    });
    this.dirty = false;
  }

  /** The weight of every shape as it was drawn last, and how many of them move something. */
  get state(): { shapes: Record<string, number>; moving: number } {
    const shapes = Object.fromEntries(this.track.names.map((name, k) => [name, this.weights[k]]));
    return { shapes, moving: this.track.names.filter((_, k) => this.moving.some(({ morph }) => morph.moves(k))).length };
  }

  dispose(): void {
    this.controls.dispose();
    this.renderer.dispose();
    this.url = "";
  }
}
