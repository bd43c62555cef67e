// A look without shine for browsers that draw on the processor: light is a part of the colour at each corner, so that all there is to
// do for a triangle is to fill it. The lights stand still, so only corners that move need it anew.

import {
  BufferAttribute, DirectionalLight, FrontSide, HemisphereLight, Matrix4, Mesh, MeshBasicMaterial, MeshLambertMaterial, MeshStandardMaterial, Vector3,
  type BufferGeometry, type Object3D,
} from "three";

/** A light as one part sees it: its direction, and what it gives to what faces it and to what faces away (linear red, green, blue). */
interface Shine {
  from: Vector3;
  facing: number[];
  away: number[];
  /** A sky lights all of what it sees, half of it from beside; a lamp nothing from beside. */
  sky: boolean;
}

function shines(lights: Object3D[], part: Mesh): Shine[] {
  const inverse = new Matrix4().copy(part.matrixWorld).invert();
  return lights.flatMap((light) => {
    if (!(light instanceof HemisphereLight || light instanceof DirectionalLight)) return [];
    const from = light.position.clone().transformDirection(inverse);
    const facing = light.color.toArray().map((each) => (each * light.intensity) / Math.PI);
    const sky = light instanceof HemisphereLight;
    return [{ from, facing, sky, away: sky ? light.groundColor.toArray().map((each) => (each * light.intensity) / Math.PI) : [0, 0, 0] }];
  });
}

/** The light on one part. */
export class Lit {
  private readonly own: Float32Array;
  private readonly colour: BufferAttribute;
  private readonly geometry: BufferGeometry;
  private readonly shines: Shine[];

  constructor(part: Mesh, { color, vertexColors }: MeshStandardMaterial, lights: Object3D[]) {
    this.geometry = part.geometry;
    this.shines = shines(lights, part);
    const tint = color.toArray();
    const painted = vertexColors ? this.geometry.attributes.color : undefined;
    const { count } = this.geometry.attributes.position;
    this.own = Float32Array.from({ length: 3 * count }, (_, k) => tint[k % 3] * (painted?.getComponent(Math.floor(k / 3), k % 3) ?? 1));
    this.colour = new BufferAttribute(new Float32Array(3 * count), 3);
  }

  /** Light the corners as they stand now. */
  update(): void {
    const { normal } = this.geometry.attributes;
    const colours = this.colour.array;
    for (let k = 0; k < normal.count; k++) {
      const x = normal.getX(k);
      const y = normal.getY(k);
      const z = normal.getZ(k);
      const size = Math.sqrt(x * x + y * y + z * z) || 1;
      let red = 0;
      let green = 0;
      let blue = 0;
      for (let n = 0; n < this.shines.length; n++) {
        const { from, facing, away, sky } = this.shines[n];
        const straight = (x * from.x + y * from.y + z * from.z) / size;
        const part = sky ? (straight + 1) / 2 : Math.max(straight, 0);
        red += away[0] + (facing[0] - away[0]) * part;
        green += away[1] + (facing[1] - away[1]) * part;
        blue += away[2] + (facing[2] - away[2]) * part;
      }
      colours[3 * k] = this.own[3 * k] * red;
      colours[3 * k + 1] = this.own[3 * k + 1] * green;
      colours[3 * k + 2] = this.own[3 * k + 2] * blue;
    }
    this.geometry.setAttribute("color", this.colour);
    this.colour.needsUpdate = true;
  }
}

/** Take the shine off `model`. Gives the light of each part that has it in its corners; pictures and glass are lit where they are drawn. */
export function matt(model: Object3D, lights: Object3D[]): Map<Mesh, Lit> {
  const found = new Map<Mesh, Lit>();
  model.updateMatrixWorld(true);
  model.traverse((part) => {
    if (!(part instanceof Mesh && part.material instanceof MeshStandardMaterial)) return;
    const { color, map, vertexColors, side, transparent, opacity, alphaTest } = part.material;
    part.material.dispose();
    if (map || transparent || alphaTest || side !== FrontSide || !part.geometry.attributes.normal) {
      part.material = new MeshLambertMaterial({ color, map, vertexColors, side, transparent, opacity, alphaTest });
    } else {
      found.set(part, new Lit(part, part.material, lights));
      part.material = new MeshBasicMaterial({ vertexColors: true });
    }
  });
  found.forEach((lit) => lit.update());
  return found;
}
