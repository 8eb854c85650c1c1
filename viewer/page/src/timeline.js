// The frames that can be shown: those of the last minute, or all of a report; and which one is shown.

const KEPT_S = 60;
const MOST_FRAMES = 5 * 60 * KEPT_S; // while an old moment is looked at

export class Timeline {
  constructor(frames = []) {
    this.frames = frames;
    this.isLive = frames.length === 0;
    this.isPlaying = false;
    this.index = frames.length > 0 ? 0 : -1;
    this.listeners = [];
  }

  onChange(listener) {
    this.listeners.push(listener);
  }

  changed() {
    for (const listener of this.listeners) listener();
  }

  get frame() {
    return this.frames[this.index];
  }

  get first() {
    return this.frames.length > 0 ? this.frames[0].time : 0;
  }

  get last() {
    return this.frames.length > 0 ? this.frames[this.frames.length - 1].time : 0;
  }

  // A live frame. A server that was started again begins anew.
  push(frame) {
    if (this.frames.length > 0 && frame.sequence < this.frames[this.frames.length - 1].sequence) this.clear();
    this.frames.push(frame);
    this.forget(frame.time - KEPT_S);
    if (this.isLive || this.index < 0) this.index = this.frames.length - 1;
    this.changed();
  }

  // Another run may follow, and nothing is left to look back at.
  clear() {
    this.frames = [];
    this.index = -1;
    this.playTime = undefined;
    this.isLive = true;
    this.isPlaying = false;
  }

  // Leaves frames before `time` out, but not those from the shown one on.
  forget(time) {
    let count = 0;
    const most = this.isLive ? this.frames.length - 1 : this.index;
    while (count < most && this.frames[count].time < time) ++count;
    const excess = this.frames.length - MOST_FRAMES;
    count = Math.max(count, excess);
    if (count <= 0) return;
    this.frames.splice(0, count);
    this.index = Math.max(this.index - count, 0);
  }

  goLive() {
    this.playTime = undefined;
    this.isLive = true;
    this.isPlaying = false;
    this.index = this.frames.length - 1;
    this.changed();
  }

  pause() {
    this.playTime = undefined;
    this.isLive = false;
    this.isPlaying = false;
    this.changed();
  }

  play() {
    if (this.frames.length === 0) return;
    this.isLive = false;
    this.isPlaying = true;
    if (this.index >= this.frames.length - 1) this.index = 0;
    this.changed();
  }

  // Goes to the last frame before `time`; a run that plays goes on from there.
  seek(time) {
    this.playTime = undefined;
    this.show(time);
  }

  show(time) {
    if (this.frames.length === 0) return;
    let low = 0;
    let high = this.frames.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.frames[middle].time <= time) low = middle;
      else high = middle - 1;
    }
    this.isLive = false;
    this.index = low;
    this.changed();
  }

  step(count) {
    if (this.frames.length === 0) return;
    this.playTime = undefined;
    this.isLive = false;
    this.isPlaying = false;
    this.index = Math.min(Math.max(this.index + count, 0), this.frames.length - 1);
    this.changed();
  }

  // While it plays: `seconds` have passed.
  advance(seconds) {
    if (!this.isPlaying || this.frames.length === 0) return;
    const time = (this.playTime ?? this.frame.time) + seconds;
    this.show(time);
    this.isPlaying = time < this.last;
    this.playTime = this.isPlaying ? time : undefined;
    if (!this.isPlaying) this.changed();
  }
}
