// An arrow with a shaft that has a thickness: a line of one pixel is hard to see.

import { ConeGeometry, CylinderGeometry, Group, Mesh, MeshBasicMaterial, Vector3 } from 'three';

const UP = new Vector3(0, 1, 0); // along both geometries
const SHAFT = new CylinderGeometry(1, 1, 1, 8).translate(0, 0.5, 0);
const HEAD = new ConeGeometry(1, 1, 12).translate(0, -0.5, 0);

export class Arrow extends Group {
  constructor(material = new MeshBasicMaterial()) {
    super();
    this.material = material;
    this.shaft = new Mesh(SHAFT, material);
    this.head = new Mesh(HEAD, material);
    this.add(this.shaft, this.head);
  }

  // `direction` has length 1. The head is a third as wide as it is long.
  point(direction, length, headLength) {
    this.quaternion.setFromUnitVectors(UP, direction);
    this.shaft.scale.set(0.09 * headLength, length - 0.5 * headLength, 0.09 * headLength);
    this.head.scale.set(headLength / 3, headLength, headLength / 3);
    this.head.position.y = length;
  }

  get length() { return this.head.position.y; }

  direction() { return UP.clone().applyQuaternion(this.quaternion); }

  // Seen through everything.
  showThrough() {
    this.material.depthTest = false;
    for (const mesh of this.children) mesh.renderOrder = 10;
  }
}
