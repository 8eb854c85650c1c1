// Makes dist/index.html, the whole page in one file: node build.mjs [--check], which only compares.

import { readFile, writeFile } from 'node:fs/promises';
import { build } from 'esbuild';

const source = new URL('./src/', import.meta.url);
const target = new URL('./dist/index.html', import.meta.url);

const bundle = await build({
  entryPoints: [new URL('main.js', source).pathname],
  bundle: true,
  minify: true,
  format: 'esm',
  target: 'es2022',
  legalComments: 'inline',
  // uPlot's sources have no comment that the bundle would keep.
  banner: { js: `/*! uPlot\n${await readFile(new URL('./node_modules/uplot/LICENSE', import.meta.url), 'utf8')}*/` },
  charset: 'utf8',
  write: false,
});

// What would end the script early, and what String.replace would take for a pattern.
const script = bundle.outputFiles[0].text.replaceAll('</script', '<\\/script');
const styles = ['./node_modules/uplot/dist/uPlot.min.css', './src/palette.css', './src/style.css'];
const style = (await Promise.all(styles.map((file) => readFile(new URL(file, import.meta.url), 'utf8')))).join('\n');
const page = (await readFile(new URL('index.html', source), 'utf8'))
  .replace('<!--style-->', () => `<style>\n${style}</style>`)
  .replace('<!--script-->', () => `<script type="module">\n${script}</script>`);

if (process.argv.includes('--check')) {
  if (page !== (await readFile(target, 'utf8'))) {
    console.error('viewer/page/dist/index.html is not what the sources make: run scripts/build_page');
    process.exit(1);
  }
} else {
  await writeFile(target, page);
  console.log(`viewer/page/dist/index.html: ${Math.round(page.length / 1024)} KiB`);
}
