// What ten pages that look on cost the haptic loop: node measure.mjs [RUNS]. Runs of 'glissade demo' without a server of
// pages, with one at which nobody looks, and with ten pages take turns. Prints the median duration of ticks of each run,
// and the ratios of the medians.

import { launch, Program } from './test/harness.mjs';

const runs = Number(process.argv[2] ?? 5);
const browser = await launch();

async function tick_us(has_server, viewers) {
  const program = new Program(['demo', '--seconds', '8', '--json', ...(has_server ? ['--view', '0'] : [])]);
  const page = await browser.newPage();
  if (has_server) {
    await page.goto(`${await program.url()}nothing`); // a page of the server that draws nothing
    await page.evaluate((count) => {
      const first = new WebSocket(`ws://${location.host}/live`); // the demonstration begins with it; it does not read on
      if (count === 0) first.onmessage = () => first.close();
      for (let i = 1; i < count; ++i) {
        const socket = new WebSocket(`ws://${location.host}/live`);
        socket.onmessage = () => socket.send('shown');
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
const alone = [];
const looking = [];
for (let i = 0; i < runs; ++i) {
  without.push(await tick_us(false, 0));
  alone.push(await tick_us(true, 0));
  looking.push(await tick_us(true, 10));
}
console.log(`tick p50 without a server: ${without.join(', ')} us`);
console.log(`with one, without viewers: ${alone.join(', ')} us`);
console.log(`with ten viewers: ${looking.join(', ')} us`);
console.log(`ten viewers to none: ${(median(looking) / median(alone)).toFixed(3)}`);
console.log(`ten viewers to no server: ${(median(looking) / median(without)).toFixed(3)}`);
await browser.close();
