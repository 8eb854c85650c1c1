// Plots by uPlot, live and in reports: what all of them share.

import uPlot from 'uplot';
import { cssColor, lineColor, onSchemeChange } from './colors.js';

// With the decimals of the step between them, as far as there is room, in any language.
function labelsOf(u, values, axis, space, step) {
  const isWhole = (x) => Math.abs(x - Math.round(x)) < 1e-6 * x;
  const decimals = [0, 1, 2, 3, 4, 5].find((d) => isWhole(step * 10 ** d));
  return values.map((value) => (decimals === undefined ? Number(value.toPrecision(3)).toExponential() : value.toFixed(decimals)));
}

const axisOf = (options) => ({
  stroke: () => cssColor('quiet'), grid: { stroke: () => cssColor('grid'), width: 1 }, ticks: { show: false }, values: labelsOf, ...options,
});

const widthOf = (container) => Math.max(container.clientWidth, 100);

// As wide as their containers, in the colours of the page. Those over time belong to a timeline: a click on one goes to
// that moment, and a line in each shows the moment.
export class Charts {
  constructor(timeline) {
    this.timeline = timeline;
    this.plots = [];
    onSchemeChange(() => { for (const plot of this.plots) plot.redraw(false); });
    this.sizes = new ResizeObserver(() => {
      for (const plot of this.plots) plot.setSize({ width: widthOf(plot.root.parentElement), height: plot.height });
    });
  }

  clear() {
    this.sizes.disconnect();
    for (const plot of this.plots) plot.destroy();
    this.plots = [];
  }

  // A plot with a line for each of `names`. `x` and `line` are uPlot's options for the first column of the data and for
  // the others, as far as not all plots share them, and `options` all other options.
  add(container, data, { name, names, x, line, axes, overTime, hooks, legend, ...options }) {
    const plot = new uPlot({
      width: widthOf(container),
      axes: axes.map(axisOf),
      series: [{ ...x }, ...names.map((label, i) => (
        { label, stroke: () => cssColor(lineColor(i)), width: 1.4, points: { show: false }, ...line }))],
      legend: { markers: { width: 0, fill: (_, i) => `var(--${lineColor(i - 1)})` }, ...legend },
      hooks: { draw: [(u) => this.showMoment(u)], ...hooks },
      ...options,
    }, data, container);
    plot.root.setAttribute('role', 'img');
    plot.root.setAttribute('aria-label', name);
    if (overTime) this.link(plot);
    this.plots.push(plot);
    this.sizes.observe(container);
  }

  link(plot) {
    plot.moment = document.createElement('div');
    plot.moment.className = 'moment';
    plot.over.append(plot.moment);
    plot.over.addEventListener('click', (event) => {
      this.timeline.seek(this.timeline.first + plot.posToVal(event.offsetX, 'x'));
    });
    this.showMoment(plot);
  }

  showMoment({ moment, over, valToPos }) {
    const { frame, isLive, first } = this.timeline;
    if (!moment) return;
    const x = frame ? valToPos(frame.time - first, 'x') : NaN;
    const isOutside = !(x > -1 && x < over.clientWidth + 1); // where one has zoomed in
    moment.hidden = isLive || isOutside;
    if (!moment.hidden) moment.style.left = `${x}px`;
  }

  showMoments() {
    for (const plot of this.plots) this.showMoment(plot);
  }
}
