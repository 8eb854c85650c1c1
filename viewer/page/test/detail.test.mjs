// When the whole scene is drawn, and when its coarse model.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Detail } from '../src/detail.js';

// A scene that has been drawn whole so often, each time within `ms`, and moves.
function moving(ms, pictures = 4) {
  const detail = new Detail();
  for (let i = 0; i < pictures; ++i) detail.drewWhole(ms);
  detail.moved();
  return detail;
}

test('a scene that takes longer than a picture may is coarse while things move, and whole at rest', () => {
  const detail = moving(300);
  assert.equal(detail.showsWhole(1), false);
  detail.drew(10);
  assert.equal(detail.showsWhole(350), false);
  assert.equal(detail.showsWhole(500), true);
  detail.moved();
  assert.equal(detail.showsWhole(501), false);
});

test('between pictures that take long, a motion is no rest', () => {
  const detail = moving(300);
  detail.drew(0);
  detail.moved();
  assert.equal(detail.showsWhole(1000), false);
  detail.drew(1200);
  assert.equal(detail.showsWhole(1300), false);
});

test('a scene that keeps up is always whole', () => {
  assert.equal(moving(10).showsWhole(1), true);
});

test('two pictures judge a new scene, the first of which only loads it', () => {
  assert.equal(moving(2000, 0).showsWhole(1), true);
  assert.equal(moving(2000, 1).showsWhole(1), true);
  assert.equal(moving(2000, 2).showsWhole(1), false);
  const fast = moving(2000, 1);
  fast.drewWhole(10);
  assert.equal(fast.showsWhole(1), true);
  const other = moving(10);
  other.reset();
  other.drewWhole(2000);
  other.drewWhole(300);
  assert.equal(other.showsWhole(1), false);
});

test('a scene of many triangles is not tried while things move', () => {
  const detail = new Detail();
  detail.reset(5e6);
  detail.moved();
  assert.equal(detail.showsWhole(1), false);
  detail.drew(2);
  assert.equal(detail.showsWhole(500), true);
  for (const ms of [2000, 10]) detail.drewWhole(ms);
  detail.moved();
  assert.equal(detail.showsWhole(501), true);
});

test('one slow picture is no reason to draw less, several are', () => {
  const detail = moving(10);
  detail.drewWhole(300);
  assert.equal(detail.showsWhole(1), true);
  detail.drewWhole(300);
  detail.drewWhole(300);
  assert.equal(detail.showsWhole(1), false);
  detail.drewWhole(10); // at rest
  assert.equal(detail.showsWhole(1), true);
});
