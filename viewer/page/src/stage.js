// The three-dimensional view.

import {
  Box3, CircleGeometry, Color, DirectionalLight, GridHelper, Group, HemisphereLight,
  LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial, MeshLambertMaterial, Plane, Quaternion,
  Raycaster, Scene, Sphere, SphereGeometry, Vector2, Vector3, WebGLRenderer, DoubleSide,
} from 'three';
import { Arrow } from './arrow.js';
import { cssColor, onSchemeChange } from './colors.js';
import { Detail } from './detail.js';
import { Eye } from './eye.js';
import { copyOf } from './model.js';
import { length, pictureOf } from './frame.js';

const MOST_CONTACTS = 24;
const MOST_PATCHES = 8;

function setPose(object, pose) {
  object.position.set(...pose.p);
  object.quaternion.set(...pose.q);
}

export class Stage {
  constructor(canvas) {
    this.canvas = canvas;
    this.renderer = new WebGLRenderer({ canvas, preserveDrawingBuffer: true });
    this.scene = new Scene();
    this.eye = new Eye(canvas, () => this.touched());
    this.camera = this.eye.camera;
    this.plane = new Plane(new Vector3(-1, 0, 0), 0);
    this.bounds = new Sphere(new Vector3(), 1);
    this.box = new Box3(new Vector3(-1, -1, -1), new Vector3(1, 1, 1)); // until there is a scene
    this.shown = { ghosts: true, contacts: true, forces: true, edges: true, through: false };
    this.detail = new Detail();
    this.isDirty = true;
    this.materials = this.makeMaterials();
    this.setFine(true);
    this.addLights();
    this.addMarkers();
    onSchemeChange(() => this.recolor());
    this.recolor();
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    this.resize();
  }

  makeMaterials() {
    const solid = () => new MeshLambertMaterial({ side: DoubleSide });
    const edge = new LineBasicMaterial({ transparent: true });
    // A little nearer than they are, so that edges lie on top. Faces stay where they are: an offset of faces grows with
    // their slope, which is not the same for all triangles of a plane, and bodies that touch are micrometres apart.
    edge.onBeforeCompile = (shader) => {
      shader.vertexShader = shader.vertexShader.replace(
        '#include <project_vertex>', '#include <project_vertex>\n\tgl_Position.z -= 1e-4 * gl_Position.w;');
    };
    const ghost = new MeshLambertMaterial({ side: DoubleSide, transparent: true, opacity: 0.28, depthWrite: false });
    return {
      fixed: solid(), held: solid(), loose: solid(), moving: solid(), skin: solid(), ghost,
      edge,
      contact: new MeshBasicMaterial(),
      // Over the faces that touch there.
      patch: new MeshBasicMaterial({ side: DoubleSide, transparent: true, opacity: 0.22, depthWrite: false, depthTest: false }),
    };
  }

  addLights() {
    // One light from above, one from beside the eye: no side that is looked at is dark.
    const sky = new HemisphereLight(0xffffff, 0x8a8a99, 1.5);
    sky.position.set(0, 0, 1);
    const lamp = new DirectionalLight(0xffffff, 1.6);
    lamp.position.set(-0.6, 0.8, 1);
    this.camera.add(lamp, lamp.target);
    this.scene.add(sky, this.camera);
  }

  addMarkers() {
    this.ghosts = new Group();
    this.contacts = Array.from({ length: MOST_CONTACTS }, () => {
      const marker = new Group();
      marker.add(new Mesh(new SphereGeometry(1, 12, 8), this.materials.contact));
      marker.arrow = new Arrow(this.materials.contact);
      marker.add(marker.arrow);
      marker.visible = false;
      this.scene.add(marker);
      return marker;
    });
    this.patches = Array.from({ length: MOST_PATCHES }, () => {
      const disc = new Mesh(new CircleGeometry(1, 48), this.materials.patch);
      disc.visible = false;
      this.scene.add(disc);
      return disc;
    });
    this.forces = []; // by hand: { force, torque }
    this.scene.add(this.ghosts);
  }

  recolor() {
    for (const name of ['fixed', 'held', 'loose', 'moving', 'skin', 'edge', 'contact'])
      this.materials[name].color = new Color(cssColor(name));
    this.materials.patch.color = new Color(cssColor('contact'));
    this.materials.ghost.color = new Color(cssColor('held'));
    this.scene.background = new Color(cssColor('stage'));
    for (const { force, torque } of this.forces) {
      force.material.color = new Color(cssColor('force'));
      torque.material.color = new Color(cssColor('torque'));
    }
    if (this.grid) this.addGrid();
    this.isDirty = true;
  }

  resize() {
    const { clientWidth, clientHeight } = this.canvas.parentElement;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    this.isDirty = true;
  }

  // A fine picture has more pixels than the screen, which smooths all edges. Lines are a pixel wide: of a fine one, they
  // are thinner.
  setFine(isFine) {
    this.isFine = isFine;
    this.renderer.setPixelRatio(isFine ? Math.min(2 * devicePixelRatio, 3) : Math.min(devicePixelRatio, 2));
    this.materials.edge.opacity = isFine ? 0.9 : 0.55;
    this.isDirty = true;
  }

  // The first model of a scene takes the place of the one before; `whole` is added to it.
  setModel(model) {
    for (const old of [this.coarse, this.whole]) if (old) this.dispose(old);
    const isOther = this.coarse?.info.title !== model.info.title;
    this.whole = undefined;
    this.coarse = model;
    this.paint(model);
    this.scene.add(model.group);
    this.measure(model);
    this.addGhosts(model);
    this.addForces(model.info.hands.length);
    this.addGrid();
    if (isOther) this.fit('corner');
    this.isDirty = true;
  }

  dispose(model) {
    this.scene.remove(model.group);
    model.group.traverse((child) => child.geometry?.dispose());
  }

  setWholeModel(model) {
    this.paint(model);
    this.whole = model;
    this.detail.reset(model.triangles);
    this.scene.add(model.group);
    if (this.frame) this.show(this.frame);
    this.isDirty = true;
  }

  paint(model) {
    const names = { fixed: 'fixed', part: 'loose', moving: 'moving', segment: 'skin' };
    for (const node of model.group.children) {
      node.traverse((child) => {
        if (child instanceof Mesh) child.material = this.materials[names[node.userData.kind]];
        if (!(child instanceof LineSegments)) return;
        child.material = this.materials.edge;
        child.visible = this.shown.edges;
        child.raycast = () => {};
      });
    }
    for (const { node } of model.segments) node.visible = false;
  }

  measure(model) {
    const box = new Box3();
    for (const node of model.objects) box.expandByObject(node);
    if (!box.isEmpty()) box.getBoundingSphere(this.bounds);
    this.box = box;
    // A newton and a newton metre as lengths, in round numbers.
    const round = (x) => 10 ** Math.floor(Math.log10(x)) * ([1, 2, 5].findLast((d) => d <= x / 10 ** Math.floor(Math.log10(x))) ?? 1);
    this.metresPerNewton = round(this.bounds.radius / 12);
    this.metresPerNewtonMetre = round(this.bounds.radius / 1.2);
  }

  addGhosts(model) {
    this.ghosts.clear();
    this.ghostOf = new Map();
    for (const [number, node] of model.parts) {
      const ghost = copyOf(node, this.materials.ghost);
      ghost.visible = false;
      this.ghosts.add(ghost);
      this.ghostOf.set(number, ghost);
    }
  }

  addForces(hands) {
    for (const { force, torque } of this.forces) this.scene.remove(force, torque);
    const arrow = (name) => {
      const made = new Arrow(new MeshBasicMaterial({ color: new Color(cssColor(name)) }));
      made.visible = false;
      made.showThrough(); // what the hand feels must not hide in the part
      this.scene.add(made);
      return made;
    };
    this.forces = Array.from({ length: hands }, () => ({ force: arrow('force'), torque: arrow('torque') }));
  }

  addGrid() {
    if (this.grid) {
      this.scene.remove(this.grid);
      this.grid.dispose();
    }
    const step = 10 ** Math.round(Math.log10(this.bounds.radius / 3));
    const count = 2 * Math.ceil((1.6 * this.bounds.radius) / step);
    const color = new Color(cssColor('grid'));
    this.grid = new GridHelper(count * step, count, color, color);
    this.grid.rotation.x = Math.PI / 2;
    this.grid.position.copy(this.bounds.center);
    this.grid.position.z = this.box.isEmpty() ? 0 : this.box.min.z;
    this.scene.add(this.grid);
    this.gridStep = step;
  }

  show(frame) {
    if (!this.coarse) return;
    this.frame = frame;
    const held = new Set(frame.hands.map((hand) => hand.part));
    for (const model of [this.coarse, this.whole]) {
      if (!model) continue;
      for (const [number, node] of model.parts) {
        const part = frame.parts[number];
        if (!part) continue;
        setPose(node, part.visible);
        const name = node.userData.kind === 'moving' ? 'moving' : held.has(number) ? 'held' : 'loose';
        node.traverse((child) => {
          if (child instanceof Mesh) child.material = this.materials[name];
        });
      }
      for (const { node, hand, link } of model.segments) {
        const pose = frame.hands[hand]?.links[link];
        node.visible = pose !== undefined;
        if (pose) setPose(node, pose);
      }
    }
    this.showGhosts(frame, held);
    this.showContacts(frame);
    this.showPatches(frame);
    this.showForces(frame);
    // Frames come while nothing moves, too.
    const picture = pictureOf(frame);
    if (picture !== this.picture) this.touched();
    this.picture = picture;
  }

  showGhosts(frame, held) {
    for (const [number, ghost] of this.ghostOf) {
      const part = frame.parts[number];
      ghost.visible = this.shown.ghosts && part !== undefined && held.has(number);
      if (ghost.visible) setPose(ghost, part.ghost);
    }
  }

  showContacts(frame) {
    const size = this.bounds.radius;
    this.contacts.forEach((marker, i) => {
      const contact = frame.contacts[i];
      marker.visible = this.shown.contacts && contact !== undefined && frame.parts[contact.part] !== undefined;
      if (!marker.visible) return;
      const { p, q } = frame.parts[contact.part].visible;
      marker.position.set(...contact.p).applyQuaternion(new Quaternion(...q)).add(new Vector3(...p));
      marker.children[0].scale.setScalar(0.008 * size);
      marker.arrow.point(new Vector3(...contact.n).normalize(), 0.09 * size, 0.03 * size);
    });
  }

  // A disc in the plane of the contacts, as far as they reach; that of a single contact is small.
  showPatches(frame) {
    this.patches.forEach((disc, i) => {
      const patch = frame.patches[i];
      disc.visible = this.shown.contacts && patch !== undefined && frame.parts[patch.part] !== undefined;
      if (!disc.visible) return;
      const { p, q } = frame.parts[patch.part].visible;
      disc.position.set(...patch.p).applyQuaternion(new Quaternion(...q)).add(new Vector3(...p));
      disc.quaternion.setFromUnitVectors(new Vector3(0, 0, 1), new Vector3(...patch.n).normalize());
      disc.scale.setScalar(Math.max(patch.extent, 0.012 * this.bounds.radius));
    });
  }

  showForces(frame) {
    this.forces.forEach(({ force, torque }, h) => {
      const hand = frame.hands[h];
      const at = hand && this.pointOf(frame, hand);
      this.showArrow(force, at, hand?.force, this.metresPerNewton, 1e-3);
      this.showArrow(torque, at, hand?.torque, this.metresPerNewtonMetre, 1e-4);
    });
  }

  // Where a hand feels its force: at the part that it holds, or at its own root.
  pointOf(frame, hand) {
    const part = frame.parts[hand.part];
    if (part) return part.visible.p;
    return hand.links.length > 0 ? hand.links[0].p : undefined;
  }

  showArrow(arrow, at, vector, metresPerUnit, least) {
    const size = vector ? length(vector) : 0;
    arrow.visible = this.shown.forces && at !== undefined && size > least;
    if (!arrow.visible) return;
    const reach = size * metresPerUnit;
    arrow.position.set(...at);
    arrow.point(new Vector3(...vector).normalize(), reach, Math.min(0.3 * reach, 0.06 * this.bounds.radius));
  }

  setShown(what, isShown) {
    this.shown[what] = isShown;
    if (what === 'through') {
      Object.assign(this.materials.fixed, { transparent: isShown, opacity: isShown ? 0.22 : 1, depthWrite: !isShown });
    }
    if (what === 'edges') {
      for (const model of [this.coarse, this.whole]) {
        model?.group.traverse((child) => {
          if (child instanceof LineSegments) child.visible = isShown;
        });
      }
    }
    if (this.frame) this.show(this.frame);
    this.isDirty = true;
  }

  // `axis` 0, 1 or 2, `share` of the way through the scene; null: no section.
  setSection(axis, share, isFlipped) {
    if (axis === null) {
      this.renderer.clippingPlanes = [];
    } else {
      const normal = new Vector3();
      normal.setComponent(axis, isFlipped ? 1 : -1);
      const min = this.box.min.getComponent(axis);
      const max = this.box.max.getComponent(axis);
      const place = min + share * (max - min);
      this.plane.set(normal, isFlipped ? -place : place);
      this.renderer.clippingPlanes = [this.plane];
    }
    this.touched();
  }

  // The whole scene, or the focus: an object that was picked.
  fit(view) {
    this.eye.fit(view, this.focus ? new Box3().expandByObject(this.focus) : this.box, this.bounds.radius);
  }

  // The object at a point of the canvas, in its pixels.
  pick(x, y) {
    if (!this.coarse) return undefined;
    const { clientWidth, clientHeight } = this.canvas;
    const ray = new Raycaster();
    ray.setFromCamera(new Vector2((2 * x) / clientWidth - 1, 1 - (2 * y) / clientHeight), this.camera);
    const planes = this.renderer.clippingPlanes;
    const hit = ray.intersectObject(this.coarse.group, true).find(
      ({ object, point }) => object.userData.owner?.visible && planes.every((plane) => plane.distanceToPoint(point) >= 0));
    return hit?.object.userData.owner;
  }

  // The object that comes `step` places after the focus in the list of all that can be picked, which is a ring.
  neighborOfFocus(step) {
    const nodes = this.coarse?.group.children.filter((node) => node.visible) ?? [];
    const place = nodes.indexOf(this.focus);
    const start = place < 0 && step < 0 ? 0 : place; // without a focus, the first one or the last one
    return nodes.at((start + step) % nodes.length);
  }

  touched() {
    this.detail.moved();
    this.isDirty = true;
  }

  // Draws if something has changed.
  render() {
    const isFine = this.detail.isFine(performance.now());
    if (isFine !== this.isFine) this.setFine(isFine);
    if (!this.isDirty) return;
    this.isDirty = false;
    if (this.whole) {
      this.whole.group.visible = isFine;
      this.coarse.group.visible = !isFine;
    }
    if (isFine) this.detail.drewFine(this.timed());
    else if (this.detail.isJudged()) this.draw();
    else this.detail.drewQuick(this.timed());
    this.detail.drew(performance.now());
  }

  draw() {
    const nodes = [...this.ghosts.children, ...this.forces.flatMap(({ force, torque }) => [force, torque])];
    if (this.coarse) nodes.push(...this.coarse.objects, ...this.coarse.segments.map(({ node }) => node));
    this.eye.setDepths(nodes.filter((node) => node.visible), this.grid, this.bounds);
    this.renderer.render(this.scene, this.camera);
  }

  // Draws; returns how long that took, in milliseconds.
  timed() {
    this.waitForPicture();
    const start = performance.now();
    this.draw();
    this.waitForPicture();
    return performance.now() - start;
  }

  // The graphics card draws on its own time, unless somebody wants to know a pixel.
  waitForPicture() {
    const gl = this.renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  }
}
