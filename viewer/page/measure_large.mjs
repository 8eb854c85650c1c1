// How soon a large scene is there, and how fluid it turns, in a browser that draws with the processor:
// node measure_large.mjs [TRIANGLES]. Two scenes of so many triangles, 5 million without the argument: one ball, and 25
// balls of different sizes. Prints the seconds from the start of 'glissade view' until it serves and those from the request
// of the page to the first picture, and the pictures per second while the camera turns: at first, while the whole model is
// made and loaded, and once it is there.

import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { eventually, inspect, launch, open, Program } from './test/harness.mjs';

const triangles = Number(process.argv[2] ?? 5e6);
const TURN_S = 5;

function sceneOf(balls) {
  const lines = ['objects:', '  - {name: box, movable: true, shape: {type: box, size_x_m: 0.05}, pose: {position_m: [0.12, 0, 0]}}'];
  for (let i = 0; i < balls; ++i) {
    const position = [0.2 * (i % 5), 0.2 * Math.floor(i / 5), -0.3];
    lines.push(`  - {name: ball_${i}, shape: {type: sphere, radius_m: ${0.05 + 1e-3 * i}, ` +
      `triangles: ${Math.round(triangles / balls)}}, pose: {position_m: [${position}]}}`);
  }
  return `${lines.join('\n')}\n`;
}

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
  }), TURN_S);
}

async function measure(name, balls, browser, folder) {
  const scene = join(folder, `${name}.yaml`);
  writeFileSync(scene, sceneOf(balls));
  const start = performance.now();
  const program = new Program(['view', scene, '--port', '0']);
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
  await eventually(async () => (await inspect(page)).showsWhole, () => program.output);
  const turning = await turn(page);
  console.log(`${name}: serves after ${served.toFixed(1)} s; first picture ${first.toFixed(1)} s after the page was asked for; ` +
    `${loading.toFixed(0)} pictures a second while turning at first, ${turning.toFixed(0)} later`);
  await page.context().close();
  await program.stop();
}

const folder = mkdtempSync(join(tmpdir(), 'glissade_measure_'));
const browser = await launch();
await measure('one ball', 1, browser, folder);
await measure('25 balls', 25, browser, folder);
await browser.close();
rmSync(folder, { recursive: true });
