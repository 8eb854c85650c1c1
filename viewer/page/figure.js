// Draws models of hands and their objects as figures, with the view of the page. Runs in a browser; figures.mjs bundles it.

import gifenc from 'gifenc';
import {
  Box3, Color, DoubleSide, LineSegments, Matrix4, Mesh, MeshBasicMaterial, MeshLambertMaterial, Vector3,
} from 'three';
import { cssColor } from './src/colors.js';
import { parseModel } from './src/model.js';
import { Stage } from './src/stage.js';

const { applyPalette, quantize } = gifenc;
const FRAME_M = 0.012; // round the hands
const THUMBNAIL = 80; // pixels
const SMOOTH = 4; // drawn pixels for one of the figure, in each direction
const COLORS = 64; // of a figure, so that its file is small
const UP = new Vector3(0, 0, 1);

const stage = new Stage(document.getElementById('canvas'));
stage.camera.fov = 10; // nearly a parallel projection

function all(nodes, kind) {
  const found = [];
  for (const node of nodes) node.traverse((child) => { if (child instanceof kind) found.push(child); });
  return found;
}

// Takes the place of the model before. The vertical `up` is that of the picture.
function show(model, up) {
  model.group.quaternion.setFromUnitVectors(up, UP);
  stage.setModel(model);
  stage.grid.visible = false;
  for (const { node } of model.segments) node.visible = true;
  for (const line of all([model.group], LineSegments)) line.visible = false;
}

const CLOSER = -6000; // about a millimetre

function material(color, options) {
  return new MeshLambertMaterial({ color: new Color(cssColor(color)), side: DoubleSide, ...options });
}

// `links` has the numbers of the links of the first hand that have a colour of their own, by the name of the colour in the
// style sheet. A second hand, the target, is seen through the object, and where it is not in the first one.
function paint(model, links) {
  // Segments overlap at their joints: those with a colour of their own are shown there.
  const own = new Map(Object.entries(links).flatMap(([color, numbers]) => {
    const made = material(color, { polygonOffset: true, polygonOffsetUnits: CLOSER });
    return numbers.map((link) => [link, made]);
  }));
  const target = material('target', {
    transparent: true, opacity: 0.5, polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: -2 * CLOSER,
  });
  const hasTarget = model.segments.some(({ hand }) => hand > 0);
  const object = hasTarget ? material('held', { transparent: true, opacity: 0.55, depthWrite: false }) : stage.materials.held;
  for (const mesh of all(model.objects, Mesh)) {
    mesh.material = object;
    mesh.renderOrder = 1; // after what is seen through it
  }
  for (const line of all(model.objects, LineSegments)) line.visible = true;
  for (const { node, hand, link } of model.segments)
    for (const mesh of all([node], Mesh)) mesh.material = hand > 0 ? target : own.get(link) ?? stage.materials.skin;
}

// Each object and link in a grey of its own, so that a pixel tells whose it is.
const OBJECT = -1;
function greyOf(link) {
  return 8 * (link - OBJECT);
}

function paintGrey(model) {
  const paintNode = (node, link) => {
    const [grey, side] = [greyOf(link), DoubleSide];
    for (const mesh of all([node], Mesh)) mesh.material = new MeshBasicMaterial({ color: `rgb(${grey}, ${grey}, ${grey})`, side });
  };
  for (const node of model.objects) paintNode(node, OBJECT);
  for (const { node, link } of model.segments) paintNode(node, link);
}

function cornersOfHands({ group, segments }) {
  group.updateMatrixWorld(true);
  return all(segments.map(({ node }) => node), Mesh).flatMap(({ geometry: { attributes: { position } }, matrixWorld }) =>
    Array.from({ length: position.count }, (_, i) => new Vector3().fromBufferAttribute(position, i).applyMatrix4(matrixWorld)));
}

// The camera sees all corners in a square picture; the eye is in the direction `towards`.
function look(corners, towards) {
  const { camera } = stage;
  const toWorld = new Matrix4().lookAt(towards, new Vector3(), UP);
  const toView = toWorld.clone().invert();
  const box = new Box3().setFromPoints(corners.map((corner) => corner.clone().applyMatrix4(toView)));
  const size = box.getSize(new Vector3());
  const center = box.getCenter(new Vector3()).applyMatrix4(toWorld);
  const distance = (0.5 * Math.max(size.x, size.y) + FRAME_M) / Math.tan((0.5 * camera.fov * Math.PI) / 180);
  camera.position.copy(center).addScaledVector(towards, distance);
  camera.lookAt(center);
  const sky = stage.scene.children.find((child) => child.isHemisphereLight);
  sky.position.copy(towards).add(UP); // no side that is looked at is dark, also from below
}

function draw(size, smooth) {
  stage.renderer.setPixelRatio(smooth);
  stage.renderer.setSize(size, size, false);
  stage.draw();
  return stage.canvas;
}

function paper(width, height) {
  const context = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
  context.imageSmoothingQuality = 'high';
  return context;
}

// Slightly aside of the axes, so that no side of a box is seen edge-on.
function directions() {
  const steps = [-1, 0, 1];
  const places = steps.flatMap((x) => steps.flatMap((y) => steps.map((z) => [x, y, z]))).filter((place) => place.some((i) => i !== 0));
  return places.map(([x, y, z]) => new Vector3(x + 0.13, y + 0.21, z + 0.17).normalize()).filter(({ z }) => Math.abs(z) < 0.95);
}

// How much of a thumbnail shows what, by its grey.
function sharesOf(thumbnail) {
  const { data } = thumbnail.getImageData(0, 0, THUMBNAIL, THUMBNAIL);
  const shares = new Array(256).fill(0);
  for (let i = 0; i < data.length; i += 4) shares[data[i]] += 1 / THUMBNAIL ** 2;
  return shares;
}

// The direction to the eye from which most of the links with a colour, and the object, are in sight.
function bestDirection(model, corners, colored) {
  paintGrey(model);
  const thumbnail = paper(THUMBNAIL, THUMBNAIL);
  const scored = directions().map((towards) => {
    look(corners, towards);
    thumbnail.drawImage(draw(THUMBNAIL, 1), 0, 0);
    const shares = sharesOf(thumbnail);
    let score = Math.min(1, shares[greyOf(OBJECT)] / 0.05);
    for (const { link } of model.segments) score += shares[greyOf(link)];
    for (const link of colored) score += Math.min(1, shares[greyOf(link)] / 0.012);
    return { towards, score };
  });
  return scored.reduce((best, here) => (here.score > best.score ? here : best)).towards;
}

function bytesOf(base64) {
  return Uint8Array.from(atob(base64), (character) => character.charCodeAt(0)).buffer;
}

// A picture of models side by side, seen in the same way: their bytes in base64, and the links with a colour of their own.
// `up` and `towards`, the direction to the eye, are in the axes of the models. Without `towards`, these links of the first
// model are seen best.
window.drawFigure = async (moments, { up = [0, 0, 1], towards, size }) => {
  const vertical = new Vector3(...up).normalize();
  const shown = await Promise.all(moments.map(async ({ bytes, links }) => ({ model: await parseModel(bytesOf(bytes)), links })));
  for (const { model } of shown) show(model, vertical);
  const corners = shown.flatMap(({ model }) => cornersOfHands(model));
  const [first] = shown;
  const direction = towards
    ? new Vector3(...towards).normalize().applyQuaternion(first.model.group.quaternion)
    : bestDirection(first.model, corners, Object.values(first.links).flat());
  look(corners, direction);
  const picture = paper(size * shown.length, size);
  shown.forEach(({ model, links }, i) => {
    show(model, vertical);
    paint(model, links);
    picture.drawImage(draw(size, SMOOTH), size * i, 0, size, size);
  });
  const { data, width, height } = picture.getImageData(0, 0, size * shown.length, size);
  const palette = quantize(data, COLORS);
  return { width, height, palette, pixels: [...applyPalette(data, palette)] };
};
