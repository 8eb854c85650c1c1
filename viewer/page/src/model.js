// The scene as three.js objects, from the GLB of viewer/scene_model.h.

import { Group, Mesh } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';

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
