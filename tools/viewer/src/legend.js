// What the colours mean, over the picture.
import { element } from './dom.js';
import { counted, grouped, ticks } from './words.js';

/**
 * Layers that share a list of categories have no counts there: triangles and balls would be added up.
 * entries: [{ layers: [{ title, count, shape }], attribute: name or null, unit, range: { min, max }, categories,
 * counts, colour }]
 */
export function legend(entries, palette) {
  const lines = entries.reduce((sum, { layers, counts }) => sum + layers.length + (counts?.filter((count) => count > 0).length ?? 3), 0);
  return element(
    'div', { class: lines > 16 ? 'legend long' : 'legend' },
    ...entries.map(({ layers, attribute, unit, range, categories, counts, colour }) =>
      element(
        'div', { class: 'entry' },
        ...layers.map(({ title, count, shape, key }) =>
          element('div', { class: 'title', 'data-legend': key, 'data-count': count },
            colour && swatch(colour), element('span', { text: title }), element('span', { class: 'count', text: counted(count, shape) }))),
        range && scale(attribute, unit, range, palette),
        categories && element('ul', {}, ...categories.map((name, i) => counts[i] > 0 &&
          element('li', { 'data-category': name }, swatch(palette.category(i)), element('span', { text: name }), layers.length === 1 && element('span', { class: 'count', text: grouped(counts[i]) })))),
      )),
  );
}

function swatch(colour) {
  const mark = element('span', { class: 'swatch' });
  mark.style.background = colour;
  return mark;
}

function scale(attribute, unit, { min, max }, palette) {
  const bar = element('div', { class: 'bar' });
  bar.style.background = palette.gradient();
  const texts = ticks(min === max ? [min] : [min, (min + max) / 2, max]);
  return element(
    'div', { class: 'scale' },
    element('div', { class: 'what', text: unit ? `${attribute} (${unit})` : attribute }),
    bar,
    element('div', { class: 'ticks' }, ...texts.map((text) => element('span', { text }))),
  );
}
