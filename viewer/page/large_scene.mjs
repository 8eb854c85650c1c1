// A scene of many triangles in which a box goes to and fro, for measure_large.mjs.

import { writeFileSync } from 'node:fs';
import { join } from 'node:path';

export const SECONDS = 600; // of the box's way: longer than anybody looks
const PERIOD = 2;
const BOX = '  - {name: box, movable: true, shape: {type: box, size_x_m: 0.05}, pose: {position_m: [0.12, 0, 0]}}';

// Writes a scene into the folder: the box, and fixed balls that have so many triangles together. Returns its path.
export function writeScene(folder, name, { triangles, balls }) {
  const script = ['t_s,x_m,y_m,z_m,qw,qx,qy,qz'];
  for (let t = 0; t <= SECONDS; t += PERIOD / 2) script.push(`${t},0.12,0,${t % PERIOD === 0 ? 0 : 0.05},1,0,0,0`);
  writeFileSync(join(folder, 'to_and_fro.csv'), `${script.join('\n')}\n`);
  const lines = ['script: to_and_fro.csv', 'objects:', BOX];
  for (let i = 0; i < balls; ++i) {
    const position = [0.2 * (i % 5), 0.2 * Math.floor(i / 5), -0.3];
    lines.push(`  - {name: ball_${i}, shape: {type: sphere, radius_m: ${0.05 + 1e-3 * i}, ` +
      `triangles: ${Math.round(triangles / balls)}}, pose: {position_m: [${position}]}}`);
  }
  const path = join(folder, `${name}.yaml`);
  writeFileSync(path, `${lines.join('\n')}\n`);
  return path;
}

// For so many seconds: how many frames with a new pose of the box are shown in a second.
export function posesShown(page, seconds) {
  return page.evaluate((duration) => new Promise((resolve) => {
    const { stage } = window.glissade.page;
    const start = performance.now();
    let last;
    let count = 0;
    const next = () => {
      const place = stage.coarse.parts.get(0).position.toArray().join();
      if (place !== last) ++count;
      last = place;
      const passed = (performance.now() - start) / 1000;
      if (passed < duration) requestAnimationFrame(next);
      else resolve(count / passed);
    };
    requestAnimationFrame(next);
  }), seconds);
}
