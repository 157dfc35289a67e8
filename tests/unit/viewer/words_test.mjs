import assert from 'node:assert/strict';
import { test } from 'node:test';
import { bytes, counted, duration, grouped, plain, rounded, ticks } from '../../../tools/viewer/src/words.js';

const spaced = (text) => text.replaceAll('\u2009', ' ');

test('numbers are short and lose nothing that matters', () => {
  assert.equal(spaced(grouped(1234567)), '1 234 567');
  assert.equal(grouped(999), '999');
  assert.equal(rounded(0.12345678), '0.1235');
  assert.equal(rounded(1.5e-7), '1.5e-7');
  assert.equal(rounded(123456789), '1.235e8');
  assert.equal(rounded(-2), '-2');
  assert.equal(plain([1, 'a']), '[1,"a"]');
  assert.equal(plain('<b>'), '<b>');
});

test('ticks that are close have more digits', () => {
  assert.deepEqual(ticks([0.5, 0.75, 1]), ['0.5', '0.75', '1']);
  assert.deepEqual(ticks([0.30801, 0.30802, 0.30803]), ['0.30801', '0.30802', '0.30803']);
  assert.deepEqual(ticks([2]), ['2']);
});

test('times and sizes have units', () => {
  assert.equal(spaced(duration(0.0042)), '4.2 ms');
  assert.equal(spaced(duration(1.239)), '1.24 s');
  assert.equal(spaced(duration(59.96)), '1 min 00 s');
  assert.equal(spaced(duration(125)), '2 min 05 s');
  assert.equal(spaced(bytes(12345678)), '12.3 MB');
  assert.equal(spaced(counted(1, 'balls')), '1 ball');
  assert.equal(spaced(counted(2000, 'triangles')), '2 000 triangles');
});
