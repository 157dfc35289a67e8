// Pages show foreign texts as texts, and a browser lets them load and run nothing.
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { ballflow, folder, graphs, startChromium } from './support.mjs';

const bad = '<script>window.broken=1</script><img src=x onerror="window.broken=1">';
let browser;
before(async () => { browser = await startChromium(); });
after(() => browser?.close());

test('names and values from a report are texts', async () => {
  const path = join(folder, 'bad.json');
  const node = { type: bad, status: 'run', seconds: 1, reason: bad, params: { [bad]: bad }, inputs: {}, warnings: [bad], body: [bad],
    outputs: { [bad]: { type: bad, digest: '0'.repeat(64), bytes: 1, summary: { [bad]: bad } } } };
  const variant = (value) => ({ name: value, status: 'ok', params: { [bad]: value }, nodes: [bad], subgraphs: {} });
  writeFileSync(path, JSON.stringify({ run: bad, graph: bad, status: bad, params: { [bad]: bad }, nodes: { [bad]: node }, outputs: {},
    axes: [bad], variants: [variant(bad), variant('b')] }));
  ballflow('view', path, '-o', join(folder, 'bad.html'));
  const page = await browser.open(join(folder, 'bad.html'));
  await page.click('[data-node]');
  await page.until(() => document.querySelectorAll('.panel').length >= 2);
  assert.equal(await page.evaluate('window.broken'), undefined);
  assert.equal(await page.evaluate('document.images.length'), 0);
  assert.equal(await page.evaluate('document.querySelector("[data-node]").dataset.node'), bad);
  assert.ok((await page.evaluate('document.querySelector(".side").textContent')).includes(bad));
  assert.ok((await page.evaluate('document.querySelector("svg title, .node title").textContent')).includes(bad));
  assert.deepEqual(page.complaints, []);
  await page.close();
});

test('a browser refuses scripts, pictures and requests that the page did not bring', async () => {
  ballflow('graph', `${graphs}dmt_points.json`, '--html', join(folder, 'graph.html'));
  const page = await browser.open(join(folder, 'graph.html'));
  assert.deepEqual(page.complaints, []);
  await page.evaluate(() => {
    document.body.append(Object.assign(document.createElement('script'), { textContent: 'window.broken = 1' }));
    document.body.append(Object.assign(document.createElement('img'), { src: 'http://127.0.0.1:9/x.png' }));
    document.body.setAttribute('onclick', 'window.broken = 1');
  });
  assert.equal(await page.evaluate('fetch("http://127.0.0.1:9/").then(() => "fetched", () => "refused")'), 'refused');
  await page.clickAt(3, 300);
  assert.equal(await page.evaluate('window.broken'), undefined);
  await page.until(() => true);
  assert.ok(page.complaints.filter((text) => /Content Security Policy/.test(text)).length >= 3, page.complaints.join('\n'));
});

test('a page of a graph shows nodes without a 3D view', async () => {
  const page = await browser.open(join(folder, 'graph.html'));
  assert.equal(await page.evaluate('document.querySelectorAll("[data-node]").length'), 3);
  assert.equal(await page.evaluate('document.querySelector("canvas")'), null);
  await page.click('[data-node="label"]');
  assert.match(await page.evaluate('document.querySelector(".side").innerText'), /method\s+angle/);
  assert.deepEqual(page.complaints, []);
});
