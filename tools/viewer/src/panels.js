// The side panel: variants, layers, clipping, what is known of a node.
import { element } from './dom.js';
import { bytes, counted, duration, grouped, plain, rounded } from './words.js';

export function section(title, ...children) {
  return element('section', { class: 'panel' }, element('h2', { text: title }), ...children);
}

/** One control per axis of a sweep. */
export function variantPanel({ axes, variants, current, choose }) {
  if (axes.length === 0) return null;
  const { values } = variants[current];
  const rows = axes.map(({ name, values: all, numeric }) => {
    const place = Math.max(0, all.findIndex((value) => JSON.stringify(value) === JSON.stringify(values[name])));
    if (!numeric) {
      const select = element('select', { 'data-axis': name, onchange: () => choose(name, all[select.selectedIndex]) });
      for (const value of all) select.append(element('option', { text: plain(value) }));
      select.selectedIndex = place;
      return element('label', { class: 'axis' }, element('span', { text: name }), select);
    }
    const shown = element('output', { text: plain(all[place]) });
    const slider = element('input', {
      type: 'range', min: 0, max: all.length - 1, step: 1, 'data-axis': name,
      oninput: () => {
        shown.textContent = plain(all[slider.valueAsNumber]);
        choose(name, all[slider.valueAsNumber]);
      },
    });
    slider.value = place;
    return element('label', { class: 'axis' }, element('span', { text: name }), slider, shown);
  });
  return section('Variant', ...rows);
}

function layerRow(layer, settings, palette, change) {
  const setting = settings.get(layer.key);
  const set = (more) => change(layer.key, more);
  const colours = element('select', { title: 'colour by', onchange: () => set({ colourBy: colours.value }) });
  colours.append(element('option', { value: '', text: 'one colour' }));
  for (const { name } of layer.attributes) colours.append(element('option', { value: name, text: name }));
  colours.value = setting.colourBy;
  const opacity = element('input', {
    type: 'range', min: 5, max: 100, step: 5, title: 'opacity',
    oninput: () => set({ opacity: opacity.valueAsNumber / 100 }),
  });
  opacity.value = Math.round(100 * setting.opacity);
  const check = element('input', { type: 'checkbox', checked: setting.visible, onchange: () => set({ visible: check.checked }) });
  let style = null;
  if (layer.shape === 'triangles') {
    style = element('select', { title: 'how triangles are drawn', onchange: () => set({ style: style.value }) });
    for (const [value, text] of [['solid', 'solid'], ['edges', 'with edges'], ['wire', 'wire']]) style.append(element('option', { value, text }));
    style.value = setting.style;
  }
  const swatch = element('span', { class: 'swatch' });
  swatch.style.background = setting.colourBy === '' ? palette.plainOf(layer) : palette.gradient();
  return element(
    'li', { class: setting.visible ? 'layer' : 'layer off', 'data-layer': layer.key },
    element('label', { class: 'name' }, check, swatch, element('span', { text: layer.name })),
    element('span', { class: 'count', text: counted(layer.count, layer.shape) }),
    setting.visible && element('div', { class: 'look' }, colours, style, opacity),
  );
}

export function layersPanel({ title, groups, settings, palette, change, back, withOutputs, setWithOutputs }) {
  const lists = groups.map(({ title: name, artifact, layers }) => {
    const rows = layers.map((layer) => layerRow(layer, settings, palette, change));
    const note =
      artifact.missing ?? (artifact.layers === undefined ? `${artifact.type}: ${artifact.words}` : layers.length === 0 ? 'empty' : null);
    return element(
      'div', { class: 'group' },
      element('h3', {}, element('span', { text: name }), element('span', { class: 'type', text: artifact.type })),
      rows.length > 0 && element('ul', {}, ...rows),
      note && element('p', { class: 'note', text: note }),
    );
  });
  const scope = back && element(
    'div', { class: 'scope' },
    element('button', { text: 'Back to the outputs', onclick: back }),
    element('label', {}, element('input', { type: 'checkbox', checked: withOutputs, onchange: (event) => setWithOutputs(event.target.checked) }), 'keep the outputs'),
  );
  return section(title, scope, ...lists);
}

/** chains: [{ number, name, joints, values }]; change(number, joint, value), reset(number) */
export function jointsPanel({ chains, change, reset }) {
  if (chains.length === 0) return null;
  return section('Joints', ...chains.flatMap(({ number, name, joints, values }) => [
    chains.length > 1 && element('h3', { text: name }),
    element('div', { class: 'joints' }, ...joints.map((joint, i) => {
      const shown = element('output', { text: `${rounded(values[i], 3)}\u2009${joint.unit}` });
      const slider = element('input', {
        type: 'range', min: joint.lower, max: joint.upper, step: 'any', 'data-joint': joint.name, 'data-chain': number,
        oninput: () => {
          shown.textContent = `${rounded(slider.valueAsNumber, 3)}\u2009${joint.unit}`;
          change(number, i, slider.valueAsNumber);
        },
      });
      slider.value = values[i];
      const range = `${rounded(joint.lower)} to ${rounded(joint.upper)} ${joint.unit}`;
      return element('label', { class: 'axis', title: range }, element('span', { text: joint.name }), slider, shown);
    })),
    element('button', { text: 'Reset', title: 'joints as they were at first', 'data-reset': number, onclick: () => reset(number) }),
  ]));
}

const axisNames = ['x', 'y', 'z'];

/** clip: { on, axis, position in [0, 1] of the box, flipped } */
export function clipPanel({ clip, box, change }) {
  const at = () => {
    if (!box) return 0;
    const extent = box.upper[clip.axis] - box.lower[clip.axis];
    const position = box.lower[clip.axis] + clip.position * extent;
    return Math.abs(position) < extent / 1000 ? 0 : position; // no 1e-17 in the middle of a symmetric model
  };
  const on = element('input', { type: 'checkbox', checked: clip.on, onchange: () => change({ on: on.checked }) });
  const value = element('output', { text: rounded(at()) });
  const slider = element('input', {
    type: 'range', min: 0, max: 1, step: 0.002, disabled: !clip.on, 'data-clip': 'position',
    oninput: () => {
      clip.position = slider.valueAsNumber;
      value.textContent = rounded(at());
      change({ position: slider.valueAsNumber }, true);
    },
  });
  slider.value = clip.position;
  const axes = axisNames.map((name, axis) =>
    element('button', { text: name, class: axis === clip.axis ? 'chosen' : '', disabled: !clip.on, onclick: () => change({ axis }) }));
  return section(
    'Section',
    element('div', { class: 'clip' },
      element('label', {}, on, 'cut'),
      element('span', { class: 'buttons' }, ...axes, element('button', { text: 'flip', disabled: !clip.on, class: clip.flipped ? 'chosen' : '', onclick: () => change({ flipped: !clip.flipped }) }))),
    element('label', { class: 'axis' }, element('span', { text: axisNames[clip.axis] }), slider, value),
  );
}

function table(rows) {
  return element('table', {}, ...rows.map(([name, value, title]) =>
    element('tr', title ? { title } : {}, element('th', { text: name }), element('td', typeof value === 'string' ? { text: value } : {}, typeof value === 'string' ? null : value))));
}

const statusWords = { hit: 'from the cache', run: 'ran', failed: 'failed', skipped: 'did not run', cancelled: 'was cancelled',
  HIT: 'in the cache', RUN: 'would run', MAYBE: 'may run', '-': 'not needed' };

function timeOf(node) {
  if (node.status === 'run' && node.seconds !== undefined) return duration(node.seconds);
  const planned = node.status === 'RUN' || node.status === 'MAYBE';
  if (node.cost_seconds) return planned ? `about ${duration(node.cost_seconds)}` : `${duration(node.cost_seconds)} when it ran`;
  return null;
}

export function nodePanel({ node, type, artifacts }) {
  const facts = [['type', node.type, type?.summary]];
  if (node.status) facts.push(['status', statusWords[node.status] ?? node.status]);
  if (node.reason) facts.push(['reason', node.reason]);
  const time = timeOf(node);
  if (time) facts.push(['time', time]);
  if (node.iterations !== undefined) facts.push(['iterations', grouped(node.iterations)]);
  const params = Object.entries(node.params).map(([name, value]) => {
    const { unit, doc } = type?.params?.[name] ?? {};
    const measured = unit && unit !== '1' && typeof value === 'number';
    return [name, element('span', {}, plain(value), measured && element('span', { class: 'type', text: ` ${unit}` })), doc];
  });
  const outputs = Object.entries(node.outputs).map(([port, output]) => {
    const artifact = artifacts[output.digest];
    const lines = [element('span', { text: artifact?.words ?? output.type })];
    if (output.bytes !== undefined) lines.push(element('span', { class: 'type', text: `${output.type}, ${bytes(output.bytes)}` }));
    if (artifact?.missing) lines.push(element('span', { class: 'note', text: artifact.missing }));
    return [port, element('div', { class: 'lines' }, ...lines)];
  });
  const summaries = Object.values(node.outputs).flatMap(({ summary }) =>
    Object.entries(summary ?? {}).map(([name, value]) => [name, value === null ? 'unknown' : plain(value)]));
  const inputs = Object.entries(node.inputs);
  return section(
    node.name,
    type && element('p', { class: 'summary', text: type.summary }),
    node.error && element('p', { class: 'error', text: `${node.error.cause}. ${node.error.hint}` }),
    ...(node.warnings ?? []).map((text) => element('p', { class: 'warning', text })),
    table(facts),
    params.length > 0 && element('h3', { text: 'Parameters' }), params.length > 0 && table(params),
    inputs.length > 0 && element('h3', { text: 'Inputs' }), inputs.length > 0 && table(inputs),
    outputs.length > 0 && element('h3', { text: 'Outputs' }), outputs.length > 0 && table(outputs),
    summaries.length > 0 && element('h3', { text: 'Summary' }), summaries.length > 0 && table(summaries),
    node.body && element('h3', { text: 'Body of the loop' }), node.body && element('p', { class: 'note', text: node.body.join(', ') }),
  );
}
