import assert from 'node:assert/strict';
import { test } from 'node:test';
import { layOut } from '../../../tools/viewer/src/graph_layout.js';

const size = { width: 100, height: 40, columnGap: 50, rowGap: 10 };

function laidOut(edges, depth) {
  const nodes = [...depth.keys()];
  return { nodes, ...layOut(nodes, edges, depth, size) };
}

/** A seeded generator, so that a failure can be repeated. */
function generator(seed) {
  let state = seed;
  return () => (state = (state * 1103515245 + 12345) % 2147483648) / 2147483648;
}

function randomGraph(seed) {
  const random = generator(seed);
  const depth = new Map();
  const edges = [];
  const count = 2 + Math.floor(40 * random());
  for (let i = 0; i < count; ++i) {
    let layer = 0;
    for (let k = 0; i > 0 && k < 3; ++k) {
      if (random() < 0.3) continue;
      const from = Math.floor(i * random());
      if (edges.some((edge) => edge.from === from && edge.to === i)) continue;
      edges.push({ from, to: i });
      layer = Math.max(layer, depth.get(from) + 1);
    }
    depth.set(i, layer);
  }
  return laidOut(edges, depth);
}

test('nodes never overlap, are inside of the drawing, and edges go from left to right', () => {
  for (let seed = 1; seed <= 200; ++seed) {
    const { nodes, places, routes, width, height } = randomGraph(seed);
    for (const a of nodes) {
      const p = places.get(a);
      assert.ok(p.x >= 0 && p.y >= 0 && p.x + size.width <= width && p.y + size.height <= height, `seed ${seed}, node ${a}`);
      for (const b of nodes) {
        const q = places.get(b);
        const apart = a === b || p.x !== q.x || Math.abs(p.y - q.y) >= size.height;
        assert.ok(apart, `seed ${seed}: ${a} and ${b}`);
      }
    }
    for (const route of routes) {
      for (let i = 1; i < route.length; ++i) assert.ok(route[i].x > route[i - 1].x, `seed ${seed}`);
    }
  }
});

test('edges pass beside the nodes of the layers between', () => {
  for (let seed = 1; seed <= 200; ++seed) {
    const { nodes, places, routes } = randomGraph(seed);
    for (const route of routes) {
      for (let i = 1; i < route.length - 1; ++i) {
        for (const node of nodes) {
          const { x, y } = places.get(node);
          const through = route[i].x >= x && route[i].x <= x + size.width && route[i].y > y && route[i].y < y + size.height;
          assert.ok(!through, `seed ${seed}, node ${node}`);
        }
      }
    }
  }
});

test('edges that need not cross do not', () => {
  // Two chains, listed so that their second layers begin in the wrong order.
  const depth = new Map([['a', 0], ['b', 0], ['b2', 1], ['a2', 1]]);
  const { places } = laidOut([{ from: 'a', to: 'a2' }, { from: 'b', to: 'b2' }], depth);
  assert.equal(places.get('a').y < places.get('b').y, places.get('a2').y < places.get('b2').y);
});

test('a chain is a straight line', () => {
  const depth = new Map([['a', 0], ['b', 1], ['c', 2]]);
  const { places, width } = laidOut([{ from: 'a', to: 'b' }, { from: 'b', to: 'c' }], depth);
  assert.deepEqual([...places.values()], [{ x: 0, y: 5 }, { x: 150, y: 5 }, { x: 300, y: 5 }]);
  assert.equal(width, 400);
});
