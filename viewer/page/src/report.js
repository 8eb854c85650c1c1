// A report: its data, and its plots.

import uPlot from 'uplot';
import { Charts } from './charts.js';
import { cssColor, lineColor } from './colors.js';
import { append, byId } from './dom.js';
import { decodeFrames } from './frame.js';

function bytesOf(id) {
  const text = atob(byId(id).textContent.trim());
  return Uint8Array.from(text, (character) => character.charCodeAt(0)).buffer;
}

export function isReport() {
  return byId('report-plots') !== null;
}

// The run in three dimensions, if the report has it.
export function replayData() {
  if (!byId('report-frames')) return undefined;
  return {
    model: bytesOf('report-model'),
    wholeModel: byId('report-whole-model') ? bytesOf('report-whole-model') : undefined,
    frames: decodeFrames(bytesOf('report-frames')),
  };
}

// What is nothing to a hand, a millionth of a newton, a millimetre or a degree, is flat, as is noise of rounding. A flat
// line is drawn in the middle.
function rangeOf(low, high) {
  const largest = Math.max(Math.abs(low), Math.abs(high));
  if (high - low > Math.max(1e-9 * largest, 1e-6)) return uPlot.rangeNum(low, high, 0.1, true);
  const room = largest > 1e-6 ? 0.5 * largest : 1;
  return [low - room, high + room];
}

const WHOLE_STEPS = Array.from({ length: 30 }, (_, i) => [1, 2, 5][i % 3] * 10 ** Math.floor(i / 3));
const AXIS = { font: '12px system-ui, sans-serif', labelFont: '13px system-ui, sans-serif', labelSize: 20 };
const X_AXIS = { ...AXIS, size: 28, space: 70 };
const Y_AXIS = { ...AXIS, size: 58 }; // the same in all plots, so that times lie below each other
const ROOM = 10; // above what is drawn, in pixels
const ROW = 40; // of a strip: its name, and below it the strip
const NAME = 18;

const number = (value) => (Number.isFinite(value) ? `${Number(value.toPrecision(5))}` : null);

// The last point before the cursor: its value holds.
function heldAt(u, line, nearest, x) {
  let i = nearest;
  while (i >= 0 && (u.data[0][i] > x || u.data[line][i] === undefined)) --i;
  return i < 0 ? null : i;
}

// What curves and strips share. Those over time zoom together.
function optionsOf({ title, x_label: label, series, over_time: overTime, steps, words }) {
  return {
    name: title, overTime,
    names: series.map((one) => one.name),
    x: { label, value: (u) => (u.cursor.left < 0 ? null : number(u.posToVal(u.cursor.left, 'x'))) },
    cursor: {
      y: false, drag: { dist: 5 },
      ...(overTime && { sync: { key: 'time', setSeries: false } }),
      ...((steps || words.length > 0) && { dataIdx: heldAt }),
    },
  };
}

function optionsOfCurves({ x_label: xLabel, y_label: yLabel, counts, steps }) {
  return {
    height: 300,
    padding: [ROOM, 16, 0, 0],
    line: { value: (_, value) => number(value), ...(steps && { paths: uPlot.paths.stepped({ align: 1 }) }) },
    scales: { x: { time: false }, y: { range: (_, low, high) => rangeOf(low, high) } },
    axes: [{ ...X_AXIS, label: xLabel }, { ...Y_AXIS, label: yLabel, ...(counts && { incrs: WHOLE_STEPS }) }],
  };
}

// Words over time, one strip below the other: each word has a colour.
function optionsOfStrips(plot) {
  return {
    height: ROOM + ROW * plot.series.length + X_AXIS.size + X_AXIS.labelSize,
    padding: [ROOM, 16, 0, Y_AXIS.size + Y_AXIS.labelSize],
    line: { paths: () => null, value: (_, word) => plot.words[word] ?? null },
    scales: { x: { time: false }, y: { range: [0, 1] } },
    axes: [{ ...X_AXIS, label: plot.x_label }, { show: false }],
    legend: { markers: { show: false, stroke: 'inherit' } },
    hooks: { drawAxes: [(u) => drawStrips(u, plot)] },
  };
}

function drawStrips(u, { series }) {
  const { ctx, bbox: { left, top, width } } = u;
  const pixel = devicePixelRatio;
  const xOf = (time) => Math.min(Math.max(u.valToPos(time, 'x', true), left), left + width);
  ctx.save();
  ctx.font = `${13 * pixel}px system-ui, sans-serif`;
  ctx.textAlign = 'left';
  ctx.textBaseline = 'alphabetic';
  series.forEach(({ name, x, y }, row) => {
    const begin = top + ROW * pixel * row;
    ctx.fillStyle = cssColor('quiet');
    ctx.fillText(name, left, begin + 0.7 * NAME * pixel);
    for (let i = 0; i + 1 < x.length; ++i) {
      ctx.fillStyle = cssColor(lineColor(y[i]));
      ctx.fillRect(xOf(x[i]), begin + NAME * pixel, xOf(x[i + 1]) - xOf(x[i]), NAME * pixel);
    }
  });
  ctx.restore();
}

function addWords(section, { words, series }) {
  const list = append(section, 'ul');
  words.forEach((word, i) => {
    if (series.some(({ y }) => y.includes(i))) append(list, 'li', word).style.setProperty('--dot', `var(--${lineColor(i)})`);
  });
}

// Cells with numbers come by their number, empty ones last, all others by their text.
function comparable(row, column) {
  const cell = row.cells[column];
  if (!cell.classList.contains('number')) return cell.textContent;
  return cell.dataset.number === undefined ? NaN : Number(cell.dataset.number);
}

function compared(a, b, sign) {
  if (typeof a === 'string' || typeof b === 'string') return sign * `${a}`.localeCompare(`${b}`, undefined, { numeric: true });
  if (Number.isNaN(a) || Number.isNaN(b)) return Number.isNaN(a) - Number.isNaN(b);
  return sign * (a - b);
}

function sortBy(head) {
  const descends = head.getAttribute('aria-sort') === 'ascending';
  for (const other of head.parentElement.cells) other.removeAttribute('aria-sort');
  head.setAttribute('aria-sort', descends ? 'descending' : 'ascending');
  const body = head.closest('table').tBodies[0];
  const keys = new Map([...body.rows].map((row) => [row, comparable(row, head.cellIndex)]));
  body.append(...[...body.rows].sort((a, b) => compared(keys.get(a), keys.get(b), descends ? -1 : 1)));
}

// A click on the head of a column sorts the rows, a second one turns their order.
export function makeTablesSortable() {
  for (const button of document.querySelectorAll('.rows th button')) {
    button.addEventListener('click', () => sortBy(button.parentElement));
  }
}

export class ReportPlots {
  constructor(timeline) {
    this.charts = new Charts(timeline);
    for (const plot of JSON.parse(byId('report-plots').textContent)) this.add(plot);
  }

  add(plot) {
    const section = append(byId('plots'), 'section');
    append(section, 'h2', plot.title);
    if (plot.series.every(({ y }) => y.every((value) => value === null))) {
      append(section, 'p', 'no data');
      return;
    }
    const hasWords = plot.words.length > 0;
    if (hasWords) addWords(section, plot);
    // Lines may have values at different times: where one has none, it goes on to its next.
    const data = uPlot.join(plot.series.map(({ x, y }) => [x, y]));
    this.charts.add(append(section, 'div'), data, { ...optionsOf(plot), ...(hasWords ? optionsOfStrips(plot) : optionsOfCurves(plot)) });
  }

  clear() {
    this.charts.clear();
    byId('plots').replaceChildren();
  }

  show() {
    this.charts.showMoments();
  }
}
