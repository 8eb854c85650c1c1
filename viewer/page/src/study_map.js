// Success over any two parameters of a study: cells with the rate, and a point for each slide.

import { cssColor, onSchemeChange } from './colors.js';
import { append } from './dom.js';

const HEIGHT = 460;
const BOTTOM = 40;
const ROOM = 14;
const FONT = '12px system-ui, sans-serif';
const CELLS = 16; // along each axis
const NEAR = 14; // of a click, in pixels
const RADIUS = 3;

// The range of a column, and the places of its numbers in it.
class Axis {
  constructor(slides, name) {
    this.slides = slides;
    this.name = name;
    let [low, high] = [Infinity, -Infinity];
    for (let row = 0; row < slides.count; ++row) {
      const value = slides.numberAt(name, row);
      low = Math.min(low, value);
      high = Math.max(high, value);
    }
    const room = slides.words.has(name) || !(high > low) ? 0.5 : 0.02 * (high - low);
    this.low = low - room;
    this.high = high + room;
  }

  // Slides with the same word lie beside each other.
  share(row) {
    const spread = this.slides.words.has(this.name) ? 0.6 * ((row * 0.618034) % 1 - 0.5) : 0;
    return (this.slides.numberAt(this.name, row) + spread - this.low) / (this.high - this.low);
  }

  // Words have a label each; numbers five.
  labels() {
    const words = this.slides.words.get(this.name);
    const at = (value) => (value - this.low) / (this.high - this.low);
    if (words) return words.map((word, i) => [at(i), word]);
    const range = this.high - this.low;
    const largest = Math.max(Math.abs(this.low), Math.abs(this.high));
    const digits = Math.min(15, 3 + Math.max(0, Math.ceil(Math.log10(largest / range))));
    return [0, 1, 2, 3, 4].map((i) => [i / 4, `${Number((this.low + i / 4 * range).toPrecision(digits))}`]);
  }
}

class StudyMap {
  // `chosen.x` and `chosen.y` are the names of the parameters; a click on a point calls `onClick(slide)`.
  constructor(section, slides, names, chosen, onClick) {
    this.slides = slides;
    chosen.x = names.includes(chosen.x) ? chosen.x : names[0];
    chosen.y = names.includes(chosen.y) ? chosen.y : names[1] ?? names[0];
    this.chosen = chosen;
    const choice = append(section, 'p', '', 'group');
    for (const axis of ['x', 'y']) this.addChoice(choice, axis, names);
    const legend = append(section, 'ul');
    for (const [text, color] of [['success', 'c2'], ['failure', 'c4']]) {
      append(legend, 'li', text).style.setProperty('--dot', `var(--${color})`);
    }
    this.canvas = append(section, 'canvas');
    this.canvas.id = 'map';
    this.canvas.setAttribute('role', 'img');
    this.canvas.setAttribute('aria-label', 'Success over two parameters; a click on a point opens its replay');
    this.hint = append(section, 'p', 'A click on a point opens its replay.');
    this.hint.id = 'map-hint';
    this.canvas.addEventListener('mousemove', (event) => this.tell(this.nearest(event)));
    this.canvas.addEventListener('click', (event) => {
      const row = this.nearest(event);
      if (row !== undefined) onClick(slides.at('slide', row));
    });
    this.draw();
  }

  addChoice(parent, axis, names) {
    const label = append(parent, 'label', `${axis} `);
    const select = append(label, 'select');
    select.id = `map-${axis}`;
    for (const name of names) append(select, 'option', name).value = name;
    select.value = this.chosen[axis];
    select.addEventListener('change', () => {
      this.chosen[axis] = select.value;
      this.draw();
    });
  }

  place(row) {
    const { width, height } = this.size;
    return [this.left + this.x.share(row) * width, ROOM + (1 - this.y.share(row)) * height];
  }

  draw() {
    const { canvas } = this;
    const width = Math.max(canvas.parentElement.clientWidth - 40, 200);
    Object.assign(canvas, { width: width * devicePixelRatio, height: HEIGHT * devicePixelRatio });
    Object.assign(canvas.style, { width: `${width}px`, height: `${HEIGHT}px` });
    const ctx = canvas.getContext('2d');
    ctx.font = FONT;
    this.y = new Axis(this.slides, this.chosen.y);
    this.left = 28 + Math.max(...this.y.labels().map(([, text]) => ctx.measureText(text).width));
    canvas.dataset.left = this.left; // for tests
    this.size = { width: width - this.left - ROOM, height: HEIGHT - BOTTOM - ROOM };
    this.x = new Axis(this.slides, this.chosen.x);
    ctx.scale(devicePixelRatio, devicePixelRatio);
    this.drawCells(ctx);
    this.drawPoints(ctx);
    this.drawAxes(ctx);
  }

  drawCells(ctx) {
    const counts = new Map();
    for (let row = 0; row < this.slides.count; ++row) {
      const key = CELLS * Math.floor(CELLS * this.y.share(row)) + Math.floor(CELLS * this.x.share(row));
      const cell = counts.get(key) ?? [0, 0];
      ++cell[this.slides.succeeds(row) ? 0 : 1];
      counts.set(key, cell);
    }
    const [cellWidth, cellHeight] = [this.size.width / CELLS, this.size.height / CELLS];
    for (const [key, [successes, failures]] of counts) {
      const rate = successes / (successes + failures);
      ctx.globalAlpha = 0.12 + 0.22 * Math.abs(2 * rate - 1);
      ctx.fillStyle = cssColor(rate >= 0.5 ? 'c2' : 'c4');
      ctx.fillRect(this.left + (key % CELLS) * cellWidth, ROOM + (CELLS - 1 - Math.floor(key / CELLS)) * cellHeight, cellWidth, cellHeight);
    }
    ctx.globalAlpha = 1;
  }

  // Rings succeed, crosses fail: one sees it without colours, too.
  drawPoints(ctx) {
    ctx.lineWidth = 1.3;
    for (const succeeds of [true, false]) {
      ctx.strokeStyle = cssColor(succeeds ? 'c2' : 'c4');
      ctx.beginPath();
      for (let row = 0; row < this.slides.count; ++row) {
        if (this.slides.succeeds(row) !== succeeds) continue;
        const [x, y] = this.place(row);
        if (succeeds) {
          ctx.moveTo(x + RADIUS, y);
          ctx.arc(x, y, RADIUS, 0, 2 * Math.PI);
        } else {
          ctx.moveTo(x - RADIUS, y - RADIUS);
          ctx.lineTo(x + RADIUS, y + RADIUS);
          ctx.moveTo(x - RADIUS, y + RADIUS);
          ctx.lineTo(x + RADIUS, y - RADIUS);
        }
      }
      ctx.stroke();
    }
  }

  drawAxes(ctx) {
    const { width, height } = this.size;
    ctx.strokeStyle = cssColor('axis');
    ctx.lineWidth = 1;
    ctx.strokeRect(this.left, ROOM, width, height);
    ctx.fillStyle = cssColor('quiet');
    ctx.font = FONT;
    ctx.textAlign = 'center';
    for (const [share, text] of this.x.labels()) {
      const half = ctx.measureText(text).width / 2;
      const x = Math.min(this.left + share * width, this.left + width + ROOM - half);
      ctx.fillText(text, x, ROOM + height + 15);
    }
    ctx.fillText(this.x.name, this.left + width / 2, ROOM + height + 33);
    ctx.textAlign = 'right';
    for (const [share, text] of this.y.labels()) ctx.fillText(text, this.left - 5, ROOM + (1 - share) * height + 4);
    ctx.save();
    ctx.translate(12, ROOM + height / 2);
    ctx.rotate(-Math.PI / 2);
    ctx.textAlign = 'center';
    ctx.fillText(this.y.name, 0, 0);
    ctx.restore();
  }

  // The row of the point at the mouse.
  nearest({ offsetX, offsetY }) {
    let best;
    let least = NEAR;
    for (let row = 0; row < this.slides.count; ++row) {
      const [x, y] = this.place(row);
      const distance = Math.hypot(x - offsetX, y - offsetY);
      if (distance >= least) continue;
      least = distance;
      best = row;
    }
    return best;
  }

  tell(row) {
    this.canvas.style.cursor = row === undefined ? 'default' : 'pointer';
    if (row === undefined) return;
    const values = [this.chosen.x, this.chosen.y].map((name) => `${name} ${this.slides.at(name, row)}`);
    this.hint.textContent = `slide ${this.slides.at('slide', row)}: ${this.slides.at('outcome', row)}, ${values.join(', ')}`;
  }
}

let shown;
const sizes = new ResizeObserver(() => shown.draw());
onSchemeChange(() => shown?.draw());

// Shows a map in place of the one before.
export function showMap(section, ...rest) {
  sizes.disconnect();
  shown = new StudyMap(section, ...rest);
  sizes.observe(section);
}
