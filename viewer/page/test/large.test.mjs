// A scene of many triangles: a coarse model first, then all of it, and the coarse one again while the camera moves.

import assert from 'node:assert/strict';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { close, eventually, inspect, launch, open, Program, screenshot } from './harness.mjs';

let browser;
let folder;
before(async () => {
  browser = await launch();
  folder = mkdtempSync(join(tmpdir(), 'glissade_large_'));
});
after(async () => {
  await browser.close();
  rmSync(folder, { recursive: true });
});

test('a large scene is coarse while the camera moves, and whole and smooth at rest', async () => {
  const scene = join(folder, 'large.yaml');
  writeFileSync(join(folder, 'still.csv'), 't_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,0.12,0,0,1,0,0,0\n1,0.12,0,0,1,0,0,0\n');
  writeFileSync(scene, 'script: still.csv\nobjects:\n' +
    '  - {name: box, movable: true, shape: {type: box, size_x_m: 0.05}, pose: {position_m: [0.12, 0, 0]}}\n' +
    '  - {name: ball, shape: {type: sphere, triangles: 300000}}\n');
  const program = new Program(['demo', '--scene', scene, '--seconds', '120', '--view', '0']);
  const page = await open(browser, await program.url());
  const first = await inspect(page);
  assert.ok(first.triangles > 6000 && first.triangles < 16000, `${first.triangles}`);
  const whole = await eventually(async () => {
    const state = await inspect(page);
    return state.showsWhole && state;
  }, () => program.output);
  assert.equal(whole.wholeTriangles, whole.info.triangles);
  assert.ok(whole.wholeTriangles > 290000, `${whole.wholeTriangles}`);
  await screenshot(page, 'large');

  // The graphics card of this machine may be quick or not: as if it had taken a second for each picture.
  await page.evaluate(() => { window.glissade.page.stage.detail.durations = [1000, 1000, 1000]; });
  const [atRest, turning] = await eventually(() => page.evaluate(() => {
    const { stage } = window.glissade.page;
    const look = () => ({ ...window.glissade.inspect(), width: stage.canvas.width });
    const before = look();
    if (!before.showsWhole || !before.isFine) return undefined; // not at rest yet
    stage.eye.orbit(0.1, 0);
    stage.render();
    return [before, look()];
  }));
  assert.deepEqual([turning.showsWhole, turning.isFine], [false, false]);
  assert.equal(turning.width, atRest.width / 2);
  await eventually(async () => {
    const state = await inspect(page);
    return state.showsWhole && state.isFine && state.frame.sequence > turning.frame.sequence;
  });
  await close(page);
  await program.stop();
});
