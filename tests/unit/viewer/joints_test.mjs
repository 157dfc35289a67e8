import assert from 'node:assert/strict';
import { test } from 'node:test';
import { growths, moved, motions, place, poses } from '../../../tools/viewer/src/chain.js';
import { Joints } from '../../../tools/viewer/src/joints.js';

const at = (...t) => [1, 0, 0, 0, 1, 0, 0, 0, 1, ...t];
// An arm that turns about z at (0, 0, 1), a tray that slides along its x from (2, 0, 0) on, and a door that follows the
// tray: a tenth of a turn, and ten turns for each metre.
const arm = {
  name: 'arm',
  frames: [
    { name: 'base', parent: -1, origin: at(0, 0, 0), motion: 'none', axis: [1, 0, 0], joint: -1, factor: 1, offset: 0 },
    { name: 'arm', parent: 0, origin: at(0, 0, 1), motion: 'turn', axis: [0, 0, 1], joint: 0, factor: 1, offset: 0 },
    { name: 'tray', parent: 1, origin: at(2, 0, 0), motion: 'slide', axis: [1, 0, 0], joint: 1, factor: 1, offset: 0 },
    { name: 'door', parent: 0, origin: at(5, 0, 0), motion: 'turn', axis: [0, 1, 0], joint: 1, factor: 20 * Math.PI, offset: 0.2 * Math.PI },
  ],
  joints: [
    { name: 'turn', unit: 'rad', lower: -2, upper: 2, value: 0 },
    { name: 'out', unit: 'm', lower: 0.25, upper: 1, value: 0.25 },
  ],
};
const near = (a, b) => a.forEach((x, i) => assert.ok(Math.abs(x - b[i]) < 1e-6, `${a} is not ${b}`));

test('frames are where their joints put them', () => {
  const [base, turned, tray, door] = poses(arm, [Math.PI / 2, 0.5]);
  near(moved(base, [1, 2, 3]), [1, 2, 3]);
  near(moved(turned, [1, 0, 0]), [0, 1, 1]);
  near(moved(tray, [0, 0, 0]), [0, 2.5, 1]);
  // 0.1 + 10 * 0.5 turns are a tenth of a turn; x goes to -z about y.
  near(moved(door, [1, 0, 0]), [5 + Math.cos(0.2 * Math.PI), 0, -Math.sin(0.2 * Math.PI)]);
});

test('layers move from the pose that they are given in', () => {
  assert.equal(motions(arm, [0, 0.25]), null, 'nothing has moved');
  const all = motions(arm, [Math.PI / 2, 0.75]);
  // A ball of the base and one of the tray, which is at (2.25, 0, 1) at first; the centre of the layer is (1, 1, 1).
  const layer = { vertices: Float32Array.from([-1, -1, -1, 1.25, -1, 0]), frames: [0, 2], radii: [0.5, 0.25] };
  const placed = place(layer, [1, 1, 1], all);
  near([...placed.vertices], [-1, -1, -1, -1, 1.75, 0]);
  near(placed.lower, [-0.5, -0.5, -0.5]);
  near(placed.upper, [0.5, 3, 1.25]);
});

test('radii grow with the joints of all frames that a ball hangs on', () => {
  const modes = {
    frames: [
      { parent: -1, origin: at(0, 0, 0), motion: 'slide', axis: [1, 0, 0], joint: 0, factor: 2, offset: 0, growth: Math.log(2) },
      { parent: 0, origin: at(0, 0, 0), motion: 'none', axis: [1, 0, 0], joint: 1, factor: 1, offset: 0, growth: Math.log(3) },
    ],
    joints: [{ name: 'mode 0', lower: -3, upper: 3, value: 0 }, { name: 'mode 1', lower: -3, upper: 3, value: 1 }],
  };
  assert.equal(growths(arm, [1, 1]), null, 'nothing of a robot grows');
  near(growths(modes, [1, 0]), [2, 2 / 3]);
  const layer = { vertices: Float32Array.from([0, 0, 0, 1, 0, 0]), frames: [0, 1], radii: Float32Array.from([1, 3]) };
  const placed = place(layer, [0, 0, 0], motions(modes, [1, 0]), growths(modes, [1, 0]));
  near([...placed.radii], [2, 2]);
  near([...placed.vertices], [2, 0, 0, 3, 0, 0]);
  near(placed.lower, [0, -2, -2]);
  near(placed.upper, [5, 2, 2]);
  assert.equal(place(layer, [0, 0, 0], motions(arm, [1, 1])).radii, layer.radii);
});

test('values from an address are kept within the limits, and those of other robots are ignored', () => {
  const joints = new Joints([arm], new Map([[0, [9, -9]]]));
  assert.deepEqual(joints.values(0), [2, 0.25]);
  assert.deepEqual(new Joints([arm], new Map([[0, [1]], [3, [1, 1]]])).moved, new Map());
  joints.reset(0);
  assert.deepEqual(joints.values(0), [0, 0.25]);
  joints.set(0, 1, 0.5);
  assert.deepEqual(joints.values(0), [0, 0.5]);
});

test('only layers that can be shown bring sliders', () => {
  const joints = new Joints([arm, { name: 'rock', frames: [arm.frames[0]], joints: [] }]);
  assert.deepEqual(joints.of([{ chain: undefined }, { chain: 1 }]), []);
  assert.deepEqual(joints.of([{ chain: 0 }, { chain: 0 }]).map(({ name, values }) => [name, values]), [['arm', [0, 0.25]]]);
});

test('the box follows what has moved', async () => {
  const layer = { chain: 0, drawing: 'a', vertices: 0, frames: 1, centre: [0, 0, 0], lower: [2.25, 0, 1], upper: [2.25, 0, 1] };
  const blocks = { get: async (number) => [Float32Array.from([2.25, 0, 1]), Uint32Array.from([2])][number] };
  let shown = null;
  const drawing = { arrays: {}, move: (vertices) => { shown = [...vertices]; } };
  const joints = new Joints([arm]);
  joints.set(0, 1, 1);
  await joints.move(layer, drawing, blocks);
  near(shown, [3, 0, 1]);
  near(joints.boxOf([layer]).upper, [3, 0, 1]);
  joints.reset(0);
  await joints.move(layer, drawing, blocks);
  near(shown, [2.25, 0, 1]);
  near(joints.boxOf([layer]).upper, [2.25, 0, 1]);
});
