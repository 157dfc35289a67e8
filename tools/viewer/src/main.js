// The page: reads its data, keeps what the user chose, and draws again what depends on it.
import * as address from './address.js';
import { Blocks } from './blocks.js';
import { element } from './dom.js';
import { Drawing } from './drawing.js';
import { graphView } from './graph_view.js';
import { heading } from './heading.js';
import { helpDialog } from './help.js';
import { Joints } from './joints.js';
import { legend } from './legend.js';
import * as model from './model.js';
import { channels, Palette } from './palette.js';
import { clipPanel, jointsPanel, layersPanel, nodePanel, variantPanel } from './panels.js';
import { pick } from './pick.js';
import { Stage } from './stage.js';
import { rounded } from './words.js';

const scene = JSON.parse(document.getElementById('ballflow-scene').textContent);
const palette = new Palette(scene.palette);
const blocks = new Blocks(scene.blocks, (number) => document.getElementById(`block-${number}`).textContent);
const variants = model.withRuns(scene.variants, scene.graphs);
const axes = model.axesOf(variants);
const hasLayers = Object.values(scene.artifacts).some(({ layers }) => layers?.length > 0);
const remembered = address.read(location.hash);

const state = {
  variant: remembered.variant < variants.length ? remembered.variant : 0,
  node: remembered.node ?? null,
  withOutputs: false,
  settings: new Map(), // by key of a layer
  clip: { on: false, axis: 0, position: 0.5, flipped: false },
  graphOpen: true,
};
const joints = new Joints(scene.chains, remembered.joints);
const boxOf = (layers) => joints.boxOf(layers);

const variant = () => variants[state.variant] ?? null;
const nodes = () => model.nodesOf(scene, variant());
const chosenNode = () => nodes().find(({ path }) => path === state.node) ?? null;
const groups = () => model.groupsOf(scene, variant(), state.node, state.withOutputs);
const allLayers = () => groups().flatMap(({ layers }) => layers);

/** The same node in another variant: paths differ, names do not. */
function nodeLike(path) {
  const all = scene.graphs.flatMap((graph) => graph.nodes);
  const name = all.find((node) => node.path === path)?.name;
  return nodes().find((node) => node.path === path)?.path ?? nodes().find((node) => node.name === name)?.path ?? null;
}

let known; // all layers of a key over the variants, for the range of colours
function layersOfKey(key) {
  if (known?.node !== chosenNode()?.name || known?.withOutputs !== state.withOutputs) {
    const name = chosenNode()?.name;
    const all = (variants.length > 0 ? variants : [null]).map((one) => {
      const path = model.nodesOf(scene, one).find((node) => node.name === name)?.path ?? null;
      return model.groupsOf(scene, one, path, state.withOutputs);
    });
    known = { node: name, withOutputs: state.withOutputs, find: model.layersByKey(scene, all) };
  }
  return known.find(key);
}

function settle(shown) {
  const first = model.firstSettings(shown, state.node === null || !chosenNode());
  for (const [key, setting] of first) if (!state.settings.has(key)) state.settings.set(key, setting);
}

// --- the frame of the page ---

const parts = {
  side: element('aside', { class: 'side', 'aria-label': 'layers and details' }),
  legend: element('div', { class: 'legend-place' }),
  picked: element('div', { class: 'picked', hidden: true, role: 'status' }),
  busy: element('div', { class: 'busy', hidden: true, text: 'unpacking\u2026' }),
  graph: element('div', { class: 'graph-place' }),
  canvas: element('canvas', { tabindex: 0, 'aria-label': '3D view; press ? for the keys' }),
};
const help = helpDialog();
let stage = null;

const graphOf = () => (variant() ? scene.graphs[variant().graph] : null);

function button(text, title, onclick) {
  return element('button', { text, title, onclick });
}

function toolbar() {
  return element(
    'div', { class: 'toolbar', role: 'toolbar' },
    button('Fit', 'fit what is visible (f)', () => fit()),
    button('Iso', 'from above, aside (0)', () => fit('iso')),
    button('Front', 'from the front (1)', () => fit('front')),
    button('Right', 'from the right (2)', () => fit('right')),
    button('Top', 'from above (3)', () => fit('top')),
    button('Parallel', 'parallel or perspective projection (p)', () => toggleProjection()),
    button('y up', 'y or z is up (u)', () => toggleUp()),
  );
}

// --- what is drawn again ---

function visibleLayers() {
  return allLayers().filter(({ key }) => state.settings.get(key)?.visible);
}

function coloured(layer) {
  const { colourBy } = state.settings.get(layer.key);
  const attribute = layer.attributes.find(({ name }) => name === colourBy);
  if (!attribute) return { attribute: null, colour: palette.plainOf(layer) };
  if (attribute.categories) return { attribute };
  const sharing = visibleLayers().filter(({ key }) => state.settings.get(key).colourBy === colourBy);
  return { attribute, range: model.rangeOf(colourBy, sharing.flatMap(({ key }) => layersOfKey(key))) };
}

function showLegend() {
  const entries = [];
  for (const layer of visibleLayers()) {
    const { attribute, colour, range } = coloured(layer);
    const line = { title: layer.title, count: layer.count, shape: layer.shape, key: layer.key };
    const shared = attribute && entries.find((entry) => model.sameScale(entry, attribute));
    if (shared) {
      shared.layers.push(line);
      shared.counts = shared.counts?.map((count, i) => count + attribute.counts[i]);
      continue;
    }
    entries.push({ layers: [line], attribute: attribute?.name, unit: attribute?.unit, range, categories: attribute?.categories, counts: attribute?.counts, colour });
  }
  parts.legend.replaceChildren(legend(entries, palette));
}

function showSide() {
  const node = chosenNode();
  const shown = groups();
  const scroll = parts.side.scrollTop;
  parts.side.replaceChildren(
    ...[
      variantPanel({ axes, variants, current: state.variant, choose: chooseVariant }),
      hasLayers && jointsPanel({
        chains: joints.of(allLayers()),
        change: (...joint) => { joints.set(...joint); jointsMoved(); },
        reset: (number) => { joints.reset(number); showSide(); jointsMoved(); },
      }),
      hasLayers && layersPanel({
        title: node && shown.some(({ title }) => title.startsWith(`${node.name}.`)) ? `Layers of ${node.name}` : 'Layers',
        groups: shown, settings: state.settings, palette, change: changeLayer,
        back: node ? () => chooseNode(null) : null,
        withOutputs: state.withOutputs,
        setWithOutputs: (on) => { state.withOutputs = on; showAll(); },
      }),
      hasLayers && clipPanel({ clip: state.clip, box: boxOf(visibleLayers()), change: changeClip }),
      node && nodePanel({ node, type: scene.types[node.type], artifacts: scene.artifacts }),
    ].filter(Boolean),
  );
  parts.side.scrollTop = scroll;
}

function showGraph() {
  const all = nodes();
  parts.graph.hidden = all.length === 0 || (hasLayers && !state.graphOpen);
  if (parts.graph.hidden) return;
  const scrolled = parts.graph.firstChild;
  const [left, top] = scrolled ? [scrolled.scrollLeft, scrolled.scrollTop] : [0, 0];
  const focused = document.activeElement?.getAttribute('data-node');
  parts.graph.replaceChildren(graphView({ nodes: all, chosen: state.node, choose: (path) => chooseNode(path === state.node ? null : path) }));
  parts.graph.firstChild.scrollTo(left, top);
  if (focused) [...parts.graph.querySelectorAll('[data-node]')].find((box) => box.getAttribute('data-node') === focused)?.focus();
}

const drawings = new Map(); // by artifact and layer

async function drawingOf(layer) {
  if (!drawings.has(layer.drawing)) {
    const arrays = {};
    for (const name of ['vertices', 'radii', 'segments', 'triangles']) {
      if (layer[name] !== undefined) arrays[name] = await blocks.get(layer[name]);
    }
    if (!drawings.has(layer.drawing)) drawings.set(layer.drawing, new Drawing(layer, arrays, stage.common));
  }
  const drawing = drawings.get(layer.drawing);
  await joints.move(layer, drawing, blocks);
  return drawing;
}

async function paint(drawing, layer) {
  const { attribute, colour, range } = coloured(layer);
  if (!attribute) return drawing.setColour({ mode: 'plain', colour: channels(colour) });
  const values = await blocks.get(attribute.values);
  const perElement = attribute.per === 'element';
  if (attribute.categories) return drawing.setColour({ mode: 'categories', values, perElement, table: stage.categoryTable });
  drawing.setColour({ mode: 'scalar', values, perElement, ...range, table: stage.scalarTable });
}

let shownAt = 0;
let picture = Promise.resolve();

/** Brings the picture up to date; a later call overtakes an earlier one that still unpacks. */
function showPicture() {
  picture = drawLayers();
  return picture;
}

async function drawLayers() {
  if (!stage) return;
  const mine = ++shownAt;
  const layers = model.drawingOrder(visibleLayers());
  const waiting = setTimeout(() => { parts.busy.hidden = false; }, 150);
  try {
    const list = [];
    for (const [order, layer] of layers.entries()) {
      const drawing = await drawingOf(layer);
      await paint(drawing, layer);
      if (mine !== shownAt) return;
      const { opacity, style } = state.settings.get(layer.key);
      drawing.setLook({ opacity, style, order });
      list.push(drawing);
    }
    stage.setBound(boxOf(layers));
    applyClip();
    stage.show(list);
    hidePicked();
  } finally {
    clearTimeout(waiting);
    if (mine === shownAt) parts.busy.hidden = true;
  }
}

function showAll() {
  settle(groups());
  showSide();
  showLegend();
  showGraph();
  remember();
  return showPicture();
}

// --- what users do ---

function changeLayer(key, more) {
  const before = state.settings.get(key);
  state.settings.set(key, { ...before, ...more });
  // A slider that is being moved must not be replaced.
  if (!('opacity' in more)) showSide();
  showLegend();
  showPicture();
}

function changeClip(more, moving = false) {
  Object.assign(state.clip, more);
  if (!moving) showSide();
  applyClip();
}

function applyClip() {
  if (!stage) return;
  const box = boxOf(visibleLayers());
  const { on, axis, position, flipped } = state.clip;
  stage.clip = on && box ? { axis, flipped, position: box.lower[axis] + position * (box.upper[axis] - box.lower[axis]) } : null;
  stage.request();
}

const jointsMoved = () => { remember(); return showPicture(); };

function chooseVariant(axis, value) {
  state.variant = model.chooseVariant(variants, state.variant, axis, value);
  state.node = state.node === null ? null : nodeLike(state.node);
  const focused = document.activeElement?.getAttribute('data-axis');
  const done = showAll();
  if (focused) [...parts.side.querySelectorAll('[data-axis]')].find((one) => one.getAttribute('data-axis') === focused)?.focus();
  return done;
}

function chooseNode(path) {
  const fits = new Set(visibleLayers().map(({ key }) => key));
  state.node = path;
  const done = showAll();
  const now = visibleLayers();
  if (stage && now.length > 0 && !now.some(({ key }) => fits.has(key))) fit();
  parts.graph.querySelector('.chosen')?.scrollIntoView({ block: 'nearest', inline: 'nearest' });
  return done;
}

function fit(view) {
  stage?.fit(boxOf(visibleLayers()), view);
}

function toggleProjection() {
  stage?.setParallel(stage.camera === stage.perspective);
}

function toggleUp() {
  stage?.setUp(stage.up === 'y' ? 'z' : 'y');
  fit('iso');
  showToolbar();
}

function toggleGraph() {
  state.graphOpen = !state.graphOpen;
  showGraph();
}

const dark = () => (document.documentElement.dataset.theme ?? (matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light')) === 'dark';

function ground() {
  stage?.setGround(getComputedStyle(document.body).getPropertyValue('--ground').trim());
}

function toggleTheme() {
  document.documentElement.dataset.theme = dark() ? 'light' : 'dark';
  ground();
}

function hidePicked() {
  parts.picked.hidden = true;
}

async function showPicked(event) {
  const layers = visibleLayers();
  const list = layers.map(({ drawing }) => drawings.get(drawing)).filter(Boolean);
  const { origin, direction } = stage.ray(event.clientX, event.clientY);
  const kept = (point) => stage.clip === null || (point[stage.clip.axis] - stage.clip.position) * (stage.clip.flipped ? -1 : 1) <= 0;
  const hit = pick(list, origin.toArray(), direction.toArray(), stage.centre, kept);
  if (!hit) return hidePicked();
  const { layer } = hit.drawing;
  const lines = [`${layer.title}, ${layer.shape.slice(0, -1)} ${hit.index}`];
  for (const attribute of layer.attributes) {
    const values = await blocks.get(attribute.values);
    const value = values[attribute.per === 'element' ? hit.index : hit.vertex];
    lines.push(`${attribute.name} ${attribute.categories ? attribute.categories[value] : rounded(value, 5)}`);
  }
  const place = layer.shape === 'balls' ? [0, 1, 2].map((i) => hit.drawing.arrays.vertices[3 * hit.index + i] + layer.centre[i]) : hit.point;
  lines.push(`${layer.shape === 'balls' ? 'centre' : 'at'} ${place.map((x) => rounded(x, 5)).join(', ')}`);
  parts.picked.replaceChildren(...lines.map((text) => element('div', { text })));
  parts.picked.hidden = false;
}

/** A double click makes the camera turn about what was hit. */
function turnAbout(event) {
  const { origin, direction } = stage.ray(event.clientX, event.clientY);
  const list = visibleLayers().map(({ drawing }) => drawings.get(drawing)).filter(Boolean);
  const hit = pick(list, origin.toArray(), direction.toArray(), stage.centre, () => true);
  if (!hit) return;
  stage.target.set(...hit.point.map((x, i) => x - stage.centre[i]));
  stage.controls.update();
  stage.changed();
}

let remembering = 0;
function remember() {
  clearTimeout(remembering);
  remembering = setTimeout(() => {
    const text = address.written({ camera: stage?.getCamera(), variant: state.variant, node: state.node, joints: joints.moved });
    history.replaceState(null, '', `#${text}`);
  }, 250);
}

function stepAxis(step) {
  const axis = axes[0];
  if (!axis) return;
  const place = axis.values.findIndex((value) => JSON.stringify(value) === JSON.stringify(variant().values[axis.name]));
  const next = axis.values[place + step];
  if (next !== undefined) chooseVariant(axis.name, next);
}

const keys = {
  f: () => fit(), 0: () => fit('iso'), 1: () => fit('front'), 2: () => fit('right'), 3: () => fit('top'),
  p: toggleProjection, u: toggleUp, g: toggleGraph, t: toggleTheme,
  c: () => changeClip({ on: !state.clip.on }),
  x: () => changeClip({ on: true, axis: 0 }), y: () => changeClip({ on: true, axis: 1 }), z: () => changeClip({ on: true, axis: 2 }),
  '[': () => stepAxis(-1), ']': () => stepAxis(1),
  '?': () => help.showModal(),
  Escape: () => { if (state.node !== null) chooseNode(null); else hidePicked(); },
};

function onKey(event) {
  if (event.ctrlKey || event.metaKey || event.altKey || help.open) return;
  if (event.target.matches('select, input:not([type=checkbox]):not([type=range])')) return;
  const action = keys[event.key];
  if (!action || (!hasLayers && !'tg?Escape'.includes(event.key))) return;
  event.preventDefault();
  action();
}

function showToolbar() {
  const bar = toolbar();
  bar.lastChild.textContent = `${stage.up} up`;
  document.querySelector('.toolbar')?.replaceWith(bar);
}

async function start() {
  const app = document.getElementById('app');
  settle(groups());
  const view = element('main', { class: 'view' }, parts.canvas, element('div', { class: 'toolbar' }), parts.legend, parts.picked, parts.busy);
  app.className = hasLayers ? 'with-view' : 'graph-only';
  app.append(heading({ scene, graph: graphOf(), buttons: [
    graphOf() && hasLayers && button('Graph', 'show or hide the graph (g)', () => toggleGraph()),
    button('Theme', 'light or dark (t)', toggleTheme),
    button('?', 'keys (?)', () => help.showModal()),
  ] }), ...(hasLayers ? [view] : []), parts.graph, parts.side, help);
  if (!hasLayers && scene.graphs.length === 0) app.append(element('p', { class: 'empty', text: 'There is nothing to show in 3D.' }));
  document.addEventListener('keydown', onKey);
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', ground);
  if (hasLayers) {
    const box = model.boxOf(visibleLayers()) ?? model.boxOf(allLayers()) ?? { lower: [0, 0, 0], upper: [1, 1, 1] };
    try {
      stage = new Stage(parts.canvas, palette, box.lower.map((x, i) => (x + box.upper[i]) / 2));
    } catch (error) {
      view.replaceChildren(element('p', { class: 'empty', text: `This browser cannot draw in 3D: ${error.message}` }));
    }
  }
  if (stage) {
    showToolbar();
    ground();
    let pressed = null;
    parts.canvas.addEventListener('pointerdown', (event) => { pressed = [event.clientX, event.clientY]; });
    parts.canvas.addEventListener('click', (event) => {
      if (pressed && Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) < 4) showPicked(event);
    });
    parts.canvas.addEventListener('dblclick', turnAbout);
    stage.onchange = () => { hidePicked(); remember(); };
    stage.setBound(boxOf(visibleLayers()));
    if (scene.chains.length > 0) stage.setUp('z'); // descriptions of what has joints stand on z = 0
    if (remembered.camera) stage.setCamera(remembered.camera);
    else fit('iso');
    showToolbar();
  }
  await showAll();
  stage?.quick();
}

const ready = start();

// For tests and scripts; docs/viewer.md describes it.
window.ballflow = {
  ready,
  project: (point) => stage.project(point),
  camera: () => stage.getCamera(),
  setCamera: (camera) => stage.setCamera(camera),
  layers: () => allLayers().map(({ key, name, shape, count }) => ({ key, name, shape, count, ...state.settings.get(key) })),
  arrays: async (key) => {
    const layer = allLayers().find((one) => one.key === key);
    const { arrays } = await drawingOf(layer);
    return { centre: layer.centre, ...Object.fromEntries(Object.entries(arrays).map(([name, values]) => [name, Array.from(values)])) };
  },
  joints: () => joints.of(allLayers()).flatMap(({ number, joints: all, values }) =>
    all.map(({ name, unit, lower, upper }, i) => ({ chain: number, name, unit, lower, upper, value: values[i] }))),
  settled: async () => {
    await picture;
    stage?.finish();
  },
};
