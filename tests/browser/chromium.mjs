// Drives headless Chromium through the pipe of its debugging protocol: no driver program, no packages.
import { spawn } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

const flags = [
  '--headless=new', '--remote-debugging-pipe', '--no-first-run', '--no-default-browser-check', '--no-sandbox',
  '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--hide-scrollbars', '--mute-audio', '--disable-extensions',
  '--disable-background-networking', '--disable-component-update', '--disable-default-apps', '--disable-sync',
  '--disable-features=Translate,MediaRouter,OptimizationHints', '--disable-dev-shm-usage', '--force-color-profile=srgb',
];

/** A message that Chromium did not answer in time is a failure, not a hang. */
const patience = 40_000;

export class Chromium {
  #next = 1;
  #waiting = new Map();
  #listeners = new Set();
  #rest = '';

  static async start(program) {
    const browser = new Chromium();
    browser.profile = mkdtempSync(join(tmpdir(), 'ballflow-chromium-'));
    browser.process = spawn(program, [...flags, `--user-data-dir=${browser.profile}`, 'about:blank'], {
      stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'],
    });
    browser.ended = new Promise((done) => browser.process.once('exit', done));
    browser.ended.then((code) => {
      for (const { fail } of browser.#waiting.values()) fail(new Error(`Chromium ended with ${code}`));
      browser.#waiting.clear();
    });
    browser.process.stdio[4].setEncoding('utf8').on('data', (text) => browser.#read(text));
    browser.process.stdio[3].on('error', () => {}); // its end is reported above
    return browser;
  }

  #read(text) {
    const messages = (this.#rest + text).split('\0');
    this.#rest = messages.pop();
    for (const message of messages.map((one) => JSON.parse(one))) {
      const waiting = this.#waiting.get(message.id);
      if (!waiting) {
        for (const listener of this.#listeners) listener(message);
        continue;
      }
      this.#waiting.delete(message.id);
      if (message.error) waiting.fail(new Error(`${waiting.method}: ${message.error.message}`));
      else waiting.done(message.result);
    }
  }

  send(method, params = {}, sessionId = undefined) {
    const id = this.#next++;
    return new Promise((done, fail) => {
      const timer = setTimeout(() => {
        this.#waiting.delete(id);
        fail(new Error(`${method}: no answer in ${patience / 1000} s`));
      }, patience);
      const settled = (settle) => (value) => {
        clearTimeout(timer);
        settle(value);
      };
      this.#waiting.set(id, { method, done: settled(done), fail: settled(fail) });
      this.process.stdio[3].write(`${JSON.stringify({ id, method, params, sessionId })}\0`);
    });
  }

  listen(listener) {
    this.#listeners.add(listener);
    return () => this.#listeners.delete(listener);
  }

  async open(file, options = {}) {
    const page = new Page(this);
    await page.open(file, options);
    return page;
  }

  async close() {
    await this.send('Browser.close').catch(() => {});
    await this.ended;
    rmSync(this.profile, { recursive: true, force: true, maxRetries: 5 });
  }
}

class Page {
  /** Errors and warnings of the console, exceptions, and violations of the page's policy. */
  complaints = [];
  /** Addresses that the page asked for, without itself. */
  requests = [];

  constructor(browser) {
    this.browser = browser;
  }

  async open(file, { width = 1280, height = 800, dark = false, hash = '' } = {}) {
    const { targetId } = await this.browser.send('Target.createTarget', { url: 'about:blank' });
    this.target = targetId;
    this.session = (await this.browser.send('Target.attachToTarget', { targetId, flatten: true })).sessionId;
    this.quiet = this.browser.listen((message) => {
      if (message.sessionId === this.session) this.#note(message);
    });
    for (const domain of ['Page', 'Runtime', 'Network', 'Log']) await this.send(`${domain}.enable`);
    await this.send('Emulation.setDeviceMetricsOverride', { width, height, deviceScaleFactor: 1, mobile: false });
    await this.send('Emulation.setEmulatedMedia', { features: [{ name: 'prefers-color-scheme', value: dark ? 'dark' : 'light' }] });
    const address = pathToFileURL(file).href + hash;
    this.address = pathToFileURL(file).href;
    const before = performance.now();
    const loaded = this.event('Page.loadEventFired');
    await this.send('Page.navigate', { url: address });
    await loaded;
    await this.evaluate('window.ballflow ? ballflow.ready.then(() => true) : true');
    this.readyAfter = (performance.now() - before) / 1000;
  }

  #note({ method, params }) {
    if (method === 'Runtime.exceptionThrown') {
      const { text, exception } = params.exceptionDetails;
      this.complaints.push(exception?.description ?? text);
    }
    if (method === 'Runtime.consoleAPICalled' && ['error', 'warning', 'assert'].includes(params.type)) {
      this.complaints.push(params.args.map(({ value, description }) => value ?? description).join(' '));
    }
    if (method === 'Log.entryAdded' && ['error', 'warning'].includes(params.entry.level)) this.complaints.push(params.entry.text);
    if (method === 'Network.requestWillBeSent' && !params.request.url.startsWith(this.address)) this.requests.push(params.request.url);
  }

  send(method, params) {
    return this.browser.send(method, params, this.session);
  }

  event(name) {
    return new Promise((done, fail) => {
      const timer = setTimeout(() => fail(new Error(`${name} did not happen`)), patience);
      const quiet = this.browser.listen(({ method, params, sessionId }) => {
        if (method !== name || sessionId !== this.session) return;
        clearTimeout(timer);
        quiet();
        done(params);
      });
    });
  }

  /** The value of an expression; promises are awaited. A function is called with the arguments. */
  async evaluate(expression, ...values) {
    const code = typeof expression === 'function' ? `(${expression})(...${JSON.stringify(values)})` : expression;
    const { result, exceptionDetails } = await this.send('Runtime.evaluate', { expression: code, awaitPromise: true, returnByValue: true });
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    return result.value;
  }

  /** Waits until a function of the page returns something true. */
  async until(condition, ...values) {
    const end = performance.now() + 20_000;
    for (;;) {
      const value = await this.evaluate(condition, ...values);
      if (value) return value;
      if (performance.now() > end) throw new Error(`never came true: ${condition}`);
      await new Promise((done) => setTimeout(done, 30));
    }
  }

  async mouse(type, x, y, more = {}) {
    await this.send('Input.dispatchMouseEvent', { type, x, y, ...more });
  }

  /** Clicks as a user does: in the middle of the first element that the selector finds, which must be on top there. */
  async click(selector) {
    const at = await this.evaluate((wanted) => {
      const node = document.querySelector(wanted);
      if (!node) throw new Error(`there is no ${wanted}`);
      node.scrollIntoView({ block: 'nearest', inline: 'nearest' });
      const { left, top, width, height } = node.getBoundingClientRect();
      const [x, y] = [left + width / 2, top + height / 2];
      const hit = document.elementFromPoint(x, y);
      if (!node.contains(hit) && !hit?.contains(node)) throw new Error(`${wanted} is covered by ${hit?.outerHTML.slice(0, 80)}`);
      return { x, y };
    }, selector);
    await this.clickAt(at.x, at.y);
  }

  async clickAt(x, y) {
    await this.mouse('mouseMoved', x, y);
    await this.mouse('mousePressed', x, y, { button: 'left', clickCount: 1 });
    await this.mouse('mouseReleased', x, y, { button: 'left', clickCount: 1 });
  }

  async drag(x, y, toX, toY) {
    await this.mouse('mouseMoved', x, y);
    await this.mouse('mousePressed', x, y, { button: 'left', buttons: 1, clickCount: 1 });
    for (let i = 1; i <= 4; ++i) await this.mouse('mouseMoved', x + ((toX - x) * i) / 4, y + ((toY - y) * i) / 4, { button: 'left', buttons: 1 });
    await this.mouse('mouseReleased', toX, toY, { button: 'left', clickCount: 1 });
  }

  async key(key) {
    const text = key.length === 1 ? key : undefined;
    await this.send('Input.dispatchKeyEvent', { type: 'keyDown', key, text });
    await this.send('Input.dispatchKeyEvent', { type: 'keyUp', key });
  }

  /** Sets a slider to a value, as moving its knob does. */
  async slide(selector, value) {
    await this.evaluate((wanted, to) => {
      const slider = document.querySelector(wanted);
      slider.focus();
      slider.value = to;
      slider.dispatchEvent(new Event('input', { bubbles: true }));
    }, selector, value);
  }

  /** A PNG of what is seen. */
  async screenshot() {
    const { data } = await this.send('Page.captureScreenshot', { format: 'png' });
    return Buffer.from(data, 'base64');
  }

  async close() {
    this.quiet();
    await this.browser.send('Target.closeTarget', { targetId: this.target });
  }
}
