// A layered drawing of a DAG from left to right. Long edges pass through a place of their own in every layer
// between, so that they cross no node. No DOM.

const sweeps = 12;

function layersOf(nodes, edges, depth) {
  const layers = [];
  const put = (entry, layer) => {
    (layers[layer] ??= []).push(entry);
    entry.layer = layer;
    entry.before = [];
    entry.after = [];
  };
  const entries = new Map();
  for (const id of nodes) {
    const entry = { id };
    entries.set(id, entry);
    put(entry, depth.get(id));
  }
  const routes = [];
  for (const { from, to } of edges) {
    const route = [entries.get(from)];
    for (let layer = depth.get(from) + 1; layer < depth.get(to); ++layer) {
      const bend = { id: null };
      put(bend, layer);
      route.push(bend);
    }
    route.push(entries.get(to));
    for (let i = 1; i < route.length; ++i) {
      route[i - 1].after.push(route[i]);
      route[i].before.push(route[i - 1]);
    }
    routes.push(route);
  }
  return { layers: Array.from(layers, (layer) => layer ?? []), routes };
}

const mean = (numbers) => numbers.reduce((sum, x) => sum + x, 0) / numbers.length;

/** Fewer crossings: entries are sorted by the mean place of their neighbours, forth and back. */
function sortLayers(layers) {
  const number = (layer) => layer.forEach((entry, i) => (entry.place = i));
  layers.forEach(number);
  const sort = (layer, side) => {
    for (const entry of layer) {
      const neighbours = entry[side];
      entry.wish = neighbours.length > 0 ? mean(neighbours.map(({ place }) => place)) : entry.place;
    }
    layer.sort((a, b) => a.wish - b.wish || a.place - b.place);
    number(layer);
  };
  for (let i = 0; i < sweeps; ++i) {
    layers.forEach((layer) => sort(layer, 'before'));
    [...layers].reverse().forEach((layer) => sort(layer, 'after'));
  }
}

/** Heights: entries move to the mean height of their neighbours as far as those beside them let them. */
function placeEntries(layers, heightOf) {
  const gap = (a, b) => (heightOf(a) + heightOf(b)) / 2;
  for (const layer of layers) {
    let y = 0;
    layer.forEach((entry, i) => {
      if (i > 0) y += gap(layer[i - 1], entry);
      entry.y = y;
    });
  }
  const settle = (layer, sides) => {
    if (layer.length === 0) return;
    const wishes = layer.map((entry) => {
      const neighbours = sides.flatMap((side) => entry[side]);
      return neighbours.length > 0 ? mean(neighbours.map(({ y }) => y)) : entry.y;
    });
    // Pushed apart downwards and upwards; the middle of both keeps the layer where it wants to be.
    const down = [...wishes];
    const up = [...wishes];
    for (let i = 1; i < layer.length; ++i) down[i] = Math.max(down[i], down[i - 1] + gap(layer[i - 1], layer[i]));
    for (let i = layer.length - 2; i >= 0; --i) up[i] = Math.min(up[i], up[i + 1] - gap(layer[i], layer[i + 1]));
    layer.forEach((entry, i) => (entry.y = (down[i] + up[i]) / 2));
  };
  for (let i = 0; i < sweeps; ++i) {
    layers.forEach((layer) => settle(layer, ['before']));
    [...layers].reverse().forEach((layer) => settle(layer, ['after']));
  }
  layers.forEach((layer) => settle(layer, ['before', 'after']));
}

/**
 * nodes: ids; edges: [{ from, to }]; depth: Map from id to layer, where an edge goes to a greater one.
 * Returns { places: Map(id -> { x, y }) of left upper corners, routes: [[{ x, y }, ...]] as edges, width, height }.
 */
export function layOut(nodes, edges, depth, { width, height, columnGap = 40, rowGap = 14 }) {
  const { layers, routes } = layersOf(nodes, edges, depth);
  sortLayers(layers);
  const heightOf = ({ id }) => (id === null ? rowGap : height + rowGap);
  placeEntries(layers, heightOf);
  const all = layers.flat();
  const top = Math.min(...all.map((entry) => entry.y - heightOf(entry) / 2));
  const left = (entry) => entry.layer * (width + columnGap);
  const places = new Map();
  for (const entry of all) {
    entry.y -= top;
    if (entry.id !== null) places.set(entry.id, { x: left(entry), y: entry.y - height / 2 });
  }
  const points = routes.map((route) =>
    route.flatMap((entry, i) => {
      if (i === 0) return [{ x: left(entry) + width, y: entry.y }];
      if (i === route.length - 1) return [{ x: left(entry), y: entry.y }];
      return [
        { x: left(entry), y: entry.y },
        { x: left(entry) + width, y: entry.y },
      ];
    }),
  );
  return {
    places,
    routes: points,
    width: layers.length * (width + columnGap) - columnGap,
    height: Math.max(0, ...all.map((entry) => entry.y + heightOf(entry) / 2)),
  };
}
