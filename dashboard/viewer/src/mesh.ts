// A character's mesh, drawn from one or several sides.

import {
  ACESFilmicToneMapping, Box3, DirectionalLight, HemisphereLight, Material, Mesh, PMREMGenerator, Scene, Vector3, WebGLRenderer, type Group, type Object3D,
} from "three";
import { RoomEnvironment } from "three/examples/jsm/environments/RoomEnvironment.js";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import { Cameras } from "./cameras";
import { Track, type Loaded } from "./data";
import { bytes } from "./files";
import { matt, type Lit } from "./matt";
import { Morph } from "./morph";
import { Pace } from "./pace";

const MIRRORED = 64; // pixels of each side of the room that faces mirror; skin shows no more
const REST = 500; // milliseconds of standing still after which a coarse picture is drawn once more, sharp
const ARRIVING = 700; // milliseconds in which a page that one has just come to is drawn itself

/** Whether pictures are drawn by the processor, which needs a hundred times as long as a graphics card. */
function drawsInSoftware(): boolean {
  const pen = document.createElement("canvas").getContext("webgl2");
  const told = pen?.getExtension("WEBGL_debug_renderer_info");
  const name = pen && told ? String(pen.getParameter(told.UNMASKED_RENDERER_WEBGL)) : "";
  pen?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}

let software: boolean | null = null;

export class MeshView {
  readonly root = document.createElement("div");
  private readonly canvas = document.createElement("canvas");
  private weights = new Float32Array(0);
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly cameras = new Cameras(this.root, () => (this.dirty = true));
  private model: Group | null = null;
  private moving: { part: Mesh; morph: Morph; lit?: Lit }[] = [];
  private url = "";
  private track = new Track();
  private readonly pace: Pace;
  /** When it was drawn last, in milliseconds of the page. */
  drawn = 0;
  private sharpness = 1;
  private keeps = 0;
  private stretched = false;
  dirty = true;
  /** Kept when there is something to see, or an error to read. */
  ready: Promise<void> = Promise.resolve();

  /** `failed` hears why there is no face to see; "" takes it back. Throws where the browser has no WebGL. */
  constructor(public failed: (why: string) => void) {
    this.root.className = "mesh";
    this.root.append(this.canvas);
    software ??= drawsInSoftware();
    this.pace = new Pace(software ? 0.5 : 1);
    this.renderer = new WebGLRenderer({ canvas: this.canvas, antialias: !software, alpha: true });
    this.renderer.toneMapping = ACESFilmicToneMapping;
    this.light();
    this.canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
    this.canvas.addEventListener("webglcontextrestored", () => {
      this.light();
      this.dirty = true;
    });
  }

  private light(): void {
    this.scene.clear();
    if (software) {
      this.scene.add(new HemisphereLight(0xffffff, 0xb8b0a8, 2.6)); // about as bright as the room, without mirrors
    } else {
      const maker = new PMREMGenerator(this.renderer);
      this.scene.environment = maker.fromScene(new RoomEnvironment(), 0, 0.1, 100, { size: MIRRORED }).texture;
      maker.dispose();
      this.scene.environmentIntensity = 0.55;
    }
    for (const [colour, strength, x, y, z] of [[0xfff0dc, 2.2, -1.5, 1.6, 2.4], [0xcfe0ff, 1.4, 1.2, 1.5, -2]]) {
      const light = new DirectionalLight(colour, strength);
      light.position.set(x, y, z);
      this.scene.add(light);
    }
    if (this.model) this.scene.add(this.model);
  }

  show({ face, shapes }: Loaded): void {
    if (face.kind !== "mesh") return;
    this.track = shapes;
    this.weights = new Float32Array(shapes.names.length);
    if (face.url === this.url) this.connect();
    else this.ready = this.load(face.url);
    this.dirty = true;
  }

  private async load(url: string): Promise<void> {
    this.url = url;
    this.root.classList.add("loading");
    try {
      const loaded = await new GLTFLoader().parseAsync(await bytes(url), "");
      if (this.url !== url) return; // another face was asked for meanwhile
      if (this.model) free(this.model);
      this.model?.removeFromParent();
      this.model = loaded.scene;
      const lit = software ? matt(this.model, this.scene.children) : null;
      this.scene.add(this.model);
      this.moving = [];
      this.model.traverse((part) => {
        if (part instanceof Mesh && part.morphTargetInfluences) this.moving.push({ part, morph: new Morph(part), lit: lit?.get(part) });
      });
      this.connect();
      this.frame(loaded.scene);
      await this.drawOnce();
      this.root.classList.remove("loading");
    } catch (error) {
      if (this.url !== url) return;
      this.url = "";
      this.failed(`The face could not be loaded (${error instanceof Error ? error.message : String(error)}). Reload the page.`);
    }
  }

  /** Draw what is there and wait for it: the first picture can take seconds, and nothing should sound meanwhile. */
  private async drawOnce(): Promise<void> {
    await this.renderer.compileAsync(this.scene, this.cameras.of(0));
    this.draw(0, false);
    this.renderer.getContext().readPixels(0, 0, 1, 1, WebGL2RenderingContext.RGBA, WebGL2RenderingContext.UNSIGNED_BYTE, new Uint8Array(4));
  }

  private connect(): void {
    this.moving.forEach(({ morph }) => morph.connect(this.track.names));
    this.dirty = true;
  }

  /** Show all that moves. */
  private frame(model: Group): void {
    const moved = new Box3();
    model.updateMatrixWorld(true);
    const point = new Vector3();
    for (const { part, morph } of this.moving) {
      for (const at of morph.moved()) moved.expandByPoint(point.fromArray(at).applyMatrix4(part.matrixWorld));
    }
    this.cameras.frame(new Box3().setFromObject(model), moved);
  }

  look(angles: number[]): void {
    this.cameras.look(angles);
  }

  resize(): void {
    this.cameras.resize();
    this.dirty = true;
  }

  /**
   * Let the canvas go from `left` to `right`, no wider than what is seen of the face: of a wide player most is background. Returns
   * its left edge, and how much wider and taller than it is seen the picture has to be drawn to fill its pixels.
   */
  private fit([left, right]: [number, number]): [left: number, wider: number, taller: number] {
    const ratio = Math.min(devicePixelRatio, 2) * this.sharpness;
    const [width, height] = [right - left, this.root.clientHeight || 1];
    this.canvas.style.left = `${left}px`;
    this.canvas.style.width = `${width}px`;
    this.stretched = this.canvas.width !== Math.floor(width * ratio) || this.canvas.height !== Math.floor(height * ratio);
    if (this.stretched && this.root.isConnected && performance.now() > this.keeps) {
      this.renderer.setDrawingBufferSize(width, height, ratio);
      this.stretched = false;
    }
    const pixels = this.renderer.getPixelRatio();
    return [left, this.canvas.width / pixels / width, this.canvas.height / pixels / height];
  }

  /**
   * Come to another page. The canvas keeps its size for a while, where the processor draws: a new one waits until all is drawn that
   * was asked for before, a third of a second while the page itself comes.
   */
  arrive(): void {
    if (software) this.keeps = performance.now() + ARRIVING;
  }

  /** Called for every frame of the screen; `playing` when many of them follow each other. */
  draw(time: number, playing: boolean): void {
    const now = performance.now();
    if (playing) this.pace.frame(now);
    if (playing || this.pace.sharpness === 1) this.sharpness = this.pace.sharpness;
    this.drawn = now;
    this.track.at(time, this.weights);
    for (const { morph, lit } of this.moving) if (morph.apply(this.weights)) lit?.update();
    const { places } = this.cameras;
    const [edge, wider, taller] = this.fit(this.cameras.aim(places));
    this.renderer.setScissorTest(true);
    places.forEach(({ left, bottom, width, height }, k) => {
      const part = [(left - edge) * wider, bottom * taller, width * wider, height * taller] as const;
      this.renderer.setViewport(...part);
      this.renderer.setScissor(...part);
      this.renderer.render(this.scene, this.cameras.of(k));
    });
    this.dirty = false;
  }

  /** A picture that was drawn coarse to keep up, or to come at once, becomes sharp once nothing moves. */
  rest(): void {
    const now = performance.now();
    const coarse = this.sharpness !== 1 && now - this.drawn >= REST;
    if (coarse) this.sharpness = 1;
    this.dirty = coarse || (this.stretched && now > this.keeps);
  }

  /** The weight of every shape as it was drawn last, how many of them move something, and how sharp playing is. */
  get state(): { shapes: Record<string, number>; moving: number; sharpness: number } {
    const shapes = Object.fromEntries(this.track.names.map((name, k) => [name, this.weights[k]]));
    const moving = this.track.names.filter((_, k) => this.moving.some(({ morph }) => morph.moves(k))).length;
    return { shapes, moving, sharpness: this.pace.sharpness };
  }

  /** Whether it has the face at `url`. */
  shows(url: string): boolean {
    return this.url === url;
  }

  /** Whether its face stands, and can be drawn on another page as well. */
  get whole(): boolean {
    return this.url !== "" && !this.root.classList.contains("loading") && !this.renderer.getContext().isContextLost();
  }

  /** Another one with the same face. */
  async twin(): Promise<MeshView> {
    const made = new MeshView(() => {});
    made.renderer.setDrawingBufferSize(this.canvas.width, this.canvas.height, 1);
    made.ready = made.load(this.url);
    await made.ready;
    return made;
  }

  dispose(): void {
    this.url = "";
    this.cameras.dispose();
    if (this.model) free(this.model);
    this.scene.environment?.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss(); // browsers allow sixteen at a time
  }
}

function free(model: Object3D): void {
  model.traverse((part) => {
    if (!(part instanceof Mesh)) return;
    part.geometry.dispose();
    for (const material of [part.material].flat() as Material[]) material.dispose();
  });
}
