// Draws the whole page, with an object picked and near: node draw_page.mjs RECORDING OBJECT PNG=SECONDS. The page shows
// the repetition of a recording, and looks back at the moment.

import { eventually, inspect, launch, open, Program } from './test/harness.mjs';

const [recording, object, picture] = process.argv.slice(2);
const [file, seconds] = picture.split('=');

const program = new Program(['replay', recording, '--view', '0']);
const browser = await launch();
// Without a graphics card, a browser keeps up with a small picture only.
const page = await open(browser, await program.url(), { viewport: { width: 400, height: 300 }, colorScheme: 'light' });
const time = await eventually(() => page.evaluate((passed) => {
  const { timeline } = window.glissade.page;
  if (timeline.last - timeline.first < passed) return undefined;
  timeline.seek(timeline.first + passed);
  return timeline.frame.time;
}, Number(seconds)), () => program.output);
await page.setViewportSize({ width: 1280, height: 860 });
await eventually(async () => {
  await page.keyboard.press('n');
  return (await page.evaluate(() => window.glissade.page.picked.userData.name)) === object;
});
for (const key of '6f---') await page.keyboard.press(key);
await eventually(async () => {
  const { frame, isFine } = await inspect(page);
  return frame?.time === time && isFine;
});
await page.screenshot({ path: file });
await browser.close();
await program.stop();
