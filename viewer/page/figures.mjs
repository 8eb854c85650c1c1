// Figures of the models that the program grasp_models writes, drawn in a browser.

import { readFile } from 'node:fs/promises';
import { join } from 'node:path';
import { build } from 'esbuild';

const here = new URL('./', import.meta.url);

async function htmlOfFigures() {
  const bundle = await build({
    entryPoints: [new URL('figure.js', here).pathname], bundle: true, format: 'esm', target: 'es2022', write: false,
  });
  const palette = await readFile(new URL('src/palette.css', here), 'utf8');
  const script = bundle.outputFiles[0].text.replaceAll('</script', '<\\/script');
  return `<html class="figure"><style>${palette}</style><div style="width: 100px; height: 100px"><canvas id="canvas"></canvas></div>` +
    `<script type="module">${script}</script>`;
}

// The figures of a folder of models. Each is a picture with at most 64 colours, as `indexedPng` writes it.
export class Figures {
  static async open(browser, folder) {
    const figures = new Figures();
    figures.folder = folder;
    figures.list = JSON.parse(await readFile(join(folder, 'figures.json'), 'utf8'));
    figures.page = await browser.newPage({ colorScheme: 'light' });
    await figures.page.setContent(await htmlOfFigures());
    return figures;
  }

  async draw(moments, view) {
    const read = async ({ name, links }) => ({ bytes: await readFile(join(this.folder, `${name}.glb`), 'base64'), links });
    return this.page.evaluate(([models, how]) => window.drawFigure(models, how), [await Promise.all(moments.map(read)), view]);
  }

  // A hand and its object, from the side from which most of the segments that touch are in sight.
  grasp({ name, touching, up_W }) {
    return this.draw([{ name, links: { touching } }], { up: up_W, size: 200 });
  }

  // The open hand from the side of the palm: the kinds of its segments.
  hand() {
    return this.draw([this.list.hand], { up: [1, 0, 0], towards: [0, 0, -1], size: 320 });
  }

  // How a hand closes: the visible hand, and its target translucent.
  clasp() {
    const moments = this.list.clasp.map(({ name, touching }) => ({ name, links: { touching } }));
    return this.draw(moments, { towards: [0, 0.94, 0.34], size: 220 });
  }
}
