// Draws pictures of a report: node draw.mjs REPORT.html PNG=SECONDS GIF, of which either may be '-'.

import { writeFile } from 'node:fs/promises';
import { resolve } from 'node:path';
import gifenc from 'gifenc';
import { eventually, inspect, launch, open } from './test/harness.mjs';

const { GIFEncoder, applyPalette, quantize } = gifenc;
const [report, png, gif] = process.argv.slice(2);
const FRAME_MS = 100;

const browser = await launch();

async function openReport(width, height, zoom) {
  const page = await open(browser, `file://${resolve(report)}`, { viewport: { width: 1280, height: 900 }, colorScheme: 'light' });
  await page.evaluate(([w, h]) => {
    const view = document.getElementById('view');
    view.style.cssText = `position: fixed; inset: 0 auto auto 0; width: ${w}px; height: ${h}px; z-index: 1; border: 0; border-radius: 0`;
    for (const id of ['legend', 'scale', 'object']) document.getElementById(id).style.display = 'none';
    document.getElementById('show-through').click();
  }, [width, height]);
  await page.waitForTimeout(300);
  // The middle of the part's way is the middle of the picture.
  await page.evaluate((factor) => {
    const { stage, timeline } = window.glissade.page;
    stage.fit('corner');
    const [first, last] = [timeline.frames[0], timeline.frames.at(-1)].map((frame) => frame.parts[0].visible.p);
    const move = stage.controls.target.clone().fromArray(first.map((x, i) => (x + last[i]) / 2)).sub(stage.controls.target);
    stage.controls.target.add(move);
    stage.camera.position.add(move);
    stage.zoom(factor);
  }, zoom);
  return page;
}

async function goTo(page, seconds) {
  await page.evaluate((t) => {
    const { timeline } = window.glissade.page;
    timeline.seek(timeline.first + t);
  }, seconds);
  const chosen = await page.evaluate(() => window.glissade.page.timeline.frame.sequence);
  await eventually(async () => (await inspect(page)).frame?.sequence === chosen);
  await page.waitForTimeout(60);
}

if (png !== '-') {
  const [file, seconds] = png.split('=');
  const page = await openReport(1000, 560, 0.75);
  await goTo(page, Number(seconds));
  await page.locator('#view').screenshot({ path: file });
}

if (gif !== '-') {
  const [width, height] = [480, 300];
  const page = await openReport(width, height, 0.6);
  const duration = await page.evaluate(() => window.glissade.page.timeline.last - window.glissade.page.timeline.first);
  const encoder = GIFEncoder();
  let palette;
  for (let t = 0; t <= duration; t += (2 * FRAME_MS) / 1000) {
    await goTo(page, t);
    const pixels = await page.evaluate(([w, h]) => {
      const copy = new OffscreenCanvas(w, h).getContext('2d');
      copy.drawImage(document.getElementById('canvas'), 0, 0, w, h);
      return [...copy.getImageData(0, 0, w, h).data];
    }, [width, height]);
    const data = Uint8ClampedArray.from(pixels);
    palette ??= quantize(data, 64);
    encoder.writeFrame(applyPalette(data, palette), width, height, { palette, delay: FRAME_MS });
  }
  encoder.finish();
  await writeFile(gif, encoder.bytes());
}

await browser.close();
