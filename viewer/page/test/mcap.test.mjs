// What `glissade log to-mcap` writes, read by the reader of others: @mcap/core.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { McapIndexedReader, McapStreamReader } from '@mcap/core';
import { PROGRAM, rowsOf } from './harness.mjs';

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
  const obj = join(folder, 'start.obj');
  execFileSync(PROGRAM, ['export', '--log', door.log, '--out', obj]);
  const boxes = new Map();
  let box;
  for (const [kind, ...words] of readFileSync(obj, 'utf8').split('\n').map((line) => line.split(' '))) {
    if (kind === 'g') boxes.set(words[0], (box = boxOf([])));
    if (kind === 'v') include(box, words.map(Number));
  }

  const all = await messages(await indexed(door.bytes), { topics: ['/scene', '/tf'] });
  const scenes = all.filter(({ topic }) => topic === '/scene');
  assert.equal(scenes.length, 1);
  const { entities } = scenes[0].json;
  assert.equal(entities.length, boxes.size);
  const start = all.find(({ topic }) => topic === '/tf').json.transforms;
  let triangles = 0;
  for (const entity of entities) {
    const [list] = entity.triangles;
    triangles += list.indices.length / 3;
    assert.ok(list.indices.every((index) => index < list.points.length));
    const frame = start.find(({ child_frame_id: child }) => child === entity.frame_id);
    assert.equal(entity.frame_id === 'world', !frame, entity.frame_id);
    let points = list.points.map((p) => placed(xyz(p), list.pose.position, list.pose.orientation));
    if (frame) points = points.map((p) => placed(p, frame.translation, frame.rotation));
    const [shown, exported] = [boxOf(points), boxes.get(entity.id)];
    for (const side of ['least', 'most'])
      for (let axis = 0; axis < 3; ++axis)
        assert.ok(Math.abs(shown[side][axis] - exported[side][axis]) < 2e-3, `${entity.id}: ${shown[side]}, ${exported[side]}`);
  }
  assert.ok(triangles > 50_000 && triangles < 105_000, `${triangles} triangles`);
  assert.deepEqual(entities.filter((entity) => entity.frame_id !== 'world').map(({ id }) => id), ['window_motor']);
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

function boxOf(points) {
  const box = { least: [Infinity, Infinity, Infinity], most: [-Infinity, -Infinity, -Infinity] };
  for (const point of points) include(box, point);
  return box;
}

function include(box, point) {
  for (let axis = 0; axis < 3; ++axis) {
    box.least[axis] = Math.min(box.least[axis], point[axis]);
    box.most[axis] = Math.max(box.most[axis], point[axis]);
  }
}

// The point in the parent of a frame at this pose.
function placed(p, translation, { x, y, z, w }) {
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const u = [x, y, z];
  const t = cross(u, p).map((value) => 2 * value);
  const ut = cross(u, t);
  const at = xyz(translation);
  return p.map((value, i) => value + w * t[i] + ut[i] + at[i]);
}
