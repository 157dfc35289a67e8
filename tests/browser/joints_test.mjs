// Sliders of a robot: meshes and spheres are where the joints of its description put them.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { ballflow, folder, graphs, likeness, shot, startChromium } from './support.mjs';

const path = join(folder, 'page.html');
let browser, page, robot;

/** Links and joints of a URDF without rotations of origins, read from its text alone. */
function readUrdf(text) {
  const attribute = (xml, name) => xml.match(new RegExp(`\\b${name}="([^"]*)"`))?.[1];
  const numbers = (xml, name) => attribute(xml, name)?.split(/\s+/).map(Number);
  assert.ok(!/rpy="(?!0 0 0")/.test(text), 'no rotations here');
  const found = { spheres: {}, joints: [] };
  for (const [, name, body] of text.matchAll(/<link name="([^"]+)"\s*(?:\/>|>(.*?)<\/link>)/gs)) {
    found.spheres[name] = [...(body ?? '').matchAll(/<collision[\s>].*?<\/collision>/gs)]
      .map(([shape]) => [...(numbers(shape.match(/<origin[^>]*>/)?.[0] ?? '', 'xyz') ?? [0, 0, 0]), Number(attribute(shape.match(/<sphere[^>]*>/)[0], 'radius'))]);
  }
  for (const [, head, body] of text.matchAll(/<joint ([^>]*)>(.*?)<\/joint>/gs)) {
    const part = (tag) => body.match(new RegExp(`<${tag}[^>]*>`))?.[0] ?? '';
    found.joints.push({
      name: attribute(head, 'name'), type: attribute(head, 'type'), parent: attribute(part('parent'), 'link'), child: attribute(part('child'), 'link'),
      xyz: numbers(part('origin'), 'xyz') ?? [0, 0, 0], axis: numbers(part('axis'), 'xyz'),
      lower: Number(attribute(part('limit'), 'lower')), upper: Number(attribute(part('limit'), 'upper')), mimic: attribute(part('mimic'), 'joint'),
    });
  }
  return found;
}

/** A point of a link in the model, from the leaf to the root, by Rodrigues' formula. */
function placed(link, point, values) {
  const joint = robot.joints.find(({ child }) => child === link);
  if (!joint) return point;
  const value = values[joint.mimic ?? joint.name] ?? 0;
  let p = point;
  if (joint.type === 'prismatic') p = p.map((x, i) => x + value * joint.axis[i]);
  if (joint.type === 'revolute' || joint.type === 'continuous') {
    const [u, c, s] = [joint.axis, Math.cos(value), Math.sin(value)];
    const along = u[0] * p[0] + u[1] * p[1] + u[2] * p[2];
    const across = [u[1] * p[2] - u[2] * p[1], u[2] * p[0] - u[0] * p[2], u[0] * p[1] - u[1] * p[0]];
    p = p.map((x, i) => x * c + across[i] * s + u[i] * along * (1 - c));
  }
  return placed(joint.parent, p.map((x, i) => x + joint.xyz[i]), values);
}

before(async () => {
  const out = join(folder, 'out');
  ballflow('run', `${graphs}check_spheres.json`, '--quiet', '--out', out, '--format', 'spheres=urdf', '--report', join(out, 'report.json'));
  robot = readUrdf(readFileSync(join(out, 'spheres.urdf'), 'utf8'));
  ballflow('view', join(out, 'report.json'), '-o', path);
  browser = await startChromium();
  page = await browser.open(path);
});
after(() => browser?.close());

const settled = (of = page) => of.evaluate('ballflow.settled()');
const points = async (key, of = page) => {
  const { centre, vertices } = await of.evaluate((wanted) => ballflow.arrays(wanted), key);
  return Array.from({ length: vertices.length / 3 }, (_, i) => [0, 1, 2].map((k) => vertices[3 * i + k] + centre[k]));
};
const apart = (a, b) => Math.hypot(...a.map((x, i) => x - b[i]));

/** All spheres, and the corners of the box of the forearm, are where these values put them. */
async function agrees(values, of = page) {
  const expected = Object.entries(robot.spheres).flatMap(([link, spheres]) => spheres.map((sphere) => placed(link, sphere.slice(0, 3), values)));
  const shown = await points('spheres/spheres', of);
  assert.equal(shown.length, expected.length);
  shown.forEach((p, i) => assert.ok(apart(p, expected[i]) < 1e-6, `sphere ${i} is at ${p}, not ${expected[i]}`));
  const mesh = await points('robot/links', of);
  for (const x of [0, 0.26]) {
    for (const y of [-0.035, 0.035]) {
      for (const z of [-0.025, 0.025]) {
        const corner = placed('forearm', [x, y, z], values);
        assert.ok(mesh.some((p) => apart(p, corner) < 1e-6), `no vertex at ${corner}`);
      }
    }
  }
}

const values = { turn: 1, elbow: -0.7, wrist: 2, left: 0.03 };

test('there is a slider for what moves by itself, within its limits', async () => {
  const joints = await page.evaluate('ballflow.joints()');
  const expected = robot.joints.filter(({ type, mimic }) => type !== 'fixed' && !mimic);
  assert.deepEqual(joints.map(({ name }) => name), expected.map(({ name }) => name));
  joints.forEach(({ name, lower, upper, unit, value }, i) => {
    const { type } = expected[i];
    const limits = type === 'continuous' ? [-Math.PI, Math.PI] : [expected[i].lower, expected[i].upper];
    assert.deepEqual([lower, upper], limits, name);
    assert.equal(unit, type === 'prismatic' ? 'm' : 'rad');
    assert.equal(value, 0);
  });
  assert.equal(await page.evaluate('document.querySelectorAll("input[data-joint]").length'), joints.length);
  await agrees({});
  assert.equal((await page.evaluate('ballflow.camera()')).up, 'z');
});

test('mesh and spheres are shown together, the spheres translucent, parts in frames of their own not', async () => {
  const layers = await page.evaluate('ballflow.layers()');
  assert.deepEqual(layers.filter(({ visible, shape }) => visible && shape !== 'points').map(({ key }) => key).sort(), ['robot/links', 'spheres/spheres']);
  assert.ok(layers.find(({ key }) => key === 'spheres/spheres').opacity < 0.5);
  assert.equal(layers.find(({ key }) => key === 'robot/links').opacity, 1);
  assert.equal(await page.evaluate('document.querySelectorAll("[data-category=forearm]").length'), 1, 'one list of colours for both');
});

test('points that the spheres leave out are red, and belong to no sphere', async () => {
  const layer = (await page.evaluate('ballflow.layers()')).find(({ key }) => key === 'spheres/not covered');
  assert.ok(layer.visible);
  const open = await points('spheres/not covered');
  assert.ok(open.length > 10);
  const all = Object.entries(robot.spheres).flatMap(([link, spheres]) => spheres.map((s) => [...placed(link, s.slice(0, 3), {}), s[3], link]));
  // Each is outside of the spheres of its own link, and the base, of which a fifth is outside, has some.
  const links = await page.evaluate(async () => {
    const { attributes } = Object.values(JSON.parse(document.getElementById('ballflow-scene').textContent).artifacts)
      .find(({ type }) => type === 'RobotSpheres').layers.find(({ name }) => name === 'not covered');
    return attributes[0].categories.filter((_, i) => attributes[0].counts[i] > 0);
  });
  assert.deepEqual(links, ['base', 'forearm', 'hand']);
  for (const p of open) {
    const near = all.filter(([x, y, z, r]) => apart(p, [x, y, z]) < r - 1e-6).map((sphere) => sphere[4]);
    assert.ok(!links.every((link) => near.includes(link)), `${p} is inside`);
  }
  await page.click('[data-layer="spheres/spheres"] input[type=checkbox]');
  await settled();
  const places = await page.evaluate((list) => list.map((p) => ballflow.project(p)), open);
  const covered = await page.evaluate((list) => list.map(({ x, y }) => document.elementFromPoint(x, y)?.tagName !== 'CANVAS'), places);
  const picture = await shot(page);
  const red = places.filter(({ x, y }, i) => !covered[i] && likeness(picture.at(x, y), [227, 0, 15]) > 0.98);
  assert.ok(red.length >= 3, `${red.length} of ${open.length} are seen`);
  await page.click('[data-layer="spheres/spheres"] input[type=checkbox]');
  await settled();
});

test('sliders move mesh and spheres as the description says', async () => {
  await settled();
  const before_ = await shot(page);
  const hand = await page.evaluate((p) => ballflow.project(p), placed('hand', [0.03, 0, 0], {}));
  for (const [name, value] of Object.entries(values)) await page.slide(`input[data-joint=${name}]`, value);
  await settled();
  await agrees(values);
  const after_ = await shot(page);
  assert.notDeepEqual(after_.at(hand.x, hand.y), before_.at(hand.x, hand.y), 'the hand is no longer where it was');
  await page.key('f');
  await settled();
  const fitted = await shot(page);
  const now = await page.evaluate((p) => ballflow.project(p), placed('hand', [0.03, 0, 0], values));
  assert.notDeepEqual(fitted.at(now.x, now.y), fitted.at(940, 60), 'and is seen where it is now');
  assert.match(await page.evaluate('document.querySelector("input[data-joint=left] + output").textContent'), /^0\.03\Dm$/);
  assert.deepEqual(page.complaints, []);
});

test('a click names what is there now', async () => {
  const { position } = await page.evaluate('ballflow.camera()');
  const at = placed('hand', [0.03, 0, 0], values);
  const { x, y } = await page.evaluate((p) => ballflow.project(p), at);
  assert.ok(apart(position, at) > 0.1);
  await page.clickAt(x, y);
  await page.until(() => !document.querySelector('.picked').hidden);
  assert.match(await page.evaluate('document.querySelector(".picked").textContent'), /^spheres, ball 6link hand/);
});

test('a copied address has the same pose, and reset takes it back', async () => {
  await page.until(() => location.hash.includes('joints='));
  await page.evaluate(() => new Promise((done) => setTimeout(done, 400)));
  const copy = await browser.open(path, { hash: await page.evaluate('location.hash') });
  await settled(copy);
  for (const { name, value } of await copy.evaluate('ballflow.joints()')) assert.ok(Math.abs(value - values[name]) < 1e-6);
  await agrees(values, copy);
  await copy.close();
  await page.click('button[data-reset]');
  await settled();
  await agrees({});
  assert.deepEqual((await page.evaluate('ballflow.joints()')).map(({ value }) => value), [0, 0, 0, 0]);
  assert.deepEqual(page.complaints, []);
  assert.deepEqual(page.requests, []);
});
