// What the address of a page remembers, and the keys.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { ballflow, folder, graphs, startChromium } from './support.mjs';

const path = join(folder, 'page.html');
let browser, page;

before(async () => {
  ballflow('run', `${graphs}dmt_points.json`, '--quiet', '--set', 'input=shape:torus?n=300');
  ballflow('view', '-o', path);
  browser = await startChromium();
  page = await browser.open(path);
});
after(() => browser?.close());

const camera = () => page.evaluate('ballflow.camera()');

test('a copied address shows the same view and the same node', async () => {
  await page.drag(500, 300, 620, 340);
  await page.click('[data-node="poles"]');
  await page.until(() => location.hash.includes('camera=') && location.hash.includes('node=poles'));
  await page.evaluate(() => new Promise((done) => setTimeout(done, 400)));
  const hash = await page.evaluate('location.hash');
  const here = await camera();
  const copy = await browser.open(path, { hash });
  const there = await copy.evaluate('ballflow.camera()');
  for (const part of ['position', 'target']) {
    here[part].forEach((x, i) => assert.ok(Math.abs(x - there[part][i]) < 1e-4, `${part} ${here[part]} ${there[part]}`));
  }
  assert.equal(await copy.evaluate('document.querySelector(".node.chosen").dataset.node'), 'poles');
  assert.deepEqual(copy.complaints, []);
  await copy.close();
  await page.key('Escape');
});

test('dragging turns, the wheel comes nearer, f shows everything again', async () => {
  const distance = ({ position, target }) => Math.hypot(...position.map((x, i) => x - target[i]));
  await page.key('0');
  const before_ = await camera();
  await page.drag(400, 300, 500, 300);
  const turned = await camera();
  assert.ok(Math.abs(distance(turned) - distance(before_)) < 1e-3 * distance(before_), 'turning keeps the distance');
  assert.ok(Math.hypot(...turned.position.map((x, i) => x - before_.position[i])) > 0.1 * distance(before_));
  const aimed = { x: 420, y: 260 };
  await page.mouse('mouseWheel', aimed.x, aimed.y, { deltaX: 0, deltaY: -300 });
  await page.until((wanted) => {
    const { position, target } = ballflow.camera();
    return Math.hypot(...position.map((x, i) => x - target[i])) < 0.95 * wanted;
  }, distance(turned));
  await page.key('f');
  assert.ok(Math.abs(distance(await camera()) - distance(before_)) < 0.3 * distance(before_));
});

test('views look along axes', async () => {
  const direction = async (key) => {
    await page.key(key);
    const { position, target } = await camera();
    const way = position.map((x, i) => x - target[i]);
    return way.map((x) => Math.round(x / Math.hypot(...way)) + 0);
  };
  assert.deepEqual(await direction('1'), [0, 0, 1]);
  assert.deepEqual(await direction('2'), [1, 0, 0]);
  assert.deepEqual(await direction('3'), [0, 1, 0]);
  await page.key('u');
  assert.deepEqual(await direction('1'), [0, -1, 0]);
  assert.deepEqual(await direction('3'), [0, 0, 1]);
});

test('? lists the keys', async () => {
  await page.key('?');
  assert.equal(await page.evaluate('document.querySelector("dialog").open'), true);
  await page.click('dialog button');
  assert.equal(await page.evaluate('document.querySelector("dialog").open'), false);
  assert.deepEqual(page.complaints, []);
});
