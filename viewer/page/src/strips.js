// Plots of the last minute, one below the other.

import uPlot from 'uplot';
import { cssColor, onSchemeChange, SERIES } from './colors.js';

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
    this.lastDrawn = 0;
    this.plots = [];
    onSchemeChange(() => this.make(this.info));
    new ResizeObserver(() => this.resize()).observe(container);
  }

  make(info) {
    if (!info) return;
    this.info = info;
    for (const { plot } of this.plots) plot.destroy();
    this.container.replaceChildren();
    this.plots = STRIPS.map((strip) => this.makePlot(strip));
    this.draw();
  }

  namesOf(strip) {
    if (strip.perHand) return this.info.hands.map((hand) => hand.name);
    if (strip.perPart) return this.info.parts;
    return strip.names;
  }

  makePlot(strip) {
    const axis = { stroke: cssColor('quiet'), grid: { stroke: cssColor('grid'), width: 1 }, ticks: { show: false } };
    const font = '11px system-ui, sans-serif';
    const plot = new uPlot({
      title: strip.title,
      width: Math.max(this.container.clientWidth, 100),
      height: 112,
      cursor: { y: false, points: { show: false }, sync: { key: 'strips' }, drag: { setScale: false } },
      legend: { show: this.namesOf(strip).length > 1, live: false },
      scales: { x: { time: false }, y: { range: (_, low, high) => [Math.min(0, low), Math.max(1.1 * high, strip.least ?? 0.01)] } },
      axes: [{ ...axis, font, size: 24, space: 60 }, { ...axis, font, size: 44, space: 26 }],
      series: [{}, ...this.namesOf(strip).map((label, i) => ({
        label, stroke: cssColor(SERIES[i % SERIES.length]), width: 1.3, points: { show: false },
      }))],
      hooks: { draw: [(u) => this.drawCursor(u)] },
    }, this.data(strip), this.container);
    plot.over.addEventListener('click', (event) => {
      const x = plot.posToVal(event.offsetX, 'x');
      this.timeline.seek(x + this.timeline.first);
    });
    plot.root.setAttribute('role', 'img');
    plot.root.setAttribute('aria-label', strip.title);
    return { plot, strip };
  }

  // A line at the frame that is shown, if that is not the newest one.
  drawCursor(u) {
    const { frame, isLive } = this.timeline;
    if (!frame || isLive) return;
    const x = u.valToPos(frame.time - this.timeline.first, 'x', true);
    u.ctx.save();
    u.ctx.strokeStyle = cssColor('text');
    u.ctx.beginPath();
    u.ctx.moveTo(x, u.bbox.top);
    u.ctx.lineTo(x, u.bbox.top + u.bbox.height);
    u.ctx.stroke();
    u.ctx.restore();
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
    for (const { plot, strip } of this.plots) plot.setData(this.data(strip));
  }

  drawSometimes() {
    if (this.container.clientHeight > 0 && performance.now() - this.lastDrawn > PERIOD_MS) this.draw();
  }

  resize() {
    for (const { plot } of this.plots) plot.setSize({ width: Math.max(this.container.clientWidth, 100), height: 112 });
  }
}
