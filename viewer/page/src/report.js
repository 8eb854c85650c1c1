// The data of a report, and the link between its plots and the view.

import { decodeFrames } from './frame.js';

function bytesOf(id) {
  const text = atob(document.getElementById(id).textContent.trim());
  return Uint8Array.from(text, (character) => character.charCodeAt(0)).buffer;
}

export function isReport() {
  return document.getElementById('report-frames') !== null;
}

export function reportData() {
  const hasWhole = document.getElementById('report-whole-model') !== null;
  return {
    model: bytesOf('report-model'),
    wholeModel: hasWhole ? bytesOf('report-whole-model') : undefined,
    frames: decodeFrames(bytesOf('report-frames')),
  };
}

// A click on a plot over time goes to that moment, and a line shows the moment in all plots. A plot says in data-from,
// data-to, data-left, data-right, data-top and data-bottom which times in seconds lie where in its drawing.
export class LinkedPlots {
  constructor(timeline) {
    this.timeline = timeline;
    this.plots = [...document.querySelectorAll('svg[data-from]')].map((svg) => this.link(svg));
  }

  link(svg) {
    const place = Object.fromEntries(['from', 'to', 'left', 'right', 'top', 'bottom'].map((key) => [key, Number(svg.dataset[key])]));
    const line = document.createElementNS('http://www.w3.org/2000/svg', 'line');
    line.setAttribute('class', 'moment');
    line.setAttribute('y1', place.top);
    line.setAttribute('y2', place.bottom);
    svg.append(line);
    const seek = (event) => {
      const box = svg.getBoundingClientRect();
      const x = ((event.clientX - box.left) / box.width) * svg.viewBox.baseVal.width;
      const share = Math.min(Math.max((x - place.left) / (place.right - place.left), 0), 1);
      this.timeline.seek(this.timeline.first + place.from + share * (place.to - place.from));
    };
    svg.addEventListener('pointerdown', (event) => {
      svg.setPointerCapture(event.pointerId);
      seek(event);
    });
    svg.addEventListener('pointermove', (event) => {
      if (event.buttons & 1) seek(event);
    });
    return { line, place };
  }

  show() {
    const { frame } = this.timeline;
    if (!frame) return;
    const time = frame.time - this.timeline.first;
    for (const { line, place } of this.plots) {
      const share = (time - place.from) / (place.to - place.from);
      const x = place.left + Math.min(Math.max(share, 0), 1) * (place.right - place.left);
      line.setAttribute('x1', x);
      line.setAttribute('x2', x);
    }
  }
}
