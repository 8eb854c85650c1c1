// Buttons and keys.

import { VIEWS } from './eye.js';

const TURN = Math.PI / 24;
const PRESS = [' ', 'Enter'];
const ARROWS = ['ArrowLeft', 'ArrowRight', 'ArrowUp', 'ArrowDown'];

// Whether the element does something by itself when the key is pressed.
function takesKey(element, key) {
  if (element.closest('select')) return true; // letters choose of it
  if (element.closest('input[type="range"]')) return ARROWS.includes(key);
  return element.closest('button, input, summary, a') !== null && PRESS.includes(key);
}

export class Controls {
  constructor(stage, timeline, onPick) {
    this.stage = stage;
    this.timeline = timeline;
    this.byId = (id) => document.getElementById(id);
    this.addTimeButtons();
    this.addViewButtons();
    this.addSection();
    this.addPicking(onPick);
    this.addKeys(onPick);
  }

  addTimeButtons() {
    const { timeline, byId } = this;
    byId('play').addEventListener('click', () => this.playOrPause());
    byId('back').addEventListener('click', () => timeline.step(-1));
    byId('forward').addEventListener('click', () => timeline.step(1));
    byId('live').addEventListener('click', () => timeline.goLive());
    byId('time').addEventListener('input', (event) => {
      timeline.isPlaying = false;
      timeline.seek(timeline.first + Number(event.target.value));
    });
  }

  playOrPause() {
    const { timeline } = this;
    if (timeline.isLive || timeline.isPlaying) timeline.pause();
    else timeline.play();
  }

  addViewButtons() {
    for (const name of Object.keys(VIEWS))
      this.byId(`view-${name}`).addEventListener('click', () => this.stage.fit(name));
    this.byId('fit').addEventListener('click', () => this.stage.fit());
    for (const what of ['ghosts', 'contacts', 'forces', 'edges', 'through'])
      this.byId(`show-${what}`).addEventListener('change', (event) => this.stage.setShown(what, event.target.checked));
  }

  addSection() {
    const axis = this.byId('section-axis');
    const place = this.byId('section-place');
    const flip = this.byId('section-flip');
    const update = () => {
      const isOff = axis.value === '';
      place.disabled = flip.disabled = isOff;
      this.stage.setSection(isOff ? null : Number(axis.value), Number(place.value), flip.checked);
    };
    for (const input of [axis, place, flip]) input.addEventListener('input', update);
    update();
  }

  addPicking(onPick) {
    const { canvas } = this.stage;
    let down;
    canvas.addEventListener('pointerdown', (event) => { down = [event.offsetX, event.offsetY]; });
    canvas.addEventListener('pointerup', (event) => {
      if (!down || Math.hypot(event.offsetX - down[0], event.offsetY - down[1]) > 4) return;
      onPick(this.stage.pick(event.offsetX, event.offsetY));
    });
  }

  addKeys(onPick) {
    const { stage, timeline } = this;
    const keys = {
      ' ': () => this.playOrPause(),
      ',': () => timeline.step(-1),
      '.': () => timeline.step(1),
      l: () => this.byId('live').click(),
      n: () => onPick(stage.neighborOfFocus(1)),
      p: () => onPick(stage.neighborOfFocus(-1)),
      Escape: () => onPick(undefined),
      f: () => stage.fit(),
      g: () => this.byId('show-ghosts').click(),
      c: () => this.byId('show-contacts').click(),
      a: () => this.byId('show-forces').click(),
      e: () => this.byId('show-edges').click(),
      x: () => this.byId('show-through').click(),
      '+': () => stage.eye.zoom(1 / 1.15),
      '-': () => stage.eye.zoom(1.15),
      ArrowLeft: () => stage.eye.orbit(-TURN, 0),
      ArrowRight: () => stage.eye.orbit(TURN, 0),
      ArrowUp: () => stage.eye.orbit(0, TURN),
      ArrowDown: () => stage.eye.orbit(0, -TURN),
    };
    Object.keys(VIEWS).forEach((name, i) => { keys[`${i + 1}`] = () => stage.fit(name); });
    document.addEventListener('keydown', (event) => {
      const key = event.key.length === 1 ? event.key.toLowerCase() : event.key; // with Caps Lock, letters are upper-case
      if (event.ctrlKey || event.metaKey || event.altKey || !keys[key]) return;
      if (takesKey(event.target, key)) return;
      event.preventDefault();
      keys[key]();
    });
  }

  show() {
    const { timeline, byId } = this;
    const time = byId('time');
    const span = timeline.last - timeline.first;
    const now = timeline.frame ? timeline.frame.time - timeline.first : 0;
    time.max = span;
    time.value = now;
    time.disabled = timeline.frames.length === 0;
    const text = `${now.toFixed(2)} of ${span.toFixed(2)} s`;
    time.setAttribute('aria-valuetext', text);
    byId('clock').textContent = text;
    const runs = timeline.isLive || timeline.isPlaying;
    byId('play').textContent = runs ? 'Pause' : 'Play';
    byId('live').setAttribute('aria-pressed', timeline.isLive);
  }
}
