// What ten viewers cost the haptic loop: node measure.mjs [RUNS]. Runs of 'glissade demo' without a server of pages, with
// one at which nobody looks, and with ten viewers take turns. Prints of each run the median duration of ticks and how many
// processors were busy meanwhile; how much time of a processor the server's thread took, and how often it woke up; and the
// ratios of the medians. On a machine that is busy with other programs, the ticks of all runs are slow, and the ratios
// say little.
//
// The viewers do what a page does with the network and nothing else, because a browser that draws takes far more
// processor time than the server. One of them never reads.

import { readdirSync, readFileSync } from 'node:fs';
import os from 'node:os';
import { setTimeout as wait } from 'node:timers/promises';
import { connect, Program, readFrames } from './test/harness.mjs';

const runs = Number(process.argv[2] ?? 5);
const SHOWN = Buffer.from([0x81, 0x81, 0, 0, 0, 0, 's'.charCodeAt(0)]); // a message of one masked letter

function busyMs() {
  return os.cpus().reduce((sum, { times }) => sum + times.user + times.nice + times.sys + times.irq, 0);
}

// What the server's thread has done so far.
function workOfServer(pid) {
  const folder = `/proc/${pid}/task`;
  const thread = readdirSync(folder).find((id) => readFileSync(`${folder}/${id}/comm`, 'utf8') === 'viewer\n');
  const [ns, , wakeUps] = readFileSync(`${folder}/${thread}/schedstat`, 'utf8').split(' ').map(Number);
  return { ms: ns / 1e6, wakeUps };
}

// The same of a second, after the start.
async function workInASecond(pid) {
  const seconds = 4;
  await wait(2000);
  const before = workOfServer(pid);
  await wait(1000 * seconds);
  const after = workOfServer(pid);
  return `, server ${((after.ms - before.ms) / seconds).toFixed(1)} ms/s, ` +
    `${Math.round((after.wakeUps - before.wakeUps) / seconds)} wake-ups/s`;
}

async function measured(hasServer, viewers) {
  const start = { time: performance.now(), busy: busyMs() };
  const program = new Program(['demo', '--seconds', '8', '--json', ...(hasServer ? ['--view', '0'] : [])]);
  if (hasServer) {
    const url = await program.url();
    const first = await connect(url); // the demonstration begins with it
    if (viewers === 0) first.destroy();
    for (let i = 1; i < viewers; ++i) {
      const socket = await connect(url);
      readFrames(socket, () => socket.write(SHOWN));
    }
  }
  const work = hasServer ? await workInASecond(program.child.pid) : '';
  await program.exited;
  const busy = (busyMs() - start.busy) / (performance.now() - start.time);
  return { busy, work, tick_us: JSON.parse(program.output.slice(program.output.indexOf('\n{') + 1)).tick_us_p50 };
}

function median(results) {
  return results.map(({ tick_us }) => tick_us).toSorted((a, b) => a - b)[Math.floor(results.length / 2)];
}

const without = [];
const alone = [];
const looking = [];
for (let i = 0; i < runs; ++i) {
  without.push(await measured(false, 0));
  alone.push(await measured(true, 0));
  looking.push(await measured(true, 10));
}
const rows = [['without a server', without], ['with one, without viewers', alone], ['with ten viewers', looking]];
for (const [name, results] of rows) {
  console.log(`tick p50 ${name}:`);
  for (const { tick_us, busy, work } of results) console.log(`  ${tick_us.toFixed(1)} us (${busy.toFixed(1)} busy${work})`);
}
console.log(`ten viewers to none: ${(median(looking) / median(alone)).toFixed(3)}`);
console.log(`ten viewers to no server: ${(median(looking) / median(without)).toFixed(3)}`);
