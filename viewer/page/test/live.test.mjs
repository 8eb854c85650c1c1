// The page of a running program.

import assert from 'node:assert/strict';
import { once } from 'node:events';
import { after, before, test } from 'node:test';
import { close, connect, eventually, inspect, launch, open, Program, readFrames, screenshot } from './harness.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

test('a hand closes round the part and holds it', async () => {
  const program = new Program(['demo', '--fingers', '--seconds', '30', '--view', '0']);
  const page = await open(browser, await program.url());
  const state = await eventually(async () => {
    const now = await inspect(page);
    return now.frame?.hands[0].activity === 4 && now;
  }, () => program.output);
  assert.equal(state.frame.hands[0].part, 0);
  assert.ok(state.frame.hands[0].grasp > 0);
  assert.match(await page.locator('#status').textContent(), /(precision|power|push)[^:]*: the .* touch/);
  const shown = state.segments.filter((segment) => segment.visible);
  assert.ok(shown.length >= 17, `${shown.length} segments`);
  // All near the part that they hold.
  for (const { p } of shown) assert.ok(Math.hypot(...p.map((x, i) => x - state.parts[0].p[i])) < 0.25);
  await screenshot(page, 'hand');
  await close(page);
  await program.stop();
});

test('a hidden page goes on listening', async () => {
  const program = new Program(['demo', '--seconds', '60', '--view', '0']);
  const page = await open(browser, await program.url());
  await page.evaluate(() => { window.requestAnimationFrame = () => 0; }); // a browser draws no hidden page
  const { frames } = await inspect(page);
  await eventually(async () => (await inspect(page)).frames > frames + 3);
  await close(page);
  await program.stop();
});

test('the past can be looked at while the run goes on', async () => {
  const program = new Program(['demo', '--seconds', '60', '--view', '0']);
  const page = await open(browser, await program.url());
  await eventually(async () => (await inspect(page)).frame?.sequence > 3000);
  const newest = (await inspect(page)).frame.sequence;
  await page.locator('#time').evaluate((slider) => {
    slider.value = 1;
    slider.dispatchEvent(new Event('input'));
  });
  const past = await eventually(async () => {
    const state = await inspect(page);
    return !state.isLive && state.frame.sequence < newest - 1000 && state;
  });
  const frames = past.frames;
  await eventually(async () => (await inspect(page)).frames > frames + 2); // it goes on listening
  assert.equal((await inspect(page)).frame.sequence, past.frame.sequence);
  await page.keyboard.press('.');
  await eventually(async () => (await inspect(page)).frame.sequence > past.frame.sequence);
  await page.locator('#live').click();
  await eventually(async () => (await inspect(page)).frame.sequence > newest);
  await page.reload();
  await eventually(async () => (await inspect(page))?.frame?.sequence > newest);
  await close(page);
  await program.stop();
});

test('a server that starts again is found again', async () => {
  const first = new Program(['demo', '--seconds', '20', '--view', '0']);
  const url = await first.url();
  const page = await open(browser, url);
  await eventually(async () => (await inspect(page)).frame?.sequence > 500);
  await page.keyboard.press(' '); // looks at the past
  await eventually(async () => !(await inspect(page)).isLive);
  await first.stop();
  await eventually(async () => !(await inspect(page)).isConnected);
  assert.equal(await page.locator('#state').textContent(), 'ended: waits for the next run');
  assert.equal(await page.locator('body.lost').count(), 0); // the end is no failure
  const second = new Program(['demo', '--seconds', '20', '--view', new URL(url).port]);
  await eventually(async () => {
    const state = await inspect(page);
    return state.isConnected && state.isLive && state.frames > 1 && state.frame.sequence < 2000;
  }, () => second.output);
  const { frame } = await inspect(page);
  await eventually(async () => (await inspect(page)).frame.sequence > frame.sequence);
  await close(page, { hasLostServer: true }); // that was the first one
  await second.stop();
});

test('a server that fails is told from one that has ended', async () => {
  const program = new Program(['demo', '--seconds', '60', '--view', '0']);
  const page = await open(browser, await program.url());
  await eventually(async () => (await inspect(page)).frame);
  program.child.kill('SIGKILL');
  await eventually(async () => !(await inspect(page)).isConnected);
  assert.match(await page.locator('#state').textContent(), /no connection/);
  assert.equal(await page.locator('body.lost').count(), 1);
  await close(page, { hasLostServer: true });
});

test('nothing is asked of any other machine, and other sites are refused', async () => {
  const program = new Program(['demo', '--seconds', '60', '--view', '0']);
  const url = await program.url();
  const page = await open(browser, url);
  await eventually(async () => (await inspect(page)).frame);
  assert.ok(page.requests.includes(`${url.replace('http', 'ws')}live`), `${page.requests}`); // `close` checks all of them
  const answer = await fetch(url, { headers: { Origin: 'http://elsewhere.example' } });
  assert.equal(answer.status, 403);
  assert.match((await fetch(url)).headers.get('content-security-policy'), /default-src 'none'/);
  await close(page);
  await program.stop();
});

test('ten pages look on, of which one does not read', async () => {
  const program = new Program(['demo', '--seconds', '8', '--view', '0', '--json']);
  const url = await program.url();
  const page = await open(browser, url);
  const deaf = await connect(url);
  await page.evaluate(() => {
    window.count = Array.from({ length: 9 }, () => 0);
    window.count.forEach((_, i) => {
      const socket = new WebSocket(`ws://${location.host}/live`);
      socket.onmessage = () => {
        ++window.count[i];
        socket.send('shown');
      };
    });
  });
  assert.equal(await program.exited, 0, program.output);
  const count = await page.evaluate(() => window.count);
  await close(page, { hasLostServer: true });
  for (const frames of count) assert.ok(frames > 10, `${count}`); // few on a busy machine, but not held up by the deaf one
  let unread = 0;
  readFrames(deaf, () => { ++unread; });
  await once(deaf, 'close');
  assert.equal(unread, 1, 'frames that the server sent to the connection that never reads');
});
