// Morph targets on the processor: only what moves is touched, which is quicker than the graphics card's way on most laptops
// and many times quicker where there is no graphics card.

import { BufferAttribute, type Mesh } from "three";

interface Sparse {
  at: Uint32Array;
  by: Float32Array;
}

/** Where the values that `target` changes stand in the flat array, and by how much. */
function sparse(target: { count: number; getComponent(index: number, component: number): number }): Sparse {
  const at: number[] = [];
  const by: number[] = [];
  for (let k = 0; k < target.count; k++) {
    for (let c = 0; c < 3; c++) {
      const value = target.getComponent(k, c);
      if (Math.abs(value) > 1e-7) {
        at.push(3 * k + c);
        by.push(value);
      }
    }
  }
  return { at: Uint32Array.from(at), by: Float32Array.from(by) };
}

/** One part of a face: positions and normals at rest, and what each of its targets adds to them. */
export class Morph {
  private readonly names: Record<string, number>;
  private readonly layers: { attribute: BufferAttribute; rest: Float32Array; targets: Sparse[] }[] = [];
  private columns: number[] = [];
  /** Of the columns, those whose target changes anything here: most parts of a face stand still, or hear one name. */
  private heard: number[] = [];
  private shown = new Float32Array(0);
  private stale = false;
  private readonly turns: boolean;

  constructor(part: Mesh) {
    this.names = part.morphTargetDictionary ?? {};
    const { geometry } = part;
    for (const name of ["position", "normal"] as const) {
      const targets = geometry.morphAttributes[name];
      const source = geometry.attributes[name];
      if (!targets || !source) continue;
      const rest = new Float32Array(3 * source.count);
      for (let k = 0; k < source.count; k++) for (let c = 0; c < 3; c++) rest[3 * k + c] = source.getComponent(k, c);
      const attribute = new BufferAttribute(rest.slice(), 3);
      geometry.setAttribute(name, attribute);
      this.layers.push({ attribute, rest, targets: targets.map(sparse) });
    }
    this.turns = this.layers[1]?.targets.some(({ at }) => at.length) ?? false;
    geometry.morphAttributes = {};
    part.updateMorphTargets();
  }

  /** Positions that anything moves, three numbers each. */
  moved(): number[][] {
    const layer = this.layers[0];
    if (!layer) return [];
    const vertices = new Set(layer.targets.flatMap(({ at, by }) => [...at].filter((_, k) => Math.abs(by[k]) > 1e-4).map((index) => Math.floor(index / 3))));
    return [...vertices].map((vertex) => [...layer.rest.subarray(3 * vertex, 3 * vertex + 3)]);
  }

  /** Which target each of `names` moves. */
  connect(names: string[]): void {
    this.columns = names.map((name) => this.names[name] ?? -1);
    this.heard = [...this.columns.keys()].filter((k) => this.layers.some(({ targets }) => targets[this.columns[k]]?.at.length));
    this.shown = new Float32Array(this.heard.length);
    this.stale = true;
  }

  /** Whether the name at `column` moves anything here. */
  moves(column: number): boolean {
    return this.columns[column] >= 0;
  }

  /** Move the part as `weights` say; whether that turns anything another way. */
  apply(weights: Float32Array): boolean {
    if (!this.stale && this.heard.every((column, k) => this.shown[k] === weights[column])) return false;
    this.stale = false;
    this.heard.forEach((column, k) => (this.shown[k] = weights[column]));
    for (const { attribute, rest, targets } of this.layers) {
      const values = attribute.array as Float32Array;
      values.set(rest);
      for (const column of this.heard) {
        const weight = weights[column];
        if (!weight) continue;
        const { at, by } = targets[this.columns[column]];
        for (let i = 0; i < at.length; i++) values[at[i]] += weight * by[i];
      }
      attribute.needsUpdate = true;
    }
    return this.turns;
  }
}
