// Whether a picture is fine, i.e. of the whole scene and smooth, or quick, i.e. of the coarse model with steps at its
// edges: fine once all is at rest, and always where that keeps up.

const REST_MS = 400; // after the last picture of a motion
const LONGEST_MS = 1000 / 60; // of a fine picture while things move
const HEAVY_TRIANGLES = 2e6; // not drawn whole while things move: it might take seconds
const JUDGED = 3; // pictures; the shortest of them counts, so that a moment in which the machine is busy does not

export class Detail {
  constructor() {
    this.moves = false;
    this.lastMotion = -Infinity;
    this.reset();
  }

  // Another model: nothing is known of it but its size.
  reset(triangles = 0) {
    this.isHeavy = triangles > HEAVY_TRIANGLES;
    this.isLoaded = false;
    this.durations = []; // of fine pictures
    this.quickDurations = [];
  }

  // The camera or an object moves.
  moved() {
    this.moves = true;
  }

  isFine(now) {
    if (!this.moves && now - this.lastMotion > REST_MS) return true;
    if (this.isJudged()) return Math.min(...this.durations) <= LONGEST_MS;
    // A fine picture takes longer than a quick one.
    return !this.isHeavy && Math.min(...this.quickDurations) <= LONGEST_MS;
  }

  // Whether it is known how long a fine picture takes.
  isJudged() {
    return this.durations.length > 0;
  }

  // A picture was drawn; it shows all motion so far. A slow one is no pause.
  drew(now) {
    if (this.moves) this.lastMotion = now;
    this.moves = false;
  }

  drewQuick(ms) {
    this.quickDurations = [...this.quickDurations, ms].slice(-JUDGED);
  }

  // A fine picture was drawn within `ms`. The first picture of a model says nothing: it brings it to the
  // graphics card.
  drewFine(ms) {
    if (this.isLoaded) this.durations = [...this.durations, ms].slice(-JUDGED);
    this.isLoaded = true;
  }
}
