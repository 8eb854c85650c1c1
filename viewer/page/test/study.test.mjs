// The page of a study: opened from disk, and served during the run.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { close, eventually, launch, open, PROGRAM, Program, screenshot } from './harness.mjs';

const SLIDES = 60;

let browser;
let folder;
let study;
before(async () => {
  browser = await launch();
  folder = mkdtempSync(join(tmpdir(), 'glissade_study_'));
  execFileSync(PROGRAM, ['example', folder]);
  study = join(folder, 'square_peg_study.yaml');
  const text = readFileSync(study, 'utf8').replace(/^slides:.*$/m, `slides: ${SLIDES}`);
  writeFileSync(study, text);
});
after(async () => {
  await browser.close();
  rmSync(folder, { recursive: true });
});

const isReady = async (page) => (await page.locator('#map').count()) === 1;

// The place of a slide on the map, in the window.
async function placeOf(page, slide) {
  await page.locator('#map').scrollIntoViewIfNeeded();
  const box = await page.locator('#map').boundingBox();
  const data = JSON.parse(await page.locator('#report-study').textContent());
  const { columns, data: values } = data.table;
  const share = (name) => {
    const column = values[columns.indexOf(name)];
    const [low, high] = [Math.min(...column), Math.max(...column)];
    return (column[slide] - low + 0.02 * (high - low)) / (1.04 * (high - low));
  };
  const [x, y] = [await page.locator('#map-x').inputValue(), await page.locator('#map-y').inputValue()];
  // The margins of the map: those of its labels and 14 pixels in x, 14 and 40 in y.
  const left = Number(await page.locator('#map').getAttribute('data-left'));
  return [box.x + left + share(x) * (box.width - left - 14), box.y + 14 + (1 - share(y)) * (box.height - 54)];
}

// The page that a click opens.
async function clickOn(page, slide) {
  const opened = page.context().waitForEvent('page');
  await page.mouse.click(...await placeOf(page, slide));
  const replay = await opened;
  await eventually(() => replay.evaluate(() => window.glissade?.inspect().triangles > 0));
  return replay;
}

test('the page on disk shows what the rows say', async () => {
  const output = execFileSync(PROGRAM, ['study', study, '--out', join(folder, 'results'), '--quiet'], { encoding: 'utf8' });
  const [successes, rate] = output.match(/^(\d+) of 60 slides succeed: ([\d.]+) %/).slice(1).map(Number);
  const page = await open(browser, `file://${join(folder, 'results', 'index.html')}`, { isReady });
  const said = await page.locator('.rate').textContent();
  assert.ok(said.includes(`${successes} of 60 slides`) && said.startsWith(rate.toFixed(1)), said);
  await screenshot(page, 'study');

  const parameters = await page.locator('.tornado tbody tr td:first-child').allTextContents();
  assert.deepEqual(parameters.sort(), ['path.x_m', 'path.yaw_deg', 'width']);
  const forces = (await page.locator('.worst tbody tr td:nth-child(2)').allTextContents()).map(Number);
  assert.equal(forces.length, 10);
  assert.deepEqual(forces, [...forces].sort((a, b) => b - a));
  const histogram = await page.locator('#plots section h2').allTextContents();
  assert.deepEqual(histogram, ['Greatest force on the hand']);

  // The table: sorted by a click, the other way by a second one; all rows on request.
  const column = async () => (await page.locator('#slides tbody td:nth-child(2)').allTextContents()).map(Number);
  assert.equal((await column()).length, 20);
  await page.locator('#more-rows').click();
  assert.equal((await column()).length, SLIDES);
  await page.locator('#slides th:nth-child(2) button').click();
  const ascending = await column();
  assert.deepEqual(ascending, [...ascending].sort((a, b) => a - b));
  await page.locator('#slides th:nth-child(2) button').click();
  assert.equal((await column())[0], ascending.at(-1));
  await close(page);
});

test('a click on the map opens the replay of a slide, or says how to make it', async () => {
  const page = await open(browser, `file://${join(folder, 'results', 'index.html')}`, { isReady });
  const { replays } = JSON.parse(await page.locator('#report-study').textContent());
  await page.locator('#map-y').selectOption('path.x_m');
  const replay = await clickOn(page, replays[0]);
  assert.equal(await replay.title(), `Slide ${replays[0]} of square_peg_study`);
  await replay.close();

  const unmade = Array.from({ length: SLIDES }, (_, slide) => slide).find((slide) => !replays.includes(slide));
  await page.mouse.click(...await placeOf(page, unmade));
  const note = await page.locator('#replay-note').textContent();
  assert.ok(note.includes(`slide ${unmade} `) && note.includes(`--slide ${unmade} --report`), note);
  await page.context().close(); // it has asked for another file: the replay
});

test('a served page follows the run, and has the replay of every slide', async () => {
  const program = new Program(['study', study, '--out', join(folder, 'served'), '--workers', '1', '--view', '0']);
  const page = await open(browser, await program.url(), { isReady: async (one) => (await one.locator('#study section').count()) > 0 });
  const first = await eventually(async () => /of the (\d+) slides that are done/.exec(await page.locator('#study').textContent()));
  assert.ok(Number(first[1]) < SLIDES);
  await eventually(async () => (await page.locator('#study').textContent()).includes(`of ${SLIDES} slides succeed`));
  await eventually(() => program.output.includes('page:'));
  await page.reload();
  const { replays } = JSON.parse(await page.locator('#report-study').textContent());
  assert.deepEqual(replays, [], 'a server makes each replay when one asks for it');
  const replay = await clickOn(page, 41);
  assert.equal(await replay.title(), 'Slide 41 of square_peg_study');
  await replay.close();
  const rows = await page.evaluate(async () => (await fetch('slides.csv')).text());
  assert.equal(rows.trim().split('\n').length, SLIDES + 1);
  assert.equal(await page.evaluate(async () => (await fetch('slides/60/')).status), 404);
  const url = await program.url();
  writeFileSync(join(folder, 'square_peg_script.csv'), 'no trajectory');
  const refused = await fetch(`${url}slides/7/`);
  assert.equal(refused.status, 500);
  assert.match(await refused.text(), /worker processes cannot start/);
  assert.equal((await fetch(`${url}slides/41/`)).status, 200, 'the page that has been made stays');
  await page.context().close();
  assert.equal(await program.stop(), 0);
});
