// The three-dimensional view.

import {
  ArrowHelper, Box3, CircleGeometry, Color, DirectionalLight, GridHelper, Group, HemisphereLight,
  LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial, MeshLambertMaterial, PerspectiveCamera, Plane, Quaternion,
  Raycaster, Scene, Sphere, SphereGeometry, Vector2, Vector3, WebGLRenderer, DoubleSide,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { cssColor, onSchemeChange } from './colors.js';
import { Detail } from './detail.js';
import { copyOf } from './model.js';
import { length, pictureOf } from './frame.js';

const MOST_CONTACTS = 24;
const MOST_PATCHES = 8;

export const VIEWS = {
  front: [0, -1, 0], back: [0, 1, 0], left: [-1, 0, 0], right: [1, 0, 0], top: [0, -1e-3, 1], corner: [0.8, -1, 0.6],
};

function setPose(object, pose) {
  object.position.set(...pose.p);
  object.quaternion.set(...pose.q);
}

export class Stage {
  constructor(canvas) {
    this.canvas = canvas;
    this.renderer = new WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
    this.scene = new Scene();
    this.camera = new PerspectiveCamera(40, 1, 0.001, 100);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.addEventListener('change', () => this.touched());
    this.plane = new Plane(new Vector3(-1, 0, 0), 0);
    this.bounds = new Sphere(new Vector3(), 1);
    this.box = new Box3(new Vector3(-1, -1, -1), new Vector3(1, 1, 1)); // until there is a scene
    this.shown = { ghosts: true, contacts: true, forces: true, edges: true, through: false };
    this.detail = new Detail();
    this.isDirty = true;
    this.materials = this.makeMaterials();
    this.addLights();
    this.addMarkers();
    onSchemeChange(() => this.recolor());
    this.recolor();
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    this.resize();
  }

  makeMaterials() {
    const solid = () => new MeshLambertMaterial({ side: DoubleSide });
    const ghost = new MeshLambertMaterial({ side: DoubleSide, transparent: true, opacity: 0.28, depthWrite: false });
    return {
      fixed: solid(), held: solid(), loose: solid(), moving: solid(), skin: solid(), ghost,
      edge: new LineBasicMaterial({ transparent: true, opacity: 0.55 }),
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
      marker.arrow = new ArrowHelper(new Vector3(0, 0, 1), new Vector3(), 1);
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
    for (const marker of this.contacts) marker.arrow.setColor(new Color(cssColor('contact')));
    for (const { force, torque } of this.forces) {
      force.setColor(new Color(cssColor('force')));
      torque.setColor(new Color(cssColor('torque')));
    }
    if (this.grid) this.addGrid();
    this.isDirty = true;
  }

  resize() {
    const { clientWidth, clientHeight } = this.canvas.parentElement;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    this.camera.updateProjectionMatrix();
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
      const helper = new ArrowHelper(new Vector3(0, 0, 1), new Vector3(), 1, new Color(cssColor(name)));
      helper.visible = false;
      // Seen through everything: what the hand feels must not hide in the part.
      for (const mesh of [helper.line, helper.cone]) {
        mesh.material.depthTest = false;
        mesh.renderOrder = 10;
      }
      this.scene.add(helper);
      return helper;
    };
    this.forces = Array.from({ length: hands }, () => ({ force: arrow('force'), torque: arrow('torque') }));
  }

  addGrid() {
    if (this.grid) this.scene.remove(this.grid);
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
      marker.arrow.setDirection(new Vector3(...contact.n).normalize());
      marker.arrow.setLength(0.09 * size, 0.03 * size, 0.015 * size);
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
    arrow.setDirection(new Vector3(...vector).normalize());
    arrow.setLength(reach, Math.min(0.3 * reach, 0.06 * this.bounds.radius), Math.min(0.15 * reach, 0.03 * this.bounds.radius));
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
    const box = this.focus ? new Box3().expandByObject(this.focus) : this.box;
    const bounds = box.getBoundingSphere(new Sphere());
    const direction = new Vector3(...(VIEWS[view] ?? this.camera.position.clone().sub(this.controls.target).toArray()));
    direction.normalize();
    const distance = this.distanceToFit(direction, box);
    this.controls.target.copy(bounds.center);
    this.camera.position.copy(bounds.center).addScaledVector(direction, distance);
    this.camera.near = this.bounds.radius / 500;
    this.camera.far = 20 * (distance + this.bounds.radius);
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.touched();
  }

  // From where, seen along `direction`, the corners of the box just fit into the picture.
  distanceToFit(direction, box) {
    const right = new Vector3().crossVectors(this.camera.up, direction).normalize();
    const up = new Vector3().crossVectors(direction, right);
    const tanY = Math.tan(0.5 * this.camera.fov * (Math.PI / 180)) / 1.08;
    const tanX = tanY * this.camera.aspect;
    const center = box.getCenter(new Vector3());
    let distance = 0.02 * this.bounds.radius;
    for (let i = 0; i < 8; ++i) {
      const corner = new Vector3(...[0, 1, 2].map((axis) => ((i >> axis) & 1 ? box.max : box.min).getComponent(axis)));
      corner.sub(center);
      const near = corner.dot(direction);
      distance = Math.max(distance, near + Math.abs(corner.dot(right)) / tanX, near + Math.abs(corner.dot(up)) / tanY);
    }
    return distance;
  }

  // By keyboard: angles in radians about the target, or a factor of the distance.
  orbit(azimuth, elevation) {
    const offset = this.camera.position.clone().sub(this.controls.target);
    offset.applyAxisAngle(this.camera.up, azimuth);
    const side = new Vector3().crossVectors(this.camera.up, offset).normalize();
    const turned = offset.clone().applyAxisAngle(side, -elevation);
    const angle = turned.angleTo(this.camera.up);
    if (angle > 0.02 && angle < Math.PI - 0.02) offset.copy(turned);
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
    this.touched();
  }

  zoom(factor) {
    const offset = this.camera.position.clone().sub(this.controls.target).multiplyScalar(factor);
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
    this.touched();
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

  touched() {
    this.detail.moved();
    this.isDirty = true;
  }

  // Draws if something has changed.
  render() {
    const showsWhole = this.whole !== undefined && this.detail.showsWhole(performance.now());
    if (this.coarse && showsWhole === this.coarse.group.visible) this.isDirty = true;
    if (!this.isDirty) return;
    if (this.coarse) this.coarse.group.visible = !showsWhole;
    if (this.whole) this.whole.group.visible = showsWhole;
    this.isDirty = false;
    if (showsWhole) this.drawWhole();
    else this.draw();
    this.detail.drew(performance.now());
  }

  draw() {
    this.renderer.render(this.scene, this.camera);
  }

  drawWhole() {
    this.waitForPicture();
    const start = performance.now();
    this.draw();
    this.waitForPicture();
    this.detail.drewWhole(performance.now() - start);
  }

  // The graphics card draws on its own time, unless somebody wants to know a pixel.
  waitForPicture() {
    const gl = this.renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  }
}
