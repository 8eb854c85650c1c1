// The plots of a report, with data of which one knows how they look.

import assert from 'node:assert/strict';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { close, eventually, launch, open, screenshot } from './harness.mjs';

const TIME = 'time [s]';
const eleven = Array.from({ length: 11 }, (_, i) => i);

const PLOTS = [
  {
    title: 'Force <of> "glove"', x_label: TIME, y_label: 'force [N]', over_time: true,
    series: [
      { name: 'magnitude', x: eleven, y: eleven.map((t) => (t === 7 ? null : 5)) }, // a gap from 6 to 8
      { name: 'x', x: [0, 10], y: [1, 3] }, // at other times
    ],
  },
  { title: 'Contacts', x_label: TIME, y_label: 'contacts', over_time: true, counts: true, series: [{ name: 'peg', x: [0, 10], y: [0, 2] }] },
  { title: 'Torque', x_label: TIME, y_label: 'torque [Nm]', over_time: true, series: [{ name: 'peg', x: [0, 10], y: [-1e-5, 4e-5] }] },
  { title: 'Noise', x_label: TIME, y_label: 'angle [degrees]', over_time: true, series: [{ name: 'peg', x: [0, 10], y: [-1e-7, 1e-7] }] },
  { title: 'Histogram', x_label: 'duration [us]', y_label: 'share [%]', steps: true, series: [{ name: 'tick', x: [0, 50, 100], y: [20, 80, 80] }] },
  { title: 'Nothing', x_label: TIME, y_label: 'clearance [um]', over_time: true, series: [{ name: 'peg', x: [0, 1], y: [null, null] }] },
  {
    title: 'States', x_label: TIME, y_label: '', over_time: true, words: ['free', 'sliding', 'never'],
    series: [{ name: 'peg', x: [0, 4, 10], y: [0, 1, 1] }, { name: 'ring', x: [0, 10], y: [1, 1] }],
  },
];

let browser;
let folder;
let page;
before(async () => {
  browser = await launch();
  folder = mkdtempSync(join(tmpdir(), 'glissade_plots_'));
  const data = JSON.stringify(PLOTS.map((plot) => ({ words: [], ...plot }))).replaceAll('<', '\\u003c');
  const frame = readFileSync(new URL('../dist/index.html', import.meta.url), 'utf8');
  writeFileSync(join(folder, 'index.html'), frame.replace('<!--report-->', () =>
    `<div class="paper"><div id="plots"></div></div><script type="application/json" id="report-plots">${data}</script>`));
  page = await open(browser, `file://${join(folder, 'index.html')}`, {
    colorScheme: 'light',
    prepare: noteTexts,
    isReady: async (opened) => (await opened.locator('#plots section').count()) === PLOTS.length,
  });
  await page.waitForTimeout(300); // uPlot draws later
});
after(async () => {
  await browser.close();
  rmSync(folder, { recursive: true });
});

// Keeps what is written in each canvas, and whether upwards.
function noteTexts() {
  const { fillText } = CanvasRenderingContext2D.prototype;
  CanvasRenderingContext2D.prototype.fillText = function (text, ...place) {
    (this.canvas.texts ??= new Set()).add(this.getTransform().b < 0 ? `${text} upwards` : text);
    fillText.call(this, text, ...place);
  };
}

const sectionOf = (title) => page.locator('#plots section', { has: page.getByRole('heading', { name: title }) });
const textsOf = (title) => sectionOf(title).locator('canvas').evaluate((canvas) => [...canvas.texts]);
const namesOf = (title) => sectionOf(title).locator('.u-legend .u-label').allTextContents();
const valuesOf = (title) => sectionOf(title).locator('.u-legend .u-value').allTextContents();

async function boxOf(title) {
  const over = sectionOf(title).locator('.u-over');
  await over.scrollIntoViewIfNeeded();
  return over.boundingBox();
}

// Points at a share of the width of a plot, and waits until its legend tells of it.
async function pointAt(title, share, height = 0.5) {
  const box = await boxOf(title);
  await page.mouse.move(box.x + share * box.width, box.y + height * box.height);
  await page.waitForTimeout(100);
}

// Where the colours of lines are at these shares of the width, in columns of some pixels: the share of the height from
// below, by name.
function coloursAt(title, ...shares) {
  return sectionOf(title).locator('.uplot').evaluate((plot, places) => {
    const style = getComputedStyle(document.documentElement);
    const colours = Array.from({ length: 6 }, (_, i) => [`c${i}`, style.getPropertyValue(`--c${i}`).match(/\w\w/g).map((byte) => parseInt(byte, 16))]);
    const [canvas, over] = [plot.querySelector('canvas'), plot.querySelector('.u-over')];
    const WIDTH = 6;
    const scale = canvas.width / canvas.clientWidth;
    const [left, top, width, height] = [over.offsetLeft, over.offsetTop, over.offsetWidth, over.offsetHeight].map((x) => x * scale);
    return places.map((share) => {
      const { data } = canvas.getContext('2d').getImageData(Math.round(left + share * width), top, WIDTH, height);
      const found = {};
      for (let i = 0; i < WIDTH * height; ++i) {
        const pixel = data.slice(4 * i, 4 * i + 4);
        const hit = colours.find(([, rgb]) => rgb.every((value, part) => Math.abs(value - pixel[part]) < 30) && pixel[3] > 200);
        if (hit) found[hit[0]] = 1 - Math.floor(i / WIDTH) / height;
      }
      return found;
    });
  }, shares);
}

test('each plot has its title, labels with units, and a legend', async () => {
  assert.deepEqual(await page.locator('#plots h2').allTextContents(), PLOTS.map(({ title }) => title));
  assert.equal(await page.locator('#viewer').isVisible(), false, 'there is no replay');
  const texts = await textsOf('Force');
  for (const text of [TIME, 'force [N] upwards', '0', '5']) assert.ok(texts.includes(text), `${text}: ${texts}`);
  assert.deepEqual(await namesOf('Force'), [TIME, 'magnitude', 'x']);
  const histogram = await textsOf('Histogram');
  for (const text of ['duration [us]', 'share [%] upwards']) assert.ok(histogram.includes(text), `${text}: ${histogram}`);
  assert.equal(await sectionOf('Nothing').locator('p').textContent(), 'no data');
  const markers = await sectionOf('Force').locator('.u-marker').evaluateAll((all) => all.map((marker) => getComputedStyle(marker).backgroundColor));
  assert.deepEqual(markers.slice(1), ['rgb(31, 111, 191)', 'rgb(211, 105, 10)'], 'the colours of the lines');
  await screenshot(page, 'plots');
});

test('lines go through their points and break at gaps', async () => {
  const [at5, at7, at9] = await coloursAt('Force', 0.5, 0.7, 0.9);
  assert.deepEqual([at5, at7, at9].map((found) => Object.keys(found).sort()), [['c0', 'c1'], ['c1'], ['c0', 'c1']]);
  assert.ok(at9.c1 > at5.c1 + 0.05, 'x rises');
  assert.ok(Math.abs(at9.c0 - at5.c0) < 0.01 && at5.c0 > at9.c1, 'the magnitude is flat, and above x');
});

const ticksOf = async (title) => (await textsOf(title)).filter((text) => /^[\d.,e-]+$/.test(text));

test('bars are flat, numbers of things whole, small ones told apart, and noise is a line in the middle', async () => {
  const [low, before50, after50] = await coloursAt('Histogram', 0.1, 0.47, 0.53);
  assert.ok(Math.abs(low.c0 - before50.c0) < 0.01 && after50.c0 > before50.c0 + 0.3, JSON.stringify([low, before50, after50]));
  const ticks = await ticksOf('Contacts');
  assert.ok(ticks.includes('1') && ticks.every((text) => Number.isInteger(Number(text))), `${ticks}`);
  const small = (await ticksOf('Torque')).map(Number).filter((value) => value !== 0 && Math.abs(value) < 1e-3);
  assert.ok(small.length > 3 && Math.abs(Math.max(...small) - 4e-5) < 1e-5 && Math.min(...small) < 0, `${small}`);
  const [noise] = await coloursAt('Noise', 0.3);
  assert.ok(Math.abs(noise.c0 - 0.5) < 0.02, JSON.stringify(noise));
});

test('strips have the colours of their words', async () => {
  assert.deepEqual(await sectionOf('States').locator('li').allTextContents(), ['free', 'sliding']);
  const dots = await sectionOf('States').locator('li').evaluateAll((all) => all.map((word) => getComputedStyle(word, '::before').backgroundColor));
  assert.deepEqual(dots, ['rgb(31, 111, 191)', 'rgb(211, 105, 10)']);
  const texts = await textsOf('States');
  for (const text of ['peg', 'ring', TIME]) assert.ok(texts.includes(text), `${text}: ${texts}`);
  const [early, late] = await coloursAt('States', 0.38, 0.42);
  assert.deepEqual(Object.keys(early).sort(), ['c0', 'c1']);
  assert.deepEqual(Object.keys(late), ['c1']);
});

test('the legend tells the values at the cursor', async () => {
  await pointAt('Force', 0.62);
  const [time, ...values] = await valuesOf('Force');
  assert.ok(Math.abs(Number(time) - 6.2) < 0.02, time);
  assert.deepEqual(values, ['5', '3'], 'at the nearest points');
  assert.deepEqual((await valuesOf('States')).slice(1), ['sliding', 'sliding'], 'all plots over time tell of this moment');
  await pointAt('States', 0.3);
  assert.deepEqual((await valuesOf('States')).slice(1), ['free', 'sliding']);
  await pointAt('Histogram', 0.4);
  assert.equal((await valuesOf('Histogram'))[1], '20', 'the bar, not the nearest begin');
});

test('all plots over time zoom together, and out again', async () => {
  const before = await coloursAt('Histogram', 0.1, 0.9);
  await pointAt('Force', 0.2);
  await page.mouse.down();
  await pointAt('Force', 0.4);
  await pointAt('Force', 0.6);
  await page.mouse.up();
  await eventually(async () => 'c0' in (await coloursAt('Force', 0.7))[0]); // 4.8 s, before the gap
  const [early, late] = await coloursAt('States', 0.45, 0.55); // 4 s is in the middle
  assert.deepEqual([Object.keys(early).length, Object.keys(late).length], [2, 1]);
  assert.deepEqual(await coloursAt('Histogram', 0.1, 0.9), before);
  const box = await boxOf('Force');
  await page.mouse.dblclick(box.x + 0.5 * box.width, box.y + 0.5 * box.height);
  await eventually(async () => !('c0' in (await coloursAt('Force', 0.7))[0]));
});

test('lines follow the light and dark scheme', async () => {
  await page.emulateMedia({ colorScheme: 'dark' });
  await eventually(async () => 'c0' in (await coloursAt('Force', 0.5))[0]); // of the palette for dark screens
  await screenshot(page, 'plots_dark');
  await close(page);
});
