// The line above everything: what is shown, and when it ran.
import { element } from './dom.js';
import { duration, plain } from './words.js';

/** graph: that of the run, or null when artifacts alone are shown. */
export function heading({ scene, graph, buttons }) {
  const title = graph ? graph.name : scene.loose.map(({ name }) => name).join(', ');
  document.title = `${title} \u2013 ballflow`;
  const started = graph?.started?.slice(0, 16).replace('T', ' ');
  const facts = [started, graph?.status, graph?.seconds !== undefined && duration(graph.seconds)].filter(Boolean);
  const params = Object.entries(graph?.params ?? {}).map(([name, value]) => `${name} = ${plain(value)}`);
  return element(
    'header', {},
    element('h1', { text: title.split('/').at(-1), title: graph?.doc ?? title }),
    element('span', { class: 'facts', text: facts.join(' \u00b7 '), title: graph?.run && `run ${graph.run}` }),
    element('span', { class: 'params', text: params.join(', '), title: params.join('\n') }),
    scene.left_out.length > 0 &&
      element('details', { class: 'left-out' }, element('summary', { text: `${scene.left_out.length} left out` }),
        element('ul', {}, ...scene.left_out.map((text) => element('li', { text })))),
    ...buttons,
  );
}
