import assert from 'node:assert/strict';
import { test } from 'node:test';
import * as model from '../../../tools/viewer/src/model.js';

const variant = (values, graph = 0) => ({ graph, name: '', values, nodes: [], outputs: [] });
const layer = (name, shape, more = {}) => ({ name, shape, count: 1, attributes: [], visible: true, opacity: 1, colour_by: '', ...more });

test('axes are what differs between variants, numbers in order', () => {
  const variants = [
    variant({ epsilon: 1, strategy: 'hybrid', seed: 7 }),
    variant({ epsilon: 0.1, strategy: 'hybrid', seed: 7 }),
    variant({ epsilon: 10, strategy: 'greedy', seed: 7 }),
  ];
  assert.deepEqual(model.axesOf(variants), [
    { name: 'epsilon', values: [0.1, 1, 10], numeric: true },
    { name: 'strategy', values: ['greedy', 'hybrid'], numeric: false },
  ]);
});

test('several runs are told apart by an axis', () => {
  const graphs = [{ run: 'a', name: 'g.json' }, { run: 'b', name: 'g.json' }];
  const variants = model.withRuns([variant({}), variant({}, 1)], graphs);
  assert.deepEqual(model.axesOf(variants).map(({ name, values }) => [name, values]), [['run', ['a g.json', 'b g.json']]]);
  assert.deepEqual(model.withRuns([variant({ e: 1 })], graphs)[0].values, { e: 1 });
});

test('where a sweep lacks a combination the variant that agrees most is shown', () => {
  const variants = [
    variant({ epsilon: 0.1, strategy: 'a', mode: 'x' }),
    variant({ epsilon: 0.3, strategy: 'b', mode: 'y' }),
    variant({ epsilon: 0.3, strategy: 'b', mode: 'x' }),
  ];
  assert.equal(model.chooseVariant(variants, 0, 'epsilon', 0.3), 2);
  assert.equal(model.chooseVariant(variants, 1, 'strategy', 'a'), 0);
  assert.equal(model.chooseVariant(variants, 1, 'strategy', 'absent'), 1);
});

test('depth is the longest way from a source, and a cycle does not hang', () => {
  const nodes = [
    { path: 'd', inputs: { x: 'a.out', y: 'c.out' } },
    { path: 'a', inputs: {} },
    { path: 'b', inputs: { x: 'a.out' } },
    { path: 'c', inputs: { x: 'b.out', given: 'inputs/cover.cover' } },
  ];
  assert.deepEqual(Object.fromEntries(model.depths(nodes)), { a: 0, b: 1, c: 2, d: 3 });
  const cycle = [{ path: 'a', inputs: { x: 'b.o' } }, { path: 'b', inputs: { x: 'a.o' } }];
  assert.equal(model.depths(cycle).size, 2);
});

const scene = {
  graphs: [{
    nodes: [
      { path: 'sample', name: 'sample', inputs: {}, outputs: { points: { digest: 'p' } } },
      { path: '[e=1]/grow', name: 'grow', inputs: { points: 'sample.points' }, outputs: { balls: { digest: 'b' }, cover: { digest: 'c' } } },
    ],
  }],
  artifacts: {
    p: { type: 'PointSet', layers: [layer('points', 'points')] },
    b: { type: 'Balls', layers: [layer('balls', 'balls'), layer('centres', 'points')] },
    c: { type: 'CoverState' },
  },
  loose: [{ name: 'mesh.st', digest: 'absent' }, { name: 'given', digest: 'p' }],
};
const shown = {
  graph: 0, values: {}, nodes: [0, 1],
  outputs: [{ name: 'balls', from: '[e=1]/grow.balls', digest: 'b' }, { name: 'points', from: 'sample.points', digest: 'p' }],
};

test('outputs come in the order in which nodes make them, then what was given', () => {
  assert.deepEqual(model.groupsOf(scene, shown, null).map(({ title }) => title), ['points', 'balls', 'given']);
});

test('what has joints comes first, and hides its parts at first', () => {
  const whole = { type: 'Robot', layers: [layer('links', 'triangles', { chain: 0 })] };
  const parted = { ...scene, artifacts: { ...scene.artifacts, r: whole, m: { type: 'TriangleMesh', layers: [layer('mesh', 'triangles')] } }, loose: [] };
  const outputs = [{ name: 'robot', from: 'sample.robot', digest: 'r' }, { name: 'hand/mesh', from: '[e=1]/grow.mesh', digest: 'm' }];
  const groups = model.groupsOf(parted, { ...shown, outputs }, null);
  assert.deepEqual(groups.map(({ title }) => title), ['robot', 'hand/mesh']);
  const settings = model.firstSettings(groups, true);
  assert.deepEqual([...settings].map(([key, { visible }]) => [key, visible]).sort(), [['hand/mesh/mesh', false], ['robot/links', true]]);
  const points = [...groups, { title: 'open', layers: [layer('open', 'points', { key: 'open' })] }];
  assert.equal(model.firstSettings(points, true).get('open').visible, false, 'a part, although nothing else has points');
  points[2].given = true;
  assert.equal(model.firstSettings(points, true).get('open').visible, true, 'given by name');
});

test('a node shows its own artifacts, under a name without the variant', () => {
  const groups = model.groupsOf(scene, shown, '[e=1]/grow');
  assert.deepEqual(groups.map(({ title }) => title), ['grow.balls', 'grow.cover']);
  assert.deepEqual(groups[0].layers.map(({ key, title }) => [key, title]), [['grow.balls/balls', 'balls'], ['grow.balls/centres', 'centres']]);
  assert.deepEqual(model.groupsOf(scene, shown, '[e=1]/grow', true).map(({ title }) => title), ['grow.balls', 'grow.cover', 'points', 'balls', 'given']);
});

test('a layer that is alone in its artifact is called as the artifact is', () => {
  assert.equal(model.groupsOf(scene, shown, null)[0].layers[0].title, 'points');
  assert.equal(model.groupsOf(scene, shown, 'sample')[0].layers[0].title, 'sample.points');
});

test('of outputs of one shape only the last is visible, and balls let through what they enclose', () => {
  const groups = [
    { title: 'inner', layers: [layer('balls', 'balls', { key: 'inner' })] },
    { title: 'balls', layers: [layer('balls', 'balls', { key: 'balls' })] },
    { title: 'axis', layers: [layer('sheets', 'triangles', { key: 'sheets' }), layer('edges', 'segments', { key: 'edges' }), layer('far', 'points', { key: 'far', visible: false })] },
  ];
  const settings = model.firstSettings(groups, true);
  const visible = [...settings].filter(([, setting]) => setting.visible).map(([key]) => key);
  assert.deepEqual(visible.sort(), ['balls', 'edges', 'sheets']);
  assert.equal(settings.get('balls').opacity, 0.25);
  assert.equal(model.firstSettings(groups, false).get('inner').visible, true);
  assert.equal(model.firstSettings(groups.slice(0, 1), true).get('inner').opacity, 1);
});

test('a range spans all layers with numbers of a name', () => {
  const numbers = (min, max) => layer('x', 'balls', { attributes: [{ name: 'radius', min, max }] });
  const kinds = layer('y', 'balls', { attributes: [{ name: 'radius', categories: ['a'] }] });
  assert.deepEqual(model.rangeOf('radius', [numbers(2, 3), kinds, numbers(-1, 2.5)]), { min: -1, max: 3 });
  assert.equal(model.rangeOf('order', [numbers(2, 3)]), null);
});

test('translucent triangles are blended over balls', () => {
  const order = model.drawingOrder([layer('m', 'triangles'), layer('b', 'balls'), layer('p', 'points')]);
  assert.deepEqual(order.map(({ name }) => name), ['p', 'b', 'm']);
});

test('colours that mean the same are explained once', () => {
  const links = { attribute: 'link', categories: ['a', 'b'] };
  assert.ok(model.sameScale(links, { name: 'link', categories: ['a', 'b'] }));
  assert.ok(!model.sameScale(links, { name: 'link', categories: ['a', 'c'] }));
  assert.ok(!model.sameScale(links, { name: 'kind', categories: ['a', 'b'] }));
  assert.ok(!model.sameScale(links, { name: 'link' }));
  assert.ok(model.sameScale({ attribute: 'radius', range: { min: 0, max: 1 } }, { name: 'radius' }));
  assert.ok(!model.sameScale({ attribute: 'radius', range: { min: 0, max: 1 } }, { name: 'radius', categories: ['a'] }));
});
