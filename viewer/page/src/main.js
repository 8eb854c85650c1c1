import './language.js';
import { Connection } from './connection.js';
import { Controls } from './controls.js';
import { byId } from './dom.js';
import { parseModel } from './model.js';
import { isReport, makeTablesSortable, replayData, ReportPlots } from './report.js';
import { Stage } from './stage.js';
import { rowsOf, rowsOfObject, showRows } from './status.js';
import { Strips } from './strips.js';
import { followStudy, studyData } from './study.js';
import { Timeline } from './timeline.js';

class Page {
  constructor(timeline) {
    this.timeline = timeline;
    this.stage = new Stage(byId('canvas'));
    this.controls = new Controls(this.stage, timeline, (node) => this.pick(node));
    this.isNew = true;
    timeline.onChange(() => { this.isNew = true; });
    this.lastTime = performance.now();
    requestAnimationFrame((time) => this.tick(time));
  }

  setModel(model) {
    this.info = model.info;
    this.picked = this.stage.focus = undefined;
    this.stage.setModel(model);
    if (this.timeline.isLive) {
      byId('title').textContent = this.info.title;
      document.title = `${this.info.title} · Glissade`;
    }
    byId('scale').textContent = `grid ${mm(this.stage.gridStep)}, 1 N ${mm(this.stage.metresPerNewton)}, ` +
      `1 Nm ${mm(this.stage.metresPerNewtonMetre)}`;
    byId('wait').hidden = true;
    this.strips?.make(this.info);
    this.isNew = true;
  }

  pick(node) {
    this.picked = this.stage.focus = node;
    this.isNew = true;
  }

  tick(time) {
    requestAnimationFrame((next) => this.tick(next));
    this.timeline.advance(Math.min((time - this.lastTime) / 1000, 0.1));
    this.lastTime = time;
    const { frame } = this.timeline;
    if (this.isNew && this.info) {
      this.isNew = false;
      if (frame) {
        this.stage.show(frame);
        showRows(byId('status'), rowsOf(frame, this.info, this.plots === undefined));
      }
      byId('object').hidden = !this.picked;
      if (this.picked) showRows(byId('picked'), [rowsOfObject(this.picked, frame, this.info)]);
      this.controls.show();
      this.plots?.show();
    }
    this.strips?.drawSometimes();
    this.stage.render();
  }
}

function mm(metres) {
  return metres >= 1 ? `${metres} m` : `${Number((1e3 * metres).toPrecision(3))} mm`;
}

function say(text) {
  byId('state').textContent = text;
}

async function showReport() {
  document.body.classList.add('report');
  say('');
  makeTablesSortable();
  const replay = replayData();
  const timeline = new Timeline(replay?.frames);
  const plots = new ReportPlots(timeline); // also where there is no WebGL for the rest
  byId('viewer').hidden = !replay;
  const study = studyData();
  if (study) followStudy(study, plots, say);
  if (!replay) return undefined;
  const page = new Page(timeline);
  page.plots = plots;
  page.setModel(await parseModel(replay.model));
  if (replay.wholeModel) page.stage.setWholeModel(await parseModel(replay.wholeModel));
  return page;
}

async function load(name) {
  const answer = await fetch(name, { cache: 'no-store' });
  if (answer.status === 202) return undefined; // it is being made
  if (!answer.ok) throw new Error(`${name}: ${answer.status}`);
  return parseModel(await answer.arrayBuffer());
}

// The rest of a model that was made smaller, when it is there.
async function loadWhole(page) {
  const { coarse } = page.stage;
  if (coarse.triangles >= page.info.triangles) return;
  for (let whole; !whole && page.stage.coarse === coarse;) {
    await new Promise((resolve) => setTimeout(resolve, 500));
    whole = await load('whole_model.glb');
    if (whole && page.stage.coarse === coarse) page.stage.setWholeModel(whole);
  }
}

const STATES = {
  connected: 'connected',
  ended: 'ended: waits for the next run',
  lost: 'no connection: tries again',
};

function showLive() {
  const page = new Page(new Timeline());
  page.strips = new Strips(byId('strips'), page.timeline);
  let newest = performance.now();
  // Another server may be there after the last one: its scene and its run take the place of what was.
  const prepare = async () => {
    const model = await load('model.glb');
    page.timeline.clear();
    page.setModel(model);
    loadWhole(page).catch((error) => {
      if (page.isConnected) say(`the whole scene could not be loaded: ${error.message}`);
    });
  };
  const onFrame = (frame) => {
    newest = performance.now();
    page.timeline.push(frame);
  };
  const onState = (state) => {
    page.isConnected = state === 'connected';
    newest = performance.now();
    say(STATES[state]);
    document.body.classList.toggle('lost', state === 'lost');
  };
  new Connection(prepare, onFrame, onState);
  setInterval(() => {
    const seconds = Math.floor((performance.now() - newest) / 1000);
    if (page.isConnected) say(seconds < 2 ? 'connected' : `connected, nothing new for ${seconds} s`);
  }, 500);
  return page;
}

// For tests and the curious: what is shown, in world axes about the scene's origin.
function inspect(page) {
  const shownBy = (arrow) => (arrow.visible ? arrow.direction().multiplyScalar(arrow.length).toArray() : undefined);
  const poseOf = (node) => ({ p: node.position.toArray(), q: node.quaternion.toArray(), visible: node.visible });
  return () => ({
    isConnected: page.isConnected ?? false,
    isLive: page.timeline.isLive,
    frames: page.timeline.frames.length,
    frame: page.stage.frame,
    info: page.info,
    triangles: page.stage.coarse?.triangles ?? 0,
    wholeTriangles: page.stage.whole?.triangles ?? 0,
    isFine: page.stage.isFine,
    showsWhole: page.stage.whole?.group.visible ?? false,
    parts: [...(page.stage.coarse?.parts ?? [])].map(([number, node]) => ({ number, ...poseOf(node) })),
    ghosts: [...(page.stage.ghostOf ?? [])].map(([number, node]) => ({ number, ...poseOf(node) })),
    segments: (page.stage.coarse?.segments ?? []).map(({ node, hand, link }) => ({ hand, link, ...poseOf(node) })),
    contacts: page.stage.contacts.filter((marker) => marker.visible)
      .map((marker) => ({ p: marker.position.toArray(), n: marker.arrow.direction().toArray() })),
    patches: page.stage.patches.filter((disc) => disc.visible)
      .map((disc) => ({ p: disc.position.toArray(), radius: disc.scale.x })),
    forces: page.stage.forces.map(({ force, torque }) => ({ force: shownBy(force), torque: shownBy(torque) })),
    metresPerNewton: page.stage.metresPerNewton,
    metresPerNewtonMetre: page.stage.metresPerNewtonMetre,
    drawCalls: page.stage.renderer.info.render.calls,
  });
}

try {
  const page = isReport() ? await showReport() : showLive();
  if (page) window.glissade = { inspect: inspect(page), page };
} catch (error) {
  byId('wait').textContent = `The scene cannot be shown: ${error.message}`;
  say('no picture');
}
