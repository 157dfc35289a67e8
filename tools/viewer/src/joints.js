// The joints of a page: their values, and where they put the layers.
import * as chain from './chain.js';
import { boxOf } from './model.js';

export class Joints {
  #moved = new Map(); // values by number of a chain, where they are not those at first
  #places = new Map(); // by artifact and layer, of layers that have moved: { values, lower, upper }

  /** chains: those of the page; remembered: a Map of values by number of a chain, from an address. */
  constructor(chains, remembered = new Map()) {
    this.chains = chains;
    for (const [number, values] of remembered) {
      const joints = chains[number]?.joints;
      if (joints?.length !== values.length) continue;
      this.#moved.set(number, values.map((value, i) => Math.min(Math.max(value, joints[i].lower), joints[i].upper)));
    }
  }

  /** What an address has to remember. */
  get moved() {
    return this.#moved;
  }

  values(number) {
    return this.#moved.get(number) ?? chain.firstValues(this.chains[number]);
  }

  set(number, joint, value) {
    this.#moved.set(number, this.values(number).map((old, i) => (i === joint ? value : old)));
  }

  reset(number) {
    this.#moved.delete(number);
  }

  /** The chains of these layers that have joints: [{ number, name, joints, values }]. */
  of(layers) {
    const numbers = new Set(layers.map((layer) => layer.chain));
    return [...numbers].filter((number) => this.chains[number]?.joints.length > 0)
      .map((number) => ({ number, ...this.chains[number], values: this.values(number) }));
  }

  /** Bounding box of layers where the joints have put them, or null. */
  boxOf(layers) {
    return boxOf(layers.map((layer) => (this.#moved.has(layer.chain) ? this.#places.get(layer.drawing) : null) ?? layer));
  }

  /** Moves the drawing of a layer to where its joints put it. */
  async move(layer, drawing, blocks) {
    if (layer.chain === undefined) return;
    const [vertices, frames] = [await blocks.get(layer.vertices), await blocks.get(layer.frames)];
    const radii = layer.radii === undefined ? undefined : await blocks.get(layer.radii);
    const values = this.values(layer.chain);
    const motions = chain.motions(this.chains[layer.chain], values);
    if (motions === null) {
      this.#places.delete(layer.drawing);
      drawing.move(vertices, radii);
    } else if (this.#places.get(layer.drawing)?.values !== values) {
      const grown = chain.growths(this.chains[layer.chain], values);
      const placed = chain.place({ vertices, frames, radii }, layer.centre, motions, grown);
      this.#places.set(layer.drawing, { values, lower: placed.lower, upper: placed.upper });
      drawing.move(placed.vertices, placed.radii);
    }
  }
}
