// A page of a real run: what it shows is compared with the artifacts as other programs read them.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { ballflow, channels, folder, graphs, likeness, readCsv, readJson, shot, startChromium } from './support.mjs';

const out = join(folder, 'out');
const pagePath = join(folder, 'page.html');
const sweepPath = join(folder, 'sweep.html');
let browser, page, report, balls, inner;

before(async () => {
  ballflow('run', `${graphs}medial_axis.json`, '--quiet', '--set', 'input=shape:torusBalls?n=2500', '--set', 'epsilon=0.1',
    '--set', 'sampling=vertices', '--set', 'growth=additive', '--set', 'repair=none', '--out', out, '--format', 'balls=csv',
    '--format', 'inner=csv', '--report', join(out, 'report.json'));
  report = readJson(join(out, 'report.json'));
  balls = readCsv(join(out, 'balls.csv'));
  inner = readCsv(join(out, 'inner.csv'));
  ballflow('view', 'latest', '-o', pagePath);
  ballflow('sweep', `${graphs}experiments/epsilon_by_strategy.json`, '--quiet', '--set', 'input=shape:torus?n=800', '--report', join(out, 'sweep.json'));
  ballflow('view', join(out, 'sweep.json'), '-o', sweepPath);
  browser = await startChromium();
  page = await browser.open(pagePath);
});
after(() => browser?.close());

const box = (key) => `[data-layer="${key}"] input[type=checkbox]`;
const legendCounts = (of = page) =>
  of.evaluate(() => Object.fromEntries([...document.querySelectorAll('[data-legend]')].map((line) => [line.dataset.legend, [Number(line.dataset.count), line.textContent]])));
const settled = (of = page) => of.evaluate('ballflow.settled()');

async function showOnly(key) {
  for (const layer of await page.evaluate('ballflow.layers()')) {
    if (layer.visible !== (layer.key === key)) await page.click(box(layer.key));
  }
  await settled();
}

/**
 * The first ball that the ray from the eye to the centre of ball `i` meets; -1 when a second one is so near behind it
 * that a pixel, which is not a ray, may show that.
 */
function nearestBall(list, eye, i, clear = 0.02) {
  const way = [0, 1, 2].map((k) => list[i][k] - eye[k]);
  const length = Math.hypot(...way);
  const ray = way.map((x) => x / length);
  const hits = list.map(([x, y, z, r], j) => {
    const to = [x - eye[0], y - eye[1], z - eye[2]];
    const middle = to[0] * ray[0] + to[1] * ray[1] + to[2] * ray[2];
    const aside = to[0] ** 2 + to[1] ** 2 + to[2] ** 2 - middle ** 2;
    return { at: aside <= r * r ? middle - Math.sqrt(r * r - aside) : Infinity, j };
  });
  const [first, second] = hits.sort((a, b) => a.at - b.at);
  return second.at - first.at < clear * list[first.j][3] ? -1 : first.j;
}

/** How many of the balls' centres have the colour that the ball in front of them should have. */
async function coloursAsExpected(list, valueOf, clear) {
  const { position } = await page.evaluate('ballflow.camera()');
  const places = await page.evaluate((points) => points.map((point) => ballflow.project(point)), list.map((ball) => ball.slice(0, 3)));
  const covered = await page.evaluate((points) => points.map(({ x, y }) => document.elementFromPoint(x, y)?.tagName !== 'CANVAS'), places);
  const table = await page.evaluate(() => JSON.parse(document.getElementById('ballflow-scene').textContent).palette.scalar);
  const picture = await shot(page);
  const values = list.map((ball, i) => valueOf(ball, i));
  const [least, greatest] = [Math.min(...values), Math.max(...values)];
  let [seen, right] = [0, 0];
  list.forEach((_, i) => {
    const j = covered[i] ? -1 : nearestBall(list, position, i, clear);
    if (j < 0) return;
    ++seen;
    const value = values[j];
    const expected = channels(table[Math.round(((value - least) / (greatest - least)) * (table.length - 1))]);
    const shown = picture.at(places[i].x, places[i].y);
    if (likeness(shown, expected) > 0.985) ++right;
    else if (process.env.VERBOSE) console.log('ball', i, 'behind', j, 'shows', shown, 'not', expected);
  });
  return { seen, right };
}

test('the page is there without a complaint and without asking anybody for anything', async () => {
  assert.equal(await page.evaluate('document.title'), 'graphs/medial_axis.json – ballflow'.replace('graphs/', graphs));
  assert.deepEqual(page.complaints, []);
  assert.deepEqual(page.requests, []);
});

test('the legend counts what the artifacts have', async () => {
  const axis = report.outputs.medial_axis.summary;
  const counts = await legendCounts();
  assert.equal(counts['balls/balls'][0], balls.length);
  assert.match(counts['balls/balls'][1], new RegExp(`${balls.length} balls$`));
  assert.equal(counts['medial_axis/medial axis edges']?.[0] ?? 0, axis.edges);
  assert.equal('inner/balls' in counts, false, 'the inner balls hide the others and are off at first');
  await page.click(box('inner/balls'));
  assert.equal((await legendCounts())['inner/balls'][0], inner.length);
  await page.click(box('inner/balls'));
});

test('the arrays of the page are those of the artifact', async () => {
  const { centre, vertices, radii } = await page.evaluate('ballflow.arrays("balls/balls")');
  assert.equal(radii.length, balls.length);
  balls.forEach(([x, y, z, r], i) => {
    [x, y, z].forEach((value, k) => assert.ok(Math.abs(centre[k] + vertices[3 * i + k] - value) < 1e-6));
    assert.ok(Math.abs(radii[i] - r) < 1e-6);
  });
});

test('balls are where they must be, in the colours of their radii', async () => {
  await showOnly('balls/balls');
  await page.slide('[data-layer="balls/balls"] input[type=range]', 100);
  await settled();
  const { seen, right } = await coloursAsExpected(balls, ([, , , r]) => r);
  assert.ok(seen > 0.5 * balls.length, `${seen} of ${balls.length} are in the picture`);
  assert.ok(right >= 0.97 * seen, `${right} of ${seen}`);
});

test('parallel projection and another attribute show the same balls', async () => {
  await page.evaluate(() => {
    const choice = document.querySelector('[data-layer="balls/balls"] select');
    choice.value = 'order';
    choice.dispatchEvent(new Event('change', { bubbles: true }));
  });
  await settled();
  const { seen, right } = await coloursAsExpected(balls, (_, i) => i);
  assert.ok(right >= 0.97 * seen, `${right} of ${seen}`);
  const wrong = await coloursAsExpected(balls, ([, , , r]) => r);
  assert.ok(wrong.right < 0.8 * wrong.seen, 'colours by radius would be noticed');
  await page.key('p');
  await settled();
  const { half } = await page.evaluate('ballflow.camera()');
  assert.ok(half > 0);
  const ground = (await shot(page)).at(940, 60);
  const picture = await shot(page);
  const places = await page.evaluate((points) => points.map((point) => ballflow.project(point)), balls.map((ball) => ball.slice(0, 3)));
  assert.ok(places.every(({ x, y }) => likeness(picture.at(x, y), ground) < 0.999), 'no centre shows the ground');
  await page.key('p');
});

test('a section cuts balls open and leaves nothing on the other side', async () => {
  await page.key('1');
  await page.key('x');
  await settled();
  const middle = balls.reduce((sum, [x]) => sum + x, 0) / balls.length;
  const { position } = await page.evaluate('ballflow.camera()');
  const places = await page.evaluate((points) => points.map((point) => ballflow.project(point)), balls.map((ball) => ball.slice(0, 3)));
  const picture = await shot(page);
  const ground = picture.at(940, 60);
  let [kept, gone] = [0, 0];
  balls.forEach(([x, , , r], i) => {
    const empty = likeness(picture.at(places[i].x, places[i].y), ground) > 0.9999;
    // Far enough from the plane that neither perspective nor neighbours matter.
    const reach = 0.25 * Math.abs(position[2]) + r;
    if (x < middle - 1e-3 && !empty) ++kept;
    if (x > middle + reach && !empty) ++gone;
  });
  assert.ok(kept > 0.3 * balls.length, `${kept} are kept`);
  assert.equal(gone, 0);
  await page.key('c');
});

test('a layer that is switched off is gone', async () => {
  const places = await page.evaluate((points) => points.map((point) => ballflow.project(point)), balls.map((ball) => ball.slice(0, 3)));
  const before_ = await shot(page);
  await page.click(box('balls/balls'));
  await settled();
  const picture = await shot(page);
  const ground = picture.at(940, 60);
  assert.deepEqual(ground, [250, 250, 251], 'the ground of the light theme');
  for (const { x, y } of places) {
    if (x > 280 || y < 400) assert.deepEqual(picture.at(x, y), ground);
  }
  assert.notDeepEqual(before_.at(places[0].x, places[0].y), ground);
  assert.deepEqual(await legendCounts(), {});
  await page.click(box('balls/balls'));
});

test('a click on a ball says which one it is', async () => {
  await showOnly('balls/balls');
  await page.key('0');
  await settled();
  const { position } = await page.evaluate('ballflow.camera()');
  const i = balls.findIndex((_, at) => nearestBall(balls, position, at) === at);
  const { x, y } = await page.evaluate((point) => ballflow.project(point), balls[i].slice(0, 3));
  await page.clickAt(x, y);
  await page.until(() => !document.querySelector('.picked').hidden);
  assert.match(await page.evaluate('document.querySelector(".picked").textContent'), new RegExp(`^balls, ball ${i}\\D`));
});

test('a node of the graph shows what it did and what it made', async () => {
  const node = report.nodes.enlarge;
  await page.click('[data-node="enlarge"]');
  await settled();
  const text = await page.evaluate('document.querySelector(".side").innerText');
  assert.match(text, /Layers of enlarge/);
  assert.match(text, /epsilon\s+0\.1/);
  assert.match(text, /ran/);
  assert.deepEqual(Object.fromEntries(Object.entries(await legendCounts()).map(([key, [count]]) => [key, count])),
    { 'enlarge.balls/balls': node.outputs.balls.summary.count,
      'enlarge.growth/grown balls': node.outputs.balls.summary.count });
  await page.click(box('enlarge.growth/grown balls')); // the same balls in other colours
  await settled();
  const { seen, right } = await coloursAsExpected(
    await page.evaluate(async () => {
      const { centre, vertices, radii } = await ballflow.arrays('enlarge.balls/balls');
      return radii.map((r, i) => [0, 1, 2].map((k) => vertices[3 * i + k] + centre[k]).concat(r));
    }), ([, , , r]) => r, 0); // so many balls that neighbours are alike
  assert.ok(seen > 100 && right >= 0.97 * seen, `${right} of ${seen}`);
  await page.key('Escape');
  await settled();
  assert.match(await page.evaluate('document.querySelector(".side").innerText'), /inner/);
  assert.equal(await page.evaluate('document.querySelectorAll(".node.chosen").length'), 0);
});

test('every node of the run is drawn once, with its status', async () => {
  const drawn = await page.evaluate(() => [...document.querySelectorAll('[data-node]')].map((node) => [node.dataset.node, node.classList[1]]));
  assert.deepEqual(Object.fromEntries(drawn), Object.fromEntries(Object.entries(report.nodes).map(([path, { status }]) => [path, status])));
  assert.equal(drawn.length, Object.keys(report.nodes).length);
});

test('light and dark are two grounds', async () => {
  await page.key('t');
  await settled();
  assert.deepEqual((await shot(page)).at(940, 60), [21, 22, 27]);
  await page.key('t');
  assert.deepEqual(page.complaints, []);
});

test('the slider of a sweep shows every variant with its own balls', async () => {
  const sweep = readJson(join(out, 'sweep.json'));
  const sheet = await browser.open(sweepPath, { dark: true });
  const choose = (strategy) => sheet.evaluate((wanted) => {
    const select = document.querySelector('select[data-axis=strategy]');
    select.selectedIndex = [...select.options].findIndex(({ text }) => text === wanted);
    select.dispatchEvent(new Event('change', { bubbles: true }));
  }, strategy);
  const seen = new Set();
  for (const { name, params } of sweep.variants) {
    await choose(params.strategy);
    await sheet.slide('input[data-axis=epsilon]', [0.1, 0.3, 1].indexOf(params.epsilon));
    await settled(sheet);
    const counts = await legendCounts(sheet);
    const expected = sweep.outputs[`${name}/balls`].summary.count;
    assert.equal(counts['balls/balls'][0], expected, name);
    assert.equal(await sheet.evaluate('document.querySelector("input[data-axis=epsilon] + output").textContent'), String(params.epsilon));
    seen.add(expected);
    const { centre, vertices, radii } = await sheet.evaluate('ballflow.arrays("balls/balls")');
    assert.equal(radii.length, expected);
    assert.equal(vertices.length, 3 * expected);
    assert.equal(centre.length, 3);
  }
  assert.ok(seen.size >= 3, 'variants differ');
  // A chosen node stays chosen in the next variant.
  await sheet.click('[data-node$="model/enlarge"]');
  await sheet.key('[');
  await settled(sheet);
  const chosen = await sheet.evaluate('document.querySelector(".node.chosen").dataset.node');
  assert.match(chosen, /epsilon=0\.3.*model\/enlarge$/);
  assert.deepEqual((await shot(sheet)).at(940, 60), [21, 22, 27], 'dark, as the system wishes');
  assert.deepEqual(sheet.complaints, []);
  assert.deepEqual(sheet.requests, []);
  await sheet.close();
});
