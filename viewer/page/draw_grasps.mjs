// Draws the figures of docs/grasps.md and docs/grasping.md: node draw_grasps.mjs MODELS IMAGES, the folder that the
// program grasp_models has filled, and docs/images.

import { mkdir, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { Figures } from './figures.mjs';
import { indexedPng } from './png.mjs';
import { launch } from './test/harness.mjs';

const [models, images] = process.argv.slice(2);

const browser = await launch();
const figures = await Figures.open(browser, models);
await mkdir(join(images, 'grasps'), { recursive: true });
const save = async (name, figure) => writeFile(join(images, `${name}.png`), indexedPng(await figure));
await save('grasping_hand', figures.hand());
await save('grasping_clasp', figures.clasp());
for (const grasp of figures.list.grasps) await save(`grasps/${grasp.name}`, figures.grasp(grasp));
await browser.close();
