// Whether the whole scene is drawn or its coarse model: the whole one once all is at rest, and always where it keeps up.

const REST_MS = 400; // after the last picture of a motion
const LONGEST_MS = 1000 / 60; // of a picture of the whole scene while things move
const HEAVY_TRIANGLES = 2e6; // not tried while things move: it might take seconds
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
    this.durations = [];
  }

  // The camera or an object moves.
  moved() {
    this.moves = true;
  }

  showsWhole(now) {
    if (!this.moves && now - this.lastMotion > REST_MS) return true;
    if (this.durations.length === 0) return !this.isHeavy;
    return Math.min(...this.durations) <= LONGEST_MS;
  }

  // A picture was drawn; it shows all motion so far. A slow one is no pause.
  drew(now) {
    if (this.moves) this.lastMotion = now;
    this.moves = false;
  }

  // The whole scene was drawn within `ms`. The first picture of a model says nothing: it brings it to the
  // graphics card.
  drewWhole(ms) {
    if (this.isLoaded) this.durations = [...this.durations, ms].slice(-JUDGED);
    this.isLoaded = true;
  }
}
