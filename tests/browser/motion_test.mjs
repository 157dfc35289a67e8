// Pages of distances, ways and shapes in the plane: what they show is compared with formulas and exported tables.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { ballflow, channels, folder, graphs, likeness, readCsv, readJson, shot, startChromium } from './support.mjs';

let browser;
before(async () => {
  browser = await startChromium();
});
after(() => browser?.close());

/** The page of a run, and its report. */
async function pageOf(name, ...words) {
  const [out, record] = [join(folder, name), join(folder, `${name}.json`)];
  ballflow('run', `${graphs}${name}.json`, '--quiet', ...words, '--out', out, '--report', record);
  const path = join(folder, `${name}.html`);
  ballflow('view', record, '-o', path);
  return { out, report: readJson(record), page: await browser.open(path) };
}

const counts = (page) =>
  page.evaluate(() => Object.fromEntries([...document.querySelectorAll('[data-legend]')].map((line) => [line.dataset.legend, Number(line.dataset.count)])));

async function showOnly(page, ...keys) {
  for (const layer of await page.evaluate('ballflow.layers()')) {
    if (layer.visible !== keys.includes(layer.key)) await page.click(`[data-layer="${layer.key}"] input[type=checkbox]`);
  }
  await page.evaluate('ballflow.settled()');
}

/** The colours at the places of points, and that of the ground. */
async function coloursAt(page, points) {
  const places = await page.evaluate((all) => all.map((point) => ballflow.project(point)), points);
  const picture = await shot(page);
  return { colours: places.map(({ x, y }) => picture.at(x, y)), ground: picture.at(940, 60), picture, places };
}

/** How many of the points have something else than the ground within two pixels. */
async function drawn(page, points) {
  const { ground, picture, places } = await coloursAt(page, points);
  return places.filter(({ x, y }) => {
    for (let dx = -2; dx <= 2; ++dx) {
      for (let dy = -2; dy <= 2; ++dy) if (likeness(picture.at(x + dx, y + dy), ground) < 0.999) return true;
    }
    return false;
  }).length;
}

test('balls have the colours of their clearance, and the nearest points are joined', async () => {
  // In a row: 1 apart from the middle one on the right, 4 and 6 from those on its left.
  const { page, report } = await pageOf('ball_distance', '--set', 'a=balls:0 0 0 0.5; 2 0 0 0.5; 5 0 0 0.5', '--set', 'b=balls:7 0 0 0.5; 7 0 0 0.25',
    '--set', 'threshold=1.25');
  assert.deepEqual(page.complaints, []);
  assert.equal(report.outputs.distance.summary.separation, 1);
  const shown = await counts(page);
  assert.equal(shown['distance/clearance of a'], 3);
  assert.equal(shown['distance/clearance of b'], 2);
  assert.equal(shown['distance/nearest points'], 1);
  assert.equal('distance/pairs below the threshold' in shown, false, 'pairs are off at first');
  await showOnly(page, 'distance/pairs below the threshold');
  assert.equal((await counts(page))['distance/pairs below the threshold'], 2);

  await showOnly(page, 'distance/clearance of a');
  await page.slide('[data-layer="distance/clearance of a"] input[type=range]', 100);
  await page.evaluate('ballflow.settled()');
  const { colours } = await coloursAt(page, [[0, 0, 0], [2, 0, 0], [5, 0, 0]]);
  const palette = (await page.evaluate(() => JSON.parse(document.getElementById('ballflow-scene').textContent).palette.scalar)).map(channels);
  // Clearances 6, 4 and 1: the ends of the palette, and what is 3 / 5 up.
  [palette.at(-1), palette[Math.round(0.6 * (palette.length - 1))], palette[0]].forEach((expected, i) =>
    assert.ok(likeness(colours[i], expected) > 0.985, `ball ${i} shows ${colours[i]}, not ${expected}`));
  await showOnly(page, 'distance/nearest points');
  assert.equal(await drawn(page, [[5.6, 0, 0], [6, 0, 0], [6.4, 0, 0]]), 3);
  assert.equal(await drawn(page, [[4, 0, 0], [2.5, 0, 0]]), 0, 'and nothing beside them');
});

test('a path is a line through its points', async () => {
  const { page, out } = await pageOf('sweep_along_path', '--set', 'tool=shape:sphere?n=300&R=0.1', '--set', 'path=path:0 0 0; 1 0 0; 1 1 0', '--format', 'path=csv');
  await showOnly(page, 'path/path');
  assert.deepEqual(readCsv(join(out, 'path.csv')).map((row) => row.slice(0, 3)), [[0, 0, 0], [1, 0, 0], [1, 1, 0]]);
  assert.equal((await counts(page))['path/path'], 2);
  assert.equal(await drawn(page, [[0.1, 0, 0], [0.5, 0, 0], [0.9, 0, 0], [1, 0.25, 0], [1, 0.75, 0]]), 5);
  assert.equal(await drawn(page, [[0.4, 0.6, 0], [0.5, 0.5, 0]]), 0);
});

test('a way is drawn with its ends', async () => {
  const { page, out, report } = await pageOf('path', '--set', 'robot=shape:sphere?n=300&R=0.1', '--set', 'obstacles=shape:sphere?n=600&R=0.5',
    '--set', 'start=-1 0 0', '--set', 'goal=1 0 0', '--format', 'way=csv');
  assert.equal(report.outputs.way.summary.answer, 'way');
  await showOnly(page, 'way/way', 'way/start and goal');
  const points = readCsv(join(out, 'way.csv')).map((row) => row.slice(0, 3));
  assert.ok(points.length > 2, 'around the obstacle');
  const shown = await counts(page);
  assert.equal(shown['way/way'], points.length - 1);
  assert.equal(shown['way/start and goal'], 2);
  assert.equal(await drawn(page, [...points, [-1, 0, 0], [1, 0, 0]]), points.length + 2);
});

test('polygons and outlines of discs are drawn along their edges and arcs', async () => {
  const { page, out, report } = await pageOf('discs', '--set', 'polygon=polygon:frames', '--format', 'outline=csv', '--format', 'polygon=poly2d');
  assert.deepEqual(page.complaints, []);
  await page.key('1');
  const arcs = readCsv(join(out, 'outline.csv'));
  assert.equal(arcs.length, report.outputs.outline.summary.arcs);
  await showOnly(page, 'outline/outline');
  const begins = arcs.map((arc) => [arc[4], arc[5], 0]);
  assert.ok((await drawn(page, begins)) >= 0.97 * begins.length, 'where arcs begin');
  const inside = arcs.filter((arc) => arc[3] > 0.02).map((arc) => [arc[1], arc[2], 0]);
  assert.ok(inside.length > 0);
  assert.ok((await drawn(page, inside)) < 0.2 * inside.length, 'centres of discs are not on the outline');
  await showOnly(page, 'polygon/polygon');
  assert.equal((await counts(page))['polygon/polygon'], report.outputs.polygon.summary.vertices, 'as many edges as corners');
});
