// The scene as three.js objects, from the GLB of viewer/scene_model.h.

import { Box3, Group, Mesh, Vector3 } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';

// Touching bodies are micrometres apart, fewer than the grid of a large mesh has: what moves is drawn so much smaller, in
// metres, that nothing seems to be inside of anything.
const INSET = 30e-6;

function inset(node) {
  for (const child of node.children) {
    const box = new Box3();
    child.traverse(({ geometry }) => {
      if (!geometry) return;
      geometry.computeBoundingBox();
      box.union(geometry.boundingBox);
    });
    if (box.isEmpty()) continue;
    const size = box.getSize(new Vector3()).multiply(child.scale);
    const factor = new Vector3(...size.toArray().map((length) => Math.max(0.98, 1 - (2 * INSET) / Math.max(length, 1e-9))));
    const centre = box.getCenter(new Vector3()).multiply(child.scale);
    child.position.add(centre.clone().sub(centre.multiply(factor)));
    child.scale.multiply(factor);
  }
}

// One version of the scene, coarse or whole.
export class Model {
  constructor(scene) {
    this.group = scene;
    this.info = scene.userData;
    this.objects = [];
    this.parts = new Map(); // by number
    this.segments = []; // { node, hand, link }
    this.triangles = 0;
    for (const node of scene.children) {
      const { kind, part, hand, link } = node.userData;
      if (kind === 'segment') this.segments.push({ node, hand, link });
      else this.objects.push(node);
      if (part !== undefined) this.parts.set(part, node);
      if (kind !== 'fixed') inset(node);
      node.traverse((child) => {
        if (!(child instanceof Mesh)) return;
        child.userData.owner = node;
        this.triangles += child.geometry.index.count / 3;
      });
    }
  }
}

export async function parseModel(buffer) {
  const gltf = await new GLTFLoader().parseAsync(buffer, '');
  return new Model(gltf.scene);
}

// A copy of a part whose meshes share their geometry.
export function copyOf(node, material) {
  const copy = new Group();
  for (const child of node.children) {
    child.traverse((original) => {
      if (!(original instanceof Mesh)) return;
      const mesh = new Mesh(original.geometry, material);
      mesh.position.copy(child.position);
      mesh.scale.copy(child.scale);
      copy.add(mesh);
    });
  }
  return copy;
}
