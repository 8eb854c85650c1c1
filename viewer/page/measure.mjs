// What ten pages that look on cost the haptic loop: node measure.mjs [RUNS]. Runs of 'glissade demo' with and without them
// take turns; prints the median duration of ticks of each run, and the ratio of the medians.

import { launch, Program } from './test/harness.mjs';

const runs = Number(process.argv[2] ?? 5);
const browser = await launch();

async function tick_us(viewers) {
  const program = new Program(['demo', '--seconds', '8', '--json', ...(viewers > 0 ? ['--view', '0'] : [])]);
  const page = await browser.newPage();
  if (viewers > 0) {
    await page.goto(`${await program.url()}nothing`); // a page of the server that draws nothing
    await page.evaluate((count) => {
      for (let i = 0; i < count; ++i) {
        const socket = new WebSocket(`ws://${location.host}/live`);
        if (i > 0) socket.onmessage = () => socket.send('shown'); // the first one does not read on
      }
    }, viewers);
  }
  await program.exited;
  await page.close();
  return JSON.parse(program.output.slice(program.output.indexOf('\n{') + 1)).tick_us_p50;
}

function median(values) {
  return values.toSorted((a, b) => a - b)[Math.floor(values.length / 2)];
}

const without = [];
const looking = [];
for (let i = 0; i < runs; ++i) {
  without.push(await tick_us(0));
  looking.push(await tick_us(10));
}
console.log(`tick p50 without viewers: ${without.join(', ')} us`);
console.log(`with ten viewers: ${looking.join(', ')} us`);
console.log(`ratio of medians: ${(median(looking) / median(without)).toFixed(3)}`);
await browser.close();
