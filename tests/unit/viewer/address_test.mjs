import assert from 'node:assert/strict';
import { test } from 'node:test';
import { read, written } from '../../../tools/viewer/src/address.js';

const camera = { position: [1.5, -2, 1e-7], target: [0, 0.25, 3], up: 'z', half: null };

test('what is written can be read', () => {
  for (const state of [
    { camera, variant: 3, node: '[epsilon=0.1]/prune & <script>' },
    { camera: { ...camera, up: 'y', half: 0.75 } },
    { camera, joints: new Map([[0, [0.5, -1]], [2, [1e-7]]]) },
  ]) {
    const again = read(`#${written(state)}`);
    assert.deepEqual(again.camera, state.camera);
    assert.equal(again.variant, state.variant);
    assert.equal(again.node, state.node);
    assert.deepEqual(again.joints, state.joints);
  }
});

test('an address that is none of ours is ignored', () => {
  for (const text of ['', '#', '#camera=1,2,3', '#camera=1,2,3,4,5,6,q', '#camera=1,2,3,4,5,x,y', '#camera=1,2,3,1,2,3,y',
    '#camera=1,2,3,4,5,6,y,-1', '#camera=1,2,3,4,5,6,y,1,2', '#variant=-1', '#variant=x', '#node=%', '#joints=', '#joints=0', '#joints=0,', '#joints=0,x', '#joints=-1,2', '#joints=0.5,2', '#javascript:x']) {
    assert.deepEqual(read(text), {}, text);
  }
});
