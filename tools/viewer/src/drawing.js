// A layer in 3D: points, balls, segments or triangles on the graphics card.
import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  Group,
  GLSL3,
  InstancedBufferAttribute,
  InstancedBufferGeometry,
  LineSegments,
  Mesh,
  NotEqualStencilFunc,
  Points,
  RawShaderMaterial,
  ReplaceStencilOp,
  Vector2,
  Vector3,
} from 'three';
import * as shaders from './shaders.js';

const square = [-1, -1, 1, -1, 1, 1, -1, 1];
const ribbon = new Float32Array([0, -1, 0, 1, -1, 0, 1, 1, 0, 0, 1, 0]);
const twoTriangles = [0, 1, 2, 0, 2, 3];

/** Indices of the edges of triangles, each edge once. */
export function edgesOf(triangles, vertices) {
  const keys = new Float64Array(triangles.length);
  for (let i = 0; i < triangles.length; i += 3) {
    for (let k = 0; k < 3; ++k) {
      const a = triangles[i + k];
      const b = triangles[i + ((k + 1) % 3)];
      keys[i + k] = Math.min(a, b) * vertices + Math.max(a, b);
    }
  }
  keys.sort();
  const edges = [];
  for (let i = 0; i < keys.length; ++i) {
    if (i > 0 && keys[i] === keys[i - 1]) continue;
    edges.push(Math.floor(keys[i] / vertices), keys[i] % vertices);
  }
  return new Uint32Array(edges);
}

/** Elements of an array of vectors by index. */
function gathered(values, indices, size) {
  const result = new Float32Array(indices.length * size);
  for (let i = 0; i < indices.length; ++i) {
    for (let k = 0; k < size; ++k) result[i * size + k] = values[indices[i] * size + k];
  }
  return result;
}

const every = (array, step, first) => Uint32Array.from({ length: array.length / step }, (_, i) => array[i * step + first]);

function repeated(values, times) {
  const result = new Float32Array(values.length * times);
  for (let i = 0; i < values.length; ++i) result.fill(values[i], i * times, (i + 1) * times);
  return result;
}

export class Drawing {
  /** arrays: { vertices, radii, segments, triangles } as the shape has them. */
  constructor(layer, arrays, common) {
    this.layer = layer;
    this.arrays = arrays;
    this.object = new Group();
    this.uniforms = {
      ...common.uniforms,
      colourMode: { value: 0 },
      plainColour: { value: new Vector3(0.5, 0.5, 0.5) },
      table: { value: common.table },
      range: { value: new Vector2(0, 1) },
      opacity: { value: 1 },
      smoothEdges: { value: true },
      unlit: { value: false },
    };
    this.#build();
  }

  #material(shape, more = {}) {
    return new RawShaderMaterial({
      glslVersion: GLSL3,
      vertexShader: shaders[`${shape}Vertex`],
      fragmentShader: shaders[`${shape}Fragment`],
      uniforms: this.uniforms,
      side: DoubleSide,
      forceSinglePass: true, // else three draws translucent surfaces twice, back and front
      ...more,
    });
  }

  #build() {
    const { shape } = this.layer;
    const { vertices, radii, segments, triangles } = this.arrays;
    let geometry;
    if (shape === 'balls') {
      // Four vertices a ball: instances of two triangles are slow where there is no graphics card.
      const { count } = this.layer;
      const four = Uint32Array.from({ length: 4 * count }, (_, i) => i >> 2);
      geometry = new BufferGeometry();
      geometry.setAttribute('position', new BufferAttribute(gathered(vertices, four, 3), 3));
      geometry.setAttribute('radius', new BufferAttribute(repeated(radii, 4), 1));
      geometry.setAttribute('corner', new BufferAttribute(Int8Array.from({ length: 8 * count }, (_, i) => square[i % 8]), 2));
      geometry.setIndex(new BufferAttribute(Uint32Array.from({ length: 6 * count }, (_, i) => 4 * Math.floor(i / 6) + twoTriangles[i % 6]), 1));
    } else if (shape === 'segments') {
      geometry = new InstancedBufferGeometry();
      geometry.instanceCount = this.layer.count;
      geometry.setAttribute('position', new BufferAttribute(ribbon, 3));
      geometry.setAttribute('start', new InstancedBufferAttribute(gathered(vertices, every(segments, 2, 0), 3), 3));
      geometry.setAttribute('end', new InstancedBufferAttribute(gathered(vertices, every(segments, 2, 1), 3), 3));
      geometry.setIndex(twoTriangles);
    } else {
      geometry = new BufferGeometry();
      geometry.setAttribute('position', new BufferAttribute(vertices, 3));
      if (shape === 'triangles') geometry.setIndex(new BufferAttribute(triangles, 1));
    }
    this.geometry = geometry;
    const material = this.#material(shape.slice(0, -1));
    // A translucent layer shows its nearest surface only: its depth is drawn first, then its colour, and where
    // several surfaces are equally near, the stencil lets one of them through.
    const depth = this.#material(shape.slice(0, -1), { colorWrite: false, transparent: true });
    const Kind = shape === 'points' ? Points : Mesh;
    this.main = new Kind(geometry, material);
    this.depth = new Kind(geometry, depth);
    for (const object of [this.depth, this.main]) {
      object.frustumCulled = false; // squares are larger than their centres say
      this.object.add(object);
    }
    this.setColour({ mode: 'plain', colour: [128, 128, 128] });
  }

  /** { mode: 'plain', colour } | { mode: 'scalar' | 'categories', values, perElement, min, max, table } */
  setColour({ mode, colour, values, perElement, min, max, table }) {
    const { uniforms } = this;
    uniforms.colourMode.value = { plain: 0, scalar: 1, categories: 2 }[mode];
    if (mode === 'plain') uniforms.plainColour.value.fromArray(colour.map((channel) => channel / 255));
    else uniforms.table.value = table;
    if (mode === 'scalar') uniforms.range.value.set(min, max);
    if (this.values !== values || !this.coloured) this.#setValues(values, perElement);
    this.values = values;
    this.coloured = true;
  }

  #setValues(values, perElement) {
    const { shape, count } = this.layer;
    const { vertices, segments, triangles } = this.arrays;
    const { geometry } = this;
    const numbers = values ? (values instanceof Float32Array ? values : Float32Array.from(values)) : null;
    if (shape === 'balls') {
      geometry.setAttribute('value', new BufferAttribute(numbers ? repeated(numbers, 4) : new Float32Array(4 * count), 1));
    } else if (shape === 'segments') {
      const at = (end) =>
        numbers === null ? new Float32Array(count) : perElement ? numbers : gathered(numbers, every(segments, 2, end), 1);
      geometry.setAttribute('startValue', new InstancedBufferAttribute(at(0), 1));
      geometry.setAttribute('endValue', new InstancedBufferAttribute(at(1), 1));
    } else if (shape === 'triangles') {
      // One value per triangle: corners are no longer shared.
      const apart = Boolean(numbers) && Boolean(perElement);
      if (apart !== Boolean(this.apart)) {
        geometry.setAttribute('position', new BufferAttribute(apart ? gathered(vertices, triangles, 3) : vertices, 3));
        geometry.setIndex(apart ? null : new BufferAttribute(triangles, 1));
        this.apart = apart;
      }
      const length = apart ? 3 * count : vertices.length / 3;
      geometry.setAttribute('value', new BufferAttribute(apart ? repeated(numbers, 3) : numbers ?? new Float32Array(length), 1));
    } else {
      geometry.setAttribute('value', new BufferAttribute(numbers ?? new Float32Array(count), 1));
    }
  }

  /** opacity in (0, 1]; style of triangles: "solid", "edges" (solid with edges) or "wire"; order of blending. */
  setLook({ opacity, style = 'solid', order = 0 }) {
    const translucent = opacity < 1;
    this.uniforms.opacity.value = opacity;
    this.uniforms.smoothEdges.value = !translucent;
    const wire = this.layer.shape === 'triangles' && style !== 'solid';
    if (wire && !this.wire) {
      const geometry = new BufferGeometry();
      const { vertices, triangles } = this.arrays;
      geometry.setAttribute('position', new BufferAttribute(vertices, 3));
      geometry.setAttribute('value', new BufferAttribute(new Float32Array(vertices.length / 3), 1));
      geometry.setIndex(new BufferAttribute(edgesOf(triangles, vertices.length / 3), 1));
      const material = this.#material('triangle');
      material.uniforms = { ...this.uniforms, unlit: { value: true }, colourMode: { value: 0 } };
      this.wire = new LineSegments(geometry, material);
      this.wire.frustumCulled = false;
      this.object.add(this.wire);
    }
    this.main.visible = style !== 'wire' || this.layer.shape !== 'triangles';
    this.depth.visible = translucent && this.main.visible;
    if (this.wire) this.wire.visible = wire;
    for (const { material } of [this.main, ...(this.wire ? [this.wire] : [])]) {
      if (material.transparent !== translucent) material.needsUpdate = true;
      material.stencilWrite = translucent;
      material.stencilFunc = NotEqualStencilFunc;
      material.stencilZPass = ReplaceStencilOp;
      material.stencilRef = (order % 255) + 1;
      material.transparent = translucent;
      material.alphaToCoverage = !translucent && this.layer.shape !== 'triangles' && this.layer.shape !== 'segments';
    }
    // Edges lie on their triangles: these give way.
    for (const { material } of [this.main, this.depth]) {
      material.polygonOffset = wire;
      material.polygonOffsetFactor = material.polygonOffsetUnits = 1;
    }
    this.depth.renderOrder = 3 * order;
    this.main.renderOrder = 3 * order + 1;
    if (this.wire) this.wire.renderOrder = 3 * order + 2;
  }

  /** Puts the vertices elsewhere: as many, relative to the same centre; and of balls gives them other radii. */
  move(vertices, radii = this.arrays.radii) {
    const same = radii === this.arrays.radii;
    if (vertices === this.arrays.vertices && same) return;
    this.arrays = { ...this.arrays, vertices };
    if (!same) this.arrays.radii = radii; // only balls have some
    const { segments, triangles } = this.arrays;
    const set = (geometry, name, values) => {
      const attribute = geometry.getAttribute(name);
      attribute.array = values;
      attribute.needsUpdate = true;
    };
    if (this.layer.shape === 'balls') {
      if (!same) set(this.geometry, 'radius', repeated(radii, 4));
      set(this.geometry, 'position', gathered(vertices, Uint32Array.from({ length: 4 * this.layer.count }, (_, i) => i >> 2), 3));
    } else if (this.layer.shape === 'segments') {
      set(this.geometry, 'start', gathered(vertices, every(segments, 2, 0), 3));
      set(this.geometry, 'end', gathered(vertices, every(segments, 2, 1), 3));
    } else {
      set(this.geometry, 'position', this.apart ? gathered(vertices, triangles, 3) : vertices);
    }
    if (this.wire) set(this.wire.geometry, 'position', vertices);
  }

  dispose() {
    for (const object of [this.main, this.depth, this.wire]) {
      object?.geometry.dispose();
      object?.material.dispose();
    }
  }
}
