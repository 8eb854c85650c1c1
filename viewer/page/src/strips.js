// Plots of the last minute, one below the other.

import { Charts } from './charts.js';

const MOST_POINTS = 3600;
const PERIOD_MS = 100; // of drawing

// What is plotted: a title with its unit, and the values of a frame, by hand, by part or for the loop.
const STRIPS = [
  { title: 'Force [N]', perHand: (hand) => hand.peak },
  { title: 'Lag [mm]', perPart: (part) => part.lag },
  { title: 'Angle of the lag [°]', perPart: (part) => part.angle },
  { title: 'Contacts', least: 1, perPart: (part) => part.contacts },
  { title: 'Duration and lateness of ticks [µs]', names: ['duration', 'lateness'], values: (f) => [f.duration, f.lateness] },
  { title: 'Age of contacts [ms]', names: ['age'], values: (f) => [f.age] },
  { title: 'Energy left to the hand [J]', perHand: (hand) => hand.energy },
];

function valuesOf(strip, frame) {
  if (strip.perHand) return frame.hands.map(strip.perHand);
  if (strip.perPart) return frame.parts.map(strip.perPart);
  return strip.values(frame);
}

export class Strips {
  constructor(container, timeline) {
    this.container = container;
    this.timeline = timeline;
    this.charts = new Charts(timeline);
    this.lastDrawn = 0;
  }

  make(info) {
    this.info = info;
    this.charts.clear();
    for (const strip of STRIPS) this.add(strip);
    this.draw();
  }

  add(strip) {
    const font = '11px system-ui, sans-serif';
    const names = this.namesOf(strip);
    this.charts.add(this.container, this.data(strip), {
      name: strip.title,
      title: strip.title,
      names,
      overTime: true,
      height: 112,
      cursor: { y: false, points: { show: false }, sync: { key: 'strips' }, drag: { setScale: false } },
      legend: { show: names.length > 1, live: false },
      scales: { x: { time: false }, y: { range: (_, low, high) => [Math.min(0, low), Math.max(1.1 * high, strip.least ?? 0.01)] } },
      axes: [{ font, size: 24, space: 60 }, { font, size: 44, space: 26 }],
    });
  }

  namesOf(strip) {
    if (strip.perHand) return this.info.hands.map((hand) => hand.name);
    if (strip.perPart) return this.info.parts;
    return strip.names;
  }

  data(strip) {
    const frames = this.timeline.frames.slice(-MOST_POINTS);
    const columns = this.namesOf(strip).map(() => []);
    const times = [];
    for (const frame of frames) {
      times.push(frame.time - this.timeline.first);
      const values = valuesOf(strip, frame);
      columns.forEach((column, i) => column.push(values[i] ?? null));
    }
    return [times, ...columns];
  }

  draw() {
    this.lastDrawn = performance.now();
    this.charts.plots.forEach((plot, i) => plot.setData(this.data(STRIPS[i])));
  }

  drawSometimes() {
    if (this.container.clientHeight > 0 && performance.now() - this.lastDrawn > PERIOD_MS) this.draw();
  }
}
