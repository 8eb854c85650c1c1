// From where the scene is seen.

import { Box3, Mesh, PerspectiveCamera, Sphere, Vector3 } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';

export const VIEWS = {
  front: [0, -1, 0], back: [0, 1, 0], left: [-1, 0, 0], right: [1, 0, 0], top: [0, -1e-3, 1], corner: [0.8, -1, 0.6],
};

// Round all meshes of a node, at its present pose.
function sphereOf(node) {
  const sphere = new Sphere().makeEmpty();
  node.updateWorldMatrix(false, true);
  node.traverse((child) => {
    if (!(child instanceof Mesh)) return;
    if (!child.geometry.boundingSphere) child.geometry.computeBoundingSphere();
    sphere.union(child.geometry.boundingSphere.clone().applyMatrix4(child.matrixWorld));
  });
  return sphere;
}

export class Eye {
  // Calls `onChange()` when it has moved.
  constructor(canvas, onChange) {
    this.onChange = onChange;
    this.camera = new PerspectiveCamera(40, 1, 0.001, 100);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.addEventListener('change', onChange);
  }

  // Sees all of the box, in a scene with this radius; from a direction of VIEWS, or as before.
  fit(view, box, radius) {
    const bounds = box.getBoundingSphere(new Sphere());
    const direction = new Vector3(...(VIEWS[view] ?? this.camera.position.clone().sub(this.controls.target).toArray()));
    direction.normalize();
    const distance = this.distanceToFit(direction, box, radius);
    this.controls.target.copy(bounds.center);
    this.camera.position.copy(bounds.center).addScaledVector(direction, distance);
    this.controls.update();
    this.onChange();
  }

  // From where, seen along `direction`, the corners of the box just fit into the picture.
  distanceToFit(direction, box, radius) {
    const right = new Vector3().crossVectors(this.camera.up, direction).normalize();
    const up = new Vector3().crossVectors(direction, right);
    const tanY = Math.tan(0.5 * this.camera.fov * (Math.PI / 180)) / 1.08;
    const tanX = tanY * this.camera.aspect;
    const center = box.getCenter(new Vector3());
    let distance = 0.02 * radius;
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
    this.onChange();
  }

  zoom(factor) {
    const offset = this.camera.position.clone().sub(this.controls.target).multiplyScalar(factor);
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
    this.onChange();
  }

  // The nearest depth is as far away as it may be: parts that touch are micrometres apart, and the nearer it is, the
  // coarser are the depths of a picture.
  setDepths(nodes, grid, bounds) {
    const { camera } = this;
    const gaps = nodes.map((node) => {
      const sphere = sphereOf(node);
      return camera.position.distanceTo(sphere.center) - sphere.radius;
    });
    if (grid) gaps.push(new Box3().setFromObject(grid).distanceToPoint(camera.position));
    const away = camera.position.distanceTo(bounds.center);
    const inCorners = 0.7; // of a picture, depth per distance, at least
    camera.near = Math.max(bounds.radius / 500, inCorners * Math.min(away, ...gaps));
    camera.far = 20 * (away + bounds.radius);
    camera.updateProjectionMatrix();
  }
}
