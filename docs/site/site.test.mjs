// The site in a browser, from files: at two widths, light and dark, no page is wider than the window, loads anything
// from elsewhere or reports an error; the search finds pages. Pictures: build/screenshots/site.

import assert from 'node:assert/strict';
import { mkdirSync, readdirSync } from 'node:fs';
import test from 'node:test';
import { eventually, launch } from '../../viewer/page/test/harness.mjs';

const SITE = new URL('../../build/site/', import.meta.url);
const SHOTS = new URL('../../build/screenshots/site/', import.meta.url).pathname;
mkdirSync(SHOTS, { recursive: true });

const pages = readdirSync(SITE, { recursive: true })
  .filter((name) => name.endsWith('.html') && !name.startsWith('cpp/') && !name.startsWith('_') && name !== 'index.html')
  .concat('cpp/index.html', 'cpp/classglissade_1_1simulation_1_1Simulation.html');

const SHOWN = ['README.html', 'docs/site/index.html', 'docs/start.html', 'docs/benchmarks.html', 'docs/grasps.html',
  'docs/sliding.html', 'docs/coming_from/fcl.html', 'docs/site/python_reference.html', 'cpp/index.html'];

test('every page fits, alone', async () => {
  const browser = await launch();
  for (const colorScheme of ['light', 'dark']) {
    for (const width of [1280, 390]) {
      const page = await browser.newPage({ viewport: { width, height: 900 }, colorScheme });
      const wrong = [];
      page.on('pageerror', (error) => wrong.push(error.message));
      page.on('request', (request) => { if (!/^(file|data|blob):/.test(request.url())) wrong.push(request.url()); });
      page.on('requestfailed', (request) => wrong.push(`not found: ${request.url()}`));
      for (const name of pages) {
        await page.goto(new URL(name, SITE).href);
        const isDark = await page.evaluate(() => {
          const [red] = getComputedStyle(document.body).backgroundColor.match(/\d+/g);
          return red < 128;
        });
        if (isDark !== (colorScheme === 'dark')) wrong.push(`${name} is ${isDark ? 'dark' : 'light'}`);
        const excess = await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
        if (excess > 0) wrong.push(`${name} is ${excess} pixels too wide`);
        if (SHOWN.includes(name)) await page.screenshot({ path: `${SHOTS}${name.replaceAll('/', '_')}_${colorScheme}_${width}.png` });
      }
      assert.deepEqual(wrong, [], `${colorScheme}, ${width} pixels`);
      await page.close();
    }
  }
  await browser.close();
});

test('the search works without a server', async () => {
  const browser = await launch();
  const page = await browser.newPage();
  await page.goto(new URL('search.html?q=ghost', SITE).href);
  const links = await eventually(() => page.evaluate(() => {
    const found = [...document.querySelectorAll('ul.search a')].map((link) => link.textContent);
    return found.length > 3 ? found : undefined;
  }));
  assert.ok(links.some((title) => title.includes('Concepts')), links.join(', '));
  await browser.close();
});
