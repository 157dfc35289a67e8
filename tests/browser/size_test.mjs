// 50 000 balls and 100 000 triangles: the page is small and soon there.
import assert from 'node:assert/strict';
import { readFileSync, readdirSync, statSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { ballflow, folder, graphs, readJson, shot, startChromium } from './support.mjs';

/** CPU seconds of a browser and all its helpers: they have its profile on their command lines. */
function cpuSeconds(browser) {
  let ticks = 0;
  for (const name of readdirSync('/proc').filter((entry) => /^\d+$/.test(entry))) {
    try {
      if (!readFileSync(`/proc/${name}/cmdline`, 'utf8').includes(browser.profile)) continue;
      const fields = readFileSync(`/proc/${name}/stat`, 'utf8').split(') ').at(-1).split(' ');
      ticks += Number(fields[11]) + Number(fields[12]);
    } catch {
      // it has ended meanwhile
    }
  }
  return ticks / 100;
}

test('a large page is small and soon ready', async () => {
  const report = join(folder, 'report.json');
  ballflow('run', `${graphs}dmt.json`, '--quiet', '--set', 'input=shape:knot?n=67000', '--set', 'sampling=vertices', '--report', report);
  const { outputs } = readJson(report);
  assert.ok(outputs.inner.summary.count > 50_000, `${outputs.inner.summary.count} balls`);
  assert.ok(outputs.mesh.summary.faces > 100_000);
  const path = join(folder, 'large.html');
  ballflow('view', outputs.inner.digest, outputs.mesh.digest, '-o', path);
  const megabytes = statSync(path).size / 1e6;
  const browser = await startChromium();
  try {
    // What a browser does once, when it first draws in 3D, is not the page's.
    ballflow('run', `${graphs}shape.json`, '--quiet', '--set', 'n=300');
    ballflow('view', '-o', join(folder, 'small.html'));
    await (await browser.open(join(folder, 'small.html'))).close();
    const started = cpuSeconds(browser);
    const page = await browser.open(path);
    const seconds = cpuSeconds(browser) - started;
    console.log(`${megabytes.toFixed(2)} MB, ready after ${page.readyAfter.toFixed(2)} s, ${seconds.toFixed(2)} s of CPU time`);
    assert.ok(megabytes < 6);
    // 4 s on two processors; ten times that, since CPU time too grows when others share the cores.
    assert.ok(seconds < 40);
    const layers = await page.evaluate('ballflow.layers()');
    assert.deepEqual(layers.map(({ shape, count, visible }) => [shape, count, visible]), [
      ['balls', outputs.inner.summary.count, true],
      ['triangles', outputs.mesh.summary.faces, true],
    ]);
    await page.evaluate('ballflow.settled()');
    const { centre, vertices } = await page.evaluate(`ballflow.arrays(${JSON.stringify(layers[0].key)})`);
    const points = Array.from({ length: 200 }, (_, i) => [0, 1, 2].map((k) => centre[k] + vertices[3 * 250 * i + k]));
    const places = await page.evaluate((list) => list.map((point) => ballflow.project(point)), points);
    const picture = await shot(page);
    const ground = picture.at(940, 60);
    const seen = places.filter(({ x, y }) => picture.at(x, y).some((channel, i) => Math.abs(channel - ground[i]) > 8)).length;
    assert.ok(seen > 150, `${seen} of 200 centres are not the ground; the legend hides some`);
    assert.deepEqual(page.complaints, []);
  } finally {
    await browser.close();
  }
});
