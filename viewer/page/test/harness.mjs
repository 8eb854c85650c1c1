// Starts the program and a browser for the tests. GLISSADE_PROGRAM is the program; GLISSADE_CHROMIUM the browser.

import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { mkdirSync, readFileSync } from 'node:fs';
import http from 'node:http';
import { chromium } from 'playwright-core';

export const PROGRAM = process.env.GLISSADE_PROGRAM ?? new URL('../../../build/release/apps/glissade', import.meta.url).pathname;
const BROWSER = process.env.GLISSADE_CHROMIUM ?? '/usr/bin/chromium';
export const SHOTS = process.env.GLISSADE_SCREENSHOTS ?? new URL('../../../build/screenshots/', import.meta.url).pathname;
const PATIENCE_MS = 60000;

export class Program {
  constructor(args) {
    this.output = '';
    this.child = spawn(PROGRAM, args, { stdio: ['ignore', 'pipe', 'pipe'] });
    for (const stream of [this.child.stdout, this.child.stderr]) stream.on('data', (data) => { this.output += data; });
    this.exited = new Promise((resolve) => { this.child.on('exit', (code) => resolve(code)); });
  }

  // The address that it prints.
  async url() {
    return (await eventually(() => this.output.match(/http:\/\/127\.0\.0\.1:\d+\//), () => this.output))[0];
  }

  // Ends it as Ctrl-C does; returns the exit code.
  stop() {
    this.child.kill('SIGINT');
    return this.exited;
  }
}

// Waits until `test` is truthy, and returns what it is.
export async function eventually(test, explain = () => '') {
  for (const end = Date.now() + PATIENCE_MS; Date.now() < end;) {
    const result = await test();
    if (result) return result;
    await new Promise((resolve) => setTimeout(resolve, 20));
  }
  throw new Error(`this did not happen: ${test}\n${explain()}`);
}

// A WebSocket for frames, as a bare connection that does not read.
export function connect(url) {
  const headers = {
    Connection: 'Upgrade', Upgrade: 'websocket', 'Sec-WebSocket-Version': 13,
    'Sec-WebSocket-Key': Buffer.alloc(16).toString('base64'),
  };
  return new Promise((resolve, reject) => {
    http.request(`${url}live`, { headers })
      .on('upgrade', (_, socket, head) => {
        socket.on('error', () => {}); // the server ends first
        socket.pause();
        if (head.length > 0) socket.unshift(head);
        resolve(socket);
      })
      .on('error', reject)
      .end();
  });
}

const CLOSING = 0x8; // the kind of the frame with which a server says goodbye

// Lets such a connection read: `onFrame()` after each frame but the last one, which closes. Its length is in the second byte, or the third and fourth.
export function readFrames(socket, onFrame) {
  let missing = 0;
  let isClosing = false;
  socket.on('data', (data) => {
    for (let rest = data; rest.length > 0;) {
      if (missing === 0) isClosing = (rest[0] & 0xf) === CLOSING;
      if (missing === 0) missing = rest[1] === 126 ? 4 + rest.readUInt16BE(2) : 2 + rest[1];
      const taken = Math.min(missing, rest.length);
      missing -= taken;
      rest = rest.subarray(taken);
      if (missing === 0 && !isClosing) onFrame();
    }
  });
  socket.resume();
}

export function launch() {
  return chromium.launch({
    executablePath: BROWSER,
    args: [
      '--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-quic',
      '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync',
    ],
  });
}

// What a browser says of a server that has ended.
const LOST = /^(WebSocket connection to .* failed|Failed to load resource: net::ERR_CONNECTION_(REFUSED|RESET|CLOSED) )/;

// A page, with what it asked for and what went wrong in it. `close` checks both. `prepare` runs in it before its scripts.
export async function open(browser, url, { prepare, isReady = inspectsModel, ...options } = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 720 }, ...options });
  if (prepare) await context.addInitScript(prepare);
  const page = await context.newPage();
  page.faults = [];
  page.requests = [];
  page.home = url;
  page.on('console', (message) => {
    if (message.type() === 'error') page.faults.push(`${message.text()} (${message.location().url})`);
  });
  page.on('pageerror', (error) => page.faults.push(error.message));
  page.on('request', (request) => page.requests.push(request.url()));
  page.on('websocket', (socket) => page.requests.push(socket.url()));
  await page.goto(url);
  await eventually(() => isReady(page), () => page.faults.join('\n'));
  return page;
}

const inspectsModel = async (page) => (await inspect(page))?.triangles > 0;

// Closes the page. Nothing went wrong in it, and it asked nothing of any other machine, of any other server of this one,
// or, opened from disk, of any other file. Where its server has ended meanwhile, the browser tells of that.
export async function close(page, { hasLostServer = false } = {}) {
  await page.context().close();
  assert.deepEqual(page.faults.filter((fault) => !hasLostServer || !LOST.test(fault)), []);
  const own = [page.home, page.home.replace(/^http/, 'ws'), 'data:'];
  assert.deepEqual(page.requests.filter((request) => !own.some((start) => request.startsWith(start))), []);
}

export function inspect(page) {
  return page.evaluate(() => window.glissade?.inspect());
}

export async function screenshot(page, name) {
  mkdirSync(SHOTS, { recursive: true });
  await page.screenshot({ path: `${SHOTS}/${name}.png` });
}

// Positions in metres, and angles of unit quaternions, that differ by less than a tenth of a millimetre or milliradian.
export function isNear(a, b, tolerance = 1e-4) {
  return a.length === b.length && a.every((x, i) => Math.abs(x - b[i]) < tolerance);
}

// The rows of a table of CSV, each by the names of the columns.
export function rowsOf(csv) {
  const [head, ...lines] = readFileSync(csv, 'utf8').trim().split('\n').map((line) => line.split(','));
  return lines.map((line) => Object.fromEntries(line.map((cell, i) => [head[i], cell])));
}
