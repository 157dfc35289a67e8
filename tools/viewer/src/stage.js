// The 3D view: camera, clipping plane, drawings. It draws when something has changed, and not otherwise.
import {
  DataTexture,
  Group,
  LinearFilter,
  Matrix4,
  NearestFilter,
  OrthographicCamera,
  PerspectiveCamera,
  RGBAFormat,
  Scene,
  Vector2,
  Vector3,
  Vector4,
  WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { channels } from './palette.js';

const fieldOfView = 35; // degrees
const slowFrame = 70; // ms; slower frames are drawn with fewer pixels while the view moves
const coarsest = 0.1; // of the pixels of a row
const settling = 250; // ms after the last change until the picture is drawn as well as it can be

// Fragments of balls that a frame may have while the view changes, and at rest: what takes a graphics card about a
// tenth of a second and a second. Without one, Chromium's SwiftShader does about seven million a second on a core.
const hardware = { moving: 5e8, rest: 5e9 };
const software = { moving: 1e7, rest: 4e7 };

function texture(colours, filter) {
  const data = new Uint8Array(colours.length * 4);
  colours.forEach((hex, i) => data.set([...channels(hex), 255], 4 * i));
  const result = new DataTexture(data, colours.length, 1, RGBAFormat);
  result.minFilter = result.magFilter = filter;
  result.needsUpdate = true;
  return result;
}

/** Directions from the target to the camera, and what is up in the picture, with y or z as the model's up. */
const views = {
  y: { front: [[0, 0, 1], [0, 1, 0]], right: [[1, 0, 0], [0, 1, 0]], top: [[0, 1, 0], [0, 0, -1]], iso: [[1, 0.8, 1.2], [0, 1, 0]] },
  z: { front: [[0, -1, 0], [0, 0, 1]], right: [[1, 0, 0], [0, 0, 1]], top: [[0, 0, 1], [0, 1, 0]], iso: [[1, -1.2, 0.8], [0, 0, 1]] },
};

export class Stage {
  #requested = 0;
  #scale = 1; // of the pixels of a row that are drawn
  #slow = 1; // the part of that which the speed of frames decides
  #moving = false;
  #lastFrame = 0;

  /** centre: of the scene, in model units; everything is drawn relative to it. */
  constructor(canvas, palette, centre) {
    this.canvas = canvas;
    this.centre = centre;
    this.renderer = new WebGLRenderer({ canvas, antialias: true, stencil: true, powerPreference: 'high-performance' });
    const gl = this.renderer.getContext();
    const names = gl.getExtension('WEBGL_debug_renderer_info');
    const name = gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER);
    this.budget = /swiftshader|llvmpipe|software|basic render/i.test(name) ? software : hardware;
    this.scalarTable = texture(palette.scalar, LinearFilter);
    this.categoryTable = texture(palette.categories, NearestFilter);
    this.scene = new Scene();
    this.shown = [];
    this.drawings = new Group();
    this.scene.add(this.drawings);
    this.uniforms = {
      clipPlane: { value: new Vector4() },
      clipping: { value: false },
      orthographic: { value: false },
      viewport: { value: new Vector2(1, 1) },
      near: { value: 0.1 },
      sceneRadius: { value: 1 },
      pointSize: { value: 4 },
      lineWidth: { value: 2 },
    };
    this.perspective = new PerspectiveCamera(fieldOfView, 1, 0.1, 10);
    this.parallel = new OrthographicCamera(-1, 1, 1, -1, 0.1, 10);
    this.camera = this.perspective;
    this.target = new Vector3();
    this.up = 'y';
    this.bound = { centre: new Vector3(), radius: 1 };
    this.clip = null; // { axis: 0 | 1 | 2, position (model units), flipped }
    this.onchange = () => {};
    this.#control();
    this.#resize();
    new ResizeObserver(([{ contentRect }]) => {
      if (contentRect.width !== this.width || contentRect.height !== this.height) this.#resize();
    }).observe(canvas.parentElement);
  }

  get common() {
    return { uniforms: this.uniforms, table: this.scalarTable };
  }

  #control() {
    this.controls?.dispose();
    this.camera.up.set(...(this.up === 'y' ? [0, 1, 0] : [0, 0, 1]));
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.target = this.target;
    this.controls.zoomToCursor = true;
    this.controls.zoomSpeed = 1.5;
    this.controls.addEventListener('change', () => this.changed());
  }

  /** Draws with as many pixels as there is time for. */
  #settle() {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => {
      this.#moving = false;
      this.#slow = 1;
      this.render();
    }, settling);
  }

  #resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    if (width === 0 || height === 0) return;
    this.width = width;
    this.height = height;
    this.#setSize();
    this.render();
  }

  #setSize() {
    this.pixelRatio = Math.min(window.devicePixelRatio, 2) * this.#scale;
    this.renderer.setPixelRatio(this.pixelRatio);
    this.renderer.setSize(this.width, this.height, false);
    this.#frame();
  }

  /** What does not depend on where the camera is. */
  #frame() {
    const aspect = this.width / this.height;
    this.perspective.aspect = aspect;
    const half = (this.parallel.top - this.parallel.bottom) / 2;
    this.parallel.left = -half * aspect;
    this.parallel.right = half * aspect;
    this.renderer.getDrawingBufferSize(this.uniforms.viewport.value);
    this.uniforms.pointSize.value = Math.max(2, 4 * this.pixelRatio);
    this.uniforms.lineWidth.value = Math.max(1, 1.8 * this.pixelRatio);
  }

  changed() {
    this.request();
    this.onchange();
  }

  /** Draws soon; quickly at first, and as well as it can be when nothing changes any more. */
  request() {
    this.#moving = true;
    this.#settle();
    this.#requested ||= requestAnimationFrame((now) => {
      const elapsed = now - this.#lastFrame;
      this.#lastFrame = now;
      if (elapsed > slowFrame && elapsed < 1000) this.#slow = Math.max(coarsest, this.#slow * 0.8);
      this.render();
    });
  }

  /** About how many fragments the visible balls have at full resolution. */
  #fragments() {
    const ratio = Math.min(window.devicePixelRatio, 2);
    const screen = this.width * this.height * ratio * ratio;
    const view = this.camera.matrixWorldInverse.elements;
    const scale = (this.height * ratio * this.camera.projectionMatrix.elements[5]) / 2;
    const parallel = this.camera === this.parallel;
    let sum = 0;
    for (const { layer, arrays, uniforms } of this.shown) {
      if (layer.shape !== 'balls') continue;
      const { vertices, radii } = arrays;
      const [x, y, z] = layer.centre.map((c, i) => c - this.centre[i]);
      const offset = view[2] * x + view[6] * y + view[10] * z + view[14];
      const passes = uniforms.opacity.value < 1 ? 2 : 1;
      for (let i = 0; i < radii.length; ++i) {
        const depth = -(view[2] * vertices[3 * i] + view[6] * vertices[3 * i + 1] + view[10] * vertices[3 * i + 2] + offset);
        const size = parallel ? radii[i] * scale : (radii[i] * scale) / Math.max(depth, radii[i]);
        sum += depth < -radii[i] ? 0 : passes * Math.min(Math.PI * size * size, screen);
      }
    }
    return sum;
  }

  #chooseScale() {
    const budget = this.#moving ? this.budget.moving : this.budget.rest;
    const wanted = Math.min(1, Math.sqrt(budget / Math.max(this.#fragments(), 1)) * (this.#moving ? this.#slow : 1));
    const scale = Math.max(coarsest, wanted);
    if (scale === this.#scale || Math.abs(scale / this.#scale - 1) < 0.1 && scale < 1) return;
    this.#scale = scale;
    this.#setSize();
  }

  /** Near and far are as tight as what is visible. */
  #range() {
    const { camera } = this;
    camera.updateMatrixWorld();
    const depth = -this.bound.centre.clone().applyMatrix4(camera.matrixWorldInverse).z;
    const radius = this.bound.radius * 1.01;
    if (camera === this.perspective) {
      camera.far = Math.max(depth + radius, radius * 1e-3);
      camera.near = Math.max(depth - radius, camera.far * 2e-4);
    } else {
      camera.near = depth - radius;
      camera.far = depth + radius;
    }
    camera.updateProjectionMatrix();
    this.uniforms.near.value = camera.near;
    this.uniforms.orthographic.value = camera !== this.perspective;
    this.uniforms.sceneRadius.value = this.bound.radius;
  }

  #cut() {
    this.uniforms.clipping.value = this.clip !== null;
    if (this.clip === null) return;
    const { axis, position, flipped } = this.clip;
    const sign = flipped ? -1 : 1;
    const normal = new Vector3().setComponent(axis, sign);
    const constant = -sign * (position - this.centre[axis]);
    // A plane (n, w) becomes (n, w) M^-1 in view space.
    const plane = new Vector4(normal.x, normal.y, normal.z, constant);
    plane.applyMatrix4(new Matrix4().copy(this.camera.matrixWorld).transpose());
    this.uniforms.clipPlane.value.copy(plane);
  }

  render() {
    cancelAnimationFrame(this.#requested);
    this.#requested = 0;
    if (!this.width) return;
    this.#range();
    this.#chooseScale();
    this.#cut();
    this.renderer.render(this.scene, this.camera);
  }

  /** Draws now, as well as it can be, and waits until that is done. */
  finish() {
    clearTimeout(this.timer);
    this.#moving = false;
    this.#slow = 1;
    this.render();
    this.#wait();
  }

  /** Draws now and quickly, and waits until that is done. */
  quick() {
    this.request();
    this.render();
    this.#wait();
  }

  #wait() {
    const gl = this.renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  }

  /** Shows these drawings and no others. */
  show(drawings) {
    this.shown = drawings;
    this.drawings.clear();
    for (const drawing of drawings) {
      const offset = drawing.layer.centre.map((x, i) => x - this.centre[i]);
      drawing.object.position.set(...offset);
      this.drawings.add(drawing.object);
    }
    this.request();
  }

  /** "#ffffff" */
  setGround(colour) {
    this.renderer.setClearColor(colour);
    this.request();
  }

  /** Tells what there is to see: a box in model units. */
  setBound(box) {
    if (!box) return;
    const lower = new Vector3(...box.lower.map((x, i) => x - this.centre[i]));
    const upper = new Vector3(...box.upper.map((x, i) => x - this.centre[i]));
    this.bound.centre.addVectors(lower, upper).multiplyScalar(0.5);
    this.bound.radius = Math.max(lower.distanceTo(upper) / 2, 1e-30);
    this.controls.minDistance = this.bound.radius * 1e-4;
    this.controls.maxDistance = this.bound.radius * 100;
    this.request();
  }

  /** The whole of a box, seen from where the camera is, or from "front", "right", "top" or "iso". */
  fit(box, view) {
    if (!box) return;
    const centre = new Vector3(...box.lower.map((x, i) => (x + box.upper[i]) / 2 - this.centre[i]));
    const direction = view
      ? new Vector3(...views[this.up][view][0]).normalize()
      : this.camera.position.clone().sub(this.target).normalize();
    this.target.copy(centre);
    // Straight from above the turntable has no up; a hair's breadth aside it has.
    if (view === 'top') direction.add(new Vector3(...views[this.up].front[0]).multiplyScalar(1e-4)).normalize();
    this.camera.position.copy(centre).add(direction);
    this.camera.lookAt(centre);
    this.camera.updateMatrixWorld();
    const toView = this.camera.matrixWorldInverse;
    const slope = Math.tan((fieldOfView / 2) * (Math.PI / 180));
    const aspect = this.width / this.height;
    let distance = 0;
    let extent = 0;
    for (let corner = 0; corner < 8; ++corner) {
      const p = new Vector3(...[0, 1, 2].map((i) => (corner & (1 << i) ? box.upper : box.lower)[i] - this.centre[i]));
      p.applyMatrix4(toView);
      const across = Math.max(Math.abs(p.x) / aspect, Math.abs(p.y));
      distance = Math.max(distance, across / slope + p.z + 1);
      extent = Math.max(extent, across);
    }
    distance *= 1.06;
    this.camera.position.copy(centre).addScaledVector(direction, distance);
    this.#extent(extent * 1.06);
    this.controls.update();
    this.changed();
  }

  /** Half of the height that the parallel camera shows. */
  #extent(half) {
    this.parallel.zoom = 1;
    this.parallel.top = half;
    this.parallel.bottom = -half;
    if (this.width) this.#frame();
  }

  setParallel(parallel) {
    const next = parallel ? this.parallel : this.perspective;
    if (next === this.camera) return;
    const before = this.camera;
    const slope = Math.tan((fieldOfView / 2) * (Math.PI / 180));
    const direction = before.position.clone().sub(this.target);
    next.position.copy(before.position);
    next.quaternion.copy(before.quaternion);
    if (parallel) {
      this.#extent(direction.length() * slope);
    } else {
      const half = this.parallel.top / this.parallel.zoom;
      next.position.copy(this.target).addScaledVector(direction.normalize(), half / slope);
    }
    this.camera = next;
    this.#control();
    this.controls.update();
    this.changed();
  }

  setUp(up) {
    if (up === this.up) return;
    this.up = up;
    this.#control();
    this.controls.update();
    this.changed();
  }

  /** The camera in model units, for the address of the page. */
  getCamera() {
    const model = (v) => v.toArray().map((x, i) => x + this.centre[i]);
    return {
      position: model(this.camera.position),
      target: model(this.target),
      up: this.up,
      half: this.camera === this.parallel ? this.parallel.top / this.parallel.zoom : null,
    };
  }

  setCamera({ position, target, up, half }) {
    const own = (p) => p.map((x, i) => x - this.centre[i]);
    this.camera = half ? this.parallel : this.perspective;
    this.up = up;
    this.camera.position.set(...own(position));
    this.target.set(...own(target));
    if (half) this.#extent(half);
    this.#control();
    this.controls.update();
    this.request();
  }

  /** A point in model units -> { x, y } in CSS pixels of the page, and its depth in view space. */
  project(point) {
    this.camera.updateMatrixWorld();
    const p = new Vector3(...point.map((x, i) => x - this.centre[i]));
    const depth = -p.clone().applyMatrix4(this.camera.matrixWorldInverse).z;
    p.project(this.camera);
    const { left, top } = this.canvas.getBoundingClientRect();
    return { x: left + ((p.x + 1) / 2) * this.width, y: top + ((1 - p.y) / 2) * this.height, depth };
  }

  /** The ray through a place of the page: { origin, direction } relative to the centre of the scene. */
  ray(x, y) {
    const { left, top } = this.canvas.getBoundingClientRect();
    const place = [((x - left) / this.width) * 2 - 1, 1 - ((y - top) / this.height) * 2];
    this.camera.updateMatrixWorld();
    const near = new Vector3(...place, -1).unproject(this.camera);
    const far = new Vector3(...place, 1).unproject(this.camera);
    return { origin: near, direction: far.sub(near).normalize() };
  }
}
