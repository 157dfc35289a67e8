// The keys of the page.
import { element } from './dom.js';

const keys = [
  ['drag', 'turn'],
  ['right drag, or shift and drag', 'move'],
  ['wheel', 'zoom to the pointer'],
  ['click', 'values of what is under the pointer'],
  ['double click', 'turn about what is under the pointer'],
  ['f', 'fit what is visible'],
  ['0  1  2  3', 'from aside, front, right, top'],
  ['p', 'parallel or perspective projection'],
  ['u', 'y or z is up'],
  ['c', 'section on or off'],
  ['x  y  z', 'section across this axis'],
  ['[  ]', 'previous or next value of the first axis of a sweep'],
  ['g', 'graph'],
  ['t', 'light or dark'],
  ['Escape', 'back to the outputs'],
];

export function helpDialog() {
  const dialog = element(
    'dialog', { class: 'help' },
    element('h2', { text: 'Keys' }),
    element('table', {}, ...keys.map(([key, text]) => element('tr', {}, element('th', { text: key }), element('td', { text })))),
    element('button', { text: 'Close', onclick: () => dialog.close() }),
  );
  dialog.addEventListener('click', (event) => {
    if (event.target === dialog) dialog.close();
  });
  return dialog;
}
