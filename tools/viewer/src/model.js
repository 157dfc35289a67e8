// What a page can show: its variants, and the layers of a variant or of a node. No DOM, no 3D.

function compare(a, b) {
  if (typeof a === 'number' && typeof b === 'number') return a - b;
  return String(a) < String(b) ? -1 : 1;
}

/**
 * The axes along which variants differ: [{ name, values, numeric }]. Values are sorted. Several runs without a
 * sweep are told apart by an axis "run".
 */
export function axesOf(variants) {
  const names = [...new Set(variants.flatMap((variant) => Object.keys(variant.values)))];
  return names
    .map((name) => {
      const known = new Map();
      for (const { values } of variants) if (name in values) known.set(JSON.stringify(values[name]), values[name]);
      const values = [...known.values()].sort(compare);
      return { name, values, numeric: values.every((value) => typeof value === 'number') };
    })
    .filter(({ values }) => values.length > 1);
}

/** Gives runs of one page an axis "run" when there are several. */
export function withRuns(variants, graphs) {
  if (new Set(variants.map(({ graph }) => graph)).size < 2) return variants;
  return variants.map((variant) => {
    const { run, name } = graphs[variant.graph];
    return { ...variant, values: { run: run ? `${run} ${name}` : name, ...variant.values } };
  });
}

const same = (a, b) => JSON.stringify(a) === JSON.stringify(b);

/** The variant with `value` on `axis` that agrees most with the one that is shown; sweeps may lack combinations. */
export function chooseVariant(variants, current, axis, value) {
  let best = current;
  let most = -1;
  variants.forEach((variant, number) => {
    if (!same(variant.values[axis], value)) return;
    const agreement = Object.keys(variant.values).filter((name) =>
      same(variant.values[name], variants[current].values[name]),
    ).length;
    if (agreement > most) [best, most] = [number, agreement];
  });
  return best;
}

/** Distance of every node from the sources, by path: longest path over inputs. */
export function depths(nodes) {
  const byPath = new Map(nodes.map((node) => [node.path, node]));
  const known = new Map();
  const visit = (node) => {
    if (known.has(node.path)) return known.get(node.path);
    known.set(node.path, 0); // a report that was tampered with may have a cycle
    let depth = 0;
    for (const from of Object.values(node.inputs)) {
      const producer = byPath.get(from.slice(0, from.lastIndexOf('.')));
      if (producer) depth = Math.max(depth, visit(producer) + 1);
    }
    known.set(node.path, depth);
    return depth;
  };
  nodes.forEach(visit);
  return known;
}

/** The nodes of a variant. */
export function nodesOf(scene, variant) {
  if (!variant) return [];
  const { nodes } = scene.graphs[variant.graph];
  return variant.nodes.map((number) => nodes[number]);
}

const shapeOrder = ['points', 'segments', 'balls', 'triangles'];

/**
 * The artifacts that are shown: those of a node when one is chosen, else the outputs of the variant in the order
 * of the graph, and the artifacts that were given by themselves. [{ title, digest, artifact, layers }]
 */
export function groupsOf(scene, variant, nodePath, withOutputs = false) {
  const groups = [];
  const taken = new Set();
  const add = (title, digest, given = false) => {
    const artifact = scene.artifacts[digest];
    if (!artifact || taken.has(title)) return;
    taken.add(title);
    const alone = artifact.layers?.length === 1;
    const layers = (artifact.layers ?? []).map((layer) => ({
      ...layer,
      title: alone ? title : layer.name,
      key: `${title}/${layer.name}`,
      drawing: `${digest}/${layer.name}`,
    }));
    groups.push({ title, digest, artifact, layers, given });
  };
  const nodes = nodesOf(scene, variant); // none of artifacts alone
  const chosen = nodes.find(({ path }) => path === nodePath);
  if (chosen) {
    for (const [port, { digest }] of Object.entries(chosen.outputs)) add(`${chosen.name}.${port}`, digest);
  }
  if (!chosen || withOutputs || !groups.some(({ layers }) => layers.length > 0)) {
    const depth = depths(nodes);
    const rank = ({ from }) => depth.get(from.slice(0, from.lastIndexOf('.'))) ?? 0;
    const outputs = [...(variant?.outputs ?? [])].sort((a, b) => rank(a) - rank(b));
    for (const { name, digest } of outputs) add(name, digest);
    for (const { name, digest } of scene.loose) add(name, digest, true);
    if (!chosen) groups.sort((a, b) => Number(hasJoints(b)) - Number(hasJoints(a))); // the whole before its parts
  }
  return groups;
}

const hasJoints = ({ layers }) => layers.some(({ chain }) => chain !== undefined);

/**
 * Which layers are visible at first, and how opaque. Of the outputs of a graph several would hide one another: of
 * those with layers of one shape only the last one is visible, and balls let through what they enclose. Beside
 * something with joints other outputs are hidden: its parts would lie on each other in frames of their own. What a
 * node made, or was given by name, is shown as its type says.
 */
export function firstSettings(groups, areOutputs) {
  const settings = new Map();
  const jointed = groups.some(hasJoints);
  const isPart = (group) => areOutputs && jointed && !hasJoints(group) && !group.given;
  const visible = groups.filter((group) => !isPart(group)).flatMap(({ layers }) => layers.filter((layer) => layer.visible));
  const encloses = visible.some(({ shape }) => shape === 'segments' || shape === 'triangles');
  const seen = new Set();
  for (const group of [...groups].reverse()) {
    const shapes = new Set();
    for (const layer of group.layers) {
      const first = !areOutputs || (!isPart(group) && !seen.has(layer.shape));
      const opacity = areOutputs && layer.shape === 'balls' && encloses ? Math.min(layer.opacity, 0.25) : layer.opacity;
      settings.set(layer.key, {
        visible: layer.visible && first,
        opacity,
        colourBy: layer.colour_by,
        style: 'solid',
      });
      if (layer.visible && !isPart(group)) shapes.add(layer.shape);
    }
    for (const shape of shapes) seen.add(shape);
  }
  return settings;
}

/** Layers in the order in which translucent ones are blended: what encloses comes last. */
export function drawingOrder(layers) {
  return [...layers].sort((a, b) => shapeOrder.indexOf(a.shape) - shapeOrder.indexOf(b.shape));
}

/**
 * All layers of a key over the variants: equal colours mean equal values while a slider moves.
 * Returns a function from key to layers.
 */
export function layersByKey(scene, groupsOfVariants) {
  const known = new Map();
  for (const groups of groupsOfVariants) {
    for (const { layers } of groups) {
      for (const layer of layers) {
        if (!known.has(layer.key)) known.set(layer.key, []);
        known.get(layer.key).push(layer);
      }
    }
  }
  return (key) => known.get(key) ?? [];
}

/** The range of an attribute in all of these layers, or null when none has numbers of this name. */
export function rangeOf(name, layers) {
  let range = null;
  for (const { attributes } of layers) {
    const attribute = attributes.find((one) => one.name === name);
    if (!attribute || attribute.categories || attribute.min === undefined) continue;
    range = range
      ? { min: Math.min(range.min, attribute.min), max: Math.max(range.max, attribute.max) }
      : { min: attribute.min, max: attribute.max };
  }
  return range;
}

/** Whether an entry of a legend, { attribute: name, range, categories }, explains the colours of an attribute too. */
export function sameScale(entry, { name, categories }) {
  return entry.attribute === name && (categories ? same(entry.categories, categories) : Boolean(entry.range));
}

/** Bounding box of layers in model units, or null. */
export function boxOf(layers) {
  if (layers.length === 0) return null;
  const lower = [0, 1, 2].map((i) => Math.min(...layers.map((layer) => layer.lower[i])));
  const upper = [0, 1, 2].map((i) => Math.max(...layers.map((layer) => layer.upper[i])));
  return { lower, upper };
}
