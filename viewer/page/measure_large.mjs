// How soon a large scene is there, how fluid it turns, and what memory it takes, in a browser that draws with the
// processor: node measure_large.mjs [TRIANGLES]. Two scenes of so many triangles, 5 million without the argument: one
// ball, and 25 balls of different sizes. A box goes to and fro beside them: another process publishes it. Prints
//  - the seconds from the start of 'glissade view' until it serves, and those from the request of the page to the first
//    picture;
//  - the pictures per second while the camera turns: at first, while the whole model is made and loaded, and once it is
//    there;
//  - the poses of the box that are shown in a second then, without turning;
//  - the heap of the page's scripts, and the memory of the page's process and of the one that draws, at the end.

import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { eventually, inspect, launch, open, Program } from './test/harness.mjs';
import { posesShown, SECONDS, writeScene } from './large_scene.mjs';

const triangles = Number(process.argv[2] ?? 5e6);
const WATCH_S = 5;
const LCM = 'udpm://239.255.76.67:7690?ttl=0';

function seconds(start) {
  return (performance.now() - start) / 1000;
}

// Turns the camera a little before each picture, and counts them until the card has drawn the last one.
function turn(page) {
  return page.evaluate((duration) => new Promise((resolve) => {
    const { stage } = window.glissade.page;
    const start = performance.now();
    let count = 0;
    const next = () => {
      stage.eye.orbit(0.05, 0);
      stage.render();
      ++count;
      const passed = (performance.now() - start) / 1000;
      if (passed < duration) {
        requestAnimationFrame(next);
        return;
      }
      stage.waitForPicture();
      resolve(count / ((performance.now() - start) / 1000));
    };
    requestAnimationFrame(next);
  }), WATCH_S);
}

// In megabytes, after all rubbish has been collected: the scripts' heap, and what the processes of each kind hold,
// memory that they share with others in shares.
async function memoryOf(page, browser) {
  const session = await page.context().newCDPSession(page);
  await session.send('HeapProfiler.collectGarbage');
  const { usedSize } = await session.send('Runtime.getHeapUsage');
  const { processInfo } = await (await browser.newBrowserCDPSession()).send('SystemInfo.getProcessInfo');
  const held = (kind) => processInfo.filter(({ type }) => type === kind).reduce((sum, { id }) =>
    sum + Number(readFileSync(`/proc/${id}/smaps_rollup`, 'utf8').match(/^Pss: +(\d+) kB/m)[1]) / 1000, 0);
  return { heap: usedSize / 1e6, page: held('renderer'), drawing: held('GPU') };
}

async function measure(name, balls, browser, folder) {
  const scene = writeScene(folder, name, { triangles, balls });
  // The same box, beside few triangles: a server prepares them at once.
  const small = writeScene(folder, 'small', { triangles: 1000, balls: 1 });
  const publisher = new Program(['demo', '--scene', small, '--seconds', `${SECONDS}`, '--lcm', LCM]);
  const start = performance.now();
  const program = new Program(['view', scene, '--port', '0', '--lcm', LCM]);
  const url = await program.url();
  const served = seconds(start);
  const asked = performance.now();
  const page = await open(browser, url);
  await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => {
    window.glissade.page.stage.waitForPicture();
    resolve();
  })));
  const first = seconds(asked);
  const loading = await turn(page);
  await eventually(async () => (await inspect(page)).wholeTriangles > 0, () => program.output);
  const turning = await turn(page);
  const poses = await posesShown(page, WATCH_S);
  await publisher.stop();
  await eventually(async () => (await inspect(page)).showsWhole, () => program.output); // nothing moves
  const memory = await memoryOf(page, browser);
  console.log(`${name}: serves after ${served.toFixed(1)} s; first picture ${first.toFixed(1)} s after the page was asked for; ` +
    `${loading.toFixed(0)} pictures a second while turning at first, ${turning.toFixed(0)} later; ` +
    `${poses.toFixed(0)} poses a second; heap ${memory.heap.toFixed(0)} MB, process of the page ${memory.page.toFixed(0)} MB, ` +
    `process that draws ${memory.drawing.toFixed(0)} MB`);
  await page.context().close();
  await program.stop();
}

const folder = mkdtempSync(join(tmpdir(), 'glissade_measure_'));
const browser = await launch();
await measure('one_ball', 1, browser, folder);
await measure('25_balls', 25, browser, folder);
await browser.close();
rmSync(folder, { recursive: true });
