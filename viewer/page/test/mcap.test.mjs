// What `glissade log to-mcap` writes, read by the reader of others: @mcap/core.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { McapIndexedReader, McapStreamReader } from '@mcap/core';
import { PROGRAM, isNear, rowsOf } from './harness.mjs';

const palette = readFileSync(new URL('../src/palette.css', import.meta.url), 'utf8'); // light screens first

let folder;
let door;
let hand;
before(() => {
  folder = mkdtempSync(join(tmpdir(), 'glissade_mcap_'));
  door = recorded('door', '--seconds', '2');
  hand = recorded('hand', '--seconds', '6', '--fingers');
});
after(() => rmSync(folder, { recursive: true }));

// Records a demonstration; returns its log as MCAP and as tables.
function recorded(name, ...options) {
  const path = (ending) => join(folder, name + ending);
  execFileSync(PROGRAM, ['demo', '--offline', '--record', path('.lcmlog'), ...options]);
  execFileSync(PROGRAM, ['log', 'to-mcap', path('.lcmlog'), path('.mcap')]);
  execFileSync(PROGRAM, ['log', 'to-csv', path('.lcmlog'), path('')]);
  const table = (file) => rowsOf(join(path(''), file));
  return { log: path('.lcmlog'), bytes: readFileSync(path('.mcap')), ticks: table('ticks.csv'), parts: table('parts.csv'), hands: table('hands.csv') };
}

function indexed(bytes) {
  const readable = {
    size: async () => BigInt(bytes.length),
    read: async (offset, length) => new Uint8Array(bytes.subarray(Number(offset), Number(offset + length))),
  };
  return McapIndexedReader.Initialize({ readable });
}

async function messages(reader, filter) {
  const all = [];
  for await (const message of reader.readMessages({ validateCrcs: true, ...filter }))
    all.push({ topic: reader.channelsById.get(message.channelId).topic, time: Number(message.logTime), json: JSON.parse(Buffer.from(message.data)) });
  return all;
}

// Every value has the type of its schema, and a property there.
function assertFits(value, schema, where) {
  if (schema.type === 'array') {
    assert.ok(Array.isArray(value), where);
    for (const item of value.slice(0, 10)) assertFits(item, schema.items, `${where}[]`);
  } else if (schema.type === 'object') {
    for (const [key, inner] of Object.entries(value)) {
      assert.ok(schema.properties[key], `${where}.${key} is not in the schema`);
      assertFits(inner, schema.properties[key], `${where}.${key}`);
    }
  } else if (schema.type === 'integer') {
    assert.ok(Number.isInteger(value), where);
  } else {
    assert.equal(typeof value, schema.type, where);
  }
}

const vector = (row, names) => names.split(' ').map((name) => Number(row[name]));
const xyz = ({ x, y, z }) => [x, y, z];
const wxyz = ({ x, y, z, w }) => [w, x, y, z];

test('every tick has the poses and forces of the tables', async () => {
  const reader = await indexed(door.bytes);
  const all = await messages(reader);
  const of = (topic) => all.filter((message) => message.topic === topic);
  for (const topic of ['/tf', '/loop', '/part_0', '/hand_0']) assert.equal(of(topic).length, 2000, topic);
  assert.equal(all.length, Number(reader.statistics.messageCount));
  assert.ok(reader.statistics.chunkCount > 3);

  const [transforms, parts, hands, loop] = ['/tf', '/part_0', '/hand_0', '/loop'].map(of);
  for (const [i, row] of door.parts.entries()) {
    const [tf, part] = [transforms[i], parts[i]];
    assert.ok(Math.abs(tf.time - 1e9 * row.t_s) < 1, `${tf.time} ns`);
    const pose = (name) => tf.json.transforms.find((transform) => transform.child_frame_id === name);
    assert.equal(pose('part_0').parent_frame_id, 'world');
    assert.deepEqual(xyz(pose('part_0').translation), vector(row, 'vx_m vy_m vz_m'));
    assert.deepEqual(wxyz(pose('part_0').rotation), vector(row, 'vqw vqx vqy vqz'));
    assert.deepEqual(xyz(pose('ghost_0').translation), vector(row, 'gx_m gy_m gz_m'));
    assert.deepEqual(wxyz(pose('ghost_0').rotation), vector(row, 'gqw gqx gqy gqz'));
    assert.equal(1e9 * pose('part_0').timestamp.sec + pose('part_0').timestamp.nsec, tf.time);
    const lag = Math.hypot(...vector(row, 'vx_m vy_m vz_m').map((v, a) => v - vector(row, 'gx_m gy_m gz_m')[a]));
    assert.ok(Math.abs(part.json.lag_m - lag) < 1e-12);
    assert.equal(part.json.state, row.state);
    assert.equal(part.json.contacts, Number(row.contacts));
    assert.equal(part.json.age_s, Number(row.contact_set_age_s));
  }
  for (const [i, row] of door.hands.entries()) {
    const { json } = hands[i];
    assert.deepEqual(xyz(json.force_N), vector(row, 'fx_N fy_N fz_N'));
    assert.deepEqual(xyz(json.torque_Nm), vector(row, 'tx_Nm ty_Nm tz_Nm'));
    assert.equal(json.energy_J, Number(row.energy_J));
    assert.equal(json.reason, row.reason);
  }
  assert.ok(hands.some(({ json }) => Math.hypot(...xyz(json.force_N)) > 0.5), 'the hand feels something');
  for (const [i, row] of door.ticks.entries()) {
    assert.equal(loop[i].json.tick, Number(row.tick));
    assert.ok(Math.abs(loop[i].json.lateness_s - 1e-6 * row.lateness_us) < 1e-12);
  }
});

test('the scene has the meshes where an export has them', async () => {
  const boxes = boxesOf(exported(door, 0));
  const all = await messages(await indexed(door.bytes), { topics: ['/scene', '/tf'] });
  const scenes = all.filter(({ topic }) => topic === '/scene');
  assert.equal(scenes.length, 1);
  const entities = scenes[0].json.entities.filter((entity) => kindOf(entity) !== 'ghost');
  assert.equal(entities.length, boxes.size);
  const start = all.find(({ topic }) => topic === '/tf').json.transforms;
  let triangles = 0;
  for (const entity of entities) {
    const [list] = entity.triangles;
    triangles += list.indices.length / 3;
    assert.ok(list.indices.every((index) => index < list.points.length));
    assertSameBox(boxOf(shownPoints(entity, start)), boxes.get(entity.id), entity.id);
  }
  assert.ok(triangles > 50_000 && triangles < 105_000, `${triangles} triangles`);
  assert.deepEqual(entities.filter((entity) => entity.frame_id !== 'world').map(({ id }) => id), ['window_motor']);
});

test('each part that hands can hold has a translucent ghost, and each object its name', async () => {
  const all = await messages(await indexed(door.bytes), { topics: ['/scene', '/tf'] });
  const { entities } = all.find(({ topic }) => topic === '/scene').json;
  const start = all.find(({ topic }) => topic === '/tf').json.transforms;
  const [part] = entities.filter((entity) => kindOf(entity) === 'part');
  const [ghost, ...more] = entities.filter((entity) => kindOf(entity) === 'ghost');
  assert.deepEqual(more, []);
  assert.deepEqual([ghost.id, ghost.frame_id], ['window_motor (ghost)', 'ghost_0']);
  const { color, ...mesh } = ghost.triangles[0];
  const [, red, green, blue] = /--held: #(..)(..)(..);/.exec(palette).map((byte) => parseInt(byte, 16) / 255);
  assert.deepEqual(part.triangles[0].color, { r: red, g: green, b: blue, a: 1 });
  assert.deepEqual({ ...mesh, color: { ...color, a: 1 } }, part.triangles[0]);
  assert.equal(color.a, 0.25);

  for (const entity of entities) {
    const names = entity.texts.map(({ text }) => text);
    assert.deepEqual(names, kindOf(entity) === 'ghost' ? [] : [entity.id]);
    if (names.length === 0) continue;
    const { least, most } = boxOf(shownPoints(entity, start));
    const [x, y, z] = inWorld(xyz(entity.texts[0].pose.position), entity, start);
    assert.ok(least[0] < x && x < most[0] && least[1] < y && y < most[1], `${entity.id}: ${[x, y]}`);
    assert.ok(most[2] < z && z < most[2] + 0.1, `${entity.id}: ${z}`);
  }
});

test('the segments of hands are where an export has them', async () => {
  const all = await messages(await indexed(hand.bytes), { topics: ['/scene', '/tf', '/hand_0'] });
  const of = (topic) => all.filter((message) => message.topic === topic);
  const segments = of('/scene')[0].json.entities.filter((entity) => kindOf(entity) === 'segment');
  assert.equal(segments.length, 18);
  const [tf, hands] = [of('/tf'), of('/hand_0')];
  const holding = hands.flatMap(({ json }, i) => (json.activity === 'holding' ? [i] : []));
  for (const i of [hands.findIndex(({ json }) => json.activity === 'free'), holding[0], holding[holding.length >> 1], holding.at(-1)]) {
    const boxes = boxesOf(exported(hand, (tf[i].time - tf[0].time) / 1e9));
    for (const entity of segments)
      assertSameBox(boxOf(shownPoints(entity, tf[i].json.transforms)), boxes.get(entity.id), `${entity.id} at ${i}`, 1e-9);
  }
  // A hand that is lost, or waits, stands nowhere.
  const isShown = ({ json }) => json.transforms.some(({ child_frame_id: child }) => child === 'hand_0_palm');
  for (const [i, { json }] of hands.entries()) assert.equal(isShown(tf[i]), ['free', 'holding'].includes(json.activity), `tick ${i}`);
});

test('contacts lie on the part, and arrows are the forces', async () => {
  const topics = ['/contacts', '/tf', '/part_0', '/hand_0', '/scene'];
  let [contactCount, forceCount, hasCleared] = [0, 0, false];
  for (const run of [door, hand]) {
    const all = await messages(await indexed(run.bytes), { topics });
    const { entities } = all.find(({ topic }) => topic === '/scene').json;
    const mesh = partMesh(run, entities.find(({ frame_id: frame }) => frame === 'part_0').id, all.find(({ topic }) => topic === '/tf'));
    const updates = all.filter(({ topic }) => topic === '/contacts');
    const at = new Map(updates.map(({ time }) => [time, {}]));
    for (const { topic, time, json } of all) if (at.has(time)) at.get(time)[topic] = json;
    const references = [];
    let hadArrows = false;
    for (const { time, json } of updates) {
      const { '/tf': { transforms }, '/part_0': part, '/hand_0': felt } = at.get(time);
      const pose = (name) => transforms.find(({ child_frame_id: child }) => child === name);
      assert.deepEqual(json.deletions, []);
      const [{ id, frame_id: frame, spheres, arrows }, ...others] = json.entities;
      assert.deepEqual([id, frame, others], ['contacts', 'world', []]);

      assert.equal(spheres.length, part.contacts);
      for (const [i, { pose: { position } }] of spheres.entries()) {
        assert.deepEqual(position, arrows[i].pose.position);
        assert.ok(Math.abs(Math.hypot(...vectorOf(arrows[i])) - 0.03) < 1e-6);
        assert.ok(isOnMesh(placedBack(xyz(position), pose('part_0')), mesh, 1e-3), `contact ${i} at ${time} ns`);
      }
      contactCount += spheres.length;

      const force = xyz(felt.force_N);
      const forces = arrows.slice(spheres.length);
      assert.equal(forces.length, Math.hypot(...force) < 1e-3 ? 0 : 1);
      for (const arrow of forces) {
        vectorOf(arrow).forEach((value, axis) => assert.ok(Math.abs(value / 0.01 - force[axis]) < 1e-9, `${value} m, ${force} N`));
        const { position } = arrow.pose;
        if (felt.part < 0) assert.deepEqual(position, pose('hand_0').translation);
        else references.push(placedBack(xyz(position), pose('part_0')));
      }
      forceCount += forces.length;
      hasCleared ||= hadArrows && arrows.length === 0 && spheres.length === 0;
      hadArrows = arrows.length > 0;
    }
    // The reference point of the part is the centre of its bounding box, or where fingers hold it.
    const { least, most } = boxOf(mesh.flatMap(({ triangle }) => triangle));
    const expected = run === door ? least.map((value, axis) => (value + most[axis]) / 2) : references[0];
    assert.ok(expected.every((value, axis) => least[axis] < value && value < most[axis]), `${expected}`);
    for (const point of references) assert.ok(isNear(point, expected, 1e-9), `${point}, ${expected}`);

    const seconds = (updates.at(-1).time - updates[0].time) / 1e9;
    updates.slice(1).forEach(({ time }, i) => assert.ok(time - updates[i].time >= 1e9 / 60));
    assert.ok(updates.length > 58 * seconds, `${updates.length} updates in ${seconds} s`);
  }
  assert.ok(contactCount > 20 && forceCount > 20 && hasCleared, `${contactCount} contacts, ${forceCount} forces, ${hasCleared}`);
});

test('hands with fingers have their posture', async () => {
  const all = await messages(await indexed(hand.bytes), { topics: ['/tf', '/hand_0'] });
  const tf = all.filter(({ topic }) => topic === '/tf');
  const hands = all.filter(({ topic }) => topic === '/hand_0');
  assert.equal(hands.length, hand.hands.length);
  for (const [i, row] of hand.hands.entries()) {
    const { json } = hands[i];
    assert.equal(json.activity, row.activity);
    if (row.activity === 'none') continue;
    for (const key of ['thumb_roll_rad', 'little_dip_rad', 'wrist_abduction_rad']) assert.equal(json.angles_rad[key], Number(row[key]));
    for (const key of ['thumb_roll_Nm', 'index_mcp_Nm']) assert.equal(json.torques_Nm[key], Number(row[key]));
    const root = tf[i].json.transforms.find((transform) => transform.child_frame_id === 'hand_0');
    assert.deepEqual(xyz(root.translation), vector(row, 'x_m y_m z_m'));
  }
  assert.ok(hands.some(({ json }) => json.activity !== 'none'));
});

test('the file is one by the rules of the format', async () => {
  const reader = await indexed(hand.bytes);
  const schemas = new Map([...reader.channelsById.values()].map(({ topic, schemaId }) => [topic, reader.schemasById.get(schemaId)]));
  assert.equal(schemas.get('/tf').name, 'foxglove.FrameTransforms');
  assert.equal(schemas.get('/scene').name, 'foxglove.SceneUpdate');
  for (const schema of schemas.values()) assert.equal(schema.encoding, 'jsonschema');
  const parsed = new Map([...schemas].map(([topic, { data }]) => [topic, JSON.parse(Buffer.from(data))]));
  for (const { topic, json } of await messages(reader)) assertFits(json, parsed.get(topic), topic);

  // A reader finds a quarter of a second by the indexes, and only what it asks for.
  const startTime = reader.statistics.messageStartTime + 1_000_000_000n;
  const quarter = await messages(reader, { topics: ['/part_0'], startTime, endTime: startTime + 249_999_999n });
  assert.equal(quarter.length, 250);

  // From beginning to end, without the indexes.
  const stream = new McapStreamReader({ validateCrcs: true });
  stream.append(hand.bytes);
  const counts = new Map();
  for (let record; (record = stream.nextRecord());)
    if (record.type === 'Message') counts.set(record.channelId, (counts.get(record.channelId) ?? 0n) + 1n);
  assert.ok(stream.done());
  assert.deepEqual(new Map([...counts].sort()), new Map([...reader.statistics.channelMessageCounts].sort()));
});

function kindOf(entity) {
  return entity.metadata.find(({ key }) => key === 'kind').value;
}

// The groups of an export of the recording, this time after its start: triangles of three points, by name.
function exported(run, seconds) {
  const obj = join(folder, 'moment.obj');
  execFileSync(PROGRAM, ['export', '--log', run.log, '--at', `${seconds}`, '--out', obj]);
  const groups = new Map();
  const vertices = [undefined]; // OBJ counts from 1
  let triangles;
  for (const [kind, ...words] of readFileSync(obj, 'utf8').split('\n').map((line) => line.split(' '))) {
    if (kind === 'g') groups.set(words[0], (triangles = []));
    if (kind === 'v') vertices.push(words.map(Number));
    if (kind === 'f') triangles.push(words.map((word) => vertices[word]));
  }
  return groups;
}

function boxesOf(groups) {
  return new Map([...groups].map(([name, triangles]) => [name, boxOf(triangles.flat())]));
}

function boxOf(points) {
  const box = { least: [Infinity, Infinity, Infinity], most: [-Infinity, -Infinity, -Infinity] };
  for (const point of points) {
    for (let axis = 0; axis < 3; ++axis) {
      box.least[axis] = Math.min(box.least[axis], point[axis]);
      box.most[axis] = Math.max(box.most[axis], point[axis]);
    }
  }
  return box;
}

function assertSameBox(shown, box, where, tolerance = 2e-3) {
  for (const side of ['least', 'most'])
    for (let axis = 0; axis < 3; ++axis)
      assert.ok(Math.abs(shown[side][axis] - box[side][axis]) < tolerance, `${where}: ${shown[side]}, ${box[side]}`);
}

// A point in the frame of an entity, in the world.
function inWorld(point, entity, transforms) {
  const frame = transforms.find(({ child_frame_id: child }) => child === entity.frame_id);
  assert.equal(entity.frame_id === 'world', !frame, entity.frame_id);
  return frame ? placed(point, frame.translation, frame.rotation) : point;
}

// The vertices of its mesh, in the world.
function shownPoints(entity, transforms) {
  const [{ points, pose }] = entity.triangles;
  return points.map((p) => inWorld(placed(xyz(p), pose.position, pose.orientation), entity, transforms));
}

// From the tail of an arrow to its tip.
function vectorOf({ pose, shaft_length: shaft, head_length: head }) {
  return placed([shaft + head, 0, 0], { x: 0, y: 0, z: 0 }, pose.orientation);
}

// The triangles of a part in its frame, and their boxes, of an export at the start.
function partMesh(run, name, { json: { transforms } }) {
  const start = transforms.find(({ child_frame_id: child }) => child === 'part_0');
  const triangles = exported(run, 0).get(name).map((triangle) => triangle.map((p) => placedBack(p, start)));
  return triangles.map((triangle) => ({ triangle, box: boxOf(triangle) }));
}

function isOnMesh(point, mesh, tolerance) {
  const isBeside = ({ least, most }) => point.every((value, axis) => least[axis] - tolerance < value && value < most[axis] + tolerance);
  return mesh.some(({ box, triangle }) => isBeside(box) && distanceToTriangle(point, triangle) < tolerance);
}

// By its plane, if the point is over the triangle, and otherwise by its edges.
function distanceToTriangle(p, [a, b, c]) {
  const sides = [[a, b], [b, c], [c, a]];
  const normal = cross(minus(b, a), minus(c, a));
  const size = Math.hypot(...normal);
  if (size > 0 && sides.every(([from, to]) => dot(cross(normal, minus(to, from)), minus(p, from)) >= 0))
    return Math.abs(dot(normal, minus(p, a))) / size;
  return Math.min(...sides.map(([from, to]) => {
    const along = minus(to, from);
    const share = Math.min(1, Math.max(0, dot(minus(p, from), along) / (dot(along, along) || 1)));
    return Math.hypot(...minus(p, from.map((value, axis) => value + share * along[axis])));
  }));
}

const minus = (a, b) => a.map((value, axis) => value - b[axis]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

// The point in the parent of a frame at this pose.
function placed(p, translation, { x, y, z, w }) {
  const u = [x, y, z];
  const t = cross(u, p).map((value) => 2 * value);
  const ut = cross(u, t);
  const at = xyz(translation);
  return p.map((value, i) => value + w * t[i] + ut[i] + at[i]);
}

// The point in the frame at this pose, of a point in its parent.
function placedBack(p, { translation, rotation: { x, y, z, w } }) {
  return placed(minus(p, xyz(translation)), { x: 0, y: 0, z: 0 }, { x: -x, y: -y, z: -z, w });
}
