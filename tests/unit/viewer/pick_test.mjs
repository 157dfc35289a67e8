import assert from 'node:assert/strict';
import { test } from 'node:test';
import { pick } from '../../../tools/viewer/src/pick.js';

const balls = (centre, vertices, radii) => ({
  layer: { shape: 'balls', count: radii.length, centre },
  arrays: { vertices: Float32Array.from(vertices), radii: Float32Array.from(radii) },
});
const triangle = {
  layer: { shape: 'triangles', count: 1, centre: [0, 0, 0] },
  arrays: { vertices: Float32Array.from([-1, -1, 2, 3, -1, 2, -1, 3, 2]), triangles: Uint32Array.from([0, 1, 2]) },
};
const everything = () => true;
const down = [0, 0, -1];

test('the nearest ball along a ray is hit, in model units', () => {
  // Layer and scene have centres of their own: the first ball is at (10, 0, 0), the second one at (10, 0, 3).
  const drawing = balls([10, 0, 1], [0, 0, -1, 0, 0, 2], [1, 0.5]);
  const hit = pick([drawing], [0, 0, 9], down, [10, 0, 0], everything);
  assert.equal(hit.index, 1);
  assert.deepEqual(hit.point, [10, 0, 3.5]);
  assert.equal(pick([drawing], [1.01, 0, 9], down, [10, 0, 0], everything), null);
});

test('a triangle is hit inside, not beside, and names its nearest corner', () => {
  const hit = pick([triangle], [1.5, -0.5, 9], down, [0, 0, 0], everything);
  assert.deepEqual([hit.index, hit.vertex], [0, 1]);
  assert.equal(pick([triangle], [1.5, 1.5, 9], down, [0, 0, 0], everything), null);
});

test('what is cut away or behind the eye is not hit', () => {
  const drawing = balls([0, 0, 0], [0, 0, 0], [1]);
  assert.equal(pick([triangle, drawing], [0, 0, 9], down, [0, 0, 0], ([, , z]) => z < 1.5).drawing, drawing);
  assert.equal(pick([triangle], [0, 0, -9], down, [0, 0, 0], everything), null);
});
