// A report, opened from disk.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { close, eventually, inspect, launch, open, Program, screenshot } from './harness.mjs';

const PROGRAM = process.env.GLISSADE_PROGRAM ?? new URL('../../../build/release/apps/glissade', import.meta.url).pathname;

let browser;
let folder;
before(async () => {
  browser = await launch();
  folder = mkdtempSync(join(tmpdir(), 'glissade_report_'));
});
after(async () => {
  await browser.close();
  rmSync(folder, { recursive: true });
});

test('the replay of a report is linked with its plots', async () => {
  execFileSync(PROGRAM, ['demo', '--offline', '--seconds', '10', '--report', folder]);
  const file = join(folder, 'index.html');
  assert.ok(statSync(file).size <= 5e6, `${statSync(file).size} bytes`);
  const page = await open(browser, `file://${file}`);
  const start = await inspect(page);
  assert.ok(start.frames >= 590 && start.frames <= 610, `${start.frames} frames of 10 s`);
  await screenshot(page, 'report');

  const force = page.locator('#plots section').first();
  assert.equal(await force.locator('h2').textContent(), 'Force on the hand of glove 1');
  assert.deepEqual(await force.locator('.u-label').allTextContents(), ['time [s]', 'magnitude', 'x', 'y', 'z']);

  // A click at seven tenths of the force plot.
  const plot = page.locator('#plots .u-over').first();
  await plot.scrollIntoViewIfNeeded();
  const box = await plot.boundingBox();
  await page.mouse.click(box.x + 0.7 * box.width, box.y + box.height / 2);
  const there = await eventually(async () => {
    const state = await inspect(page);
    return state.frame.time > start.frame.time + 1 && state;
  });
  const passed = there.frame.time - start.frame.time;
  assert.ok(Math.abs(passed - 7) < 0.05, `${passed} s`);
  assert.notDeepEqual(there.parts[0].p, start.parts[0].p);
  const lines = await page.locator('.moment').evaluateAll((all) => all.map((line) => line.getBoundingClientRect().left));
  assert.ok(lines.length >= 8 && lines.every((place) => Math.abs(place - (box.x + 0.7 * box.width)) < 2), `${lines}`);

  // It plays on from there, and after a pause from where it was put.
  await page.locator('#play').click();
  await eventually(async () => (await inspect(page)).frame.time > there.frame.time + 0.3);
  await page.locator('#play').click();
  await plot.scrollIntoViewIfNeeded();
  const now = await plot.boundingBox();
  await page.mouse.click(now.x + 3, now.y + now.height / 2);
  await eventually(async () => (await inspect(page)).frame.time < start.frame.time + 0.1);
  await page.locator('#play').click();
  const again = await eventually(async () => {
    const { frame } = await inspect(page);
    return frame.time > start.frame.time + 0.1 && frame;
  });
  assert.ok(again.time < start.frame.time + 4, `${again.time - start.frame.time} s`);
  await close(page);
});

// In its seat the motor touches a sheet without thickness from behind, with gaps of a few micrometres.
test('nothing that touches seems to be inside of what it touches', async () => {
  const page = await open(browser, `file://${join(folder, 'index.html')}`);
  for (const id of ['show-ghosts', 'show-contacts', 'show-forces', 'show-edges']) await page.locator(`#${id}`).click();
  const last = await page.evaluate(() => {
    const { timeline } = window.glissade.page;
    timeline.seek(timeline.last);
    return timeline.frame.sequence;
  });
  // Asked for and read at once: a moment later the picture may be a coarse one again.
  const blue = (await eventually(() => page.evaluate((sequence) => {
    const { stage } = window.glissade.page;
    if (stage.frame.sequence !== sequence || !stage.isFine || stage.isDirty) return undefined;
    const gl = stage.renderer.getContext();
    const pixels = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
    gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    let count = 0;
    for (let i = 0; i < pixels.length; i += 4) count += pixels[i + 2] > pixels[i] + 40 ? 1 : 0;
    return { share: count / (pixels.length / 4) };
  }, last))).share;
  assert.ok(blue < 1e-4, `${blue} of the picture: only screws are to be seen, through their holes`);
  await close(page);
});

test('the plots of a report can be read on a narrow screen', async () => {
  const page = await open(browser, `file://${join(folder, 'index.html')}`, { viewport: { width: 390, height: 844 } });
  const widths = await page.locator('#plots .uplot').evaluateAll((all) => all.map((plot) => plot.getBoundingClientRect().width));
  assert.ok(widths.length >= 8 && widths.every((width) => width > 300 && width < 360), `${widths}`);
  assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 390, 'the page itself does not scroll sideways');
  await close(page);
});

test('a report opens in a browser whose language Intl refuses', async () => {
  const page = await open(browser, `file://${join(folder, 'index.html')}`, {
    prepare: () => Object.defineProperty(Navigator.prototype, 'language', { configurable: true, get: () => 'en-US@posix' }),
  });
  assert.ok((await page.locator('#plots .uplot').count()) >= 8);
  await close(page);
});

test('a browser without WebGL is told why there is no scene', async () => {
  const context = await browser.newContext();
  await context.addInitScript(() => {
    const { getContext } = HTMLCanvasElement.prototype;
    HTMLCanvasElement.prototype.getContext = function (kind) { return kind === '2d' ? getContext.call(this, kind) : null; };
  });
  const page = await context.newPage();
  await page.goto(`file://${join(folder, 'index.html')}`);
  await eventually(async () => /^The scene cannot be shown: ./.test(await page.locator('#wait').textContent()));
  assert.ok(await page.locator('#plots .uplot').first().isVisible());
  await context.close();
});

test('a report of a hand shows the hand', async () => {
  execFileSync(PROGRAM, ['demo', '--fingers', '--offline', '--seconds', '6', '--report', folder]);
  const file = join(folder, 'index.html');
  assert.ok(statSync(file).size <= 5e6, `${statSync(file).size} bytes`);
  const page = await open(browser, `file://${file}`);
  await page.evaluate(() => { // before the first answer of the simulation, nothing is known of the hand
    const { timeline } = window.glissade.page;
    timeline.seek(timeline.first + 3);
  });
  await eventually(async () => (await inspect(page)).segments.filter((segment) => segment.visible).length >= 17);
  await screenshot(page, 'report_hand');
  await close(page);
});

test('a report of a run without a loop does not speak of one', async () => {
  const scene = join(folder, 'scene.yaml');
  const way = join(folder, 'way.csv');
  writeFileSync(scene, 'objects:\n  - {name: box, movable: true, shape: {type: box}}\n' +
    '  - {name: plate, shape: {type: plate}, pose: {position_m: [0, 0, -0.06]}}\n');
  writeFileSync(way, 't_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,0,0,0,1,0,0,0\n1,0,0,-0.02,1,0,0,0\n');
  execFileSync(PROGRAM, ['slide', scene, '--part', 'box', '--trajectory', way, '--report', folder]);
  const page = await open(browser, `file://${join(folder, 'index.html')}`);
  await eventually(async () => (await inspect(page)).frame);
  const status = await page.locator('#status').textContent();
  assert.match(status, /^handholds box/);
  assert.doesNotMatch(status, /glove|loop|tick/);
  await screenshot(page, 'report_slide');
  await close(page);

  execFileSync(PROGRAM, ['example', folder]);
  const file = (name) => join(folder, name);
  execFileSync(PROGRAM, ['grasp', file('ball_and_tray.yaml'), '--hand-trajectory', file('ball_and_tray_hand.csv'),
    '--out', file('hand.csv'), '--report', folder]);
  const grasp = await open(browser, `file://${join(folder, 'index.html')}`);
  await grasp.evaluate(() => window.glissade.page.timeline.seek(window.glissade.page.timeline.first + 3));
  await eventually(async () => /precision/.test(await grasp.locator('#status').textContent()));
  assert.doesNotMatch(await grasp.locator('#status').textContent(), /glove|loop|tick|force|torque/);
  await screenshot(grasp, 'report_grasp');
  await close(grasp);
});

test('a click on the head of a column sorts the trajectories of an assembly check', async () => {
  const scene = join(folder, 'scene.yaml');
  writeFileSync(scene, 'objects:\n  - {name: box, movable: true, shape: {type: box}}\n' +
    '  - {name: plate, shape: {type: plate}, pose: {position_m: [0, 0, -0.06]}}\n');
  const depths = { middle: -0.02, deep: -0.025, free: 0.01 };
  const ways = Object.entries(depths).map(([name, z]) => {
    const way = join(folder, `${name}.csv`);
    writeFileSync(way, `t_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,0,0,0,1,0,0,0\n1,0,0,${z},1,0,0,0\n`);
    return way;
  });
  execFileSync(PROGRAM, ['slide', scene, '--part', 'box', '--trajectory', ...ways, '--report', folder]);
  const page = await open(browser, `file://${join(folder, 'index.html')}`);
  const order = () => page.locator('.rows tbody tr td:first-child')
    .evaluateAll((all) => all.map((cell) => cell.textContent.match(/(\w+)\.csv/)[1]));
  assert.deepEqual(await order(), ['middle', 'deep', 'free']);
  await page.getByRole('button', { name: 'greatest force [N]' }).click();
  assert.deepEqual(await order(), ['free', 'middle', 'deep']);
  await page.getByRole('button', { name: 'greatest force [N]' }).click();
  assert.deepEqual(await order(), ['deep', 'middle', 'free']);
  await page.getByRole('button', { name: 'trajectory' }).click();
  assert.deepEqual(await order(), ['deep', 'free', 'middle']);
  assert.equal(await page.locator('.rows th').first().getAttribute('aria-sort'), 'ascending');
  assert.equal(await page.locator('.rows th[aria-sort]').count(), 1);
  await screenshot(page, 'report_check');
  await close(page);
});

test('a recorded run is shown again, in a browser and in a report', async () => {
  const log = join(folder, 'run.lcmlog');
  execFileSync(PROGRAM, ['demo', '--offline', '--seconds', '3', '--record', log]);
  const program = new Program(['replay', log, '--view', '0']);
  const page = await open(browser, await program.url());
  const seen = new Set(); // at the speed of the repetition, the page would see a handful
  await eventually(async () => {
    seen.add((await inspect(page)).frame?.sequence);
    return Math.max(...[...seen].filter(Number.isFinite)) > 2500;
  }, () => program.output);
  assert.ok(seen.size > 3, `${[...seen]}`);
  assert.equal(await program.exited, 0, program.output);
  await close(page, { hasLostServer: true });

  execFileSync(PROGRAM, ['replay', log, '--report', folder]);
  const report = await open(browser, `file://${join(folder, 'index.html')}`);
  assert.ok((await inspect(report)).frames >= 175);
  await close(report);
});
