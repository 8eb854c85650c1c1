// The figures of docs/grasps.md and docs/grasping.md can be drawn, and show what they should.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { Figures } from '../figures.mjs';
import { indexedPng } from '../png.mjs';
import { launch, SHOTS } from './harness.mjs';

const ROOT = new URL('../../../', import.meta.url).pathname;
const COUNT = 6; // grasps: the first touches nothing, an index presses in the last

let browser;
let folder;
let figures;
before(async () => {
  browser = await launch();
  folder = mkdtempSync(join(tmpdir(), 'glissade_grasps_'));
  execFileSync(`${ROOT}build/release/tests/grasping/grasp_models`, [`${ROOT}tests/grasping/labelled_grasps.yaml`, folder, `${COUNT}`]);
  figures = await Figures.open(browser, folder);
});
after(async () => {
  await browser.close();
  rmSync(folder, { recursive: true });
});

function hueOf([r, g, b]) {
  const [low, high] = [Math.min(r, g, b), Math.max(r, g, b)];
  if (high - low < 0.4 * high) return 'pale'; // paper and skin
  if (high === b) return 'blue';
  return g > 0.6 * r ? 'yellow' : 'red';
}

// The shares of a figure by hue, of its columns from `left` on; keeps the figure for people.
function sharesOf(figure, name, left = 0, right = figure.width) {
  mkdirSync(SHOTS, { recursive: true });
  writeFileSync(join(SHOTS, `${name}.png`), indexedPng(figure));
  const shares = { pale: 0, blue: 0, yellow: 0, red: 0 };
  const part = 1 / ((right - left) * figure.height);
  figure.pixels.forEach((color, i) => {
    const column = i % figure.width;
    if (column >= left && column < right) shares[hueOf(figure.palette[color])] += part;
  });
  return shares;
}

test('segments that touch are red, and the object is in sight', async () => {
  const [nothing, index] = [figures.list.grasps[0], figures.list.grasps[COUNT - 1]];
  const free = sharesOf(await figures.grasp(nothing), 'grasp_of_nothing');
  assert.equal(free.red, 0);
  assert.ok(free.blue > 0.02, JSON.stringify(free));
  const pressing = sharesOf(await figures.grasp(index), 'grasp_index');
  assert.ok(pressing.red > 0.005 && pressing.red < 0.1, JSON.stringify(pressing));
  assert.ok(pressing.blue > 0.02, JSON.stringify(pressing));
});

test('the open hand has its segments in three colours', async () => {
  const shares = sharesOf(await figures.hand(), 'grasp_hand');
  for (const color of ['blue', 'yellow', 'red']) assert.ok(shares[color] > 0.01 && shares[color] < 0.3, JSON.stringify(shares));
});

test('a hand that closes touches more and more', async () => {
  const clasp = await figures.clasp();
  const size = clasp.height;
  const red = [0, 1, 2, 3].map((i) => sharesOf(clasp, 'grasp_clasp', i * size, (i + 1) * size).red);
  assert.equal(red[0], 0);
  assert.ok(red[1] > 0.01, `${red}`);
  assert.ok(red[3] > red[1], `${red}`);
});
