// When a picture is fine, and when it is quick.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Detail } from '../src/detail.js';

// A scene that has been drawn fine so often, each time within `ms`, and moves; a quick picture took 2 ms.
function moving(ms, pictures = 4) {
  const detail = new Detail();
  detail.drewQuick(2);
  for (let i = 0; i < pictures; ++i) detail.drewFine(ms);
  detail.moved();
  return detail;
}

test('a scene that takes longer than a picture may is coarse while things move, and whole at rest', () => {
  const detail = moving(300);
  assert.equal(detail.isFine(1), false);
  detail.drew(10);
  assert.equal(detail.isFine(350), false);
  assert.equal(detail.isFine(500), true);
  detail.moved();
  assert.equal(detail.isFine(501), false);
});

test('between pictures that take long, a motion is no rest', () => {
  const detail = moving(300);
  detail.drew(0);
  detail.moved();
  assert.equal(detail.isFine(1000), false);
  detail.drew(1200);
  assert.equal(detail.isFine(1300), false);
});

test('a scene that keeps up is always whole', () => {
  assert.equal(moving(10).isFine(1), true);
});

test('two pictures judge a new scene, the first of which only loads it', () => {
  assert.equal(moving(2000, 0).isFine(1), true);
  assert.equal(moving(2000, 1).isFine(1), true);
  assert.equal(moving(2000, 2).isFine(1), false);
  const fast = moving(2000, 1);
  fast.drewFine(10);
  assert.equal(fast.isFine(1), true);
  const other = moving(10);
  other.reset();
  other.drewQuick(2);
  other.drewFine(2000);
  other.drewFine(300);
  assert.equal(other.isFine(1), false);
});

test('where a quick picture takes too long, no fine one is tried while things move', () => {
  const detail = new Detail();
  detail.moved();
  assert.equal(detail.isFine(1), false, 'nothing is known yet');
  detail.drewQuick(60);
  assert.equal(detail.isFine(1), false);
  detail.drewQuick(5);
  assert.equal(detail.isFine(1), true, 'the first one only took long to load');
  detail.drewFine(100);
  detail.drewFine(100);
  assert.equal(detail.isFine(1), false);
});

test('a scene of many triangles is not tried while things move', () => {
  const detail = new Detail();
  detail.reset(5e6);
  detail.drewQuick(2);
  detail.moved();
  assert.equal(detail.isFine(1), false);
  detail.drew(2);
  assert.equal(detail.isFine(500), true);
  for (const ms of [2000, 10]) detail.drewFine(ms);
  detail.moved();
  assert.equal(detail.isFine(501), true);
});

test('one slow picture is no reason to draw less, several are', () => {
  const detail = moving(10);
  detail.drewFine(300);
  assert.equal(detail.isFine(1), true);
  detail.drewFine(300);
  detail.drewFine(300);
  assert.equal(detail.isFine(1), false);
  detail.drewFine(10); // at rest
  assert.equal(detail.isFine(1), true);
});
