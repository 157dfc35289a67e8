// The graph as a drawing in which nodes can be clicked.
import { element, svg } from './dom.js';
import { layOut } from './graph_layout.js';
import { depths } from './model.js';
import { duration } from './words.js';

const size = { width: 150, height: 42 };
const smallest = 0.85; // of the natural size: what can be read
const margin = 12;

function shortened(text, most) {
  return text.length > most ? `${text.slice(0, most - 1)}\u2026` : text;
}

function path(points) {
  let text = `M${points[0].x},${points[0].y}`;
  for (let i = 1; i < points.length; ++i) {
    const [a, b] = [points[i - 1], points[i]];
    const middle = (a.x + b.x) / 2;
    text += a.y === b.y ? `L${b.x},${b.y}` : `C${middle},${a.y} ${middle},${b.y} ${b.x},${b.y}`;
  }
  return text;
}

/** nodes as in the page; chosen: path or null; choose(path). */
export function graphView({ nodes, chosen, choose }) {
  const paths = new Set(nodes.map((node) => node.path));
  const edges = nodes.flatMap((node) =>
    Object.entries(node.inputs)
      .map(([port, from]) => ({ from: from.slice(0, from.lastIndexOf('.')), to: node.path, words: `${from} \u2192 ${node.name}.${port}` }))
      .filter(({ from }) => paths.has(from) && from !== node.path),
  );
  const depth = depths(nodes);
  const forward = edges.filter(({ from, to }) => depth.get(from) < depth.get(to));
  const { places, routes, width, height } = layOut([...paths], forward, depth, size);
  // As wide as there is room, but no smaller than can be read.
  const natural = width + 2 * margin;
  const drawing = svg('svg', {
    style: { width: '100%', maxWidth: `${natural}px`, minWidth: `${smallest * natural}px` },
    viewBox: `${-margin} ${-margin} ${natural} ${height + 2 * margin}`,
    role: 'group',
    'aria-label': 'graph',
  });
  forward.forEach(({ from, to, words }, i) => {
    const touches = chosen !== null && (from === chosen || to === chosen);
    drawing.append(svg('path', { class: touches ? 'edge touched' : 'edge', d: path(routes[i]) }, svg('title', { text: words })));
  });
  for (const node of nodes) {
    const { x, y } = places.get(node.path);
    const status = node.status ?? '';
    const slash = node.name.lastIndexOf('/');
    const time = status === 'run' && node.seconds !== undefined ? duration(node.seconds) : '';
    const box = svg(
      'g',
      {
        class: `node ${status.toLowerCase().replace(/[^a-z]/g, '')}${node.path === chosen ? ' chosen' : ''}`,
        transform: `translate(${x},${y})`,
        tabindex: 0,
        role: 'button',
        'aria-label': `${node.name}, ${node.type} ${status}`,
        'data-node': node.path,
        onclick: () => choose(node.path),
        onkeydown: (event) => {
          if (event.key === 'Enter' || event.key === ' ') {
            event.preventDefault();
            choose(node.path);
          }
        },
      },
      svg('title', { text: `${node.name}: ${node.type}` }),
      svg('rect', { class: 'box', width: size.width, height: size.height, rx: 6 }),
      svg('rect', { class: 'mark', width: 4, height: size.height - 12, x: 5, y: 6, rx: 2 }),
      svg('text', { class: 'name', x: 16, y: 17 },
        svg('tspan', { class: 'group', text: slash < 0 ? '' : shortened(node.name.slice(0, slash + 1), 11) }),
        svg('tspan', { text: shortened(node.name.slice(slash + 1), slash < 0 ? 19 : 12) })),
      svg('text', { class: 'type', x: 16, y: 32, text: shortened(node.type, time || status ? 14 : 20) }),
      svg('text', { class: 'status', x: size.width - 8, y: 32, 'text-anchor': 'end', text: time || status.toUpperCase() }),
    );
    drawing.append(box);
  }
  return element('div', { class: 'graph-scroll' }, drawing);
}
