// A study: how many slides succeed, on what that depends, and where the others fail.

import { append, byId } from './dom.js';
import { showMap } from './study_map.js';
import { short, StudyTable } from './study_table.js';

export function studyData() {
  const element = byId('report-study');
  return element ? JSON.parse(element.textContent) : undefined;
}

const percent = (share) => `${(100 * share).toFixed(1)} %`;

// The rows of the table, by column. Texts of a column are numbers of its words.
export class Slides {
  constructor({ columns, data, words }) {
    this.columns = columns;
    this.data = new Map(columns.map((name, i) => [name, data[i]]));
    this.words = new Map(Object.entries(words));
    this.count = data[0].length;
  }

  has(column) {
    return this.data.has(column);
  }

  // A number, a text, or null.
  at(column, row) {
    const value = this.data.get(column)[row];
    const words = this.words.get(column);
    return words && value !== null ? words[value] : value;
  }

  // Texts as their numbers, so that they have a place on an axis.
  numberAt(column, row) {
    return this.data.get(column)[row];
  }

  succeeds(row) {
    return this.data.get('success')[row] === 1;
  }
}

// A link to the replay of a slide, or what one has to do for it.
export class Replays {
  constructor({ replays, command, is_served: isServed }) {
    this.known = new Set(replays);
    this.command = command;
    this.isServed = isServed;
  }

  has(slide) {
    return this.isServed || this.known.has(slide);
  }

  place(slide) {
    return `slides/${slide}/${this.isServed ? '' : 'index.html'}`;
  }

  open(slide) {
    byId('replay-note').textContent = '';
    if (this.has(slide)) return window.open(this.place(slide), '_blank');
    byId('replay-note').textContent = `The replay of slide ${slide} has not been made. Either of these commands makes it: ` +
      `${this.command} --slide ${slide} --report slide_${slide}, or, for all slides: ${this.command} --view`;
    return null;
  }

  cell(parent, slide) {
    const cell = append(parent, 'td', '', 'number');
    if (!this.has(slide)) cell.textContent = slide;
    else Object.assign(append(cell, 'a', `${slide}`), { href: this.place(slide), target: '_blank', title: 'replay' });
  }
}

function section(title, place = 'study') {
  const element = append(byId(place), 'section');
  append(element, 'h2', title);
  return element;
}

// Strata without slides have no rate yet.
const rateOf = ({ success_rate: rate }) => (rate === null ? 'unknown rate' : percent(rate));

function addRate(summary, isComplete, total) {
  const element = section('Success');
  const interval = summary.success_rate_95_percent;
  const range = interval ? ` (95 % interval: ${percent(interval[0])} to ${percent(interval[1])})` : '';
  const weighted = summary.strata ? ', weighted by their strata' : '';
  const of = isComplete ? `${summary.slides} slides` : `the ${summary.slides} slides that are done, of ${total}`;
  append(element, 'p', `${rateOf(summary)}${range}: ${summary.successes} of ${of} succeed${weighted}.`, 'rate');
  if (summary.success_rate !== null) {
    const [least, greatest] = interval ?? [summary.success_rate, summary.success_rate];
    addBar(append(element, 'div', '', 'track'), least, greatest, summary.success_rate);
  }
  const list = append(element, 'ul');
  for (const [outcome, count] of Object.entries(summary.outcomes)) append(list, 'li', `${outcome}: ${count}`, 'plain');
}

function addBar(track, least, greatest, mean) {
  const bar = append(track, 'div', '', 'range');
  bar.style.left = `${100 * least}%`;
  bar.style.width = `${100 * (greatest - least)}%`;
  if (mean !== null) append(track, 'div', '', 'mean').style.left = `${100 * mean}%`;
}

// The numbers in a text, with three digits.
function rounded(text) {
  return text.split(' ').map((word) => (Number.isNaN(Number(word)) ? word : `${Number(Number(word).toPrecision(3))}`)).join(' ');
}

// A bar from the least to the greatest success rate in the bins of each parameter.
function addTornado(summary) {
  const element = section('On what success depends');
  append(element, 'p', 'Success rate from the worst to the best values of each parameter. The line is the rate of all slides.');
  const table = append(append(element, 'div', '', 'wide'), 'table', '', 'rows tornado');
  const head = append(append(table, 'thead'), 'tr');
  for (const title of ['parameter', 'success rate', 'worst', 'best', 'share of variance']) append(head, 'th', title);
  const body = append(table, 'tbody');
  for (const { name, bins, share_of_variance: share } of summary.parameters) {
    const sorted = [...bins].sort((a, b) => a.success_rate - b.success_rate);
    const [worst, best] = [sorted[0], sorted.at(-1)];
    const row = append(body, 'tr');
    append(row, 'td', name);
    addBar(append(append(row, 'td', '', 'bar-cell'), 'div', '', 'track'), worst.success_rate, best.success_rate, summary.success_rate);
    for (const bin of [worst, best]) append(row, 'td', `${percent(bin.success_rate)} at ${rounded(bin.values)}`);
    append(row, 'td', percent(share), 'number');
  }
  if (summary.parameters.length < 2 || !(summary.success_rate > 0 && summary.success_rate < 1)) return;
  const alone = summary.parameters.reduce((sum, parameter) => sum + parameter.share_of_variance, 0);
  append(element, 'p', `Alone, the parameters explain ${percent(alone)} of the variance together. ` +
    'The rest comes from their combinations: see the map.');
}

const BARS = 40;

// A histogram in steps: how many slides have a greatest force between two values.
function addForces(slides, plots) {
  if (!slides.has('force_max_N')) return;
  const forces = Array.from({ length: slides.count }, (_, row) => slides.at('force_max_N', row));
  const known = forces.filter((force) => force !== null);
  if (known.length === 0) return;
  const greatest = known.reduce((a, b) => Math.max(a, b), 1e-9);
  const counts = [new Array(BARS).fill(0), new Array(BARS).fill(0)];
  forces.forEach((force, row) => {
    if (force !== null) ++counts[slides.succeeds(row) ? 0 : 1][Math.min(BARS - 1, Math.floor(BARS * force / greatest))];
  });
  const x = Array.from({ length: BARS + 1 }, (_, i) => greatest * i / BARS);
  plots.add({
    title: 'Greatest force on the hand', x_label: 'force [N]', y_label: 'slides', counts: true, steps: true, words: [],
    series: ['success', 'failure'].map((name, i) => ({ name, x, y: [...counts[i], counts[i].at(-1)] })),
  });
}

function addWorst(slides, summary, replays) {
  if (summary.greatest_forces.length === 0) return;
  const element = section('Greatest forces');
  const columns = ['force_max_N', 'torque_max_Nm', 'outcome', ...summary.parameters.map(({ name }) => name)].filter((name) => slides.has(name));
  const rowOf = new Map(Array.from({ length: slides.count }, (_, row) => [slides.at('slide', row), row]));
  const table = append(append(element, 'div', '', 'wide'), 'table', '', 'rows worst');
  const head = append(append(table, 'thead'), 'tr');
  for (const title of ['slide', ...columns]) append(head, 'th', title);
  const body = append(table, 'tbody');
  for (const slide of summary.greatest_forces) {
    if (!rowOf.has(slide)) continue;
    const row = append(body, 'tr');
    replays.cell(row, slide);
    for (const column of columns) append(row, 'td', short(slides.at(column, rowOf.get(slide))), 'number');
  }
}

function addJams(summary, replays) {
  if (summary.jams.length === 0) return;
  const element = section('Where slides jam');
  const table = append(append(element, 'div', '', 'wide'), 'table', '', 'rows jams');
  const head = append(append(table, 'thead'), 'tr');
  for (const title of ['objects', 'slides', 'x [mm]', 'y [mm]', 'z [mm]', 'for example']) append(head, 'th', title);
  const body = append(table, 'tbody');
  for (const { objects, slides, mean_m: mean, first_slide: first } of summary.jams) {
    const row = append(body, 'tr');
    append(row, 'td', objects);
    for (const value of [slides, ...mean.map((metres) => Number((1e3 * metres).toFixed(4)))]) append(row, 'td', short(value), 'number');
    replays.cell(row, first);
  }
}

function addFiles(isComplete) {
  if (!isComplete) return;
  const element = section('Files', 'study-rows');
  const list = append(element, 'ul');
  for (const file of ['slides.csv', 'slides.jsonl', 'study.json']) {
    Object.assign(append(append(list, 'li', '', 'plain'), 'a', file), { href: file, download: file });
  }
}

// Draws all of it; `chosen` are the axes of the map and the order of the table, which stay when new rows come.
export function showStudy(data, plots, chosen = {}) {
  for (const place of ['study', 'study-rows']) byId(place).replaceChildren();
  plots.clear();
  if (data.summary.slides === 0) {
    section('No slide is done yet');
    return;
  }
  const slides = new Slides(data.table);
  const replays = new Replays(data);
  addRate(data.summary, data.is_complete, data.slides);
  if (slides.count < data.summary.slides) {
    append(byId('study'), 'p', `Map, histogram and table show ${slides.count} of ${data.summary.slides} slides, chosen at random.`);
  }
  addTornado(data.summary);
  const names = data.summary.parameters.map(({ name }) => name);
  showMap(section('Map'), slides, names, chosen, (slide) => replays.open(slide));
  append(byId('study').lastElementChild, 'p').id = 'replay-note';
  addWorst(slides, data.summary, replays);
  addJams(data.summary, replays);
  addForces(slides, plots);
  new StudyTable(section('All slides', 'study-rows'), slides, replays, chosen);
  addFiles(data.is_complete);
}

const NEW_ROWS_MS = 3000;
const PATIENCE = 10; // times the time that an answer takes

const uses = (place) => byId(place).contains(document.activeElement);

// New rows, where the reader is on the page.
function refresh(data, plots, chosen) {
  const { scrollY } = window;
  document.body.style.minHeight = `${document.body.scrollHeight}px`; // nothing is there for a moment
  showStudy(data, plots, chosen);
  window.scrollTo(0, scrollY);
  document.body.style.minHeight = '';
}

// A server that still runs slides has new rows. While the reader uses a control, the page waits with them.
export function followStudy(data, plots, say) {
  const chosen = {};
  showStudy(data, plots, chosen);
  if (data.is_complete || !data.is_served) return;
  let shown = data;
  const ask = async () => {
    const start = performance.now();
    const answer = await fetch('study_page.json', { cache: 'no-store' }).catch(() => undefined);
    const newest = answer?.ok ? await answer.json() : undefined;
    if (!answer) say('no connection: tries again');
    else if (!newest) say(await answer.text());
    else if (uses('study') || uses('study-rows')) say('new rows come when no control is used');
    else {
      if (newest.summary.slides !== shown.summary.slides || newest.is_complete) refresh(newest, plots, chosen);
      shown = newest;
      say(newest.is_complete ? '' : `${newest.summary.slides} of ${newest.slides} slides are done`);
    }
    if (!shown.is_complete) setTimeout(ask, Math.max(NEW_ROWS_MS, PATIENCE * (performance.now() - start)));
  };
  setTimeout(ask, NEW_ROWS_MS);
}
