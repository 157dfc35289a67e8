// What the tests of pages share: a ballflow with a cache of its own, a browser, and the pixels of its pictures.
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { inflateSync } from 'node:zlib';
import { fileURLToPath } from 'node:url';
import { Chromium } from './chromium.mjs';

const build = process.env.BALLFLOW_BUILD;
if (!existsSync(join(build, 'share/ballflow/viewer.html'))) {
  console.log('skipped: ballflow was built without its viewer');
  process.exit(0);
}

export const folder = mkdtempSync(join(tmpdir(), 'ballflow-browser-'));
process.on('exit', () => rmSync(folder, { recursive: true, force: true }));

export const graphs = fileURLToPath(new URL('../../graphs/', import.meta.url));

/** Runs the command line and returns what it prints. */
export function ballflow(...words) {
  const env = { ...process.env, BALLFLOW_CACHE: join(folder, 'cache') };
  return execFileSync(join(build, 'bin/ballflow'), words, { env, encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'] });
}

export function readJson(path) {
  return JSON.parse(readFileSync(path, 'utf8'));
}

/** Rows of numbers of a CSV file, without its heading. */
export function readCsv(path) {
  return readFileSync(path, 'utf8').trim().split('\n').slice(1).map((line) => line.split(',').map(Number));
}

export const startChromium = () => Chromium.start(process.env.CHROMIUM_PROGRAM);

function paeth(a, b, c) {
  const p = a + b - c;
  const [pa, pb, pc] = [Math.abs(p - a), Math.abs(p - b), Math.abs(p - c)];
  return pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
}

/** Decodes the PNG files that Chromium writes: 8 bits a channel, not interlaced. */
export class Picture {
  constructor(png) {
    const data = [];
    for (let at = 8; at < png.length; ) {
      const length = png.readUInt32BE(at);
      const type = png.toString('latin1', at + 4, at + 8);
      const content = png.subarray(at + 8, at + 8 + length);
      if (type === 'IHDR') {
        this.width = content.readUInt32BE(0);
        this.height = content.readUInt32BE(4);
        this.channels = { 2: 3, 6: 4 }[content[9]];
        if (content[8] !== 8 || !this.channels || content[12] !== 0) throw new Error('a kind of PNG that is not read here');
      }
      if (type === 'IDAT') data.push(content);
      at += 12 + length;
    }
    const raw = inflateSync(Buffer.concat(data));
    const row = this.width * this.channels;
    this.pixels = new Uint8Array(row * this.height);
    for (let y = 0; y < this.height; ++y) {
      const filter = raw[y * (row + 1)];
      for (let x = 0; x < row; ++x) {
        const left = x >= this.channels ? this.pixels[y * row + x - this.channels] : 0;
        const above = y > 0 ? this.pixels[(y - 1) * row + x] : 0;
        const corner = y > 0 && x >= this.channels ? this.pixels[(y - 1) * row + x - this.channels] : 0;
        const guess = [0, left, above, (left + above) >> 1, paeth(left, above, corner)][filter];
        this.pixels[y * row + x] = raw[y * (row + 1) + 1 + x] + guess;
      }
    }
  }

  /** [red, green, blue] at a place in CSS pixels. */
  at(x, y) {
    const start = (Math.floor(y) * this.width + Math.floor(x)) * this.channels;
    return [...this.pixels.subarray(start, start + 3)];
  }
}

export const shot = async (page) => new Picture(await page.screenshot());

/** 1 for colours that differ in brightness alone. */
export function likeness(a, b) {
  const dot = (u, v) => u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
  return dot(a, b) / Math.sqrt(dot(a, a) * dot(b, b) || 1);
}

/** "#102030" -> [16, 32, 48] */
export const channels = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16));
