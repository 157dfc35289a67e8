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
const coarsest = 0.35;

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
  #scale = 1;
  #moving = false;
  #lastFrame = 0;

  /** centre: of the scene, in model units; everything is drawn relative to it. */
  constructor(canvas, palette, centre) {
    this.canvas = canvas;
    this.centre = centre;
    this.renderer = new WebGLRenderer({ canvas, antialias: true, powerPreference: 'high-performance' });
    this.scalarTable = texture(palette.scalar, LinearFilter);
    this.categoryTable = texture(palette.categories, NearestFilter);
    this.scene = new Scene();
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
    this.controls.addEventListener('start', () => (this.#moving = true));
    this.controls.addEventListener('end', () => this.#rest());
  }

  #rest() {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => {
      this.#moving = false;
      if (this.#scale === 1) return;
      this.#scale = 1;
      this.#resize();
    }, 200);
  }

  #resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    if (width === 0 || height === 0) return;
    this.width = width;
    this.height = height;
    this.pixelRatio = Math.min(window.devicePixelRatio, 2) * this.#scale;
    this.renderer.setPixelRatio(this.pixelRatio);
    this.renderer.setSize(width, height, false);
    this.#frame();
    this.render();
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

  request() {
    this.#requested ||= requestAnimationFrame((now) => {
      this.#adapt(now);
      this.render();
    });
  }

  #adapt(now) {
    const elapsed = now - this.#lastFrame;
    this.#lastFrame = now;
    if (!this.#moving || elapsed > 1000 || elapsed < slowFrame || this.#scale <= coarsest) return;
    this.#scale = Math.max(coarsest, this.#scale * 0.7);
    this.#resize();
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
    this.#cut();
    this.renderer.render(this.scene, this.camera);
  }

  /** Shows these drawings and no others. */
  show(drawings) {
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
