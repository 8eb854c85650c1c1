// Which frames are kept.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Timeline } from '../src/timeline.js';

// Frames of 60 a second, so many seconds long.
function push(timeline, seconds, from = 0) {
  for (let i = 0; i < 60 * seconds; ++i) timeline.push({ sequence: 60 * from + i, time: from + i / 60 });
}

test('a live page keeps the last minute', () => {
  const timeline = new Timeline();
  push(timeline, 90);
  assert.ok(Math.abs(timeline.last - timeline.first - 60) < 0.1, `${timeline.last - timeline.first} s`);
  assert.equal(timeline.frame.sequence, 60 * 90 - 1);
});

for (const leave of ['pause', 'play']) {
  test(`a server that was started again is shown live, also to who looks back: ${leave}`, () => {
    const timeline = new Timeline();
    push(timeline, 10);
    timeline.seek(2);
    timeline[leave]();
    push(timeline, 1);
    assert.deepEqual([timeline.isLive, timeline.isPlaying], [true, false]);
    assert.equal(timeline.frames.length, 60);
    assert.equal(timeline.frame.sequence, 59);
  });
}

test('a moment that is looked at stays for five minutes of frames, and then goes', () => {
  const timeline = new Timeline();
  push(timeline, 10);
  timeline.seek(2);
  push(timeline, 200, 10);
  assert.ok(Math.abs(timeline.frame.time - 2) < 0.02, `${timeline.frame.time} s`);
  assert.ok(timeline.frames.length < 18000);
  push(timeline, 400, 210);
  assert.equal(timeline.frames.length, 18000);
  assert.equal(timeline.index, 0);
  timeline.goLive();
  push(timeline, 1, 610);
  assert.ok(timeline.frames.length < 3700, `${timeline.frames.length} frames`);
});
