// Draws pictures of a report: node draw.mjs REPORT.html PNG=SECONDS GIF, of which either may be '-'.

import { writeFile } from 'node:fs/promises';
import { resolve } from 'node:path';
import gifenc from 'gifenc';
import { eventually, inspect, launch, open } from './test/harness.mjs';

const { GIFEncoder, applyPalette, quantize } = gifenc;
const [report, png, gif] = process.argv.slice(2);
const FRAME_MS = 100;

const browser = await launch();

async function openReport({ width, height, view, zoom, seesThrough }) {
  const page = await open(browser, `file://${resolve(report)}`, { viewport: { width: 1280, height: 900 }, colorScheme: 'light' });
  await page.evaluate(([w, h, through]) => {
    const view = document.getElementById('view');
    view.style.cssText = `position: fixed; inset: 0 auto auto 0; width: ${w}px; height: ${h}px; z-index: 1; border: 0; border-radius: 0`;
    for (const id of ['legend', 'scale', 'object']) document.getElementById(id).style.display = 'none';
    if (through) document.getElementById('show-through').click();
  }, [width, height, seesThrough]);
  await page.waitForTimeout(300);
  // The middle of the part's way is the middle of the picture.
  await page.evaluate(([direction, factor]) => {
    const { stage, timeline } = window.glissade.page;
    stage.camera.position.copy(stage.eye.controls.target).add(stage.camera.position.clone().fromArray(direction));
    stage.fit();
    const [first, last] = [timeline.frames[0], timeline.frames.at(-1)].map((frame) => frame.parts[0].visible.p);
    const move = stage.eye.controls.target.clone().fromArray(first.map((x, i) => (x + last[i]) / 2)).sub(stage.eye.controls.target);
    stage.eye.controls.target.add(move);
    stage.camera.position.add(move);
    stage.eye.zoom(factor);
  }, [view, zoom]);
  return page;
}

async function goTo(page, seconds) {
  await page.evaluate((t) => {
    const { timeline } = window.glissade.page;
    timeline.seek(timeline.first + t);
  }, seconds);
  const chosen = await page.evaluate(() => window.glissade.page.timeline.frame.sequence);
  await eventually(async () => {
    const { frame, isFine } = await inspect(page);
    return frame?.sequence === chosen && isFine;
  });
}

if (png !== '-') {
  const [file, seconds] = png.split('=');
  const page = await openReport({ width: 1000, height: 560, view: [-0.6, 1, 0.4], zoom: 0.74, seesThrough: true });
  await goTo(page, Number(seconds));
  await page.locator('#view').screenshot({ path: file });
}

if (gif !== '-') {
  const [width, height] = [480, 300];
  const page = await openReport({ width, height, view: [0.5, -1, 0.7], zoom: 0.55, seesThrough: false });
  const duration = await page.evaluate(() => window.glissade.page.timeline.last - window.glissade.page.timeline.first);
  const frames = [];
  for (let t = 0; t <= duration; t += (2 * FRAME_MS) / 1000) {
    await goTo(page, t);
    const pixels = await page.evaluate(([w, h]) => {
      const copy = new OffscreenCanvas(w, h).getContext('2d');
      copy.imageSmoothingQuality = 'high';
      copy.drawImage(document.getElementById('canvas'), 0, 0, w, h);
      return [...copy.getImageData(0, 0, w, h).data];
    }, [width, height]);
    frames.push(Uint8ClampedArray.from(pixels));
  }
  // A colour that only comes later, as that of a held part does, belongs to the palette as well.
  const some = frames.filter((_, i) => i % 6 === 0);
  const palette = quantize(Uint8Array.from(some.flatMap((frame) => [...frame])), 128);
  const encoder = GIFEncoder();
  for (const data of frames) encoder.writeFrame(applyPalette(data, palette), width, height, { palette, delay: FRAME_MS });
  encoder.finish();
  await writeFile(gif, encoder.bytes());
}

await browser.close();
