// The rows of a study. A click on the head of a column sorts them. There may be 100,000: only some are in the document.

import { append } from './dom.js';

export const short = (value) => (typeof value === 'number' ? `${Number(value.toPrecision(5))}` : `${value ?? ''}`);

const FIRST_ROWS = 20;
const MORE_ROWS = 100;
const UNSHOWN = ['input_hash', 'success'];

export class StudyTable {
  // `chosen.sort` and `chosen.descends` are the order.
  constructor(section, slides, replays, chosen) {
    this.slides = slides;
    this.replays = replays;
    this.chosen = chosen;
    this.columns = slides.columns.filter((name) => !UNSHOWN.includes(name));
    this.order = Array.from({ length: slides.count }, (_, row) => row);
    const table = append(append(section, 'div', '', 'wide'), 'table', '', 'rows');
    table.id = 'slides';
    this.head = append(append(table, 'thead'), 'tr');
    for (const name of this.columns) this.addHead(name);
    this.body = append(table, 'tbody');
    this.more = append(section, 'button', 'More rows');
    this.more.id = 'more-rows';
    this.more.addEventListener('click', () => {
      chosen.rows = this.body.rows.length + MORE_ROWS;
      this.addRows();
    });
    this.sort();
  }

  addHead(name) {
    const head = append(this.head, 'th');
    append(head, 'button', name).addEventListener('click', () => {
      this.chosen.descends = this.chosen.sort === name && !this.chosen.descends;
      this.chosen.sort = name;
      this.sort();
    });
  }

  // Empty cells come last.
  sort() {
    const { sort = 'slide', descends = false } = this.chosen;
    const sign = descends ? -1 : 1;
    const key = (row) => this.slides.at(sort, row);
    this.order.sort((a, b) => {
      const [x, y] = [key(a), key(b)];
      if (x === null || y === null) return (x === null) - (y === null) || a - b;
      return sign * (typeof x === 'string' ? x.localeCompare(y) : x - y) || a - b;
    });
    [...this.head.cells].forEach((cell, i) => {
      cell.removeAttribute('aria-sort');
      if (this.columns[i] === sort) cell.setAttribute('aria-sort', descends ? 'descending' : 'ascending');
    });
    this.body.replaceChildren();
    this.addRows();
  }

  addRows() {
    for (const row of this.order.slice(this.body.rows.length, this.chosen.rows ?? FIRST_ROWS)) {
      const line = append(this.body, 'tr');
      for (const name of this.columns) {
        const value = this.slides.at(name, row);
        if (name === 'slide') this.replays.cell(line, value);
        else append(line, 'td', short(value), typeof value === 'string' ? '' : 'number');
      }
    }
    this.more.hidden = this.body.rows.length >= this.order.length;
  }
}
