// What stands where on the page, and in which colour: as the recording of the run has it, and as the legend says.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { close, eventually, inspect, isNear, launch, open, Program, PROGRAM, rowsOf, screenshot } from './harness.mjs';

let browser;
let folder;
before(async () => {
  browser = await launch();
  folder = mkdtempSync(join(tmpdir(), 'glissade_poses_'));
});
after(async () => {
  await browser.close();
  rmSync(folder, { recursive: true });
});

// The arrows of the hand show the force and torque of the recording, to scale. The arrow of a single contact shows where
// to it pushes the part: so does the force.
function checkArrows(states, rows) {
  const hands = new Map(rows.map((row) => [Number(row.tick), row]));
  let contactsSeen = 0;
  let torques = 0;
  for (const { frame, forces, contacts, metresPerNewton, metresPerNewtonMetre } of states) {
    const row = hands.get(frame.sequence);
    const of = (names) => names.split(' ').map((name) => Number(row[name]));
    const scaled = (vector, scale) => vector.map((x) => x * scale);
    if (!forces[0].force) {
      assert.ok(Math.hypot(...of('fx_N fy_N fz_N')) < 1.1e-3, `tick ${frame.sequence}: a force without an arrow`);
      continue;
    }
    assert.ok(isNear(forces[0].force, scaled(of('fx_N fy_N fz_N'), metresPerNewton), 1e-4), `tick ${frame.sequence}`);
    if (forces[0].torque) {
      ++torques;
      assert.ok(isNear(forces[0].torque, scaled(of('tx_Nm ty_Nm tz_Nm'), metresPerNewtonMetre), 1e-4));
    }
    const force = forces[0].force;
    contactsSeen += contacts.length;
    for (const { n } of contacts) assert.ok(Math.abs(Math.hypot(...n) - 1) < 1e-6);
    const pushes = contacts.map(({ n }) => n.reduce((sum, x, i) => sum + x * force[i], 0));
    if (contacts.length === 1) assert.ok(pushes[0] > 0, `tick ${frame.sequence}: the contact pushes the hand away`);
  }
  assert.ok(contactsSeen > 0 && torques > 0, `${contactsSeen} contacts, ${torques} torques`);
}

test('a part stands where the recording of the run says', async () => {
  const log = join(folder, 'demo.lcmlog');
  const program = new Program(['demo', '--seconds', '20', '--view', '0', '--record', log]);
  const page = await open(browser, await program.url(), { viewport: { width: 160, height: 90 } }); // many pictures a second
  const seen = [];
  await eventually(async () => {
    const state = await inspect(page);
    if (state.frame) seen.push({ ...state, part: state.parts[0], ghost: state.ghosts[0] });
    return (await Promise.race([program.exited, Promise.resolve('runs')])) !== 'runs';
  }, () => program.output);
  assert.equal(await program.exited, 0, program.output);

  execFileSync(PROGRAM, ['log', 'to-csv', log, folder]);
  const rows = new Map(rowsOf(join(folder, 'parts.csv')).map((row) => [Number(row.tick), row]));
  const shown = [...new Map(seen.map((state) => [state.frame.sequence, state])).values()];
  assert.ok(shown.length > 4, `${shown.length} different moments were seen`);
  let moved = 0;
  for (const { frame, part, ghost, info } of shown) {
    const row = rows.get(frame.sequence);
    const of = (names) => names.split(' ').map((name) => Number(row[name]));
    const origin = info.origin_W_m;
    const world = (p) => p.map((x, i) => x + origin[i]);
    assert.ok(isNear(world(part.p), of('vx_m vy_m vz_m')), `tick ${frame.sequence}: ${part.p}`);
    assert.ok(isNear(part.q, of('vqx vqy vqz vqw'), 1e-3), `tick ${frame.sequence}: ${part.q}`);
    if (ghost.visible) assert.ok(isNear(world(ghost.p), of('gx_m gy_m gz_m')));
    moved = Math.max(moved, Math.hypot(...part.p.map((x, i) => x - shown[0].part.p[i])));
  }
  assert.ok(moved > 0.1, `the part moves by ${moved} m`);
  const touching = shown.filter(({ frame }) => frame.parts[0].contacts > 0 && frame.hands[0].peak > 0.5);
  assert.ok(touching.length > 0);
  checkArrows(touching, rowsOf(join(folder, 'hands.csv')));
  const patched = touching.filter(({ frame }) => frame.patches.length > 0);
  assert.ok(patched.length > 0, 'patches');
  for (const { frame, patches } of patched) {
    assert.equal(patches.length, frame.patches.length);
    assert.equal(frame.patches.reduce((sum, patch) => sum + patch.contacts, 0), frame.parts[0].contacts);
  }
  await screenshot(page, 'demo');
  await close(page, { hasLostServer: true });
});

// Where the vertices of all objects and segments are at the moment that is shown, in world axes, by the names of an export.
function look(page) {
  return page.evaluate(() => {
    const { stage, info } = window.glissade.page;
    const point = stage.camera.position.clone();
    const vertices = {};
    for (const node of stage.whole.group.children) {
      if (!node.visible) continue;
      const { kind, name, hand } = node.userData;
      const points = vertices[kind === 'segment' ? `hand_${hand}_${name}` : name.replaceAll(' ', '_')] = [];
      node.updateWorldMatrix(true, true);
      node.traverse((child) => {
        const { position } = child.isMesh ? child.geometry.attributes : {};
        for (let i = 0; i < (position?.count ?? 0); ++i) {
          const at = point.fromBufferAttribute(position, i).applyMatrix4(child.matrixWorld).toArray();
          points.push(at.map((x, axis) => x + info.origin_W_m[axis]));
        }
      });
    }
    return { tick: stage.frame.sequence, activity: stage.frame.hands[0].activity, vertices };
  });
}

// The groups of an OBJ file.
function verticesOf(obj) {
  const groups = {};
  let points;
  for (const [kind, ...words] of readFileSync(obj, 'utf8').split('\n').map((line) => line.split(' '))) {
    if (kind === 'g') groups[words[0]] = points = [];
    if (kind === 'v') points.push(words.map(Number));
  }
  return groups;
}

function boxOf(points) {
  return [Math.min, Math.max].flatMap((choose) => [0, 1, 2].map(
    (axis) => points.reduce((best, point) => choose(best, point[axis]), points[0][axis])));
}

test('fixed objects and the segments of a hand stand where an export of the recording has them', async () => {
  const log = join(folder, 'hand.lcmlog');
  const program = new Program(['demo', '--fingers', '--seconds', '40', '--view', '0', '--record', log]);
  const page = await open(browser, await program.url());
  await eventually(async () => (await inspect(page)).wholeTriangles > 0, () => program.output);
  const [FREE, HOLDING] = [3, 4];
  const moments = new Map(); // by activity
  await eventually(async () => {
    const { frame } = await inspect(page);
    if (frame && !moments.has(frame.hands[0].activity)) {
      const moment = await look(page);
      moments.set(moment.activity, moment);
    }
    return moments.has(FREE) && moments.has(HOLDING);
  }, () => program.output);
  await close(page);
  await program.stop();

  execFileSync(PROGRAM, ['log', 'to-csv', log, folder]);
  const rows = rowsOf(join(folder, 'ticks.csv'));
  const obj = join(folder, 'moment.obj');
  for (const { tick, vertices } of [moments.get(FREE), moments.get(HOLDING)]) {
    const time = Number(rows.find((row) => Number(row.tick) === tick).t_s) - Number(rows[0].t_s);
    execFileSync(PROGRAM, ['export', '--log', log, '--at', `${time + 1e-4}`, '--out', obj]);
    const exported = verticesOf(obj);
    assert.deepEqual(Object.keys(vertices).sort(), Object.keys(exported).sort());
    for (const [name, points] of Object.entries(vertices)) {
      const [shown, expected] = [boxOf(points), boxOf(exported[name])];
      assert.ok(isNear(shown, expected), `tick ${tick}, ${name}: ${shown} instead of ${expected}`);
      if (!name.startsWith('hand_')) continue;
      const isThere = (point) => exported[name].some((other) => isNear(point, other));
      assert.ok(points.every(isThere), `tick ${tick}: a corner of ${name} is elsewhere`);
    }
  }
  const [free, holding] = [FREE, HOLDING].map((activity) => boxOf(moments.get(activity).vertices.hand_0_index_distal));
  assert.ok(!isNear(free, holding, 0.02), 'the hand moves');
});

test('colours tell what is held, loose, fixed and moves on its own, as the legend has them', async () => {
  const write = (name, text) => {
    writeFileSync(join(folder, name), text);
    return join(folder, name);
  };
  write('still.csv', 't_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,0,0,0,1,0,0,0\n1,0,0,0,1,0,0,0\n');
  write('away.csv', 't_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,0.6,0,0,1,0,0,0\n1,0.7,0,0,1,0,0,0\n');
  const box = 'shape: {type: box, size_x_m: 0.05}';
  const scene = write('kinds.yaml', 'script: still.csv\nobjects:\n' +
    `  - {name: held, movable: true, ${box}}\n  - {name: loose, movable: true, ${box}, pose: {position_m: [0.2, 0, 0]}}\n` +
    `  - {name: fixed, ${box}, pose: {position_m: [0.4, 0, 0]}}\n  - {name: moving, moves: away.csv, ${box}}\n`);
  const program = new Program(['demo', '--scene', scene, '--seconds', '60', '--view', '0']);
  const url = await program.url();
  const seen = new Set();
  for (const colorScheme of ['light', 'dark']) {
    const page = await open(browser, url, { colorScheme });
    await eventually(async () => (await inspect(page)).frame?.hands[0].part === 0, () => program.output);
    const [shown, legend] = await page.evaluate(() => {
      const numbers = (color) => color.match(/\d+/g).map(Number);
      const nodes = window.glissade.page.stage.coarse.objects;
      const colors = nodes.map((node) => {
        let found;
        node.traverse((child) => { if (child.isMesh) found = numbers(child.material.color.getStyle()); });
        return [node.userData.name, found];
      });
      const dot = (name) => numbers(getComputedStyle(document.querySelector(`#legend .${name}`), '::before').backgroundColor);
      return [Object.fromEntries(colors), Object.fromEntries(nodes.map(({ userData: { name } }) => [name, dot(name)]))];
    });
    assert.deepEqual(Object.keys(shown).sort(), ['fixed', 'held', 'loose', 'moving']);
    assert.deepEqual(shown, legend, colorScheme);
    for (const color of Object.values(shown)) seen.add(`${color}`);
    await close(page);
  }
  await program.stop();
  assert.equal(seen.size, 8, `${[...seen]}`);
});
